// How a page uses Harvester Lab in a frame of its own site. See "Inside of your own page" in the README.
const element = (id) => document.getElementById(id);
const frame = element("lab");

// The frame has its functions a moment after it has loaded.
async function harvester() {
  while (!frame.contentWindow.harvester) await new Promise((resolve) => setTimeout(resolve, 50));
  return frame.contentWindow.harvester;
}

const lab = await harvester();

// Told at most five times a second. The result may still be that of the question before.
function tell() {
  const { view, result, generation, shown_generation } = JSON.parse(lab.state());
  const { alpha, beta, omega } = view.scenario.parameters;
  const numbers = `α = ${alpha}, β = ${beta}, ω = ${omega}`;
  const volts = generation === shown_generation ? result.summary?.v_rms : null;
  element("result").textContent = `${numbers}: ${volts ? `${volts.toPrecision(3)} V rms` : "no voltage yet"}`;
}

frame.contentWindow.addEventListener("harvester:change", tell);
tell();

for (const button of document.querySelectorAll("[data-omega]")) {
  button.addEventListener("click", () => {
    lab.load(JSON.stringify({ parameters: { alpha: 1e-4, beta: 0.01, omega: Number(button.dataset.omega) } }));
  });
}

element("ask").addEventListener("click", async () => {
  const { parameters } = JSON.parse(lab.state()).view.scenario;
  const question = { task: "boundary", resonance: "first", theory: "floquet", parameters, omega: [parameters.omega] };
  try {
    const { beta } = JSON.parse(await lab.solve(JSON.stringify(question)));
    const found = beta[0] === null ? "none up to 0.04" : beta[0].toPrecision(4);
    element("answer").textContent = `Lowest excitation unstable by the first resonance at ω = ${parameters.omega}: ${found}`;
  } catch (error) {
    element("answer").textContent = error.message;
  }
});
