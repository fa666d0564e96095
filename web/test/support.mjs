// SPDX-License-Identifier: MIT
// Functions for the checks: counting results, running lsc, sizes of files.
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, constants } from 'node:zlib';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const lsc = process.env.LSC ?? join(root, 'build/release/lsc');

let passed = 0;
let failed = 0;

/** Counts a fact; prints it if it is false. */
export function check(fact, text) {
  if (fact) ++passed;
  else {
    ++failed;
    console.error(`FAILED: ${text}`);
  }
}

/** Runs a named part; an exception fails it. */
export async function part(name, action) {
  const start = performance.now();
  try {
    await action();
    console.log(`${name} (${Math.round(performance.now() - start)} ms)`);
  } catch (error) {
    ++failed;
    console.error(`FAILED: ${name}: ${error.stack ?? error}`);
  }
}

/** Prints the counts and ends the program. */
export function finish() {
  console.log(`${passed} passed, ${failed} failed`);
  process.exit(failed === 0 && passed > 0 ? 0 : 1);
}

export function runLsc(...values) {
  return spawnSync(lsc, values, { encoding: 'utf8', maxBuffer: 1 << 30, cwd: root });
}

export function compressedSize(path) {
  const options = { params: { [constants.BROTLI_PARAM_QUALITY]: 9 } };
  return brotliCompressSync(readFileSync(path), options).length;
}
