//! Corner radii in points.

/// Cards and dialogues.
pub const CARD: u8 = 8;
/// Fields, buttons and pills.
pub const CONTROL: u8 = 6;
