//! The sets of colours: dark and light, each also with high contrast.
//!
//! This is the only place with colours of the page. A theme is known by its page colour (`Tokens::in_force`), so that panels need no more than `theme::tokens(ui)`. The
//! palette's tests hold contrast (WCAG 2.2) and difference: kinds of motion, which fill areas, differ by CIEDE2000 10
//! for normal sight and for simulated protanopia, deuteranopia and tritanopia; curves and marks of one plot differ by
//! line style or mark. A new series or plot belongs into the table of that test. The shell's style sheets follow by
//! `data-look`.

use egui::{Color32, Stroke, Visuals};

/// Every colour of one theme, by what it is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tokens {
    /// Whether this is the dark theme.
    pub dark: bool,
    /// Whether everything is told apart by more than shades, for those who need high contrast.
    pub contrast: bool,
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
    /// The tokens of the dark or the light theme, with high contrast or without.
    pub fn of(dark: bool, contrast: bool) -> &'static Self {
        match (dark, contrast) {
            (true, false) => &DARK,
            (false, false) => &LIGHT,
            (true, true) => &BLACK,
            (false, true) => &WHITE,
        }
    }

    /// Those that were made a style of, known by the colour behind everything.
    pub(super) fn in_force(visuals: &Visuals) -> &'static Self {
        let contrast = [&BLACK, &WHITE].iter().any(|tokens| tokens.page == visuals.panel_fill);
        Self::of(visuals.dark_mode, contrast)
    }

    /// Another number for each theme, below four: pictures are made anew when it changes.
    pub fn number(&self) -> u64 {
        u64::from(self.dark) | u64::from(self.contrast) << 1
    }

    /// The line around what other themes tell apart by its shade.
    pub fn edge(&self) -> Stroke {
        if self.contrast { Stroke::new(1.0, self.outline) } else { Stroke::NONE }
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
    contrast: false,
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
    warning: rgb(0xda_9427),
    danger: rgb(0xff_7590),
    ok: rgb(0x4f_cfa3),
    grid: rgb(0x2b_343f),
    ruler: rgb(0x5b_6877),
    numeric: rgb(0x5b_b2fb),
    theory: rgb(0xf8_a63a),
    published: rgb(0xf8_a63a),
    coupled: rgb(0x4f_cfa3),
    exact: rgb(0xff_9dd2),
    poincare: rgb(0xb8_92ff),
    ghost: rgb(0x74_818f),
};

/// The light theme.
pub const LIGHT: Tokens = Tokens {
    dark: false,
    contrast: false,
    page: rgb(0xe3_e8ee),
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
    ok: rgb(0x00_684c),
    grid: rgb(0xe4_e9ee),
    ruler: rgb(0x9a_a6b2),
    numeric: rgb(0x00_76cc),
    theory: rgb(0xc9_6100),
    published: rgb(0xc9_6100),
    coupled: rgb(0x00_8566),
    exact: rgb(0xcd_2e6b),
    poincare: rgb(0x75_3bd0),
    ghost: rgb(0x88_949f),
};

/// The dark theme with high contrast.
pub const BLACK: Tokens = Tokens {
    dark: true,
    contrast: true,
    page: rgb(0x00_0000),
    bar: rgb(0x00_0000),
    card: rgb(0x00_0000),
    inset: rgb(0x00_0000),
    field: rgb(0x1a_1a1a),
    hover: rgb(0x33_3333),
    track: rgb(0x6a_6a6a),
    outline: rgb(0xa8_a8a8),
    thumb: rgb(0xff_ffff),
    text_strong: rgb(0xff_ffff),
    text: rgb(0xff_ffff),
    text_weak: rgb(0xdc_dcdc),
    accent: rgb(0x6b_b8ff),
    on_accent: rgb(0x00_0000),
    warning: rgb(0xff_c049),
    danger: rgb(0xff_9aac),
    ok: rgb(0x50_e0a0),
    grid: rgb(0x4a_4a4a),
    ruler: rgb(0xb0_b0b0),
    numeric: rgb(0x6b_b8ff),
    theory: rgb(0xff_b347),
    published: rgb(0xff_b347),
    coupled: rgb(0x50_e0a0),
    exact: rgb(0xfb_76b0),
    poincare: rgb(0xc7_a8ff),
    ghost: rgb(0xe0_e0e0),
};

/// The light theme with high contrast.
pub const WHITE: Tokens = Tokens {
    dark: false,
    contrast: true,
    page: rgb(0xff_ffff),
    bar: rgb(0xff_ffff),
    card: rgb(0xff_ffff),
    inset: rgb(0xff_ffff),
    field: rgb(0xf0_f0f0),
    hover: rgb(0xdc_dcdc),
    track: rgb(0x94_9494),
    outline: rgb(0x50_5050),
    thumb: rgb(0xff_ffff),
    text_strong: rgb(0x00_0000),
    text: rgb(0x00_0000),
    text_weak: rgb(0x33_3333),
    accent: rgb(0x00_4a9e),
    on_accent: rgb(0xff_ffff),
    warning: rgb(0x70_4000),
    danger: rgb(0x9a_0c33),
    ok: rgb(0x00_3510),
    grid: rgb(0xcc_cccc),
    ruler: rgb(0x55_5555),
    numeric: rgb(0x00_66b2),
    theory: rgb(0xa0_4a00),
    published: rgb(0xa0_4a00),
    coupled: rgb(0x00_543c),
    exact: rgb(0xb3_185c),
    poincare: rgb(0x59_1fb7),
    ghost: rgb(0x5a_5a5a),
};

#[cfg(test)]
mod tests;
