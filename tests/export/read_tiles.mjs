// SPDX-License-Identifier: MIT
// Reads a tileset of `lsc tiles`, explicit or implicit: every glTF by the Khronos validator and by
// glTF-Transform, and the tilesets by the rules of 3D Tiles 1.1 (OGC 22-025r4).
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
const contains = (box, p, slack) => [3, 6, 9].every(first => {
    const axis = box.slice(first, first + 3);
    const length = Math.hypot(...axis);
    return Math.abs(axis.reduce((sum, x, i) => sum + x * (p[i] - box[i]), 0)) <= (length + slack) * length;
});

/// Converts the root of an implicit tileset, with all tiles that its subtree files list, to explicit tiles.
const expandImplicit = root => {
    const { subtreeLevels, availableLevels, subtrees } = root.implicitTiling;
    const named = (template, level, x, y) =>
        template.replace('{level}', level).replace('{x}', x).replace('{y}', y);
    const readSubtree = (level, x, y) => {
        const name = named(subtrees.uri, level, x, y);
        const bytes = fs.readFileSync(path.join(folder, name));
        const jsonSize = Number(bytes.readBigUInt64LE(8));
        const dataSize = Number(bytes.readBigUInt64LE(16));
        check(bytes.toString('latin1', 0, 4) === 'subt' && bytes.readUInt32LE(4) === 1, `${name}: no subtree`);
        check(jsonSize % 8 === 0 && dataSize % 8 === 0 && bytes.length === 24 + jsonSize + dataSize, `${name}: sizes`);
        const json = JSON.parse(bytes.toString('utf8', 24, 24 + jsonSize));
        const view = number => {
            const { byteOffset, byteLength } = json.bufferViews[number];
            check(byteOffset % 8 === 0 && byteOffset + byteLength <= dataSize, `${name}: a view beyond its buffer`);
            return bytes.subarray(24 + jsonSize + byteOffset, 24 + jsonSize + byteOffset + byteLength);
        };
        const bitsOf = (availability, count) => {
            const stream = availability.bitstream === undefined ? null : view(availability.bitstream);
            check(stream === null || stream.length === Math.ceil(count / 8), `${name}: a stream of another length`);
            const bits = Array.from({ length: count }, (_, i) =>
                stream === null ? availability.constant === 1 : (stream[i >> 3] >> (i & 7) & 1) === 1);
            const available = bits.filter(Boolean).length;
            check(stream === null || available === availability.availableCount, `${name}: a wrong count`);
            return bits;
        };
        const count = (4 ** subtreeLevels - 1) / 3;
        const tileBits = bitsOf(json.tileAvailability, count);
        const contentBits = bitsOf(json.contentAvailability[0], count);
        const childBits = bitsOf(json.childSubtreeAvailability, 4 ** subtreeLevels);
        const table = json.propertyTables[json.tileMetadata];
        check(table.count === tileBits.filter(Boolean).length, `${name}: a table of another size`);
        const boxes = view(table.properties.boundingBox.values);
        const errors = view(table.properties.geometricError.values);
        const rows = tileBits.map((bit, i) => tileBits.slice(0, i).filter(Boolean).length);
        const tileAt = (depth, place) => { // `place`: index on the Z-order curve of this depth
            const morton = bit => Array.from({ length: depth }, (_, i) => (place >> (2 * i + bit) & 1) << i)
                .reduce((sum, x) => sum + x, 0);
            const [column, row] = [x * 2 ** depth + morton(0), y * 2 ** depth + morton(1)];
            if (depth === subtreeLevels) {
                return childBits[place] ? [readSubtree(level + depth, column, row)] : [];
            }
            const index = (4 ** depth - 1) / 3 + place;
            if (!tileBits[index]) {
                check(!contentBits[index], `${name}: content without a tile`);
                return [];
            }
            check(level + depth < availableLevels, `${name}: a tile below the last level`);
            const entry = rows[index];
            const tile = {
                boundingVolume: { box: Array.from({ length: 12 }, (_, i) => boxes.readFloatLE(48 * entry + 4 * i)) },
                geometricError: errors.readDoubleLE(8 * entry),
                refine: root.refine,
                children: [0, 1, 2, 3].flatMap(i => tileAt(depth + 1, 4 * place + i)),
            };
            if (contentBits[index]) {
                tile.content = { uri: named(root.content.uri, level + depth, column, row) };
            }
            return [tile];
        };
        return tileAt(0, 0)[0];
    };
    // Clients that ignore metadata quarter the box and halve the error of the root with each level.
    const implied = (tile, depth) => {
        const error = root.geometricError / 2 ** depth + 1e-6;
        check(tile.content === undefined || tile.geometricError <= error, `depth ${depth}: implied error too small`);
        tile.children.forEach(child => implied(child, depth + 1));
    };
    const expanded = readSubtree(0, 0, 0);
    implied(expanded, 0);
    return { ...expanded, transform: root.transform };
};

/// Every tile with content: its file, box, frame and depth.
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
    } else { // a client must refine a tile without content
        check(tile.geometricError >= groundSide, `${name}: without content, but its error is small`);
        check(tile.children?.length > 0, `${name}: neither content nor children`);
    }
    for (const child of tile.children ?? []) {
        visit(file, child, frame, { tile }, depth + 1);
    }
};
const top = read('tileset.json');
const groundSide = top.root.implicitTiling ? 2 * top.root.boundingVolume.box[3] : top.geometricError;
check(top.asset.version === '1.1' && top.geometricError > 0, 'tileset.json: no version or error');
visit('tileset.json', top.root.implicitTiling ? expandImplicit(top.root) : top.root, identity, null, 0);

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
    const places = new Map(); // by _FEATURE_ID_0, the row of the property table
    for (const node of document.getRoot().listNodes()) {
        const batch = node.getExtension('EXT_mesh_gpu_instancing');
        const matrix = node.getWorldMatrix();
        if (node.getMesh() === null) {
            continue; // the node with the place of the tile
        }
        if (batch === null) {
            const positions = node.getMesh().listPrimitives()[0].getAttribute('POSITION');
            for (let i = 0; i < positions.getCount(); ++i) {
                const [x, y, z] = transformed(matrix, positions.getElement(i, []));
                check(contains(tile.box, [x, -z, y], 0.01), `${tile.uri}: ground beyond the box`);
            }
            continue;
        }
        const translations = batch.getAttribute('TRANSLATION');
        const ids = batch.getAttribute('_FEATURE_ID_0');
        for (let i = 0; i < translations.getCount(); ++i) {
            const [x, y, z] = transformed(matrix, translations.getElement(i, []));
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
// Each level that shows trees shows all of them, at about the same places: the origins of two levels
// of detail of a tree may be as far apart as the tree is large.
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
