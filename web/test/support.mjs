// SPDX-License-Identifier: MIT
// What the checks share: counting results, running lsc, a plain file server.
import { spawnSync } from 'node:child_process';
import { createReadStream, existsSync, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, constants } from 'node:zlib';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const site = join(root, 'build/playground');
export const lsc = process.env.LSC ?? join(root, 'build/release/lsc');

let passed = 0;
let failed = 0;

/** Counts a fact; prints it if it is false. */
export function check(fact, text) {
  if (fact) ++passed;
  else {
    ++failed;
    console.error(`FAILED: ${text}`);
  }
}

/** Runs a named part; an exception fails it. */
export async function part(name, action) {
  const start = performance.now();
  try {
    await action();
    console.log(`${name} (${Math.round(performance.now() - start)} ms)`);
  } catch (error) {
    ++failed;
    console.error(`FAILED: ${name}: ${error.stack ?? error}`);
  }
}

/** Prints the counts and ends the program. */
export function finish() {
  console.log(`${passed} passed, ${failed} failed`);
  process.exit(failed === 0 && passed > 0 ? 0 : 1);
}

export function runLsc(...values) {
  return spawnSync(lsc, values, { encoding: 'utf8', maxBuffer: 1 << 30, cwd: root });
}

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
 * Serves the built page below /some/folder/. `headers`: further headers of every answer. `log`
 * receives the path and the size of each file, compressed with brotli.
 */
export function serve({ headers = {}, plainTypes = false, log = () => undefined, port = 0 } = {}) {
  const base = '/some/folder/';
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    const inside = pathname.startsWith(base) ? pathname.slice(base.length) || 'index.html' : '';
    const path = join(site, normalize(inside));
    if (!inside || !path.startsWith(site) || !existsSync(path) || !statSync(path).isFile()) {
      response.writeHead(404).end();
      return;
    }
    log(inside, path);
    const type = types[extname(path)];
    const isPlain = plainTypes && extname(path) === '.wasm';
    response.writeHead(200, {
      ...headers,
      'Content-Type': isPlain || !type ? 'application/octet-stream' : type,
    });
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

export function compressedSize(path) {
  const options = { params: { [constants.BROTLI_PARAM_QUALITY]: 9 } };
  return brotliCompressSync(readFileSync(path), options).length;
}
