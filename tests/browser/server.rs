//! The page served by Python's own file server, as the README says it may be, below a path of several folders; what was
//! asked of it is written down.

use std::{
    fs,
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::atomic::{AtomicU32, Ordering},
    sync::{Arc, Mutex, MutexGuard},
    thread,
};

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
    /// Holds a link to the page below [`PREFIX`].
    site: PathBuf,
    server: Child,
    port: u16,
    log: Arc<Mutex<Vec<Served>>>,
}

impl Files {
    pub(crate) fn serve(root: &Path) -> Self {
        assert!(
            root.join("index.html").is_file(),
            "there is no page in {}: run `make build` (or `make dev`) first",
            root.display()
        );
        let site = site(root);
        let mut server = Command::new("python3")
            .args(["-u", "-m", "http.server", "--bind", "127.0.0.1", "--directory"])
            .arg(&site)
            .arg("0")
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("python3 serves files");
        let mut greeting = String::new();
        let stdout = server.stdout.take().expect("a pipe");
        BufReader::new(stdout).read_line(&mut greeting).expect("the server says its port");
        let port = greeting.split_whitespace().find_map(|word| word.parse().ok());
        let port = port.unwrap_or_else(|| panic!("no port in {greeting:?}"));
        let log = Arc::new(Mutex::new(Vec::new()));
        let stderr = server.stderr.take().expect("a pipe");
        thread::spawn({
            let log = Arc::clone(&log);
            move || {
                for line in BufReader::new(stderr).lines().map_while(Result::ok) {
                    log.lock().expect("the log").extend(served(&line));
                }
            }
        });
        Self { root: root.to_owned(), site, server, port, log }
    }

    pub(crate) fn url(&self) -> String {
        format!("http://127.0.0.1:{}{PREFIX}", self.port)
    }

    /// Replaces the page by that of another folder.
    pub(crate) fn deploy(&self, root: &Path) {
        let link = self.site.join(PREFIX.trim_matches('/'));
        fs::remove_file(&link).expect("the link was there");
        std::os::unix::fs::symlink(root.canonicalize().expect("a path"), link).expect("a link");
    }

    /// Cuts the network.
    pub(crate) fn stop(&mut self) {
        self.server.kill().and_then(|()| self.server.wait()).expect("the server ends");
    }

    pub(crate) fn log(&self) -> MutexGuard<'_, Vec<Served>> {
        self.log.lock().expect("the log")
    }

    /// The file behind a served path.
    pub(crate) fn file(&self, path: &str) -> Option<PathBuf> {
        let name = path.strip_prefix(PREFIX)?;
        let name = if name.is_empty() { "index.html" } else { name };
        (!name.contains("..")).then(|| self.root.join(name))
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        let _ended = self.server.kill();
        let _status = self.server.wait();
        let _removed = fs::remove_dir_all(&self.site);
    }
}

/// A new folder in which the page is found below [`PREFIX`].
fn site(root: &Path) -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let site = std::env::temp_dir().join(format!("harvester-lab-{}-{number}", std::process::id()));
    let _removed = fs::remove_dir_all(&site);
    let link = site.join(PREFIX.trim_matches('/'));
    fs::create_dir_all(link.parent().expect("a folder")).expect("a temporary folder");
    std::os::unix::fs::symlink(root.canonicalize().expect("a path"), link).expect("a link");
    site
}

/// Reads `127.0.0.1 - - [date] "GET /path HTTP/1.1" 200 -`.
fn served(line: &str) -> Option<Served> {
    let (_, request) = line.split_once("\"GET ")?;
    let (path, rest) = request.split_once(' ')?;
    let status = rest.split_whitespace().nth(1)?.parse().ok()?;
    let path = path.split(['?', '#']).next()?.to_owned();
    Some(Served { path, status })
}
