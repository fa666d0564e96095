// SPDX-License-Identifier: MIT
// Drives the built page in headless Chromium: first plant, typing, mistakes and fixes, sliders,
// growth, forest, gallery, links, downloads, Stop, use without a network, keyboard, screen readers
// (axe-core), a plain file server and a strict Content-Security-Policy. Writes pictures of the page
// to build/playground-check.
// Usage: node playground.mjs      CHROMIUM: the browser (default /usr/bin/chromium)
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import puppeteer from 'puppeteer-core';
import { serve } from '../serve.mjs';
import { check, compressedSize, finish, part, root } from './support.mjs';

const require = createRequire(import.meta.url);
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const validator = require('gltf-validator');

const pictures = join(root, 'build/playground-check');
const received = join(pictures, 'downloads');
rmSync(pictures, { recursive: true, force: true });
mkdirSync(received, { recursive: true });

const policy =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; " +
  "img-src 'self' blob:; connect-src 'self' blob:; worker-src 'self'; manifest-src 'self'; " +
  "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const requested = new Map();
const server = await serve({
  base: '/some/folder/',
  headers: { 'Content-Security-Policy': policy },
  log: (name, path) => requested.set(name, path),
});

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  headless: true,
  args: [
    '--no-sandbox',
    '--ignore-gpu-blocklist',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
  ],
});

