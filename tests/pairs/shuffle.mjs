// SPDX-License-Identifier: MIT
// Puts the pictures of scripts/pairs into an order that does not tell which program drew them.
// Usage: node shuffle.mjs SEED FOLDER QUESTION < LIST
//   LIST has one line for each pair: NUMBER, a description of our picture and one of the other, separated by tabs.
//   Reads FOLDER/parts/NUMBER-ours.png and NUMBER-other.png; writes FOLDER/pair-NN-left.png and pair-NN-right.png,
//   FOLDER/index.html and FOLDER/key.txt.
import { existsSync, readFileSync } from 'node:fs';
import { copyFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';

const [seed, folder, question] = process.argv.slice(2);
const pairs = readFileSync(0, 'utf8').trimEnd().split('\n').map(line => line.split('\t'));
let state = Number(seed);
function random() { // mulberry32: a number from 0 to 1, without 1
    state = (state + 0x6d2b79f5) | 0;
    let bits = Math.imul(state ^ (state >>> 15), state | 1);
    bits ^= bits + Math.imul(bits ^ (bits >>> 7), bits | 61);
    return ((bits ^ (bits >>> 14)) >>> 0) / 2 ** 32;
}
function shuffle(list) {
    for (let i = list.length - 1; i > 0; --i) {
        const other = Math.floor(random() * (i + 1));
        [list[i], list[other]] = [list[other], list[i]];
    }
    return list;
}

const order = shuffle([...pairs.keys()]);
const isOursLeft = shuffle(pairs.map((_, i) => i % 2 === 0)); // one half of the pairs
const rows = [];
const key = [];
for (const [place, index] of order.entries()) {
    const [pair, oursIs, otherIs] = pairs[index];
    const ours = join(folder, `parts/${pair}-ours.png`);
    const other = join(folder, `parts/${pair}-other.png`);
    if (!existsSync(ours) || !existsSync(other)) {
        continue;
    }
    const number = String(place + 1).padStart(2, '0');
    const isLeft = isOursLeft[place];
    await copyFile(isLeft ? ours : other, join(folder, `pair-${number}-left.png`));
    await copyFile(isLeft ? other : ours, join(folder, `pair-${number}-right.png`));
    const images = ['left', 'right'].map(side => `<img src="pair-${number}-${side}.png" alt="${side}">`);
    rows.push(`<h2>${number}</h2>\n<div>${images.join('')}</div>`);
    const [ourSide, otherSide] = isLeft ? ['left', 'right'] : ['right', 'left'];
    key.push(`pair-${number}: ${oursIs} is ${ourSide}, ${otherIs} ${otherSide}`);
}
await writeFile(join(folder, 'index.html'), `<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Pairs of pictures</title>
<style>
body { margin: 1em; font: 16px sans-serif }
div { display: flex; gap: 8px }
img { width: 50%; min-width: 0 }
h2 { margin: 1em 0 .3em }
</style>
<p>${question}</p>
${rows.join('\n')}
</html>
`);
await writeFile(join(folder, 'key.txt'), `${key.join('\n')}\n`);
