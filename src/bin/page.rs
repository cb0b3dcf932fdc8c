//! The page: in the browser it starts the app on the canvas; elsewhere it opens a window, or says where the page is.

#[cfg(target_arch = "wasm32")]
fn main() {
    harvester_lab::app::bridge::start();
}

#[cfg(all(feature = "window", not(target_arch = "wasm32")))]
fn main() -> std::process::ExitCode {
    match harvester_lab::app::window::open() {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("no window: {error}");
            std::process::ExitCode::FAILURE
        }
    }
}

#[cfg(not(any(feature = "window", target_arch = "wasm32")))]
fn main() {
    println!("Harvester Lab runs in a browser: `make serve` builds the page and serves it.");
}