const problems = []; // violations of the policy, errors of scripts
async function newPage(width = 1280, height = 800, url = server.url, context = browser) {
  const page = await context.newPage();
  await page.setViewport({ width, height });
  page.on('pageerror', (error) => problems.push(`error: ${error.message}`));
  page.on('console', (message) => {
    if (message.type() === 'error') problems.push(`console: ${message.text()}`);
  });
  await page.evaluateOnNewDocument(() => {
    addEventListener('securitypolicyviolation', (event) => {
      console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`);
    });
  });
  await page.goto(url);
  return page;
}

/** The number of texts shown so far; a change means that a newer text is drawn. */
const drawn = (page) => page.evaluate(() => Number(document.body.dataset.drawn ?? 0));
const waitForPlant = (page, after = 0) =>
  page.waitForFunction((count) => Number(document.body.dataset.drawn ?? 0) > count, {}, after);
const factsOf = (page) => page.$eval('#facts', (element) => element.textContent);
const textOf = (page) =>
  page.evaluate(() =>
    [...document.querySelector('#editor').shadowRoot.querySelectorAll('.cm-line')]
      .map((line) => line.textContent)
      .join('\n'),
  );
const messagesOf = (page) => page.$eval('#messages', (element) => element.innerText);
const shoot = (page, name) => page.screenshot({ path: join(pictures, `${name}.png`) });
const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));

async function type(page, text) {
  const box = await page.$('#editor >>> .cm-content');
  await box.click();
  await page.keyboard.down('Control');
  await page.keyboard.press('a');
  await page.keyboard.up('Control');
  await page.keyboard.press('Backspace');
  for (const line of text.split('\n')) {
    await page.keyboard.sendCharacter(line);
    await page.keyboard.press('Enter');
  }
}

/** The share of pixels of the canvas that are not empty, and a sum that changes with the picture. */
const pixels = (page) =>
  page.evaluate(() => {
    const view = document.querySelector('#view');
    const copy = document.createElement('canvas');
    Object.assign(copy, { width: 160, height: 120 });
    const context = copy.getContext('2d');
    context.drawImage(view, 0, 0, 160, 120);
    const { data } = context.getImageData(0, 0, 160, 120);
    let solid = 0;
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 200) ++solid;
      sum = (sum * 31 + data[i] + 7 * data[i + 1] + 13 * data[i + 2] + data[i + 3]) % 1e9;
    }
    return { solid: solid / (160 * 120), sum };
  });

async function accessible(page, name) {
  await page.evaluate(axe);
  const { violations, passes } = await page.evaluate(() => globalThis.axe.run());
  for (const each of violations)
    console.error(`axe, ${name}: ${each.id}: ${each.nodes.map((node) => node.target).join('; ')}`);
  check(violations.length === 0 && passes.length > 10, `axe finds violations: ${name}`);
}

async function download(page, format) {
  const before = new Set(readdirSync(received));
  await page.click('#download');
  await page.click(`[data-format="${format}"]`);
  for (let i = 0; i < 200; ++i) {
    const name = readdirSync(received).find(
      (each) => !before.has(each) && !each.endsWith('.crdownload'),
    );
    if (name) return { name, bytes: readFileSync(join(received, name)) };
    await pause(50);
  }
  throw new Error(`no ${format} was downloaded`);
}

let page;
await part('first plant', async () => {
  // The best of five visits without anything stored, since other programs may run.
  const times = [];
  for (let i = 0; i < 5; ++i) {
    const context = await browser.createBrowserContext();
    const visit = await newPage(1280, 800, server.url, context);
    await waitForPlant(visit);
    times.push(await visit.evaluate(() => performance.now()));
    await context.close();
  }
  const time = Math.min(...times);
  page = await newPage();
  await waitForPlant(page);
  const names = [...requested.keys()].filter((name) => !/^(gallery|sw\.js)|GLTFLoader/.test(name));
  const size = names.reduce((sum, name) => sum + compressedSize(requested.get(name)), 0);
  console.log(`  first plant after ${times.map(Math.round).join(', ')} ms, ${(size / 1e6).toFixed(2)} MB compressed`);
  check(time <= 1500, `the first plant takes ${Math.round(time)} ms`);
  check(size <= 2e6, `the page has ${size} bytes compressed`);
  const { solid } = await pixels(page);
  check(solid > 0.02, `the plant covers ${solid} of the view`);
  check(/segments/.test(await factsOf(page)), await factsOf(page));
  await shoot(page, 'desktop-light');
});


await part('typing a grammar', async () => {
  const before = await drawn(page);
  await type(page, '#n = 4;\n#param turn 25 {5, 80};\n#w : F;\n#p : F : * : F[+(turn)F]F[-(turn)F]F;');
  await waitForPlant(page, before);
  await page.waitForFunction(() => /625 segments/.test(document.querySelector('#facts').textContent));
  check((await messagesOf(page)).trim() === '', await messagesOf(page));
  await shoot(page, 'typed');
});

await part('a slider', async () => {
  const before = await pixels(page);
  const slider = await page.$('#value-0');
  const box = await slider.boundingBox();
  await page.mouse.move(box.x + box.width * 0.27, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height / 2, { steps: 5 });
  await page.mouse.move(box.x + box.width * 0.8, box.y + box.height / 2, { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction(() => {
    const lines = document.querySelector('#editor').shadowRoot.textContent;
    const found = /#param turn ([\d.]+)/.exec(lines);
    return found && Number(found[1]) > 55;
  });
  await page.waitForFunction(() => {
    const { value } = document.querySelector('#value-0');
    const { textContent } = document.querySelector('#editor').shadowRoot;
    return textContent.includes(`#param turn ${value} {5, 80};`);
  });
  await pause(500);
  check((await pixels(page)).sum !== before.sum, 'the picture does not change');
});

await part('generations', async () => {
  await page.focus('#generations');
  const before = await drawn(page);
  await page.keyboard.press('ArrowLeft');
  await waitForPlant(page, before);
  await page.waitForFunction(() => /125 segments/.test(document.querySelector('#facts').textContent));
  check((await textOf(page)).startsWith('#n = 3;'), await textOf(page));
});

await part('a mistake and its fix', async () => {
  await type(page, '#n = 6;\n#set angle 25;\n#w : A(8);\n#p : A(x) : x > 1 : F(x) [+ A(x/2)] [- A(x/2)] A(x - 2);\n#q : A(x) : x < 1 : F(1);');
  await page.waitForSelector('#messages .fixes button');
  check((await messagesOf(page)).includes('matches no production'), await messagesOf(page));
  await page.click('#messages .reason summary');
  await page.waitForSelector('#messages .reason pre.right');
  await shoot(page, 'mistake');
  await accessible(page, 'with a message');
  await page.click('#messages .fixes button');
  await page.waitForFunction(() => document.querySelector('#messages').childElementCount === 0);
  check(/x >= 1|x <= 1/.test(await textOf(page)), await textOf(page));
  await pause(500);
  const good = await pixels(page);
  await page.click('#editor');
  await page.keyboard.down('Control');
  await page.keyboard.press('End');
  await page.keyboard.up('Control');
  await page.keyboard.type('#r : A(');
  await page.waitForSelector('#messages .error');
  await pause(300);
  check((await pixels(page)).sum === good.sum, 'the last plant does not stay');
});

await part('growth', async () => {
  await type(page, '#n = 5;\n#w : F;\n#p : F : * : F[+(25)F]F[-(25)F]F;');
  await page.waitForFunction(() => /3,125 segments/.test(document.querySelector('#facts').textContent));
  await page.click('#play');
  const sums = new Set();
  const generations = new Set();
  for (let i = 0; i < 200 && (await page.$eval('#play', (e) => e.ariaLabel)) === 'Stop growth'; ++i) {
    sums.add((await pixels(page)).sum);
    generations.add(await page.$eval('#generation-text', (element) => element.value));
    await pause(60);
  }
  check(sums.size >= 6, `${sums.size} pictures of the growth`);
  check(generations.size >= 4, `${generations.size} generations of the growth`);
  await page.waitForFunction(() => document.querySelector('#play').ariaLabel === 'Play growth');
});

await part('a link opens in a second page', async () => {
  await page.click('#share');
  await page.waitForFunction(() => location.hash.length > 20);
  const other = await newPage(1000, 700, page.url());
  await waitForPlant(other);
  check((await textOf(other)) === (await textOf(page)), 'the texts differ');
  await other.waitForFunction(() => /3,125 segments/.test(document.querySelector('#facts').textContent));
  // A change of the author is kept for the next visit; a link does not replace it.
  await type(other, '#n = 1;\n#w : F F F F F;');
  await other.waitForFunction(() => /\b5 segments/.test(document.querySelector('#facts').textContent));
  check((await other.evaluate(() => location.hash)) === '', 'the address has the old link');
  await other.goto('about:blank');
  await other.goto(server.url);
  await other.waitForFunction(() => /\b5 segments/.test(document.querySelector('#facts').textContent));
  await other.goto(`${server.url}#g=damaged`);
  await other.reload();
  await other.waitForFunction(() => /damaged/.test(document.querySelector('#toast').textContent));
  await other.close();
});

await part('gallery', async () => {
  await page.click('#open-gallery');
  await page.waitForFunction(() => document.querySelectorAll('#gallery .cards img').length > 20);
  await pause(500);
  await shoot(page, 'gallery');
  await accessible(page, 'gallery');
  for (const title of ['Fern', 'Silver birch']) {
    if (!(await page.$('#gallery[open]'))) await page.click('#open-gallery');
    const before = await drawn(page);
    await page.evaluate((text) => {
      [...document.querySelectorAll('.cards button')]
        .find((card) => card.querySelector('span').textContent === text)
        .click();
    }, title);
    await waitForPlant(page, before);
    await page.waitForFunction((text) => document.querySelector('#title').value === text, {}, title);
    await pause(400);
    check((await messagesOf(page)).trim() === '', `${title}: ${await messagesOf(page)}`);
    check((await pixels(page)).solid > 0.01, `${title} is not visible`);
    await shoot(page, title.toLowerCase().replace(' ', '-'));
  }
});

await part('every sample of the gallery', async () => {
  const list = await page.evaluate(() => fetch('./gallery/list.json').then((answer) => answer.json()));
  for (const sample of list) {
    const before = await drawn(page);
    await page.evaluate((text) => {
      document.querySelector('#open-gallery').click();
      [...document.querySelectorAll('.cards button')]
        .find((card) => card.querySelector('span').textContent === text)
        .click();
    }, sample.title);
    await waitForPlant(page, before);
    check(!(await page.$('#messages .error')), `${sample.id}: ${await messagesOf(page)}`);
  }
  console.log(`  ${list.length} samples`);
});

await part('downloads', async () => {
  await (
    await browser.target().createCDPSession()
  ).send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: received });
  await page.evaluate(() => {
    document.querySelector('#open-gallery').click();
    [...document.querySelectorAll('.cards button')]
      .find((card) => card.querySelector('span').textContent === 'Fern')
      .click();
  });
  await page.waitForFunction(() => document.querySelector('#title').value === 'Fern');
  await pause(500);
  const glb = await download(page, 'glb');
  const report = await validator.validateBytes(new Uint8Array(glb.bytes));
  check(report.issues.numErrors === 0 && report.issues.numWarnings === 0, JSON.stringify(report.issues));
  check(glb.name === 'fern.glb', glb.name);
  const starts = { obj: 'PK', svg: '<?xml', png: '\x89PNG', lsys: '//', lsb: '' };
  for (const [format, start] of Object.entries(starts)) {
    const { name, bytes } = await download(page, format);
    check(bytes.length > 100 && bytes.toString('latin1').startsWith(start), `${name}: ${bytes.length} bytes`);
  }
});

