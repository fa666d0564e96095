// SPDX-License-Identifier: MIT
// Measures time and memory of readers of other projects for a forest, and checks that each has all
// trees and their bounding box. Usage: node read_forest.mjs MODULES LSC [--times N] [--levels]
// [--assimp READ_ASSIMP] [--blender BLENDER] FOREST...
//   MODULES: node_modules of package.json beside this file; LSC: the program
//   FOREST...: a scene or grammars with options of `lsc forest`, without -o
// LSC writes the forest with `--preset web`, with `--expand --instances trees` and as USDA, with
// --levels also as USDA of levels of detail, and each reader reads the file that suits it, each
// time in a process of its own. A table shows the medians: wall time and processor time in s, and
// peak memory of the process. The box of the trees, by the reader's own positions and matrices, is
// compared with that of the file without compression; the table has the greatest difference as a
// part of the shortest side. Fails if it is more than 0.1 %, or if a tree is missing.
//
// The script starts itself as `node read_forest.mjs MODULES --reader NAME FILE`, which prints the
// measurements of one reader as JSON.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { boxOfPlainGlb, forestReaders } from './forest_readers.mjs';

const kMaxDifference = 1e-3; // max difference of a box as a fraction of its shortest side
const own = fileURLToPath(import.meta.url);
const [given, ...rest] = process.argv.slice(2);
const modules = resolve(given ?? '.');

if (rest[0] === '--reader') {
    console.log(JSON.stringify(await forestReaders[rest[1]](modules, rest[2])));
    process.exit(0);
}

const settings = { times: 1 };
let lsc;
const isSetting = word => /^--(times|levels|assimp|blender)$/.test(word);
while (rest.length > 0 && (lsc === undefined || isSetting(rest[0]))) {
    const word = rest.shift();
    if (isSetting(word)) {
        settings[word.slice(2)] = word === '--levels' || (word === '--times' ? Number(rest.shift()) : rest.shift());
    } else {
        lsc = word;
    }
}
if (rest.length === 0 || !(settings.times >= 1)) {
    console.error('usage: node read_forest.mjs MODULES LSC [--times N] [--levels] [--assimp READ_ASSIMP] [--blender BLENDER] FOREST...');
    process.exit(2);
}
for (const name of ['three', '@babylonjs/core', '@loaders.gl/gltf', 'playcanvas', '@gltf-transform/core', 'tinyusdz']) {
    if (!existsSync(join(modules, name))) {
        console.error(`${join(modules, name)} is missing: run scripts/install-packages --tools`);
        process.exit(1);
    }
}

const folder = mkdtempSync(join(tmpdir(), 'read-forest-'));
process.on('exit', () => rmSync(folder, { recursive: true }));

// Instances of whole trees and of branches make different forests, so each form has its own plain
// file to compare with.
const forms = {
    plain: { file: 'plain.glb', options: ['--instances', 'trees'] },
    branches: { file: 'branches.glb', options: [] },
    webPlain: { file: 'web-plain.glb', options: ['--preset', 'web', '--compress', 'none'] },
    web: { file: 'web.glb', options: ['--preset', 'web'], like: 'webPlain', what: 'GLB, `--preset web`' },
    expanded: { file: 'expanded.glb', options: ['--expand', '--instances', 'trees'], like: 'plain',
                what: 'GLB, `--expand --instances trees`' },
    usda: { file: 'forest.usda', options: [], like: 'branches', what: 'USDA' },
    levels: { file: 'levels.glb', options: ['--instances', 'lods'] },
    usdaLevels: { file: 'levels.usda', options: ['--instances', 'lods'], like: 'levels',
                  what: 'USDA, `--instances lods`' },
};
if (!settings.levels) {
    delete forms.levels;
    delete forms.usdaLevels;
}
for (const form of Object.values(forms)) {
    form.path = join(folder, form.file);
    execFileSync(lsc, ['forest', ...rest, ...form.options, '-o', form.path], { stdio: 'pipe' });
}
for (const name of ['plain', 'branches', 'webPlain', 'levels'].filter(key => key in forms)) {
    forms[name].truth = boxOfPlainGlb(forms[name].path);
}
const bytes = readFileSync(forms.plain.path);
const { trees } = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString())
    .nodes.find(node => node.name === 'forest').extras;

