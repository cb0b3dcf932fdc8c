// Native controls beside the canvas, which screen readers cannot look into: they show what it shows and change it.
// They use nothing but window.harvester and its event.

const element = (id) => document.getElementById(id);
const canvas = element("canvas");
const form = element("controls");
const DEGREES = [2, 15];
// How long a verdict must stand before it is spoken.
const REST_MS = 400;

// What the app said last, by entry.
let entries = {};
let verdict;

const laws = ["quadratic"];
for (let degree = DEGREES[0]; degree <= DEGREES[1]; degree += 1) laws.push(`taylor${degree}`);
laws.push("exact");
for (const law of laws) form.elements.force.add(new Option(law.replace("taylor", "Taylor, degree "), law));

// 2e-3 as a native number field would write it.
const written = (control, text) => (control.type === "number" ? String(Number(text)) : text);

function complain(control, message) {
  control.setAttribute("aria-invalid", String(Boolean(message)));
  const place = element(`${control.name}-error`);
  if (place) place.textContent = message;
}

function show({ entries: now, undo, redo, verdict: sentence }) {
  for (const [name, text] of Object.entries(now)) {
    const control = form.elements[name];
    // What is being typed, or was refused, stays until the canvas shows something else.
    if (entries[name] === text) continue;
    control.value = written(control, text);
    complain(control, "");
  }
  entries = now;
  element("undo").setAttribute("aria-disabled", String(!undo));
  element("redo").setAttribute("aria-disabled", String(!redo));
  clearTimeout(verdict);
  if (sentence === null) return;
  verdict = setTimeout(() => {
    if (element("verdict").textContent !== sentence) element("verdict").textContent = sentence;
  }, REST_MS);
}

function change({ target: control }) {
  try {
    window.harvester.change(control.name, control.value);
    complain(control, "");
  } catch (error) {
    complain(control, error.message);
    if (control.tagName === "SELECT") control.value = entries[control.name];
  }
}

addEventListener("harvester:change", ({ detail }) => show(detail.mirror));
form.addEventListener("change", change);
form.addEventListener("submit", (event) => event.preventDefault());
element("undo").addEventListener("click", () => window.harvester.undo());
element("redo").addEventListener("click", () => window.harvester.redo());
element("to-controls").addEventListener("click", () => form.elements.alpha.focus());
element("to-canvas").addEventListener("click", () => canvas.focus());

// The canvas keeps Tab for its own controls; after Escape it lets go.
let leaving = false;
function letGo(event) {
  if (!element("app").contains(event.target) || form.contains(event.target)) return;
  if (event.key === "Tab" && leaving) event.stopImmediatePropagation();
  leaving = event.key === "Escape" || (leaving && event.key === "Shift");
}
addEventListener("keydown", letGo, { capture: true });
