// SPDX-License-Identifier: MIT
// The protocol library of VS Code as a client of `lsc lsp`: what an editor of today asks for, with
// positions in UTF-16 and in UTF-8.
// Usage: node protocol.mjs NODE_MODULES LSC FOLDER     FOLDER: an empty folder for the grammars
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, lsc, folder] = process.argv.slice(2);
const require = createRequire(path.join(modules, 'x.js'));
const lsp = require('vscode-languageserver-protocol/node');

const part = '#leaf : L : * : F(size);\n';
const tree = [
  '#n = 2;',
  '#define size 2;',
  '#include "part.lsys";',
  '#w : A(1) L; /* \u{1F332} */ #define thick 1;',
  '#grow : A(x) : x < size : F(x) A(x + 1);',
  '#stop : A(x) : x > size : F(thick) F({0, 1});',
  '#material 3 colour 1 0.5 0;',
  '',
].join('\n');

/** The offset of a position, counted by this program. */
function offsetOf(text, position, encoding) {
  const lines = text.split('\n');
  const before = lines.slice(0, position.line).reduce((sum, line) => sum + line.length + 1, 0);
  const line = lines[position.line];
  if (encoding === 'utf-16') {
    return before + position.character;
  }
  return before + Buffer.from(line).subarray(0, position.character).toString().length;
}

function applied(text, edits, encoding) {
  const at = (position) => offsetOf(text, position, encoding);
  return [...edits]
    .sort((a, b) => at(b.range.start) - at(a.range.start))
    .reduce((now, edit) => now.slice(0, at(edit.range.start)) + edit.newText + now.slice(at(edit.range.end)), text);
}

