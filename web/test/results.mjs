// SPDX-License-Identifier: MIT
// Prints the result of each grammar that standard input names, one path per line, as a line of
// JSON: ["word", text], ["errors", sorted codes] or ["limit"].
// Usage: node results.mjs MAX_MODULES      for tests/fuzz/compare_programs.py
import { readFileSync } from 'node:fs';
import { load, LsysError } from 'lsys';

const maxModules = Number(process.argv[2]);
const lsys = await load();

function resultOf(path) {
  try {
    const word = lsys.derive(readFileSync(path), { generations: 4, seed: 7, maxModules });
    return ['word', word.text];
  } catch (error) {
    if (!(error instanceof LsysError)) throw error;
    if (error.status === 'limit') return ['limit'];
    const errors = error.diagnostics.filter((each) => each.severity === 'error');
    return ['errors', errors.map((each) => each.code).sort()];
  }
}

for (const path of readFileSync(0, 'utf8').split('\n')) {
  console.log(JSON.stringify(resultOf(path)));
}
