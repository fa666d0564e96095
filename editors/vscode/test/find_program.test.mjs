// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { chmodSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { findProgram } from '../dist/modules/find_program.mjs';

const folder = mkdtempSync(join(tmpdir(), 'lsys-'));
after(() => rmSync(folder, { recursive: true }));
mkdirSync(join(folder, 'bin'));
const program = join(folder, 'bin', 'lsc');
writeFileSync(program, '#!/bin/sh\n');
chmodSync(program, 0o755);
writeFileSync(join(folder, 'plain'), '');
const around = { home: folder, folder, searched: `/nowhere:${join(folder, 'bin')}`, windows: false };

test('a name is searched in the folders of PATH', () => {
  assert.deepEqual(findProgram('lsc', around), { program });
  assert.deepEqual(findProgram('', around), { program });
  assert.match(findProgram('lscc', around).problem, /`lscc` is in no folder of PATH/);
  assert.match(findProgram('lsc', { ...around, searched: '' }).problem, /PATH/);
});

test('a path is absolute, or begins at the home folder or the workspace', () => {
  for (const setting of [program, '~/bin/lsc', '${workspaceFolder}/bin/lsc', './bin/lsc']) {
    assert.deepEqual(findProgram(setting, around), { program });
  }
});

test('a file that cannot be run is no program', () => {
  assert.match(findProgram('./plain', around).problem, /is no program/);
  assert.match(findProgram('./bin', around).problem, /is no program/);
  assert.match(findProgram('./missing', around).problem, /does not exist/);
});
