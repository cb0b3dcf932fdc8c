//! What the browser tells of the screen and the hand.

/// Whether fingers, rather than a mouse, are what the screen is for.
pub(super) fn has_coarse_pointer() -> bool {
    let query = web_sys::window().and_then(|window| window.match_media("(pointer: coarse)").ok().flatten());
    query.is_some_and(|query| query.matches())
}
