//! The page: in the browser it starts the app on the canvas; elsewhere it says where the page is.

#[cfg(target_arch = "wasm32")]
fn main() {
    harvester_lab::app::bridge::start();
}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    println!("Harvester Lab runs in a browser: `make serve` builds the page and serves it.");
}
