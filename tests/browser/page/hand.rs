//! Mouse, wheel, finger and keyboard.

use std::time::Duration;

use serde_json::{Value, json};

use super::Page;

/// Keys, as WebDriver numbers them.
pub(crate) const TAB: char = '\u{e004}';
pub(crate) const ENTER: char = '\u{e007}';
pub(crate) const SHIFT: char = '\u{e008}';
pub(crate) const CONTROL: char = '\u{e009}';
pub(crate) const ESCAPE: char = '\u{e00c}';

/// Moves of a finger in a swipe; the browser waits for the page at each.
const STEPS: u32 = 6;

impl Page {
    pub(crate) fn click(&self, at: (f64, f64)) {
        self.drag(&[at], Duration::ZERO);
    }

    /// Presses at the first point, moves through the others and lets go at the last.
    pub(crate) fn drag(&self, path: &[(f64, f64)], step: Duration) {
        let mut moves = Vec::new();
        for (index, &(x, y)) in path.iter().enumerate() {
            moves.push(json!({ "type": "pointerMove", "duration": step.as_millis(), "x": x, "y": y }));
            if index == 0 {
                moves.push(json!({ "type": "pointerDown", "button": 0 }));
            }
        }
        moves.push(json!({ "type": "pointerUp", "button": 0 }));
        self.mouse(moves);
    }

    fn mouse(&self, moves: Vec<Value>) {
        let mouse = json!({ "type": "pointer", "id": "mouse", "actions": moves });
        self.browser.perform(&json!({ "actions": [mouse] }));
    }

    /// Moves the mouse to a place.
    pub(crate) fn hover(&self, (x, y): (f64, f64)) {
        self.mouse(vec![json!({ "type": "pointerMove", "duration": 0, "x": x, "y": y })]);
    }

    /// Turns the wheel down over a place, by so many pixels.
    pub(crate) fn wheel(&self, (x, y): (f64, f64), by: i64) {
        let turn = json!({ "type": "scroll", "x": x as i64, "y": y as i64, "deltaX": 0, "deltaY": by, "duration": 50 });
        let wheel = json!({ "type": "wheel", "id": "wheel", "actions": [turn] });
        self.browser.perform(&json!({ "actions": [wheel] }));
    }

    /// From now on the screen can be touched.
    pub(crate) fn touches(&self) {
        let parameters = json!({ "enabled": true, "maxTouchPoints": 5 });
        self.browser.devtools("Emulation.setTouchEmulationEnabled", &parameters);
    }

    /// From now on the page is shown as on a phone whose screen has so many pixels a point.
    pub(crate) fn emulate_phone(&self, width: u32, height: u32, ratio: f64) {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": ratio, "mobile": true });
        self.browser.devtools("Emulation.setDeviceMetricsOverride", &metrics);
    }

    /// Moves a finger.
    pub(crate) fn swipe(&self, from: (f64, f64), to: (f64, f64)) {
        let mut moves = vec![
            json!({ "type": "pointerMove", "duration": 0, "x": from.0, "y": from.1 }),
            json!({ "type": "pointerDown", "button": 0 }),
        ];
        for step in 1..=STEPS {
            let part = f64::from(step) / f64::from(STEPS);
            let at = (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1));
            moves.push(json!({ "type": "pointerMove", "duration": 16, "x": at.0, "y": at.1 }));
        }
        moves.push(json!({ "type": "pointerUp", "button": 0 }));
        let finger = json!({ "type": "pointer", "id": "finger", "parameters": { "pointerType": "touch" }, "actions": moves });
        self.browser.perform(&json!({ "actions": [finger] }));
    }

    /// Presses a key while others are held down.
    pub(crate) fn keys(&self, held: &[char], key: char) {
        let down = held.iter().chain([&key]).map(|key| json!({ "type": "keyDown", "value": key }));
        let up =
            [&key].into_iter().chain(held.iter().rev()).map(|key| json!({ "type": "keyUp", "value": key }));
        let keyboard =
            json!({ "type": "key", "id": "keyboard", "actions": down.chain(up).collect::<Vec<_>>() });
        self.browser.perform(&json!({ "actions": [keyboard] }));
    }
}
