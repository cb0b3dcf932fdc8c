//! A clock to budget work by; the two platforms have different ones.

/// Milliseconds since some fixed moment.
#[cfg(target_arch = "wasm32")]
pub(super) fn milliseconds() -> f64 {
    web_sys::window().and_then(|window| window.performance()).map_or(0.0, |clock| clock.now())
}

/// Milliseconds since some fixed moment.
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn milliseconds() -> f64 {
    static START: std::sync::LazyLock<std::time::Instant> = std::sync::LazyLock::new(std::time::Instant::now);
    START.elapsed().as_secs_f64() * 1e3
}
