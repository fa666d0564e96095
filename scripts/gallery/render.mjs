// SPDX-License-Identifier: MIT
// Renders GLB files to PNG with three.js in headless Chromium, one picture per file.
// Usage: node render.mjs SIZE FILE.glb=OUT.png[,az=DEGREES][,el=DEGREES][,at=SECONDS] ...
// az turns the camera about the plant from the front, el raises the camera, at is the time of an animation.
// Needs Chromium (CHROMIUM=/path/to/it).
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import puppeteer from 'puppeteer-core';

const [size, ...jobs] = process.argv.slice(2);
if (!(Number(size) > 0) || jobs.length === 0) {
  console.error('usage: node render.mjs SIZE FILE.glb=OUT.png[,az=DEGREES][,el=DEGREES][,at=SECONDS] ...');
  process.exit(2);
}

const page = `<!doctype html><body style="margin:0"><canvas id="canvas" width="${size}" height="${size}"></canvas>
<script type="importmap">{"imports": {"three": "/node_modules/three/build/three.module.js"}}</script>
<script type="module" src="/scene.mjs"></script>`;

const here = fileURLToPath(new URL('.', import.meta.url));
const types = { '.js': 'text/javascript', '.mjs': 'text/javascript' };
let model = '';
const server = createServer(async (request, response) => {
  try {
    if (request.url === '/') {
      response.setHeader('content-type', 'text/html');
      response.end(page);
      return;
    }
    const path = request.url.startsWith('/model') ? model : join(here, request.url);
    response.setHeader('content-type', types[extname(path)] ?? 'application/octet-stream');
    response.end(await readFile(path));
  } catch (error) {
    response.statusCode = 404;
    response.end(String(error));
  }
}).listen(0);

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
let failed = false;
try {
  const tab = await browser.newPage();
  tab.on('pageerror', (error) => console.error(String(error)));
  await tab.setViewport({ width: Number(size), height: Number(size) });
  await tab.goto(`http://localhost:${server.address().port}/`);
  await tab.waitForFunction('window.draw !== undefined');
  for (const [index, job] of jobs.entries()) {
    const [files, ...options] = job.split(',');
    const [file, picture] = files.split('=');
    const view = Object.fromEntries(options.map((option) => option.split('=')));
    model = file;
    try {
      const triangles = await tab.evaluate(
        (url, ...numbers) => window.draw(url, ...numbers), `/model${index}.glb`,
        ...[view.az, view.el, view.at].map((word) => word && Number(word)));
      await tab.screenshot({ path: picture });
      console.log(`${picture}: ${triangles} triangles`);
    } catch (error) {
      console.error(`${file}: ${error}`);
      failed = true;
    }
  }
} finally {
  await browser.close();
  server.close();
}
process.exit(failed ? 1 : 0);
