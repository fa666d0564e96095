// SPDX-License-Identifier: MIT
// Reads a tileset of `lsc tiles`: every glTF by the Khronos validator and by glTF-Transform, and the
// tilesets by the rules of 3D Tiles 1.1 (OGC 22-025r4).
// Usage: read_tiles.mjs NODE_MODULES FOLDER TREES
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [, , modules, folder, treeCount] = process.argv;
const require = createRequire(path.join(path.resolve(modules), 'x.js'));
const validator = require('gltf-validator');
const { NodeIO } = require('@gltf-transform/core');
const { ALL_EXTENSIONS } = require('@gltf-transform/extensions');
const { MeshoptDecoder } = await import(
    pathToFileURL(path.resolve(modules, 'three/examples/jsm/libs/meshopt_decoder.module.js')));

let failures = 0;
const check = (holds, what) => {
    if (!holds && ++failures <= 20) {
        console.error(what);
    }
};
const read = file => JSON.parse(fs.readFileSync(path.join(folder, file), 'utf8'));

// Matrices are column by column, as in tilesets.
const multiply = (a, b) => Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + i % 4] * b[4 * Math.floor(i / 4) + k], 0));
const transformed = (m, p) => [0, 1, 2].map(i => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i]);
const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const corners = box => Array.from({ length: 8 }, (_, i) => [0, 1, 2].map(axis =>
    box[axis] + [1, 2, 4].reduce((sum, bit, k) => sum + (i & bit ? 1 : -1) * box[3 + 3 * k + axis], 0)));
const contains = (box, p, slack) => [0, 1, 2].every(axis =>
    Math.abs(p[axis] - box[axis]) <= box[3 + 4 * axis] + slack);

/// Every tile with its frame, depth and content.
const tiles = [];
const visit = (file, tile, matrix, parent, depth) => {
    const frame = multiply(matrix, tile.transform ?? identity);
    const box = tile.boundingVolume?.box;
    const name = `${file}: tile at depth ${depth}`;
    check(Array.isArray(box) && box.length === 12 && box.every(Number.isFinite), `${name}: no box`);
    check(tile.geometricError >= 0, `${name}: no geometricError`);
    if (parent !== null) {
        check(tile.geometricError <= parent.tile.geometricError, `${name}: an error above its parent's`);
        for (const corner of corners(box)) { // in the coordinates of the parent
            const there = transformed(tile.transform ?? identity, corner);
            check(contains(parent.tile.boundingVolume.box, there, 0.01), `${name}: beyond its parent`);
        }
    }
    check(tile.content === undefined || tile.content.uri !== undefined, `${name}: content without a file`);
    const uri = tile.content === undefined ? '' : path.posix.join(path.posix.dirname(file), tile.content.uri);
    if (uri.endsWith('.json')) {
        const tileset = read(uri);
        check(tileset.asset.version === '1.1', `${uri}: no version`);
        check(tile.children === undefined, `${name}: children beside another tileset`);
        check(tileset.geometricError === tile.geometricError, `${uri}: another error than its reference`);
        check(tileset.root.content === undefined, `${uri}: its root shows the tile of the reference`);
        for (const child of tileset.root.children) {
            visit(uri, child, frame, { tile }, depth);
        }
        return;
    }
    check(tile.refine === 'REPLACE', `${name}: no refine`);
    if (uri !== '') {
        tiles.push({ uri, box, frame, depth });
    } else { // a client must go on to its children, which show something
        check(tile.geometricError >= top.geometricError, `${name}: without content, but its error is small`);
        check(tile.children?.length > 0, `${name}: neither content nor children`);
    }
    for (const child of tile.children ?? []) {
        visit(file, child, frame, { tile }, depth + 1);
    }
};
const top = read('tileset.json');
check(top.asset.version === '1.1' && top.geometricError > 0, 'tileset.json: no version or error');
visit('tileset.json', top.root, identity, null, 0);

await MeshoptDecoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({ 'meshopt.decoder': MeshoptDecoder });
io.setLogger({ debug() {}, info() {}, warn() {}, error: text => check(false, text) });

