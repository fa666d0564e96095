// SPDX-License-Identifier: MIT
// The client code of the extension against the server, without VS Code.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { PlantSession } from '../dist/modules/plant_session.mjs';
import { previewPage } from '../dist/modules/preview_page.mjs';
import { sourcesAt } from '../dist/modules/sources.mjs';
import { root, startServer, uriOf } from './server.mjs';

const uri = 'file:///p/tree.lsys';
const tree = `#n = 4;
#param l 2 {1, 4}; // length
#w : F(1) A;
#grow : A : * : F(l) [+(30) A] [-(30) A];
`;

/** A session whose page and editor record what they get. */
function recordedSession(server, limits = {}) {
  const posted = [];
  const selected = [];
  const session = new PlantSession(uri, 'tree.lsys', {
    request: server.request,
    post: (message) => posted.push(message),
    select: (target, range) => selected.push([target, range]),
    limits: () => limits,
  });
  return { session, posted, selected, last: (type) => posted.filter((each) => each.type === type).at(-1) };
}

test('the server announces plants and checks grammars', async () => {
  const server = await startServer();
  assert.equal(server.capabilities.experimental.lsysPlant, true);
  await server.open(uri, '#w : F;\n#p : A : x : F;\n');
  const published = await server.diagnostics();
  assert.equal(published.uri, uri);
  assert.ok(published.diagnostics.length > 0);
  assert.equal(await server.stop(), 0);
});

test('a page that is ready gets the plant, and later each change of the text', async () => {
  const server = await startServer();
  await server.open(uri, tree);
  const { session, posted, last } = recordedSession(server);
  await session.receive({ type: 'ready' });
  assert.deepEqual(posted.map((each) => each.type), ['busy', 'plant', 'highlight']);
  const plant = posted[1];
  assert.equal(Buffer.from(plant.glb).subarray(0, 4).toString(), 'glTF');
  assert.equal(plant.info.generations, 4);
  assert.equal(plant.lastGeneration, 4);
  assert.equal(plant.parameters[0].comment, 'length');

  await server.change(uri, tree.replace('#n = 4', '#n = 3'));
  await session.refresh();
  assert.equal(last('plant').info.generations, 3);
  assert.ok(last('plant').info.modules < plant.info.modules);

  // A page that was closed and opened again.
  const count = posted.length;
  await session.receive({ type: 'ready' });
  assert.equal(posted.length, count + 1);
  assert.equal(await server.stop(), 0);
});

test('generation, seed and parameters of the page are those of the plant', async () => {
  const server = await startServer();
  await server.open(uri, tree);
  const { session, last } = recordedSession(server);
  await session.receive({
    type: 'options',
    options: { generations: 2, seed: 9, definitions: { l: 3.5 } },
  });
  const plant = last('plant');
  assert.equal(plant.info.generations, 2);
  assert.equal(plant.info.seed, 9);
  assert.equal(plant.parameters[0].value, 3.5);
  assert.equal(await server.stop(), 0);
});

test('a mistake leaves the plant and shows a message', async () => {
  const server = await startServer();
  await server.open(uri, tree);
  const { session, last } = recordedSession(server);
  await session.refresh();
  await server.change(uri, `${tree}#broken : A(;\n`);
  await session.refresh();
  assert.match(last('problem').message, /^line 5: /);
  await server.change(uri, '#n = 60;\n#w : A;\n#p : A : * : A A;\n');
  await session.refresh();
  assert.match(last('problem').message, /modules/);
  await server.change(uri, tree);
  await session.refresh();
  assert.equal(last('plant').info.generations, 4);
  assert.equal(await server.stop(), 0);
});

test('each key press asks again; only the last plant is shown', async () => {
  const server = await startServer();
  await server.open(uri, tree);
  const { session, posted } = recordedSession(server);
  const all = [];
  for (const n of [9, 10, 11, 5]) {
    await server.change(uri, tree.replace('#n = 4', `#n = ${n}`));
    all.push(session.refresh());
  }
  await Promise.all(all);
  const plants = posted.filter((each) => each.type === 'plant' || each.type === 'problem');
  assert.equal(plants.length, 1);
  assert.equal(plants[0].info.generations, 5);
  assert.equal(await server.stop(), 0);
});

