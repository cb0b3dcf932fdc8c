//! A report on one device and its motion: a single HTML file that prints on one page and needs nothing else.

use std::fmt::Write as _;

use super::markup::escape;
use super::number::{exact, typographic};
use super::{Figure, Provenance, svg};
use crate::model::Parameter;

/// The report's own words, in the language of the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Words {
    /// The language (ISO 639).
    pub language: &'static str,
    /// Before the headline, in the title.
    pub report: &'static str,
    /// Before limits that are broken.
    pub beyond: &'static str,
    /// Before limits that are kept.
    pub within: &'static str,
    /// Heading of the device.
    pub device: &'static str,
    /// Heading of the variants.
    pub variants: &'static str,
    /// Heading of the dimensionless numbers.
    pub dimensionless: &'static str,
    /// Names of the parameters, in the order of [`Parameter::ALL`].
    pub parameters: [&'static str; Parameter::ALL.len()],
    /// Modes and force law.
    pub model: String,
}

/// What a report says.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Its own words.
    pub words: Words,
    /// What the motion is, in a few words.
    pub headline: String,
    /// What it gives.
    pub facts: Vec<String>,
    /// What to know about it.
    pub remarks: Vec<String>,
    /// The limits of the device with how they are kept: the check, and whether it holds.
    pub limits: Vec<(String, bool)>,
    /// The device in SI units: name, symbol, value with unit.
    pub device: Vec<[String; 3]>,
    /// The present design beside the pinned ones: a row with their names, and for each row of numbers its name and a cell for each;
    /// empty where nothing is pinned.
    pub variants: Vec<Vec<String>>,
    /// Plots, each of one card.
    pub plots: Vec<Vec<Figure>>,
    /// Side and dark modules (column, row) of the link's QR code, where it has one.
    pub code: Option<(usize, Vec<(usize, usize)>)>,
    /// What it was computed from.
    pub provenance: Provenance,
}

/// Width of a plot in pixels: small, so that its texts are as large as those of the page when two stand side by side.
const PLOT: f64 = 480.0;

