// SPDX-License-Identifier: MIT
// Tests the page of the preview in Chromium, with plants of the server. There is no VS Code: the
// test records the ranges that PlantSession selects in the editor.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { chromium } from 'playwright-core';
import { PlantSession } from '../../dist/modules/plant_session.mjs';
import { previewPage } from '../../dist/modules/preview_page.mjs';
import { root, startServer, uriOf } from '../server.mjs';

const pictures = process.env.LSYS_PICTURES ?? 'pictures';
mkdirSync(pictures, { recursive: true });

const uri = 'file:///p/tree.lsys';
const tree = `#n = 5;
#set angle 28;
#set width 0.3;
#param ratio 0.75 {0.5, 0.9}; // length of a branch relative to its parent
#param lean  20   {0, 60};    // degrees
#object L LEAF;
#w : '(9) F(2) A(2);
#grow : A(l) : * : F(l) [+(lean) A(l*ratio)] /(137) [-(lean) A(l*ratio)] L(0.6);
`;

let browser;
let web;
let origin;

before(async () => {
  const script = readFileSync('dist/preview.js');
  web = createServer((request, response) => {
    if (request.url === '/preview.js') {
      response.setHeader('Content-Type', 'text/javascript').end(script);
    } else {
      response
        .setHeader('Content-Type', 'text/html')
        .end(previewPage({ script: '/preview.js', source: origin, nonce: 'abc' }));
    }
  });
  await new Promise((resolve) => web.listen(0, '127.0.0.1', resolve));
  origin = `http://127.0.0.1:${web.address().port}`;
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
});

after(async () => {
  await browser?.close();
  web?.close();
});

/** A page with a session, as the extension joins them. */
async function openPreview(server, documentUri = uri) {
  const page = await browser.newPage({ viewport: { width: 900, height: 600 } });
  const problems = [];
  const selected = [];
  page.on('console', (message) => {
    if (message.type() === 'error') {
      problems.push(message.text());
    }
  });
  page.on('pageerror', (error) => problems.push(String(error)));
  const session = new PlantSession(documentUri, 'tree.lsys', {
    request: server.request,
    post: (message) => {
      const plain =
        message.type === 'plant'
          ? { ...message, glb: Buffer.from(message.glb).toString('base64') }
          : message;
      sent = sent.then(() =>
        page.evaluate((data) => {
          if (data.type === 'plant') {
            data.glb = Uint8Array.from(atob(data.glb), (c) => c.charCodeAt(0)).buffer;
          }
          window.postMessage(data, '*');
        }, plain),
      );
    },
    select: (target, range) => selected.push([target, range]),
    limits: () => ({}),
  });
  let sent = Promise.resolve();
  await page.exposeFunction('toExtension', (message) => session.receive(message));
  await page.addInitScript(() => {
    globalThis.acquireVsCodeApi = () => ({ postMessage: (message) => globalThis.toExtension(message) });
  });
  await page.goto(origin);
  const shown = async (count) => {
    await page.waitForFunction((n) => Number(document.body.dataset.shown ?? 0) >= n, count, { timeout: 60000 });
    await sent;
  };
  await shown(1);
  const picture = async (name) => {
    await page.evaluate(() => globalThis.plantView.draw());
    await page.screenshot({ path: join(pictures, `${name}.png`) });
  };
  return { page, session, selected, problems, shown, picture };
}

/** A place of the window where the plant has this source. */
async function placeOf(page, source) {
  return page.evaluate((wanted) => {
    const view = globalThis.plantView;
    for (let y = 20; y < 580; y += 4) {
      for (let x = 260; x < 890; x += 4) {
        if (view.sourceAt(x, y) === wanted) {
          return { x, y };
        }
      }
    }
    return null;
  }, source);
}

