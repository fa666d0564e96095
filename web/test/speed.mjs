// SPDX-License-Identifier: MIT
// Benchmark W1 (tests/bench): derives and prints 10 generations with the npm package, and with
// native lsc on one thread. Fails if the package takes more than three times as long.
// Usage: node speed.mjs
import { load } from 'lsys';
import { check, finish, runLsc } from './support.mjs';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const text = '#set names letters; #n = 10; #w : F; #p : F : * : F+F-F-F+F;';
const median = (times) => times.sort((a, b) => a - b)[Math.floor(times.length / 2)];
function time(action) {
  const times = [];
  for (let i = 0; i < 7; ++i) {
    const start = performance.now();
    action();
    times.push(performance.now() - start);
  }
  return median(times);
}

const folder = mkdtempSync(join(tmpdir(), 'lsys-speed-'));
const path = join(folder, 'w1.lsys');
writeFileSync(path, text);
const lsys = await load();
const web = time(() => lsys.derive(text));
const webOnly = time(() => lsys.derive(text, { maxBytes: 1 }));
const native = time(() => runLsc('dump', '-q', '--threads', '1', path));
const start = time(() => runLsc('dump', '-q', '-n', '1', '--threads', '1', path));
rmSync(folder, { recursive: true });
const ratio = web / (native - start);
console.log(
  `W1, n = 10: ${web.toFixed(0)} ms with WebAssembly (${webOnly.toFixed(0)} ms to derive), ` +
    `${(native - start).toFixed(0)} ms native, ratio ${ratio.toFixed(2)}`,
);
check(ratio <= 3, `W1 takes ${ratio.toFixed(2)} times as long as native`);
finish();
