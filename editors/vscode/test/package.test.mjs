// SPDX-License-Identifier: MIT
// Checks that the files named by package.json exist, and that its snippets are grammars.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { lsc } from './server.mjs';

const manifest = JSON.parse(readFileSync('package.json', 'utf8'));
const { contributes } = manifest;

test('the files of the manifest exist', () => {
  const files = [
    manifest.main,
    manifest.icon,
    ...contributes.languages.flatMap(({ configuration, icon }) => [
      configuration,
      icon.light,
      icon.dark,
    ]),
    ...contributes.grammars.map(({ path }) => path),
    ...contributes.snippets.map(({ path }) => path),
    'dist/preview.js',
    'README.md',
    'NOTICES.txt',
  ];
  for (const file of files) {
    assert.ok(existsSync(file), file);
  }
});

/** The text of a snippet with its defaults. */
function expanded(body) {
  return [body]
    .flat()
    .join('\n')
    .replace(/\$\{\d+:((?:\\.|[^\\}])*)\}/g, '$1')
    .replace(/\$\d+/g, '')
    .replace(/\\(.)/g, '$1');
}

test('the snippets are grammars without errors', () => {
  const snippets = JSON.parse(readFileSync('snippets/lsys.json', 'utf8'));
  for (const [name, { body }] of Object.entries(snippets)) {
    let text = expanded(body);
    if (!text.startsWith('#')) {
      text = `#w : ${text};`;
    }
    if (!text.includes('#w')) {
      text = `#w : A;\n${text}`;
    }
    const { status, stdout, stderr } = spawnSync(lsc, ['check', '-'], { input: text, encoding: 'utf8' });
    assert.equal(status, 0, `${name}:\n${text}\n${stdout}${stderr}`);
  }
});

test('every command of the menus exists, and every setting has a description', () => {
  const commands = contributes.commands.map(({ command }) => command);
  for (const { command } of [
    ...Object.values(contributes.menus).flat(),
    ...contributes.keybindings,
  ]) {
    assert.ok(commands.includes(command), command);
  }
  const source = readFileSync('src/extension.ts', 'utf8');
  for (const command of commands) {
    assert.ok(source.includes(`'${command}'`), command);
  }
  for (const [name, setting] of Object.entries(contributes.configuration.properties)) {
    assert.ok(setting.description ?? setting.markdownDescription, name);
    assert.notEqual(setting.default, undefined, name);
  }
});
