//! The two sets of colours.

use egui::Color32;

/// Every colour of one theme, by what it is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tokens {
    /// Whether this is the dark theme.
    pub dark: bool,
    /// Behind everything.
    pub page: Color32,
    /// Top bar and side panel.
    pub bar: Color32,
    /// Cards and dialogues.
    pub card: Color32,
    /// Sunken areas within a card.
    pub inset: Color32,
    /// Text fields, buttons, fold headers.
    pub field: Color32,
    /// The same under the pointer, and the selected tab.
    pub hover: Color32,
    /// The part of a slider's track that is not filled, and strong outlines.
    pub track: Color32,
    /// Hairlines between and around areas.
    pub outline: Color32,
    /// Slider thumbs.
    pub thumb: Color32,
    /// Titles, values, names.
    pub text_strong: Color32,
    /// Running text.
    pub text: Color32,
    /// Hints, symbols, units, tick labels.
    pub text_weak: Color32,
    /// Filled track, selection, focus ring, links.
    pub accent: Color32,
    /// Text on `accent`.
    pub on_accent: Color32,
    /// Caution: resonance marks, a period-doubled answer.
    pub warning: Color32,
    /// Errors, and results outside a model's validity.
    pub danger: Color32,
    /// Success: converged, stable.
    pub ok: Color32,
    /// Grid lines of plots.
    pub grid: Color32,
    /// Axis-zero lines and the cursor's rulers.
    pub ruler: Color32,
    /// Computed trajectories and time histories.
    pub numeric: Color32,
    /// First-order theory, as dots over the numerics.
    pub theory: Color32,
    /// Published stability boundaries.
    pub published: Color32,
    /// Coupled-mode stability boundary.
    pub coupled: Color32,
    /// Boundary from Floquet multipliers of the full system.
    pub exact: Color32,
    /// Poincaré points.
    pub poincare: Color32,
    /// Pinned curves for comparison, and faint transients.
    pub ghost: Color32,
}

impl Tokens {
    /// The tokens of the dark or the light theme.
    pub fn of(dark: bool) -> &'static Self {
        if dark { &DARK } else { &LIGHT }
    }

    /// `colour` as a translucent tint for areas under curves and behind notices.
    pub fn tint(&self, colour: Color32) -> Color32 {
        colour.gamma_multiply(if self.dark { 0.17 } else { 0.11 })
    }
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

/// The dark theme.
pub const DARK: Tokens = Tokens {
    dark: true,
    page: rgb(0x0f_1317),
    bar: rgb(0x15_1a20),
    card: rgb(0x1b_2128),
    inset: rgb(0x13_181e),
    field: rgb(0x27_303b),
    hover: rgb(0x32_3d4a),
    track: rgb(0x3b_4653),
    outline: rgb(0x2a_333e),
    thumb: rgb(0xf1_f4f7),
    text_strong: rgb(0xf2_f5f8),
    text: rgb(0xd0_d8e0),
    text_weak: rgb(0x9c_a8b5),
    accent: rgb(0x56_adff),
    on_accent: rgb(0x05_1423),
    warning: rgb(0xf5_ad42),
    danger: rgb(0xff_7590),
    ok: rgb(0x4f_cfa3),
    grid: rgb(0x2b_343f),
    ruler: rgb(0x5b_6877),
    numeric: rgb(0x5a_b1fa),
    theory: rgb(0xf8_a63a),
    published: rgb(0xf8_a63a),
    coupled: rgb(0x4f_cfa3),
    exact: rgb(0xf0_6a9b),
    poincare: rgb(0xb8_92ff),
    ghost: rgb(0x74_818f),
};

/// The light theme.
pub const LIGHT: Tokens = Tokens {
    dark: false,
    page: rgb(0xeb_eff3),
    bar: rgb(0xfb_fcfd),
    card: rgb(0xff_ffff),
    inset: rgb(0xf3_f6f9),
    field: rgb(0xed_f1f5),
    hover: rgb(0xdd_e5ed),
    track: rgb(0xc6_d0da),
    outline: rgb(0xd9_e0e8),
    thumb: rgb(0xff_ffff),
    text_strong: rgb(0x0f_161e),
    text: rgb(0x2b_3642),
    text_weak: rgb(0x55_6270),
    accent: rgb(0x0a_66c2),
    on_accent: rgb(0xff_ffff),
    warning: rgb(0x8f_5200),
    danger: rgb(0xb3_1540),
    ok: rgb(0x00_6b4f),
    grid: rgb(0xe4_e9ee),
    ruler: rgb(0x9a_a6b2),
    numeric: rgb(0x0b_6dc9),
    theory: rgb(0xc9_6100),
    published: rgb(0xc9_6100),
    coupled: rgb(0x00_8566),
    exact: rgb(0xc8_2668),
    poincare: rgb(0x75_3bd0),
    ghost: rgb(0x88_949f),
};

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(colour: Color32) -> f64 {
        let linear = |channel: u8| {
            let value = f64::from(channel) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(colour.r()) + 0.7152 * linear(colour.g()) + 0.0722 * linear(colour.b())
    }

    fn contrast(first: Color32, second: Color32) -> f64 {
        let (first, second) = (luminance(first), luminance(second));
        (first.max(second) + 0.05) / (first.min(second) + 0.05)
    }

    #[test]
    fn text_is_legible_everywhere_it_is_drawn() {
        for tokens in [&DARK, &LIGHT] {
            for back in [tokens.page, tokens.bar, tokens.card, tokens.inset, tokens.field] {
                for text in [
                    tokens.text_strong,
                    tokens.text,
                    tokens.text_weak,
                    tokens.accent,
                    tokens.warning,
                    tokens.danger,
                    tokens.ok,
                ] {
                    let ratio = contrast(text, back);
                    assert!(ratio >= 4.5, "{text:?} on {back:?} (dark: {}): {ratio:.2}", tokens.dark);
                }
            }
            for text in [tokens.text_strong, tokens.text] {
                assert!(contrast(text, tokens.hover) >= 4.5);
            }
            assert!(contrast(tokens.on_accent, tokens.accent) >= 4.5);
        }
    }

    #[test]
    fn curves_stand_out_from_the_card() {
        for tokens in [&DARK, &LIGHT] {
            for curve in [
                tokens.numeric,
                tokens.theory,
                tokens.published,
                tokens.coupled,
                tokens.exact,
                tokens.poincare,
                tokens.ghost,
            ] {
                let ratio = contrast(curve, tokens.card);
                assert!(ratio >= 3.0, "{curve:?} (dark: {}): {ratio:.2}", tokens.dark);
            }
        }
    }
}
