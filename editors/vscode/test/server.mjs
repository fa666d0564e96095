// SPDX-License-Identifier: MIT
// A running `lsc lsp` for tests, with the protocol library that VS Code uses.

import { spawn } from 'node:child_process';
import { after } from 'node:test';
import { pathToFileURL } from 'node:url';
import rpc from 'vscode-jsonrpc/node.js';

export const lsc = process.env.LSC ?? 'lsc';
export const root = process.env.LSYS_ROOT ?? process.cwd();

const running = new Set();
// Ends the servers that failed tests have left running.
after(() => running.forEach((each) => each.kill()));

export async function startServer() {
  const process_ = spawn(lsc, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
  running.add(process_);
  const exited = new Promise((resolve) => process_.once('exit', resolve));
  process_.once('exit', () => running.delete(process_));
  const connection = rpc.createMessageConnection(
    new rpc.StreamMessageReader(process_.stdout),
    new rpc.StreamMessageWriter(process_.stdin),
  );
  const published = [];
  let arrived = () => {};
  connection.onNotification('textDocument/publishDiagnostics', (message) => {
    published.push(message);
    arrived();
  });
  connection.listen();
  const { capabilities } = await connection.sendRequest('initialize', {
    processId: process.pid,
    rootUri: null,
    capabilities: {},
  });
  await connection.sendNotification('initialized', {});
  let version = 0;
  return {
    connection,
    capabilities,
    /** The next published diagnostics. */
    async diagnostics() {
      while (published.length === 0) {
        await new Promise((resolve) => {
          arrived = resolve;
        });
      }
      return published.shift();
    },
    request: (params) => connection.sendRequest('lsys/plant', params),
    open(uri, text) {
      return connection.sendNotification('textDocument/didOpen', {
        textDocument: { uri, languageId: 'lsys', version: ++version, text },
      });
    },
    change(uri, text) {
      return connection.sendNotification('textDocument/didChange', {
        textDocument: { uri, version: ++version },
        contentChanges: [{ text }],
      });
    },
    /** The exit status of the server. */
    async stop() {
      await connection.sendRequest('shutdown');
      await connection.sendNotification('exit');
      const status = await exited;
      connection.dispose();
      return status;
    },
  };
}

export const uriOf = (path) => pathToFileURL(path).toString();
