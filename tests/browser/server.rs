//! A plain static file server that writes down what was asked of it.

use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard},
    thread::{self, JoinHandle},
};

use tiny_http::{Header, Method, Response, Server};

/// The page is served below this path, to show that it holds no absolute address.
pub(crate) const PREFIX: &str = "/some/sub/path/";

/// One answered request.
#[derive(Clone, Debug)]
pub(crate) struct Served {
    pub(crate) path: String,
    pub(crate) status: u16,
}

/// Serves a folder on a free port until dropped.
pub(crate) struct Files {
    root: PathBuf,
    server: Arc<Server>,
    log: Arc<Mutex<Vec<Served>>>,
    thread: Option<JoinHandle<()>>,
}

impl Files {
    pub(crate) fn serve(root: &Path) -> Self {
        assert!(
            root.join("index.html").is_file(),
            "there is no page in {}: run `make build` (or `make dev`) first",
            root.display()
        );
        let server = Arc::new(Server::http("127.0.0.1:0").expect("a free port"));
        let log = Arc::new(Mutex::new(Vec::new()));
        let thread = thread::spawn({
            let (server, log, root) = (Arc::clone(&server), Arc::clone(&log), root.to_owned());
            move || {
                for request in server.incoming_requests() {
                    let path = request.url().split(['?', '#']).next().unwrap_or_default().to_owned();
                    let file = (*request.method() == Method::Get).then(|| file_of(&root, &path)).flatten();
                    let body = file.as_ref().map(fs::read);
                    let status = if matches!(body, Some(Ok(_))) { 200 } else { 404 };
                    log.lock().expect("the log").push(Served { path, status });
                    // A browser that closes a connection early is no failure of the page.
                    let _sent: io::Result<()> = match (file, body) {
                        (Some(file), Some(Ok(bytes))) => {
                            request.respond(Response::from_data(bytes).with_header(content_type(&file)))
                        }
                        _ => request.respond(Response::empty(404)),
                    };
                }
            }
        });
        Self { root: root.to_owned(), server, log, thread: Some(thread) }
    }

    pub(crate) fn url(&self) -> String {
        let port = self.server.server_addr().to_ip().expect("an IP address").port();
        format!("http://127.0.0.1:{port}{PREFIX}")
    }

    pub(crate) fn log(&self) -> MutexGuard<'_, Vec<Served>> {
        self.log.lock().expect("the log")
    }

    /// The file behind a served path.
    pub(crate) fn file(&self, path: &str) -> Option<PathBuf> {
        file_of(&self.root, path)
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        self.server.unblock();
        if let Some(thread) = self.thread.take() {
            let _ended = thread.join();
        }
    }
}

fn file_of(root: &Path, path: &str) -> Option<PathBuf> {
    let name = path.strip_prefix(PREFIX)?;
    let name = if name.is_empty() { "index.html" } else { name };
    (!name.contains("..")).then(|| root.join(name))
}

fn content_type(file: &Path) -> Header {
    let kind = match file.extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript",
        Some("css") => "text/css",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("json" | "webmanifest") => "application/json",
        _ => "application/octet-stream",
    };
    Header::from_bytes("Content-Type", kind).expect("a valid header")
}
