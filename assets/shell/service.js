// Serves the page from a cache of exactly one build, so that it starts without a network and its files always belong
// together. scripts/precache.py puts the next two lines' values in: the build's name, and its files with SHA-256 digests.
const BUILD = "unlisted";
const FILES = [];

const PREFIX = `harvester-lab ${registration.scope} `;
const CACHE = PREFIX + BUILD;

const hexadecimal = (bytes) => Array.from(new Uint8Array(bytes), (byte) => byte.toString(16).padStart(2, "0")).join("");

async function fetched([path, digest]) {
  // Files with a hash in their names may come from the browser's own cache, where the page has just put them.
  const response = await fetch(path, { cache: /-[0-9a-f]{8,}/.test(path) ? "default" : "reload" });
  const found = hexadecimal(await crypto.subtle.digest("SHA-256", await response.clone().arrayBuffer()));
  if (!response.ok || found !== digest) throw new Error(`${path} is not of build ${BUILD}`);
  return [path, response];
}

// All files of this build or none: while the site is half replaced, this fails and the browser tries again later.
async function install() {
  const files = await Promise.all(FILES.map(fetched));
  const cache = await caches.open(CACHE);
  await Promise.all(files.map(([path, response]) => cache.put(path, response)));
  await skipWaiting();
}

const kept = async () => (await caches.keys()).filter((name) => name.startsWith(PREFIX));
const forget = (names) => Promise.all(names.map((name) => caches.delete(name)));

// A page in view goes on with its own build: the one before this is kept, and names with hashes keep them apart.
async function activate() {
  const others = (await kept()).filter((name) => name !== CACHE);
  await forget(others.slice(0, -1));
  await clients.claim();
}

// The page comes from this build's cache, its files from the cache that has them.
async function answer(request) {
  const where = request.mode === "navigate" ? { cacheName: CACHE } : {};
  const cached = await caches.match(request, { ...where, ignoreSearch: true, ignoreVary: true });
  return cached ?? fetch(request);
}

// Whether the address is still this page's: on one's own computer another project may be served there tomorrow.
async function leaveToOthers() {
  const response = await fetch("./", { cache: "no-store" });
  const moved = response.ok && !(await response.text()).includes("<title>Harvester Lab</title>");
  if (!moved) return;
  await forget(await kept());
  await registration.unregister();
}

addEventListener("install", (event) => event.waitUntil(install()));
addEventListener("activate", (event) => event.waitUntil(activate()));
addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || !request.url.startsWith(registration.scope)) return;
  event.respondWith(answer(request));
  if (request.mode === "navigate") event.waitUntil(leaveToOthers().catch(() => {}));
});
