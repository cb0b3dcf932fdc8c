//! One headless Chromium under chromedriver.

use std::{
    cell::Cell,
    env, fs,
    io::{BufRead as _, BufReader},
    path::PathBuf,
    process::{Child, Command, Stdio},
    sync::atomic::{AtomicUsize, Ordering},
};

use fantoccini::{Client, ClientBuilder, wd::WebDriverCompatibleCommand};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use tokio::runtime::Runtime;

use super::{Browser, program};
use crate::page::Theme;

/// A browser session.
pub(crate) struct Chromium {
    runtime: Runtime,
    client: Option<Client>,
    driver: Child,
    profile: PathBuf,
    /// What the system asks pages for: its colours, and whether they may move by themselves.
    wishes: Cell<(Theme, bool)>,
}

impl Chromium {
    pub(crate) fn start() -> Self {
        static STARTED: AtomicUsize = AtomicUsize::new(0);
        let number = STARTED.fetch_add(1, Ordering::Relaxed);
        let profile = env::temp_dir().join(format!("harvester-browser-{}-{number}", std::process::id()));
        let chromium = program("CHROMIUM", &["chromium", "chromium-browser", "google-chrome"]);
        let chromedriver = program("CHROMEDRIVER", &["chromedriver"]);

        let mut driver = Command::new(&chromedriver)
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("cannot start {}: {error}", chromedriver.display()));
        let port = announced_port(&mut driver);
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
        // Built before the session exists, so that a failed connection still ends the driver.
        let wishes = Cell::new((Theme::Dark, false));
        let mut browser = Self { runtime, client: None, driver, profile, wishes };

        let capabilities = json!({
            "browserName": "chrome",
            // A walk through a hundred controls takes a while on a busy machine.
            "timeouts": { "script": 120_000 },
            "goog:loggingPrefs": { "browser": "ALL" },
            "goog:chromeOptions": {
                "binary": chromium,
                "args": [
                    "--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
                    "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars",
                    format!("--user-data-dir={}", browser.profile.display()),
                ],
            },
        });
        let Value::Object(capabilities) = capabilities else { unreachable!("written as an object") };
        let client = browser.runtime.block_on(async {
            // Small requests and answers: waiting to fill packets would cost 40 ms each.
            let mut connector = HttpConnector::new();
            connector.set_nodelay(true);
            ClientBuilder::new(connector)
                .capabilities(capabilities)
                .connect(&format!("http://127.0.0.1:{port}"))
                .await
        });
        browser.client = Some(client.expect("a browser session"));
        browser
    }

    fn client(&self) -> &Client {
        self.client.as_ref().expect("an open session")
    }

    /// Waits for an answer of the client.
    fn run<T, E: std::fmt::Debug>(&self, answer: impl Future<Output = Result<T, E>>) -> T {
        self.runtime.block_on(answer).expect("the browser answers")
    }

    fn tell_wishes(&self) {
        let (theme, moves) = self.wishes.get();
        let (scheme, contrast) = match theme {
            Theme::Dark => ("dark", "no-preference"),
            Theme::Light => ("light", "no-preference"),
            Theme::DarkContrast => ("dark", "more"),
            Theme::LightContrast => ("light", "more"),
        };
        let motion = if moves { "no-preference" } else { "reduce" };
        let features = [
            ("prefers-color-scheme", scheme),
            ("prefers-contrast", contrast),
            ("prefers-reduced-motion", motion),
        ];
        let features = features.map(|(name, value)| json!({ "name": name, "value": value }));
        self.devtools("Emulation.setEmulatedMedia", &json!({ "features": features }));
    }

    fn post(&self, path: &'static str, body: Value) -> Value {
        self.run(self.client().issue_cmd(Post { path, body }))
    }
}

impl Browser for Chromium {
    fn goto(&self, url: &str) {
        self.run(self.client().goto(url));
    }

    fn refresh(&self) {
        self.run(self.client().refresh());
    }

    fn execute(&self, script: &str, arguments: Vec<Value>) -> Value {
        self.run(self.client().execute(script, arguments))
    }

    fn perform(&self, actions: &Value) {
        self.post("actions", actions.clone());
    }

    fn screenshot(&self) -> Vec<u8> {
        self.run(self.client().screenshot())
    }

    fn resize(&self, width: u32, height: u32, theme: Theme) {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.devtools("Emulation.setDeviceMetricsOverride", &metrics);
        self.wishes.set((theme, self.wishes.get().1));
        self.tell_wishes();
    }

    fn let_move(&self) {
        self.wishes.set((self.wishes.get().0, true));
        self.tell_wishes();
    }

    fn console(&self) -> Vec<(String, String)> {
        let entries = self.post("se/log", json!({ "type": "browser" }));
        let text = |entry: &Value, key: &str| entry[key].as_str().unwrap_or_default().to_owned();
        entries
            .as_array()
            .into_iter()
            .flatten()
            .map(|entry| (text(entry, "level"), text(entry, "message")))
            .collect()
    }

    fn devtools(&self, command: &str, parameters: &Value) -> Value {
        self.post("goog/cdp/execute", json!({ "cmd": command, "params": parameters }))
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        // Ending the session ends Chromium; killing only the driver would leave it behind.
        if let Some(client) = self.client.take() {
            let _closed = self.runtime.block_on(client.close());
        }
        let _killed = self.driver.kill();
        let _status = self.driver.wait();
        let _removed = fs::remove_dir_all(&self.profile);
    }
}

/// A command that WebDriver's standard does not know.
#[derive(Debug)]
struct Post {
    path: &'static str,
    body: Value,
}

impl WebDriverCompatibleCommand for Post {
    fn endpoint(&self, base: &url::Url, session: Option<&str>) -> Result<url::Url, url::ParseError> {
        base.join(&format!("session/{}/{}", session.unwrap_or_default(), self.path))
    }

    fn method_and_body(&self, _url: &url::Url) -> (http::Method, Option<String>) {
        (http::Method::POST, Some(self.body.to_string()))
    }
}

fn announced_port(driver: &mut Child) -> u16 {
    let output = driver.stdout.take().expect("the driver's output");
    let mut lines = BufReader::new(output).lines();
    let port = lines.by_ref().map_while(Result::ok).find_map(|line| {
        let (_, port) = line.split_once("started successfully on port ")?;
        port.trim_end_matches('.').parse().ok()
    });
    // Keep reading, or the driver blocks once the pipe is full.
    std::thread::spawn(move || lines.for_each(drop));
    port.expect("chromedriver says its port")
}
