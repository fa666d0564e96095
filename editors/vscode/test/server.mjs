// SPDX-License-Identifier: MIT
// A running `lsc lsp` for tests, with the protocol library that VS Code uses.

import { spawn } from 'node:child_process';
import { pathToFileURL } from 'node:url';
import rpc from 'vscode-jsonrpc/node.js';

export const lsc = process.env.LSC ?? 'lsc';
export const root = process.env.LSYS_ROOT ?? process.cwd();

export async function startServer() {
  const process_ = spawn(lsc, ['lsp'], { stdio: ['pipe', 'pipe', 'inherit'] });
  const exited = new Promise((resolve) => process_.once('exit', resolve));
  const connection = rpc.createMessageConnection(
    new rpc.StreamMessageReader(process_.stdout),
    new rpc.StreamMessageWriter(process_.stdin),
  );
  const diagnostics = new Map();
  connection.onNotification('textDocument/publishDiagnostics', ({ uri, diagnostics: all }) =>
    diagnostics.set(uri, all),
  );
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
    diagnostics,
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