await part('a forest of 1,000 plants', async () => {
  await page.goto('about:blank');
  await page.evaluate(() => undefined);
  await page.goto(server.url);
  await page.evaluate(() => localStorage.clear());
  await page.reload();
  await waitForPlant(page);
  const before = await drawn(page);
  const start = performance.now();
  await page.click('#show-forest');
  await waitForPlant(page, before);
  await page.waitForFunction(() => /1,000 plants/.test(document.querySelector('#facts').textContent));
  console.log(`  shown after ${Math.round(performance.now() - start)} ms`);
  await pause(500);
  check((await pixels(page)).solid > 0.03, 'the forest is not visible');
  await shoot(page, 'forest');
  await page.click('#show-plant');
  await page.waitForFunction(() => /segments/.test(document.querySelector('#facts').textContent));
});

await part('Stop ends a grammar that explodes', async () => {
  await type(page, '#n = 60;\n#w : F;\n#p : F : ~ 0.99 : F F;\n#q : F : ~ 0.01 : F;');
  await page.waitForFunction(() => !document.querySelector('#busy').hidden);
  const frames = await page.evaluate(
    () =>
      new Promise((resolve) => {
        let count = 0;
        const start = performance.now();
        const step = () => (performance.now() - start > 2000 ? resolve(count) : (++count, requestAnimationFrame(step)));
        step();
      }),
  );
  check(frames > 5, `${frames} frames in two seconds`);
  await shoot(page, 'busy');
  await page.click('#stop');
  await page.waitForFunction(() => document.querySelector('#busy').hidden, { timeout: 2000 });
  check((await messagesOf(page)).includes('stopped'), await messagesOf(page));
  await type(page, '#n = 1;\n#w : F;\n#p : F : * : F[+(25)F]F;');
  await page.waitForFunction(() => /\b3 segments/.test(document.querySelector('#facts').textContent), {
    timeout: 5000,
  });
});

