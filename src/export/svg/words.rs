//! Texts, colours and their attributes.

use std::fmt::Write as _;

use crate::export::Rgba;
use crate::export::markup::{escape, short};

/// Width of a letter over its size, on average, and for the widest.
const LETTER: f64 = 0.52;

pub(super) fn text(
    out: &mut String,
    [x, y]: [f64; 2],
    size: f64,
    colour: Rgba,
    anchor: &str,
    more: &str,
    words: &str,
) {
    let _ = writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{}{more}>{}</text>",
        short(x),
        short(y),
        filled(colour),
        escape(words.trim())
    );
}

/// About how wide a text is: fonts differ.
pub(super) fn width(words: &str, size: f64) -> f64 {
    LETTER * size * words.chars().count() as f64
}

/// The text in lines of at most `room`.
pub(super) fn wrapped(words: &str, room: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ') {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) < room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

pub(super) fn hex([r, g, b, _]: Rgba) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// An opacity as an attribute; none when opaque.
pub(super) fn opacity(what: &str, colour: Rgba) -> String {
    if colour[3] == 255 {
        String::new()
    } else {
        format!(" {what}=\"{}\"", short(f64::from(colour[3]) / 255.0))
    }
}

pub(super) fn filled(colour: Rgba) -> String {
    format!(" fill=\"{}\"{}", hex(colour), opacity("fill-opacity", colour))
}

pub(super) fn stroke(colour: Rgba, width: f64) -> String {
    let opacity = opacity("stroke-opacity", colour);
    format!(" stroke=\"{}\"{opacity} stroke-width=\"{}\"", hex(colour), short(width))
}
