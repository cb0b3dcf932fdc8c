//! The typefaces of the app: subsets of Inter for text and numbers, of DejaVu Sans for a few signs Inter lacks.
//!
//! Chinese comes from a font that is fetched when that language is chosen; only the name of the language is always there.
//! egui's own fonts are compiled out. How the subsets were made is in `assets/fonts/README.md`.
//! Digits all have one width in both weights, so a changing number does not make its neighbours jitter.

use std::sync::Arc;

use egui::epaint::text::{FontData, FontDefinitions, FontFamily, FontId};

const REGULAR: &[u8] = include_bytes!("../../assets/fonts/Inter-Regular-subset.ttf");
const SEMIBOLD: &[u8] = include_bytes!("../../assets/fonts/Inter-SemiBold-subset.ttf");
const SYMBOLS: &[u8] = include_bytes!("../../assets/fonts/DejaVuSans-symbols.ttf");
const NAME: &[u8] = include_bytes!("../../assets/fonts/DroidSansFallback-name.ttf");

/// Name under which the heavier weight is registered.
const SEMIBOLD_FAMILY: &str = "semibold";

/// Every character beyond Basic Latin and Latin-1 that texts of the app may use. A test holds the fonts to it.
pub const SPECIAL_GLYPHS: &str = "αβγδεζηθικλμνξοπρστυφχψωΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩϕ\
    ₀₁₂₃₄₅₆₇₈₉ᵢₖₙₑ₊₋⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿẋẏż·×÷−±≈≠≤≥√∞∂∫∑∆∝∈π°′″…–—‘’“”•→←↑↓↔▸▾▴◂●○◆▲▼■⊕✓✕⟲⟳";

/// Makes these fonts the only ones of `context`. Call it before the first frame.
pub fn install(context: &egui::Context, ideographs: Option<&Arc<FontData>>) {
    context.set_fonts(definitions(ideographs));
}

/// The fonts and the order in which a character is looked up in them.
pub fn definitions(ideographs: Option<&Arc<FontData>>) -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    for (name, bytes) in [("regular", REGULAR), ("semibold", SEMIBOLD), ("symbols", SYMBOLS)] {
        fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(bytes)));
    }
    let last = ideographs.cloned().unwrap_or_else(|| Arc::new(FontData::from_static(NAME)));
    fonts.font_data.insert("ideographs".to_owned(), last);
    let chain = |names: &[&str]| {
        names.iter().chain(&["ideographs"]).map(|name| (*name).to_owned()).collect::<Vec<_>>()
    };
    fonts.families.insert(FontFamily::Proportional, chain(&["regular", "symbols"]));
    fonts.families.insert(FontFamily::Monospace, chain(&["regular", "symbols"]));
    // The heavier weight has what titles need; the rest comes from the normal one.
    let heavier = chain(&["semibold", "regular", "symbols"]);
    fonts.families.insert(FontFamily::Name(SEMIBOLD_FAMILY.into()), heavier);
    fonts
}

/// The normal weight at `size` points.
pub fn regular(size: f32) -> FontId {
    FontId::new(size, FontFamily::Proportional)
}

/// The heavier weight, for titles and selected things, at `size` points.
pub fn semibold(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(SEMIBOLD_FAMILY.into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_fonts<R>(read: impl FnOnce(&mut egui::epaint::text::FontsView<'_>) -> R) -> R {
        let context = egui::Context::default();
        install(&context, None);
        let output = context.run_ui(egui::RawInput::default(), |_| {});
        output.drop_without_applying_deltas();
        context.fonts_mut(read)
    }

    #[test]
    fn every_glyph_is_there_in_both_weights() {
        with_fonts(|fonts| {
            let latin = (0x20..0x7f_u32).chain(0xa1..0xad).chain(0xae..0x100).filter_map(char::from_u32);
            for glyph in latin.chain(SPECIAL_GLYPHS.chars()) {
                for font in [regular(14.0), semibold(14.0)] {
                    assert!(fonts.has_glyph(&font, glyph), "{glyph:?} missing in {font:?}");
                }
            }
        });
    }

    #[test]
    fn digits_are_tabular() {
        with_fonts(|fonts| {
            for font in [regular(64.0), semibold(64.0)] {
                let zero = fonts.glyph_width(&font, '0');
                for digit in '1'..='9' {
                    let width = fonts.glyph_width(&font, digit);
                    assert!((width - zero).abs() < 1e-3, "{digit} is {width}, 0 is {zero}");
                }
            }
        });
    }

    #[test]
    fn fonts_stay_small() {
        assert!(REGULAR.len() + SEMIBOLD.len() + SYMBOLS.len() + NAME.len() < 90_000);
    }
}
