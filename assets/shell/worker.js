// A worker of the page: runs the page's own module, handed over by start.js, and carries out orders one by one.
// In the page itself, where this script is listed so that its name carries a hash, it does nothing.
let app;

async function start({ script, wasm }) {
  const module = await import(script);
  await module.default({ module_or_path: wasm });
  return module;
}

async function receive({ data }) {
  try {
    if (app) {
      const post = (message) => self.postMessage(message);
      post((await app).carry_out(data, post));
    } else {
      app = start(data);
      await app;
    }
  } catch (error) {
    // Thrown outside of any promise, so that the page hears of it and takes another worker.
    setTimeout(() => {
      throw error;
    });
  }
}

if (typeof document === "undefined") self.addEventListener("message", receive);