async function talk(encoding) {
  fs.writeFileSync(path.join(folder, 'part.lsys'), part);
  fs.writeFileSync(path.join(folder, 'tree.lsys'), tree);
  const uri = pathToFileURL(path.join(folder, 'tree.lsys')).href;
  const partUri = pathToFileURL(path.join(folder, 'part.lsys')).href;
  const textDocument = { uri };
  const server = spawn(lsc, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
  const ended = new Promise((resolve) => server.on('exit', resolve));
  const connection = lsp.createProtocolConnection(
    new lsp.StreamMessageReader(server.stdout), new lsp.StreamMessageWriter(server.stdin));
  const registered = new Promise((resolve) => {
    connection.onRequest(lsp.RegistrationRequest.type, (params) => resolve(params.registrations));
  });
  connection.listen();

  const started = await connection.sendRequest(lsp.InitializeRequest.type, {
    processId: process.pid,
    rootUri: null,
    workspaceFolders: [{ uri: pathToFileURL(folder).href, name: 'test' }],
    capabilities: {
      general: { positionEncodings: encoding === 'utf-8' ? ['utf-8', 'utf-16'] : ['utf-16'] },
      workspace: { didChangeWatchedFiles: { dynamicRegistration: true } },
      textDocument: {
        diagnostic: {},
        publishDiagnostics: { relatedInformation: true, codeDescriptionSupport: true },
        completion: { completionItem: { snippetSupport: true } },
        documentSymbol: { hierarchicalDocumentSymbolSupport: true },
      },
    },
  });
  const can = started.capabilities;
  assert.equal(can.positionEncoding, encoding);
  await connection.sendNotification(lsp.InitializedNotification.type, {});
  assert.equal((await registered)[0].method, 'workspace/didChangeWatchedFiles');

  let text = tree;
  let version = 1;
  await connection.sendNotification(lsp.DidOpenTextDocumentNotification.type, {
    textDocument: { uri, languageId: 'lsys', version, text },
  });
  const column = (line, column16) => (encoding === 'utf-16'
    ? column16
    : Buffer.byteLength(text.split('\n')[line].slice(0, column16)));
  const position = (line, column16) => ({ line, character: column(line, column16) });
  const ask = (type, more = {}) => connection.sendRequest(type, { textDocument, ...more });
  const change = async (line, from, to, replacement) => {
    const range = { start: position(line, from), end: position(line, to) };
    text = applied(text, [{ range, newText: replacement }], encoding);
    version += 1;
    await connection.sendNotification(lsp.DidChangeTextDocumentNotification.type, {
      textDocument: { uri, version }, contentChanges: [{ range, text: replacement }],
    });
  };
  const pull = async () => (await ask(lsp.DocumentDiagnosticRequest.type)).items;
  const all = { start: { line: 0, character: 0 }, end: { line: 100, character: 0 } };

  // Diagnose: related places, codes and links.
  const [gap] = await pull();
  assert.equal(gap.code, 'condition-gap');
  assert.ok(fs.existsSync(new URL(gap.codeDescription.href)), gap.codeDescription.href);
  assert.ok(gap.codeDescription.href.endsWith('#condition-gap'));
  await change(5, 28, 33, 'thin');
  const unknown = (await pull()).find((each) => each.code === 'unknown-name');
  assert.deepEqual(unknown.range, { start: position(5, 28), end: position(5, 32) });
  await change(5, 28, 32, 'thick');

  // Fix, and fix all.
  const fixes = await ask(lsp.CodeActionRequest.type, { range: gap.range, context: { diagnostics: [gap] } });
  assert.ok(fixes.length >= 1);
  assert.match(applied(text, fixes[0].edit.changes[uri], encoding), /[<>]= size/);
  await change(0, 6, 7, '');
  const [fixAll] = await ask(lsp.CodeActionRequest.type, {
    range: all, context: { diagnostics: [], only: ['source.fixAll'] },
  });
  assert.ok(applied(text, fixAll.edit.changes[uri], encoding).startsWith('#n = 2;\n'));
  await change(0, 6, 6, ';');

  // Rename, across files and after a character of two units.
  const renamed = await ask(lsp.RenameRequest.type, { position: position(1, 9), newName: 'reach' });
  assert.equal(applied(part, renamed.changes[partUri], encoding), '#leaf : L : * : F(reach);\n');
  assert.equal(renamed.changes[uri].length, 3);
  const thick = await ask(lsp.RenameRequest.type, { position: position(5, 30), newName: 'width' });
  assert.match(applied(text, thick.changes[uri], encoding), /\*\/ #define width 1;\n/);

  // Complete.
  await change(7, 0, 0, '#more : L : * : ');
  const items = await ask(lsp.CompletionRequest.type, { position: position(7, 16) });
  const offered = items.find((each) => each.label === 'A');
  assert.equal(offered.textEdit.newText, 'A(${1:x})');
  assert.ok(offered.documentation.value.includes('#grow'));
  await change(7, 0, 16, '');

  // Inlay hints and code lenses.
  const hints = await ask(lsp.InlayHintRequest.type, { range: all });
  assert.ok(hints.some((each) => each.label === 'draw 0' && each.position.line === 5));
  assert.ok(hints.some((each) => each.label === 'from age 0' && each.position.line === 4));
  const lenses = await ask(lsp.CodeLensRequest.type);
  assert.ok(lenses.some((each) => each.command.title.startsWith('generation 2: ')));
  assert.ok(lenses.some((each) => each.command.title === 'used once'));

  // Semantic tokens: the last name of a line with a character of two units.
  const legend = can.semanticTokensProvider.legend.tokenTypes;
  const { data } = await ask(lsp.SemanticTokensRequest.type);
  const tokens = [];
  for (let i = 0, line = 0, character = 0; i < data.length; i += 5) {
    character = data[i] === 0 ? character + data[i + 1] : data[i + 1];
    line += data[i];
    const begin = { line, character };
    const end = { line, character: character + data[i + 2] };
    tokens.push([text.slice(offsetOf(text, begin, encoding), offsetOf(text, end, encoding)), legend[data[i + 3]], line]);
  }
  assert.ok(tokens.some((each) => String(each) === 'thick,variable,3'), String(tokens));
  assert.ok(tokens.some((each) => String(each) === 'grow,method,4'), String(tokens));

  // Hover, signature, definition, references, symbols, folding, colours.
  const hover = await ask(lsp.HoverRequest.type, { position: position(1, 9) });
  assert.match(hover.contents.value, /value: 2/);
  const place = await ask(lsp.DefinitionRequest.type, { position: position(5, 30) });
  assert.deepEqual(place[0].range, { start: position(3, 30), end: position(3, 35) });
  const references = await ask(lsp.ReferencesRequest.type, {
    position: position(1, 9), context: { includeDeclaration: false },
  });
  assert.equal(references.length, 3);
  const symbols = await ask(lsp.DocumentSymbolRequest.type);
  assert.ok(symbols.some((each) => each.name === 'grow' && each.detail.startsWith('#grow')));
  const found = await connection.sendRequest(lsp.WorkspaceSymbolRequest.type, { query: 'leaf' });
  assert.equal(found[0].location.uri, partUri);
  assert.ok(Array.isArray(await ask(lsp.FoldingRangeRequest.type)));
  const [colour] = await ask(lsp.DocumentColorRequest.type);
  assert.deepEqual(colour.color, { red: 1, green: 0.5, blue: 0, alpha: 1 });
  const [written] = await ask(lsp.ColorPresentationRequest.type, {
    range: colour.range, color: { red: 0, green: 1, blue: 0.25, alpha: 1 },
  });
  assert.equal(written.label, '0 1 0.25');

  // Format: the file, a range, and on `;`.
  const options = { tabSize: 4, insertSpaces: true };
  await change(6, 0, 27, '#material   3 colour 1 0.5 0;');
  const end = text.split('\n')[6].length;
  for (const [type, more] of [
    [lsp.DocumentFormattingRequest.type, {}],
    [lsp.DocumentRangeFormattingRequest.type, { range: { start: position(6, 0), end: position(6, end) } }],
    [lsp.DocumentOnTypeFormattingRequest.type, { position: position(6, end), ch: ';' }],
  ]) {
    const edits = await ask(type, { options, ...more });
    assert.match(applied(text, edits, encoding), /\n#material 3 colour 1 0\.5 0;\n/);
  }

  await connection.sendRequest(lsp.ShutdownRequest.type);
  await connection.sendNotification(lsp.ExitNotification.type);
  assert.equal(await ended, 0);
  connection.dispose();
}

try {
  for (const encoding of ['utf-16', 'utf-8']) {
    await talk(encoding);
  }
  console.log('protocol: all passed');
} catch (error) {
  console.error(error);
  process.exit(1); // the server may still run; it ends with its input
}
