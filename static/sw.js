// The service worker: keeps the whole page for use without a server, one version of it at a time.
//
// A version is what /files.json lists: every file with its hash. It is downloaded into a cache of its own, each file checked
// against its hash, so files of two versions never mix. Each visit to a page asks for the list first: the newest version is
// shown if the server answers, the kept one if it does not. Anything that is not listed, such as the API, passes untouched.
//
// In:  {type: "check"}                       Out: {type: "newer"} to all pages when another version was downloaded
//      {type: "ask"}                              {type: "kept", version} to whoever asked, once everything is kept
//                                                 {type: "switched"} to all pages when another version took over

const PREFIX = "adaptarm-page-";
/** In a cache, the list of its files: written when its version takes over. */
const LIST = new URL("files.json", self.registration.scope).href;
/** How long a visit waits to hear which version is the newest, and then for its download. */
const ANSWER_MS = 3000;
const DOWNLOAD_MS = 10_000;
const AT_A_TIME = 6;

/** The version that pages get: `{cache, list}`. Found again after the browser has stopped this worker meanwhile. */
let serving = null;
/** Downloads under way, by version. */
const downloads = new Map();

const addressOf = (path) => new URL(path, self.registration.scope).href;
const delay = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function current() {
  serving ??= await findCurrent();
  return serving;
}

async function findCurrent() {
  // In order of creation: should two be complete, the later one took over.
  for (const name of (await caches.keys()).filter((key) => key.startsWith(PREFIX)).reverse()) {
    const cache = await caches.open(name);
    const list = await cache.match(LIST);
    if (list) {
      return { cache, list: await list.json() };
    }
  }
  return null;
}

/** The server's list, or null while it cannot be had. */
async function newestList() {
  try {
    const response = await fetch(LIST, { cache: "no-cache", signal: AbortSignal.timeout(ANSWER_MS) });
    return response.ok ? await response.json() : null;
  } catch {
    return null;
  }
}

/** Brings every file of a version into its cache; fails if one is missing or belongs to another version. */
function download(list) {
  if (!downloads.has(list.version)) {
    const done = downloadAll(list).finally(() => downloads.delete(list.version));
    downloads.set(list.version, done);
  }
  return downloads.get(list.version);
}

async function downloadAll({ version, files }) {
  const cache = await caches.open(PREFIX + version);
  const before = await current();
  const waiting = Object.entries(files);
  const fetchSome = async () => {
    for (let next = waiting.pop(); next; next = waiting.pop()) {
      const [path, hash] = next;
      const address = addressOf(path);
      const unchanged = before?.list.files[path] === hash ? await before.cache.match(address) : null;
      if (unchanged) {
        await cache.put(address, unchanged);
      } else if (!(await cache.match(address))) {
        const response = await fetch(address, { cache: "no-cache" });
        const found = await hashOf(await response.clone().arrayBuffer());
        if (!response.ok || found !== hash) {
          throw new Error(`${path} is not of version ${version}`);
        }
        await cache.put(address, response);
      }
    }
  };
  await Promise.all(Array.from({ length: AT_A_TIME }, fetchSome));
}

async function hashOf(bytes) {
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  return Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** Makes a downloaded version the one that pages get. */
async function switchTo(list) {
  const before = await current();
  const cache = await caches.open(PREFIX + list.version);
  await cache.put(LIST, new Response(JSON.stringify(list), { headers: { "Content-Type": "application/json" } }));
  serving = { cache, list };
  const others = (await caches.keys()).filter((key) => key.startsWith(PREFIX) && key !== PREFIX + list.version);
  await Promise.all(others.map((key) => caches.delete(key)));
  if (before) {
    await tellPages({ type: "switched" });
  }
}

async function tellPages(message) {
  for (const client of await self.clients.matchAll({ type: "window", includeUncontrolled: true })) {
    client.postMessage(message);
  }
}

/** A listed file from the cache of the version that pages get; null for anything else. */
async function kept(request) {
  const now = await current();
  const { pathname } = new URL(request.url);
  const address = new URL(pathname.endsWith("/") ? `${pathname}index.html` : pathname, self.registration.scope).href;
  return (await now?.cache.match(address)) ?? null;
}

/** Someone visits a page: the newest version if it can be had in time, else the one that is kept. */
async function visit(event) {
  const newest = await newestList();
  const now = await current();
  if (newest && newest.version !== now?.list.version) {
    const downloaded = download(newest).then(() => true, () => false);
    event.waitUntil(downloaded);
    if (await Promise.race([downloaded, delay(DOWNLOAD_MS).then(() => false)])) {
      await switchTo(newest);
    }
  }
  return (await kept(event.request)) ?? fetch(event.request);
}

/** Downloads another version if there is one, and tells the pages, which get it at their next visit. */
async function check() {
  const newest = await newestList();
  if (newest && newest.version !== (await current())?.list.version) {
    await download(newest);
    await tellPages({ type: "newer" });
  }
}

self.addEventListener("install", (event) => {
  const fill = async () => {
    if (!(await current())) {
      const list = await newestList();
      if (!list) {
        throw new Error("the server's list of files is missing");
      }
      await download(list);
      await switchTo(list);
    }
    await self.skipWaiting();
  };
  event.waitUntil(fill());
});

self.addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));

self.addEventListener("message", (event) => {
  if (event.data.type === "check") {
    event.waitUntil(check().catch(() => null));
  } else if (event.data.type === "ask") {
    const answer = async () => {
      const now = await current();
      event.source.postMessage({ type: "kept", version: now?.list.version ?? null });
    };
    event.waitUntil(answer());
  }
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  const scope = self.registration.scope;
  const dynamic = [`${scope}api/`, `${scope}lti/`].some((place) => request.url.startsWith(place));
  if (request.method !== "GET" || !request.url.startsWith(scope) || dynamic || request.url === LIST) {
    return;
  }
  // A cache that cannot be read is no reason to do without the file.
  if (request.mode === "navigate") {
    event.respondWith(visit(event).catch(() => fetch(request)));
  } else {
    event.respondWith(kept(request).catch(() => null).then((response) => response ?? fetch(request)));
  }
});
