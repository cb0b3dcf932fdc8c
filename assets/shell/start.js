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

// What may have to be said before the app is there to translate it, or instead of it.
const EARLY = {
  de: {
    "Loading": "Wird geladen",
    "A shaken beam with a magnet at its tip makes electricity.":
      "Ein geschüttelter Balken mit einem Magneten an der Spitze erzeugt Strom.",
    "Reload": "Neu laden",
    "Start over": "Neu beginnen",
    "Copy state": "Zustand kopieren",
    "Harvester Lab cannot start": "Harvester Lab kann nicht starten",
    "This browser cannot show Harvester Lab": "Dieser Browser kann Harvester Lab nicht zeigen",
    "{name} is missing or switched off.": "{name} fehlt oder ist abgeschaltet.",
    "Your last scenario is kept in this browser. Reload continues it. If that stops again, copy it and start over.":
      "Ihr letztes Szenario ist in diesem Browser gespeichert. „Neu laden“ setzt es fort. Hält die Seite wieder an, kopieren Sie es und beginnen Sie neu.",
    "Copied": "Kopiert",
  },
  zh: {
    "Loading": "载入中",
    "A shaken beam with a magnet at its tip makes electricity.": "受激励的梁，端部有磁体，能够发电。",
    "Reload": "重新载入",
    "Start over": "重新开始",
    "Copy state": "复制状态",
    "Harvester Lab cannot start": "Harvester Lab 无法启动",
    "This browser cannot show Harvester Lab": "此浏览器无法显示 Harvester Lab",
    "{name} is missing or switched off.": "{name} 缺失或已关闭。",
    "Your last scenario is kept in this browser. Reload continues it. If that stops again, copy it and start over.":
      "您上一次的参数保存在此浏览器中。重新载入可继续。若再次停止，请复制它并重新开始。",
    "Copied": "已复制",
  },
};
// Translations by their English texts; the app brings its own.
let words = {};
const say = (english) => words[english] ?? english;
// What was translated: its English text, and the one shown in its place.
const translated = new WeakMap();

function translate(holder, present, show) {
  const before = translated.get(holder);
  const source = before?.shown === present ? before.source : present;
  const text = source.trim();
  const shown = text ? source.replace(text, () => say(text)) : source;
  if (shown === present) return;
  translated.set(holder, { source, shown });
  show(shown);
}

// Texts and labels of the page's own elements; whatever else stands there has no translation and stays.
function speak(code, catalogue) {
  words = catalogue;
  root.lang = code;
  root.dataset.spoken = code;
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const node = texts.currentNode;
    translate(node, node.data, (shown) => (node.data = shown));
  }
  for (const labelled of document.querySelectorAll("[aria-label]")) {
    const label = labelled.getAttributeNode("aria-label");
    translate(label, label.value, (shown) => (label.value = shown));
  }
}

// What the address asks for, what was chosen last, or what the browser prefers.
function firstLanguage() {
  let chosen = null;
  try {
    chosen = JSON.parse(stored()).lang;
  } catch {
    // Nothing stored, or nothing that can be read: the app will say so.
  }
  const asked = new URLSearchParams(location.search).get("lang");
  // What is stored may be anything.
  const known = (tag) =>
    typeof tag === "string" ? ["en", ...Object.keys(EARLY)].find((code) => tag.toLowerCase().startsWith(code)) : undefined;
  return known(asked) ?? known(chosen) ?? known(navigator.language) ?? "en";
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
  element("failure-title").textContent = say(title);
  element("failure-detail").textContent = say(detail);
  element("failure-advice").textContent = state
    ? say("Your last scenario is kept in this browser. Reload continues it. If that stops again, copy it and start over.")
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
    element("copy-state").textContent = say("Copied");
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

// In the emulated phone of a browser's tools the canvas is observed in pixels of the desktop's screen, while the page is
// told the phone's ratio: what the page is told is what counts.
function countPixels() {
  const entry = window.ResizeObserverEntry?.prototype;
  const counted = entry && Object.getOwnPropertyDescriptor(entry, "devicePixelContentBoxSize");
  if (!counted) return;
  const get = function () {
    const [own] = counted.get.call(this);
    const [box] = this.contentBoxSize;
    const [wide, high] = [box.inlineSize * devicePixelRatio, box.blockSize * devicePixelRatio];
    if (Math.abs(own.inlineSize - wide) < 2 && Math.abs(own.blockSize - high) < 2) return [own];
    const size = { inlineSize: { value: Math.round(wide) }, blockSize: { value: Math.round(high) } };
    return [Object.create(ResizeObserverSize.prototype, size)];
  };
  Object.defineProperty(entry, "devicePixelContentBoxSize", { ...counted, get });
}

async function start() {
  countPixels();
  const lacking = missing();
  if (lacking) {
    fail("This browser cannot show Harvester Lab", say("{name} is missing or switched off.").replace("{name}", lacking));
    return;
  }
  addEventListener("error", stopped);
  addEventListener("unhandledrejection", stopped);
  element("canvas").addEventListener("webglcontextlost", () => {
    fail(STOPPED, "The graphics card or its driver gave up on the page.");
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
    typed.setAttribute("aria-label", say("Text typed into the picture"));
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
  speak: (code, catalogue) => speak(code, JSON.parse(catalogue)),
  // The bytes of a file whose name carries a hash.
  fetchListed: async (name) => {
    const response = await fetch(document.querySelector(`meta[name="${name}"]`).content);
    if (!response.ok) throw new Error(`${name}: ${response.status}`);
    return response.arrayBuffer();
  },
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
const language = firstLanguage();
speak(language, EARLY[language] ?? {});
element("copy-state").addEventListener("click", copyState);
element("reload").addEventListener("click", () => location.reload());
element("start-over").addEventListener("click", startOver);
start().catch((error) => fail("Harvester Lab cannot start", String(error?.message ?? error)));
