// Lets the browser keep the page for use without a network, and says when a newer version of it is ready.

const element = (id) => document.getElementById(id);
const workers = navigator.serviceWorker;

// Kept for later only where the address allows it (https, or this very computer); without, the page works as before.
async function keep(renewed) {
  const registration = await workers.register("service.js");
  // Left alone, the browser would look for a newer version half a minute later.
  if (renewed) await registration.update();
}

element("renew").addEventListener("click", () => location.reload());
element("later").addEventListener("click", () => (element("newer").hidden = true));
if (workers) {
  // At once: a newer version may take over before a slow page has loaded.
  const renewed = Boolean(workers.controller);
  workers.addEventListener("controllerchange", () => {
    if (renewed) element("newer").hidden = false;
  });
  // After the page itself: keeping it for later must not delay it now.
  addEventListener("load", () => keep(renewed).catch(() => {}));
}