await part('keyboard', async () => {
  await page.focus('#view');
  await pause(300);
  const before = (await pixels(page)).sum;
  await page.keyboard.press('ArrowRight');
  await pause(300);
  check((await pixels(page)).sum !== before, 'an arrow key does not turn the plant');
  await page.evaluate(() => document.activeElement.blur());
  const reached = new Set();
  for (let i = 0; i < 40; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement.id));
  }
  for (const id of ['open-gallery', 'share', 'download', 'view', 'show-forest', 'play', 'generations', 'editor'])
    check(reached.has(id), `Tab does not reach ${id}`);
  await page.focus('#download');
  await page.keyboard.press('Enter');
  await page.keyboard.press('ArrowDown');
  check((await page.evaluate(() => document.activeElement.dataset.format)) === 'obj', 'menu');
  await page.keyboard.press('Escape');
  check((await page.evaluate(() => document.activeElement.id)) === 'download', 'Escape of the menu');
});

await part('help, dark and phone', async () => {
  await page.click('#open-help');
  await accessible(page, 'help');
  await shoot(page, 'help');
  await page.keyboard.press('Escape');
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'dark' }]);
  await page.evaluate(() => localStorage.clear());
  await page.goto('about:blank');
  await page.goto(server.url);
  await waitForPlant(page);
  await pause(300);
  await shoot(page, 'desktop-dark');
  await accessible(page, 'dark');
  await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'light' }]);
  await pause(500);
  await accessible(page, 'light');
  await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
  await page.reload();
  await waitForPlant(page);
  await pause(300);
  await shoot(page, 'phone');
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(wide <= 390, `the page is ${wide} wide on a phone`);
  await accessible(page, 'phone');
  await page.screenshot({ path: join(pictures, 'phone-whole.png'), fullPage: true });
});

await part('without a network', async () => {
  await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
  await server.close();
  await page.setViewport({ width: 1280, height: 800 });
  await page.goto(server.url);
  await waitForPlant(page);
  const before = await drawn(page);
  await page.click('#open-gallery');
  await page.waitForFunction(() => document.querySelectorAll('#gallery .cards img').length > 20);
  await page.evaluate(() =>
    [...document.querySelectorAll('.cards button')]
      .find((card) => card.querySelector('span').textContent === 'Foxglove')
      .click(),
  );
  await waitForPlant(page, before);
  check(/segments/.test(await factsOf(page)), await factsOf(page));
  await page.click('#show-forest');
  await page.waitForFunction(() => /1,000 plants/.test(document.querySelector('#facts').textContent));
});

await part('a plain file server', async () => {
  const plain = await serve({ plainTypes: true });
  const other = await newPage(1000, 700, plain.url);
  await waitForPlant(other);
  check((await pixels(other)).solid > 0.02, 'no plant');
  await other.close();
  await plain.close();
});

check(problems.length === 0, problems.join('\n'));
check(existsSync(join(pictures, 'phone.png')), 'no pictures');
await browser.close();
finish();