test('the plant is drawn, follows the text and the sliders, and is clicked', async () => {
  const server = await startServer();
  await server.open(uri, tree);
  const { page, session, selected, problems, shown, picture } = await openPreview(server);
  await picture('plant');
  assert.match(await page.textContent('.status'), /^generation 5, .* triangles, \d+ ms$/);
  assert.deepEqual(await page.locator('.name').allTextContents(), ['Generations', 'Seed', 'ratio', 'lean']);

  // A click on the trunk, which the axiom draws, and on a branch.
  const trunk = await placeOf(page, 0);
  await page.mouse.click(trunk.x, trunk.y);
  const branch = await placeOf(page, 1);
  await page.mouse.click(branch.x, branch.y);
  await page.keyboard.down('Alt');
  await page.mouse.click(branch.x, branch.y);
  await page.keyboard.up('Alt');
  await page.waitForFunction(() => true);
  assert.deepEqual(selected, [
    [uri, { start: { line: 6, character: 0 }, end: { line: 6, character: 20 } }],
    [uri, { start: { line: 7, character: 0 }, end: { line: 7, character: 80 } }],
    [uri, { start: { line: 7, character: 19 }, end: { line: 7, character: 23 } }],
  ]);

  // A drag moves the camera, the clicks so far did not.
  const isMoved = () => page.evaluate(() => globalThis.plantView.isMovedByUser());
  assert.equal(await isMoved(), false);
  await page.mouse.move(600, 300);
  await page.mouse.down();
  await page.mouse.move(660, 300, { steps: 4 });
  await page.mouse.up();
  assert.equal(await isMoved(), true);
  assert.equal(selected.length, 3, 'a drag is no click');
  await page.getByText('Fit').click();
  assert.equal(await isMoved(), false);

  // The text cursor is on the leaf.
  session.moveCursor(uri, { line: 7, character: tree.split('\n')[7].indexOf('L(0.6)') });
  await page.waitForFunction(() => globalThis.plantView.highlightedTriangles() > 0);
  await picture('leaves-highlighted');
  const leaves = await page.evaluate(() => globalThis.plantView.highlightedTriangles());
  session.moveCursor(uri, { line: 7, character: 3 });
  await page.waitForFunction((n) => globalThis.plantView.highlightedTriangles() > n, leaves);
  session.moveCursor(uri, { line: 0, character: 0 });
  await page.waitForFunction(() => globalThis.plantView.highlightedTriangles() === 0);

  await page.locator('input[type=range]').nth(0).fill('2');
  await shown(2);
  assert.match(await page.textContent('.status'), /^generation 2, /);
  await picture('generation-2');
  await page.locator('input[type=number]').nth(3).fill('50');
  await shown(3);
  await picture('lean-50');
  await page.getByText('Reset').click();
  await shown(4);
  assert.match(await page.textContent('.status'), /^generation 5, /);

  await server.change(uri, tree.replace('#n = 5', '#n = 3'));
  await session.refresh();
  await shown(5);
  assert.match(await page.textContent('.status'), /^generation 3, /);

  await server.change(uri, tree.replace('A(2);', 'A(2'));
  await session.refresh();
  await page.waitForSelector('.status.problem');
  await picture('mistake');
  assert.match(await page.textContent('.status'), /^line \d+: /);
  assert.ok(await placeOf(page, 0), 'the last plant stays');
  assert.equal(await page.locator('input[type=range]').nth(0).inputValue(), '3');
  assert.deepEqual(problems, []);
  await page.close();
  assert.equal(await server.stop(), 0);
});

test('a sample with bark and leaves obeys the policy of the page', async () => {
  const server = await startServer();
  const path = join(root, 'samples/carey-type-0/carey-type-0.lsys');
  await server.open(uriOf(path), readFileSync(path, 'utf8'));
  const { page, problems, picture } = await openPreview(server, uriOf(path));
  await picture('sample');
  assert.deepEqual(problems, []);
  await page.close();
  assert.equal(await server.stop(), 0);
});
