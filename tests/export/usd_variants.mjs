// SPDX-License-Identifier: MIT
// Variants in USD: levels of detail and values of a parameter. Compares tinyusdz, which composes
// variants, and three.js, which ignores them, with a separate file of each variant. The maple has
// six levels. Usage: node usd_variants.mjs MODULES LSC FOLDER
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { tinyUsdz, usdLoader } from './usd.mjs';

const [modules, lsc, folder] = process.argv.slice(2).map(path => resolve(path));
const module = path => import(pathToFileURL(join(modules, path)));
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const grammar = join(folder, 'maple.lsys');
writeFileSync(grammar, `#n = 6;
#param season 0.5 {0, 1};
#object L LEAF;
#w : !(0.2) F(1) A;
#grow   : A : *              : !(0.05) F(0.7) [ +(35) A ] [ -(30) A ] /(137) J;
#winter : J : season < 0.125 : ;
#spring : J : season < 0.375 : '(12) L(0.1);
#summer : J : season < 0.625 : '(1) L(0.25);
#autumn : J : *              : '(18) L(0.25);
`);

let failures = 0;
function expect(what, found, expected) {
    if (found !== expected) {
        console.log(`${what} is ${found}, not ${expected}`);
        ++failures;
    }
}
const write = (file, ...options) => {
    execFileSync(lsc, ['export', grammar, '-q', '-o', join(folder, file), ...options]);
    return readFileSync(join(folder, file));
};
const sum = list => list.reduce((all, each) => all + each, 0);

const tiny = await tinyUsdz(module, modules);
const { three, load } = await usdLoader(module);
const inThree = bytes => {
    let triangles = 0;
    load(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)).traverse(object => {
        triangles += object.isMesh
            ? (object.geometry.index ?? object.geometry.attributes.position).count / 3 : 0;
    });
    return triangles;
};
const inTiny = (file, bytes) => {
    const loader = tiny.open(file, bytes);
    const triangles = [];
    for (let i = 0; i < loader.numMeshes(); ++i) {
        triangles.push(loader.getMesh(i).faceVertexIndices.length / 3);
    }
    loader.delete();
    return sum(triangles);
};
/// Number of triangles and names of materials of the active meshes, with variant `name` of `set`
/// selected.
const composed = (file, bytes, set, name) => {
    const text = bytes.toString('latin1').replace(new RegExp(`string ${set} = "\\w+"`),
                                                  `string ${set} = "${name}"`);
    const layer = tiny.composed(file, Buffer.from(text, 'latin1'));
    const active = layer.split('def Mesh "').slice(1)
        .filter(mesh => !/^[^{]*active = false/.test(mesh));
    const materials = active.flatMap(mesh => [...mesh.matchAll(/Materials\/(\w+)>/g)].map(m => m[1]));
    for (const material of materials) {
        expect(`${file}, ${name}: material ${material}`,
               layer.includes(`def Material "${material}"`), true);
    }
    const counts = active.map(mesh => /faceVertexCounts = \[([^\]]*)\]/.exec(mesh)[1].split(',').length);
    return { meshes: active.length, triangles: sum(counts), materials: [...new Set(materials)].sort().join() };
};

const sets = [
    { set: 'LOD', options: ['--lods', '25'],
      of: [0, 1, 2, 3, 4, 5].map(level => ({ name: `LOD${level}`, options: ['--level', `${level}`] })) },
    { set: 'season', options: ['--variants', 'season=0,0.25,0.5,0.75'],
      of: ['0', '0.25', '0.5', '0.75'].map(value => ({ name: value.replace('.', '_'),
                                                       options: ['-D', `season=${value}`] })) },
];
const seen = new Map();
for (const { set, options, of } of sets) {
    const usda = `${set}.usda`;
    const bytes = write(usda, ...options);
    const alone = of.map(each => inTiny('alone.usda', write('alone.usda', ...each.options)));
    expect(`${usda} in three.js`, inThree(bytes), alone[0]);
    expect(`${usda} in tinyusdz`, inTiny(usda, bytes), alone[0]);
    of.forEach(({ name }, i) => {
        const found = composed(usda, bytes, set, name);
        seen.set(name, found);
        expect(`${usda}, ${name}: meshes`, found.meshes, 1);
        expect(`${usda}, ${name}: triangles`, found.triangles, alone[i]);
    });
    const archive = write(`${set}.usdz`, ...options);
    expect(`${set}.usdz in tinyusdz`, inTiny(`${set}.usdz`, archive), alone[0]);
    // The archive contains the pictures that the layer names.
    const text = archive.toString('latin1');
    for (const [, name] of text.matchAll(/asset inputs:file = @\.\/([^@]+)@/g)) {
        expect(`entries ${name} of ${set}.usdz`, text.split(name).length > 3, true);
    }
    for (const [, name] of bytes.toString('latin1').matchAll(/asset inputs:file = @\.\/([^@]+)@/g)) {
        expect(`bytes of ${name}`, readFileSync(join(folder, name)).length > 1000, true);
    }
}
expect('levels fall', seen.get('LOD0').triangles > 1.9 * seen.get('LOD1').triangles, true);
for (const [name, materials] of [['0', 'bark'], ['0_25', 'bark,leaf_12'], ['0_5', 'bark,leaf'],
                                 ['0_75', 'bark,leaf_18']]) {
    expect(`materials of season ${name}`, seen.get(name).materials, materials);
}
console.log([...seen].map(([name, { triangles }]) => `${name}: ${triangles}`).join(', '));
process.exit(failures === 0 ? 0 : 1);
