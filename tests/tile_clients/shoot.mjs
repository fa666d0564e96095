// SPDX-License-Identifier: MIT
// Takes a picture of a tileset in a viewer of another project, in headless Chromium.
// Usage: node shoot.mjs CLIENT TILESET ORIGIN EYE AT ERROR PICTURE
//   CLIENT   cesium or three
//   TILESET  the address of a tileset.json, or a folder; empty: an empty page
//   ORIGIN   longitude, latitude in degrees, height in m
//   EYE, AT  camera and target in coordinates of the scene
//   ERROR    tolerated error in pixels
// Prints a line of JSON: requests and bytes of the tileset, also by kind of file, seconds until the view was complete,
// seconds in which a server made files, visible tiles, failures. With LIST=FILE it writes the requests into a file.
// Modules are found in the working folder, which holds node_modules.
import { createServer } from 'node:http';
import { existsSync } from 'node:fs';
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const require = createRequire(join(process.cwd(), 'package.json'));
const esbuild = require('esbuild');
const puppeteer = (await import(pathToFileURL(require.resolve('puppeteer-core')).href)).default;
const modules = join(process.cwd(), 'node_modules');
const here = dirname(fileURLToPath(import.meta.url));
const [client, tileset, origin, eye, at, error, picture] = process.argv.slice(2);
const isFolder = tileset !== '' && existsSync(tileset);

const script = await esbuild.build({
    entryPoints: [join(here, `${client}_page.js`)],
    bundle: true,
    format: 'esm',
    write: false,
    nodePaths: [modules],
    logLevel: 'error',
});
const cesium = '<script>window.CESIUM_BASE_URL = "/cesium/"</script><script src="/cesium/Cesium.js"></script>' +
    '<link rel="stylesheet" href="/cesium/Widgets/widgets.css">';
const page = `<!doctype html><meta charset="utf-8"><style>html,body,#view{margin:0;width:100%;height:100%}</style>
${client === 'cesium' ? cesium : ''}<div id="view"></div><script type="module" src="/page.js"></script>`;
const types = { '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json', '.wasm': 'application/wasm' };
const server = createServer(async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
    try {
        if (path === '/') {
            response.setHeader('Content-Type', 'text/html').end(page);
        } else if (path === '/favicon.ico') {
            response.writeHead(204).end();
        } else if (path === '/page.js') {
            response.setHeader('Content-Type', 'text/javascript').end(script.outputFiles[0].text);
        } else {
            const file = path.startsWith('/cesium/') ? join(modules, 'cesium/Build/Cesium', path.slice(8))
                : join(tileset, path.slice('/tiles/'.length));
            response.setHeader('Content-Type', types[extname(file)] ?? 'application/octet-stream').end(await readFile(file));
        }
    } catch {
        response.writeHead(404).end();
    }
});
await new Promise(ready => server.listen(0, '127.0.0.1', ready));
const base = `http://127.0.0.1:${server.address().port}`;

const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    protocolTimeout: 900_000,
});
const tab = await browser.newPage();
await tab.setViewport({ width: 1280, height: 720 });
const address = tileset === '' ? '' : isFolder ? `${base}/tiles/tileset.json` : tileset;
const prefix = address.slice(0, address.lastIndexOf('/') + 1);
const network = await tab.createCDPSession();
await network.send('Network.enable');
const answers = new Map();
let requests = 0;
let bytes = 0;
const kinds = {}; // by ending of the path: number of requests, bytes
const list = [];
network.on('Network.responseReceived', event => answers.set(event.requestId, event.response.url));
const cached = new Set(); // answered by the browser itself
network.on('Network.requestServedFromCache', event => cached.add(event.requestId));
network.on('Network.loadingFinished', event => {
    if (prefix !== '' && answers.get(event.requestId)?.startsWith(prefix) && event.encodedDataLength > 0 &&
        !cached.has(event.requestId)) {
        const url = answers.get(event.requestId);
        const kind = kinds[extname(new URL(url).pathname).slice(1)] ??= { requests: 0, bytes: 0 };
        ++requests;
        bytes += event.encodedDataLength;
        ++kind.requests;
        kind.bytes += event.encodedDataLength;
        list.push(`${url} ${event.encodedDataLength}`);
    }
});
const serverMakeSeconds = async () => {
    if (address === '' || isFolder) {
        return 0;
    }
    const metrics = await (await fetch(new URL('/metrics', address))).text();
    return Number(/^lsc_make_seconds_sum (.*)$/m.exec(metrics)?.[1] ?? 0);
};
const busyBefore = await serverMakeSeconds();
const messages = [];
tab.on('console', message => message.type() === 'error' && messages.push(message.text()));
tab.on('pageerror', failure => messages.push(String(failure)));
const begin = performance.now();
const query = new URLSearchParams({ tileset: address, origin, eye, at, error });
await tab.goto(`${base}/?${query}`);
let isSettled = true;
try {
    await tab.waitForFunction('window.isSettled', { timeout: Number(process.env.SECONDS ?? 400) * 1000, polling: 200 });
} catch {
    isSettled = false;
}
const seconds = (performance.now() - begin) / 1000;
await tab.screenshot({ path: picture });
const [failures, tiles] = await tab.evaluate(() => [window.failures ?? [], window.tileCounts ?? {}]);
const serverSeconds = await serverMakeSeconds() - busyBefore;
if (process.env.LIST) {
    await writeFile(process.env.LIST, list.map(line => `${line}\n`).join(''));
}
console.log(JSON.stringify({ client, isSettled, requests, bytes, kinds, seconds, serverSeconds, ...tiles, failures: [...failures, ...messages] }));
await browser.close();
server.close();
process.exit(isSettled && failures.length + messages.length === 0 ? 0 : 1);
