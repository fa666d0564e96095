// SPDX-License-Identifier: MIT
// A plain file server for the built page. Usage: node serve.mjs [PORT]     default 8000
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const site = fileURLToPath(new URL('../build/playground', import.meta.url));
const types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.json': 'application/json',
  '.svg': 'image/svg+xml',
  '.png': 'image/png',
  '.jpg': 'image/jpeg',
  '.wasm': 'application/wasm',
  '.webmanifest': 'application/manifest+json',
};

/**
 * Serves the page below the path `base`. `headers`: further headers of every answer. `plainTypes`:
 * leaves out the type of WebAssembly. `log` receives the name and the path of each file. The port 0
 * is any free port.
 */
export function serve({
  port = 0,
  base = '/',
  headers = {},
  plainTypes = false,
  log = () => undefined,
} = {}) {
  const server = createServer((request, response) => {
    const pathname = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    const name = pathname.startsWith(base) ? pathname.slice(base.length) || 'index.html' : '';
    const path = join(site, normalize(name));
    if (!name || !path.startsWith(site) || !statSync(path, { throwIfNoEntry: false })?.isFile()) {
      response.writeHead(404).end();
      return;
    }
    log(name, path);
    const type = plainTypes && extname(path) === '.wasm' ? undefined : types[extname(path)];
    response.writeHead(200, { ...headers, 'Content-Type': type ?? 'application/octet-stream' });
    createReadStream(path).pipe(response);
  });
  return new Promise((resolve) =>
    server.listen(port, '127.0.0.1', () =>
      resolve({
        url: `http://127.0.0.1:${server.address().port}${base}`,
        close: () =>
          new Promise((done) => {
            server.closeAllConnections?.();
            server.close(done);
          }),
      }),
    ),
  );
}

if (process.argv[1] === fileURLToPath(import.meta.url))
  serve({ port: Number(process.argv[2] ?? 8000) }).then(({ url }) => console.log(url));