/// One A4 page; on screens as wide as that.
const STYLE: &str = "
@page { size: A4; margin: 9mm }
* { box-sizing: border-box }
body { margin: 0 auto; max-width: 192mm; color: #141a20; background: #fff;
  font: 8.5pt/1.3 'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif }
header { display: flex; gap: 6mm; justify-content: space-between; border-bottom: .4mm solid #141a20; padding-bottom: 2mm }
h1 { font-size: 15pt; margin: 0 } h2 { font-size: 10pt; margin: 3mm 0 1mm }
p { margin: 0 0 .8mm } .weak, footer { color: #556270 } .bad { color: #b31540; font-weight: 600 }
.tables { display: grid; grid-template-columns: 5fr 3fr; gap: 6mm }
.device { columns: 2; column-gap: 6mm }
table { border-collapse: collapse; width: 100%; font-size: 8pt; line-height: 1.2 }
td { padding: .25mm 0; border-bottom: .1mm solid #e2e7ec } td:last-child { text-align: right; white-space: nowrap }
.variants td:last-child { text-align: left; white-space: normal } .variants td { padding-right: 3mm }
.plots { display: grid; grid-template-columns: 1fr 1fr; gap: 0 3mm; margin-top: 1mm }
.plots svg { width: 100%; height: auto; display: block } .plots figure { margin: 0; break-inside: avoid }
.code { width: 24mm; height: 24mm; flex: none } a { color: inherit; overflow-wrap: anywhere }
footer { margin-top: 2mm; font-size: 7pt }
@media screen { body { padding: 8mm 5mm } }
@media (max-width: 600px) { .plots, .tables { grid-template-columns: 1fr } .device { columns: 1 } }
";

/// The report as HTML that is also well-formed XML.
pub fn html(report: &Report) -> String {
    let mut out = String::with_capacity(1 << 17);
    let _ = write!(
        out,
        "<!DOCTYPE html>\n<html lang=\"{}\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{}: {}</title>\n\
         <style>{}</style>\n</head>\n<body>\n<header>\n<div>\n<h1>{}</h1>\n",
        report.words.language,
        escape(report.words.report),
        escape(&report.headline),
        escape(STYLE).replace("&gt;", ">"),
        escape(&report.headline)
    );
    paragraph(&mut out, "", &report.facts.join(" · "));
    paragraph(&mut out, " class=\"weak\"", &report.remarks.join(" · "));
    for (holds, class, word) in
        [(false, " class=\"bad\"", report.words.beyond), (true, "", report.words.within)]
    {
        let checks = report.limits.iter().filter(|(_, kept)| *kept == holds);
        let checks: Vec<&str> = checks.map(|(text, _)| text.as_str()).collect();
        if !checks.is_empty() {
            paragraph(&mut out, class, &format!("{word}: {}", checks.join(" · ")));
        }
    }
    out.push_str("</div>\n");
    if let Some((side, modules)) = &report.code {
        code(&mut out, *side, modules);
    }
    out.push_str("</header>\n<div class=\"tables\">\n<section>\n");
    heading(&mut out, report.words.device);
    out.push_str("<div class=\"device\">\n<table>\n");
    for [name, symbol, value] in &report.device {
        row(&mut out, name, symbol, value);
    }
    out.push_str("</table>\n</div>\n</section>\n<section>\n");
    heading(&mut out, report.words.dimensionless);
    out.push_str("<table>\n");
    for (parameter, name) in Parameter::ALL.into_iter().zip(report.words.parameters) {
        let value = typographic(&exact(report.provenance.scenario.parameters.get(parameter)));
        let fact = parameter.fact();
        row(&mut out, name, fact.symbol, format!("{value} {}", fact.shown.0).trim_end());
    }
    out.push_str("</table>\n");
    paragraph(&mut out, " class=\"weak\"", &report.words.model);
    out.push_str("\n</section>\n</div>\n");
    variants(&mut out, report);
    out.push_str("<div class=\"plots\">\n");
    for (number, plot) in report.plots.iter().enumerate() {
        // Identifiers are of the whole page here.
        let (drawing, _) = svg::drawing_with(plot, &[], PLOT, &format!("f{number}"));
        let _ = writeln!(out, "<figure>{drawing}</figure>");
    }
    out.push_str("</div>\n<footer>\n");
    paragraph(&mut out, "", &report.provenance.caption());
    let link = escape(&report.provenance.link);
    let _ = write!(out, "<p><a href=\"{link}\">{link}</a></p>\n</footer>\n</body>\n</html>\n");
    out
}

fn paragraph(out: &mut String, attributes: &str, text: &str) {
    if !text.is_empty() {
        let _ = writeln!(out, "<p{attributes}>{}</p>", escape(text));
    }
}

fn row(out: &mut String, name: &str, symbol: &str, value: &str) {
    let [name, symbol, value] = [name, symbol, value].map(escape);
    let _ = writeln!(out, "<tr><td>{name}</td><td>{symbol}</td><td>{value}</td></tr>");
}

/// The designs side by side.
fn variants(out: &mut String, report: &Report) {
    if report.variants.is_empty() {
        return;
    }
    heading(out, report.words.variants);
    out.push_str("<table class=\"variants\">\n");
    for cells in &report.variants {
        let cells: String = cells.iter().map(|cell| format!("<td>{}</td>", escape(cell))).collect();
        let _ = writeln!(out, "<tr>{cells}</tr>");
    }
    out.push_str("</table>\n");
}

fn heading(out: &mut String, text: &str) {
    let _ = writeln!(out, "<h2>{}</h2>", escape(text));
}

fn code(out: &mut String, side: usize, modules: &[(usize, usize)]) {
    let mut path = String::new();
    for (column, row) in modules {
        let _ = write!(path, "M{column} {row}h1v1h-1z");
    }
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"code\" viewBox=\"-4 -4 {0} {0}\" role=\"img\" \
         shape-rendering=\"crispEdges\"><title>QR code of the link</title><path d=\"{path}\"/></svg>",
        side + 8
    );
}