function versionOf(name) {
    return JSON.parse(readFileSync(join(modules, name, 'package.json'), 'utf8')).version;
}
const inNode = (name, version) => ({
    name: `${name} ${version}`,
    read: path => execFileSync(process.execPath, [own, modules, '--reader', name, path]),
});
const readers = [
    ['web', inNode('three', versionOf('three'))],
    ['web', inNode('babylon', versionOf('@babylonjs/core'))],
    ['web', inNode('playcanvas', versionOf('playcanvas'))],
    ['web', inNode('loaders.gl', versionOf('@loaders.gl/gltf'))],
    ['web', inNode('gltf-transform', versionOf('@gltf-transform/core'))],
    ['usda', inNode('tinyusdz', versionOf('tinyusdz'))],
];
if (settings.levels) {
    readers.push(['usdaLevels', inNode('tinyusdz', versionOf('tinyusdz'))]);
}
if (settings.assimp !== undefined) {
    readers.push(['expanded', { name: 'assimp', read: path => execFileSync(settings.assimp, ['--box', path]) }]);
}
if (settings.blender !== undefined) {
    // A Blender without its own Python uses the modules of the first python3 in PATH.
    const env = { ...process.env, PATH: `/usr/bin:${process.env.PATH}` };
    const script = join(dirname(own), 'box_in_blender.py');
    readers.push(['expanded', { name: 'blender', read: path => execFileSync(settings.blender,
        ['--background', '--factory-startup', '--python-exit-code', '1', '--python', script, '--', path],
        { env, stdio: ['ignore', 'pipe', 'ignore'] }) }]);
}

const median = numbers => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
let failures = 0;
console.log(`${trees} trees\n\n| reader | file | MB | s | s of processor | MB of memory | box off by |\n|---|---|---|---|---|---|---|`);
for (const [form, { name, read }] of readers) {
    const { path, like, what } = forms[form];
    const { truth } = forms[like];
    let runs;
    try {
        runs = Array.from({ length: settings.times }, () => {
            const lines = read(path).toString().split('\n');
            return JSON.parse(lines.find(line => line.startsWith('{')));
        });
    } catch (error) {
        console.log(`| ${name} | ${what} | cannot read it: ${String(error.message).split('\n')[0]} |`);
        ++failures;
        continue;
    }
    const [found] = runs;
    const side = Math.min(...truth.high.map((x, i) => x - truth.low[i]));
    const off = Math.max(...['low', 'high'].flatMap(
        end => truth[end].map((x, i) => Math.abs(found[end][i] - x)))) / side;
    const megabytes = statSync(path).size / 1e6;
    console.log(`| ${found.reader ?? name} | ${what} | ${megabytes.toFixed(1)} | ` +
        `${median(runs.map(run => run.seconds)).toFixed(2)} | ` +
        `${median(runs.map(run => run.processor)).toFixed(2)} | ${median(runs.map(run => run.megabytes)).toFixed(0)} | ` +
        `${(100 * off).toFixed(4)} % |`);
    if (!(off <= kMaxDifference) || found.instances !== truth.instances) {
        console.log(`${name}: ${found.instances} instances of ${truth.instances}; ` +
            `box ${found.low} ${found.high}, not ${truth.low} ${truth.high}`);
        ++failures;
    }
}
if (forms.plain.truth.instances !== trees) {
    console.log(`${forms.plain.truth.instances} instances instead of ${trees} trees`);
    ++failures;
}
console.log(`\n${readers.length} readers, ${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
