// Loads the app, shows what goes wrong, and offers the app's functions as window.harvester.

// The app writes its state under this key (src/app/bridge/storage.rs).
const KEY = "harvester-lab.v1";
const STOPPED = "Harvester Lab stopped";
const root = document.documentElement;
const element = (id) => document.getElementById(id);
// Inside of another page: nothing of it is stored, and the wheel, fingers and keys are the outer page's first.
const embedded = new URLSearchParams(location.search).has("embed");
if (embedded) {
  root.dataset.embedded = "";
  // The app takes the keyboard when it starts; from slides it must not.
  HTMLInputElement.prototype.focus = () => {};
}

function stored() {
  try {
    return embedded ? null : localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function fail(title, detail) {
  // The first failure is the cause; what follows is its echo.
  if (root.dataset.phase === "failed") return;
  root.dataset.phase = "failed";
  const state = stored();
  // Shown first, filled then: so it is read out.
  element("failure").hidden = false;
  element("failure-title").textContent = title;
  element("failure-detail").textContent = detail;
  element("failure-advice").textContent = state
    ? "Your last scenario is kept in this browser. Reload continues it. If that stops again, copy it and start over."
    : "";
  element("copy-state").hidden = !state;
  element("start-over").hidden = !state;
  element("reload").focus();
}

async function copyState() {
  const text = element("state-text");
  text.value = stored() ?? "";
  try {
    await navigator.clipboard.writeText(text.value);
    element("copy-state").textContent = "Copied";
  } catch {
    // No clipboard without permission or https: show the text to copy by hand.
    text.hidden = false;
    text.select();
  }
}

function startOver() {
  const state = stored();
  if (state) localStorage.setItem(`${KEY}.before`, state);
  localStorage.removeItem(KEY);
  location.reload();
}

// The compiled code cannot go on after any of these; a panic has told its own story before it stops there.
function stopped({ error, reason }) {
  const what = error ?? reason;
  if (what instanceof WebAssembly.RuntimeError || what instanceof RangeError) fail(STOPPED, what.message);
}

function missing() {
  if (typeof WebAssembly !== "object") return "WebAssembly";
  // The app gets this very context: egui smooths its own edges, and multisampling costs a software renderer a core.
  const context = { alpha: false, antialias: false, depth: false, stencil: false };
  if (!element("canvas").getContext("webgl2", context)) return "WebGL 2";
  return null;
}

async function start() {
  const lacking = missing();
  if (lacking) {
    fail("This browser cannot show Harvester Lab", `${lacking} is missing or switched off.`);
    return;
  }
  addEventListener("error", stopped);
  addEventListener("unhandledrejection", stopped);
  element("canvas").addEventListener("webglcontextlost", () => {
    fail(STOPPED, "The graphics card or its driver gave the page up.");
  });
  const app = await import(element("module").href);
  await app.default({ module_or_path: element("wasm").href });
  const keep = () => {
    if (root.dataset.phase === "ready") app.keep();
  };
  addEventListener("pagehide", keep);
  document.addEventListener("visibilitychange", () => document.hidden && keep());
  window.harvester = Object.freeze({
    state: app.state,
    load: app.load,
    solve: app.solve,
    change: app.change,
    undo: app.undo,
    redo: app.redo,
    frames: app.frames,
    controls: app.controls,
  });
}

window.harvesterShell = Object.freeze({
  ready: () => {
    if (root.dataset.phase !== "loading") return;
    root.dataset.phase = "ready";
    delete HTMLInputElement.prototype.focus;
    // The field into which the app has texts typed; it comes and goes by the canvas, not by Tab.
    const typed = element("canvas").nextElementSibling;
    typed.tabIndex = -1;
    typed.setAttribute("aria-label", "Text typed into the picture");
  },
  // Tells whoever listens; what is costly to make is made when it is looked at.
  changed: (mirror) => {
    const detail = Object.freeze({
      mirror: JSON.parse(mirror),
      get state() {
        return window.harvester.state();
      },
    });
    dispatchEvent(new CustomEvent("harvester:change", { detail }));
  },
  // What is around the canvas looks as what is in it.
  look: (dark, contrast) => (root.dataset.look = `${dark ? "dark" : "light"}${contrast ? " contrast" : ""}`),
  fail,
  // A worker that runs the page's own module, compiled only once.
  worker: (wasm) => {
    try {
      const worker = new Worker(element("worker").src, { type: "module" });
      worker.postMessage({ script: element("module").href, wasm });
      return worker;
    } catch {
      return null;
    }
  },
});
element("copy-state").addEventListener("click", copyState);
element("reload").addEventListener("click", () => location.reload());
element("start-over").addEventListener("click", startOver);
start().catch((error) => fail("Harvester Lab cannot start", String(error?.message ?? error)));
