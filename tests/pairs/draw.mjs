// SPDX-License-Identifier: MIT
// Draws the pairs of pairs.json: trees of ez-tree, and the sky, ground and shadow for plants of lsview.
// Usage: node draw.mjs PAIRS FOLDER [NUMBER...]     numbers of pairs, default: all
//   FOLDER holds NUMBER.glb, the plant of lsc, for each pair. Written: NUMBER-theirs.png and NUMBER-backdrop.png of
//   2560x1440 pixels, and NUMBER.camera, the camera for lsview.
// Modules are found in the working folder, which holds node_modules.
import { createServer } from 'node:http';
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const require = createRequire(join(process.cwd(), 'package.json'));
const esbuild = require('esbuild');
const puppeteer = (await import(pathToFileURL(require.resolve('puppeteer-core')).href)).default;
const [description, folder, ...wanted] = process.argv.slice(2);
const { sun, pairs } = JSON.parse(await readFile(description, 'utf8'));
const script = await esbuild.build({
    entryPoints: [join(dirname(fileURLToPath(import.meta.url)), 'page.js')],
    bundle: true,
    format: 'esm',
    write: false,
    nodePaths: [join(process.cwd(), 'node_modules')],
    logLevel: 'error',
});
const server = createServer(async (request, response) => {
    if (request.url === '/') {
        response.setHeader('Content-Type', 'text/html').end('<!doctype html><meta charset="utf-8">' +
            '<style>body{margin:0}</style><script type="module" src="/page.js"></script>');
    } else if (request.url === '/page.js') {
        response.setHeader('Content-Type', 'text/javascript').end(script.outputFiles[0].text);
    } else if (/^\/[0-9]+\.glb$/.test(request.url)) {
        response.end(await readFile(join(folder, request.url.slice(1))));
    } else {
        response.writeHead(404).end();
    }
});
await new Promise(ready => server.listen(0, '127.0.0.1', ready));
const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    protocolTimeout: 900_000,
});
let failures = 0;
async function draw(request, picture) {
    const tab = await browser.newPage();
    tab.on('pageerror', failure => { ++failures; console.error(String(failure)); });
    await tab.setViewport({ width: 1280, height: 720, deviceScaleFactor: 2 });
    await tab.goto(`http://127.0.0.1:${server.address().port}/`);
    await tab.waitForFunction('window.isReady', { timeout: 120_000 });
    const result = await tab.evaluate(description => window.draw(description), { ...request, sun });
    await tab.screenshot({ path: join(folder, picture) });
    await tab.close();
    return result;
}
for (const [index, { preset }] of pairs.entries()) {
    const number = index + 1;
    if (wanted.length > 0 && !wanted.includes(String(number))) {
        continue;
    }
    const { triangles } = await draw({ preset }, `${number}-theirs.png`);
    console.log(`${number} ${preset}: ${triangles} triangles with the ground`);
    const { camera } = await draw({ model: `/${number}.glb` }, `${number}-backdrop.png`);
    await writeFile(join(folder, `${number}.camera`), camera);
}
await browser.close();
server.close();
process.exit(failures === 0 ? 0 : 1);
