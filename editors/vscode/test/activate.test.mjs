// SPDX-License-Identifier: MIT
// The messages of the extension to a user without lsc. The bundle is loaded with a stand-in for
// the module `vscode`.
import assert from 'node:assert/strict';
import Module, { createRequire } from 'node:module';
import { test } from 'node:test';

/** A value with every member, which is a function, a class and a namespace at the same time. */
function anything() {
  return new Proxy(function () {}, {
    get(target, name) {
      if (name === 'then') {
        return undefined; // no promise
      }
      if (!(name in target)) {
        target[name] = typeof name === 'symbol' ? undefined : anything();
      }
      return target[name];
    },
    apply: () => anything(),
    construct: () => anything(),
  });
}

function standIn(settings) {
  const log = { errors: [], notes: [], executed: [], commands: new Map() };
  const vscode = anything();
  vscode.workspace = anything();
  vscode.workspace.workspaceFolders = undefined;
  vscode.workspace.getConfiguration = () => ({ get: (name) => settings[name] });
  vscode.window = anything();
  vscode.window.activeTextEditor = undefined;
  vscode.window.showErrorMessage = async (text, ...items) => {
    log.errors.push(text);
    return items[0];
  };
  vscode.window.showInformationMessage = async (text) => log.notes.push(text);
  vscode.commands = {
    registerCommand: (name, run) => log.commands.set(name, run),
    executeCommand: async (...all) => log.executed.push(all),
  };
  return { vscode, log };
}

test('without lsc a message says what to set, and opens the setting', async () => {
  const { vscode, log } = standIn({ path: '/nowhere/lsc' });
  const load = Module._load;
  Module._load = (name, ...rest) => (name === 'vscode' ? vscode : load(name, ...rest));
  try {
    const require = createRequire(import.meta.url);
    const extension = require('../dist/extension.js');
    extension.activate({ subscriptions: [], extensionUri: vscode.Uri });
    await new Promise((resolve) => setTimeout(resolve, 50));
    assert.equal(log.errors.length, 1);
    assert.match(log.errors[0], /need the compiler lsc\. `\/nowhere\/lsc` does not exist/);
    assert.match(log.errors[0], /set `lsys\.path`/);
    assert.deepEqual(log.executed, [['workbench.action.openSettings', 'lsys.path']]);
    assert.deepEqual([...log.commands.keys()], ['lsys.preview', 'lsys.restart']);
    log.commands.get('lsys.preview')();
    assert.match(log.notes[0], /Open an L-system grammar/);
    await extension.deactivate();
  } finally {
    Module._load = load;
  }
});