/// The JSON and the buffer of a GLB.
const parseGlb = bytes => {
    const size = bytes.readUInt32LE(12);
    return [JSON.parse(bytes.toString('utf8', 20, 20 + size)), bytes.subarray(28 + size)];
};

const treesOfDepth = new Map();
for (const tile of tiles) {
    const file = path.join(folder, tile.uri);
    const bytes = fs.readFileSync(file);
    const report = await validator.validateBytes(new Uint8Array(bytes), {
        uri: tile.uri,
        externalResourceFunction: uri => Promise.resolve(
            new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))))),
    });
    for (const message of report.issues.messages) {
        check(message.severity > 1, `${tile.uri}: ${message.code} ${message.message} ${message.pointer ?? ''}`);
    }
    const [json, data] = parseGlb(bytes);
    const document = await io.read(file);
    // The ground and all instances lie within the box, in the frame of the tile with +Z up.
    const places = new Map(); // by row of the table
    for (const node of document.getRoot().listNodes()) {
        const batch = node.getExtension('EXT_mesh_gpu_instancing');
        if (batch === null) {
            const positions = node.getMesh().listPrimitives()[0].getAttribute('POSITION');
            const matrix = node.getWorldMatrix();
            for (let i = 0; i < positions.getCount(); ++i) {
                const [x, y, z] = transformed(matrix, positions.getElement(i, []));
                check(contains(tile.box, [x, -z, y], 0.01), `${tile.uri}: ground beyond the box`);
            }
            continue;
        }
        const translations = batch.getAttribute('TRANSLATION');
        const ids = batch.getAttribute('_FEATURE_ID_0');
        for (let i = 0; i < translations.getCount(); ++i) {
            const [x, y, z] = translations.getElement(i, []);
            places.set(ids.getElement(i, [])[0], [x, -z, y]);
        }
    }
    const table = json.extensions?.EXT_structural_metadata?.propertyTables[0];
    const property = name => {
        const view = json.bufferViews[table.properties[name].values];
        return data.subarray(view.byteOffset, view.byteOffset + view.byteLength);
    };
    if (table === undefined) {
        check(places.size === 0, `${tile.uri}: trees without a table`);
        continue;
    }
    check(table.count === places.size, `${tile.uri}: ${table.count} rows for ${places.size} trees`);
    const species = json.extensions.EXT_structural_metadata.schema.enums.species.values.length;
    const trees = treesOfDepth.get(tile.depth) ?? new Map();
    treesOfDepth.set(tile.depth, trees);
    for (let i = 0; i < table.count; ++i) {
        const number = property('number').readUInt32LE(4 * i);
        check(!trees.has(number), `${tile.uri}: tree ${number} is there twice`);
        check(property('species').readUInt16LE(2 * i) < species, `${tile.uri}: a species without a name`);
        trees.set(number, {
            height: property('height').readFloatLE(4 * i),
            place: transformed(tile.frame, places.get(i)),
        });
    }
}
const leafDepth = Math.max(...tiles.map(tile => tile.depth));
const finest = treesOfDepth.get(leafDepth) ?? new Map();
check(finest.size === Number(treeCount), `${finest.size} trees instead of ${treeCount}`);
// Each level that shows trees shows all of them, at about the same places: levels of detail of a hero
// have origins of their own, up to the extent of the hero.
for (const [depth, trees] of treesOfDepth) {
    check(trees.size === finest.size, `depth ${depth}: ${trees.size} trees`);
    for (const [number, tree] of trees) {
        const other = finest.get(number);
        const apart = other ? Math.hypot(...tree.place.map((x, i) => x - other.place[i])) : Infinity;
        check(apart < 3 * tree.height + 1, `depth ${depth}: tree ${number} is ${apart} m away`);
    }
}
console.log(`${tiles.length} tiles, ${treesOfDepth.size} levels with ${finest.size} trees`);
process.exit(failures === 0 ? 0 : 1);