test('a grammar without end gives a message after the time of the settings', async () => {
  const server = await startServer();
  await server.open(uri, '#n = 4000000000;\n#w : A(0);\n#p : A(x) : * : A(x + 1);\n');
  const { session, last } = recordedSession(server, { maxSeconds: 0.3 });
  await session.refresh();
  assert.match(last('problem').message, /longer than 0.3 s/);
  assert.equal(await server.stop(), 0);
});

test('a click selects the production, with Alt the module; the cursor finds the parts', async () => {
  const server = await startServer();
  await server.open(uri, tree);
  const { session, selected, last } = recordedSession(server);
  await session.refresh();
  await session.receive({ type: 'pick', source: 1, exact: false });
  await session.receive({ type: 'pick', source: 1, exact: true });
  await session.receive({ type: 'pick', source: 7, exact: false }); // of an older plant
  assert.deepEqual(selected, [
    [uri, { start: { line: 3, character: 0 }, end: { line: 3, character: 41 } }],
    [uri, { start: { line: 3, character: 16 }, end: { line: 3, character: 20 } }],
  ]);
  session.moveCursor(uri, { line: 3, character: 17 });
  assert.deepEqual(last('highlight').sources, [1]);
  session.moveCursor(uri, { line: 3, character: 2 });
  assert.deepEqual(last('highlight').sources, [1]);
  session.moveCursor(uri, { line: 0, character: 2 });
  assert.deepEqual(last('highlight').sources, []);
  session.moveCursor('file:///p/other.lsys', { line: 3, character: 17 });
  assert.deepEqual(last('highlight').sources, []);

  // The statement has another number among the sources of the new plant; the highlight follows.
  session.moveCursor(uri, { line: 3, character: 17 });
  await server.change(uri, tree.replace('F(1) A', 'f(1) A'));
  await session.refresh();
  assert.deepEqual(last('highlight').sources, [0]);
  session.clearHighlight();
  assert.deepEqual(last('highlight').sources, []);
  assert.equal(await server.stop(), 0);
});

test('sources of a position: the module there, else those of the statement', () => {
  const range = (line, from, to) => ({
    start: { line, character: from },
    end: { line, character: to },
  });
  const sources = [
    { production: 'p', uri, range: range(1, 10, 11), statement: range(1, 0, 30) },
    { production: 'p', uri, range: range(1, 14, 15), statement: range(1, 0, 30) },
    { production: null },
  ];
  assert.deepEqual(sourcesAt(sources, uri, { line: 1, character: 14 }), [1]);
  assert.deepEqual(sourcesAt(sources, uri, { line: 1, character: 3 }), [0, 1]);
  assert.deepEqual(sourcesAt(sources, uri, { line: 2, character: 0 }), []);
});

test('samples of the gallery have plants', async () => {
  const server = await startServer();
  for (const name of ['carey-type-0', 'carey-type-2']) {
    const path = join(root, 'samples', name, `${name}.lsys`);
    const sample = uriOf(path);
    await server.open(sample, readFileSync(path, 'utf8'));
    const { plant } = await server.request({ textDocument: { uri: sample }, generations: 8 });
    assert.ok(plant.triangles > 100, name);
    assert.ok(plant.sources.length > 1, name);
    assert.ok(plant.sources.every((source) => source.uri === sample), name);
  }
  assert.equal(await server.stop(), 0);
});

test('the page runs no script but its own', () => {
  const page = previewPage({ script: 'S', source: 'O', nonce: 'N' });
  assert.match(page, /default-src 'none'; script-src 'nonce-N'; style-src 'nonce-N'/);
  assert.doesNotMatch(page, /unsafe|https?:|\son[a-z]+=/);
});
