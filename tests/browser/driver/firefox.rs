//! One Firefox, driven by its own protocol, Marionette: WebDriver's commands over a socket, without another program in
//! between. It draws on a screen of its own in memory, because without any screen it has no WebGL.

use std::{
    cell::RefCell,
    env, fs,
    io::{BufRead as _, BufReader, Read as _, Write as _},
    net::TcpStream,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::atomic::{AtomicUsize, Ordering},
    thread::sleep,
    time::{Duration, Instant},
};

use base64::Engine as _;
use serde_json::{Value, json};

use super::{Browser, program};
use crate::page::Theme;

/// How long the browser may take to start on a slow machine.
const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Firefox {
    /// Ends last: fields are dropped in this order.
    marionette: RefCell<Option<Marionette>>,
    browser: Child,
    screen: Child,
    profile: PathBuf,
}

impl Firefox {
    pub(crate) fn start(theme: Theme) -> Self {
        static STARTED: AtomicUsize = AtomicUsize::new(0);
        let number = STARTED.fetch_add(1, Ordering::Relaxed);
        let profile = env::temp_dir().join(format!("harvester-firefox-{}-{number}", std::process::id()));
        let _removed = fs::remove_dir_all(&profile);
        fs::create_dir_all(&profile).expect("a temporary folder");
        let dark = u8::from(theme == Theme::Light);
        let preferences = [
            ("marionette.port", json!(0)),
            ("layout.css.prefers-color-scheme.content-override", json!(dark)),
            ("ui.prefersReducedMotion", json!(1)),
            ("webgl.force-enabled", json!(true)),
            ("app.update.enabled", json!(false)),
            ("browser.shell.checkDefaultBrowser", json!(false)),
            ("datareporting.policy.dataSubmissionEnabled", json!(false)),
            ("network.captive-portal-service.enabled", json!(false)),
            ("network.connectivity-service.enabled", json!(false)),
        ];
        let lines = preferences.map(|(name, value)| format!("user_pref(\"{name}\", {value});\n"));
        fs::write(profile.join("user.js"), lines.concat()).expect("preferences");

        let mut screen = Command::new(program("XVFB", &["Xvfb"]))
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", "1920x1400x24"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut display = String::new();
        let output = screen.stdout.take().expect("a pipe");
        BufReader::new(output).read_line(&mut display).expect("Xvfb says its number");
        let browser = Command::new(program("FIREFOX", &["firefox-esr", "firefox"]))
            .args(["--marionette", "--no-remote", "--profile"])
            .arg(&profile)
            .env("DISPLAY", format!(":{}", display.trim()))
            .env_remove("WAYLAND_DISPLAY")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("Firefox starts");
        // Built before the session exists, so that a failed connection still ends the programs.
        let firefox = Self { marionette: RefCell::new(None), browser, screen, profile };
        let mut marionette = Marionette::connect(&firefox.profile);
        marionette.call("WebDriver:NewSession", &json!({}));
        firefox.marionette.replace(Some(marionette));
        firefox
    }

    fn call(&self, command: &str, parameters: &Value) -> Value {
        self.marionette.borrow_mut().as_mut().expect("an open session").call(command, parameters)
    }
}

impl Browser for Firefox {
    fn goto(&self, url: &str) {
        self.call("WebDriver:Navigate", &json!({ "url": url }));
    }

    fn refresh(&self) {
        // Marionette's own way asks the network past the service worker, as a user's Shift+Reload does.
        self.execute("window.unloaded = false; location.reload()", vec![]);
        let gone = || {
            self.execute("return window.unloaded === undefined && document.readyState === 'complete'", vec![])
        };
        while gone() != true {
            sleep(Duration::from_millis(30));
        }
    }

    fn execute(&self, script: &str, arguments: Vec<Value>) -> Value {
        // The page's own objects, not views of them.
        let parameters = json!({ "script": script, "args": arguments, "sandbox": null });
        self.call("WebDriver:ExecuteScript", &parameters)["value"].clone()
    }

    fn perform(&self, actions: &Value) {
        self.call("WebDriver:PerformActions", actions);
    }

    fn screenshot(&self) -> Vec<u8> {
        let picture = self.call("WebDriver:TakeScreenshot", &json!({ "full": false }));
        let text = picture["value"].as_str().expect("a picture");
        base64::engine::general_purpose::STANDARD.decode(text).expect("base64")
    }

    fn resize(&self, width: u32, height: u32, _theme: Theme) {
        self.call("WebDriver:SetWindowRect", &json!({ "x": 0, "y": 0, "width": width, "height": height }));
    }
}

impl Drop for Firefox {
    fn drop(&mut self) {
        for program in [&mut self.browser, &mut self.screen] {
            let _ended = program.kill();
            let _status = program.wait();
        }
        let _removed = fs::remove_dir_all(&self.profile);
    }
}

/// The protocol: messages of JSON, each after its length and a colon.
struct Marionette {
    stream: BufReader<TcpStream>,
    number: u64,
}

impl Marionette {
    fn connect(profile: &Path) -> Self {
        let began = Instant::now();
        let port: u16 = loop {
            let written = fs::read_to_string(profile.join("MarionetteActivePort")).ok();
            if let Some(port) = written.and_then(|text| text.trim().parse().ok()) {
                break port;
            }
            assert!(began.elapsed() < PATIENCE, "Firefox does not listen");
            sleep(Duration::from_millis(30));
        };
        let stream = TcpStream::connect(("127.0.0.1", port)).expect("Firefox listens");
        stream.set_nodelay(true).expect("a socket");
        let mut marionette = Self { stream: BufReader::new(stream), number: 0 };
        let greeting = marionette.receive();
        assert_eq!(greeting["marionetteProtocol"], 3, "{greeting}");
        marionette
    }

    fn receive(&mut self) -> Value {
        let mut length = Vec::new();
        self.stream.read_until(b':', &mut length).expect("Firefox answers");
        let length =
            std::str::from_utf8(&length).ok().and_then(|text| text.trim_end_matches(':').parse().ok());
        let mut message = vec![0; length.expect("the length of an answer")];
        self.stream.read_exact(&mut message).expect("the whole answer");
        serde_json::from_slice(&message).expect("an answer in JSON")
    }

    fn call(&mut self, command: &str, parameters: &Value) -> Value {
        self.number += 1;
        let message = json!([0, self.number, command, parameters]).to_string();
        write!(self.stream.get_mut(), "{}:{message}", message.len()).expect("Firefox listens");
        let answer = self.receive();
        assert!(answer[2].is_null(), "{command}: {}", answer[2]);
        answer[3].clone()
    }
}
