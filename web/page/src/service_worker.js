// SPDX-License-Identifier: MIT
// Stores the page at the first visit, so that it works without a network. The build replaces the
// version and the list of files; a new version replaces all files together.
const version = 'VERSION';
const files = [/* FILES */];
const name = `lsc-playground-${version}`;
const prefix = 'lsc-playground-';

self.addEventListener('install', (event) => {
  event.waitUntil(
    caches
      .open(name)
      .then((cache) => cache.addAll(files))
      .then(() => self.skipWaiting()),
  );
});

self.addEventListener('activate', (event) => {
  event.waitUntil(
    caches
      .keys()
      .then((keys) =>
        Promise.all(
          keys.filter((key) => key.startsWith(prefix) && key !== name).map((key) => caches.delete(key)),
        ),
      )
      .then(() => self.clients.claim()),
  );
});

async function answer(request) {
  const stored = await caches.match(request, { cacheName: name, ignoreSearch: true });
  if (stored) return stored;
  const response = await fetch(request);
  if (response.ok) {
    const cache = await caches.open(name);
    await cache.put(request, response.clone());
  }
  return response;
}

self.addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method === 'GET' && new URL(request.url).origin === self.location.origin)
    event.respondWith(answer(request));
});
