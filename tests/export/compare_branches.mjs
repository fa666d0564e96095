// SPDX-License-Identifier: MIT
// Compares the finest tiles of `lsc tiles --instances branches --error 0` with `lsc forest` of the same scene: the area
// of all surfaces, its centre and its spread must agree, for the trees alone.
// Usage: compare_branches.mjs NODE_MODULES FOLDER FOREST.glb
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [, , modules, folder, forest] = process.argv;
const require = createRequire(path.join(path.resolve(modules), 'x.js'));
const { NodeIO } = require('@gltf-transform/core');
const { ALL_EXTENSIONS } = require('@gltf-transform/extensions');
const { MeshoptDecoder } = await import(
    pathToFileURL(path.resolve(modules, 'three/examples/jsm/libs/meshopt_decoder.module.js')));
await MeshoptDecoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({ 'meshopt.decoder': MeshoptDecoder });
io.setLogger({ debug() {}, info() {}, warn() {}, error: text => console.error(text) });

const subtract = (a, b) => a.map((x, i) => x - b[i]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const transformed = (m, p) => [0, 1, 2].map(i => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i]);
const rotated = ([x, y, z, w], v) => {
    const t = cross([x, y, z], v).map(each => 2 * each);
    const u = cross([x, y, z], t);
    return v.map((each, i) => each + w * t[i] + u[i]);
};

/// Area and centre of the surface of a mesh.
const measured = new Map();
const measure = mesh => {
    if (!measured.has(mesh)) {
        let area = 0;
        const centre = [0, 0, 0];
        for (const primitive of mesh.listPrimitives()) {
            const positions = primitive.getAttribute('POSITION');
            const indices = primitive.getIndices();
            const corner = i => positions.getElement(indices.getScalar(i), []);
            for (let i = 0; i < indices.getCount(); i += 3) {
                const [a, b, c] = [corner(i), corner(i + 1), corner(i + 2)];
                const part = 0.5 * Math.hypot(...cross(subtract(b, a), subtract(c, a)));
                area += part;
                a.forEach((x, k) => { centre[k] += part * (x + b[k] + c[k]) / 3; });
            }
        }
        measured.set(mesh, { area, centre: centre.map(x => area > 0 ? x / area : 0) });
    }
    return measured.get(mesh);
};

/// Adds all instances of a document; `move` converts its coordinates to those of the scene.
const addInstances = (document, move, sums) => {
    for (const node of document.getRoot().listNodes()) {
        const batch = node.getExtension('EXT_mesh_gpu_instancing');
        if (batch === null) {
            continue; // the ground
        }
        const matrix = node.getWorldMatrix();
        const { area, centre } = measure(node.getMesh());
        const [places, turns, scales] = ['TRANSLATION', 'ROTATION', 'SCALE'].map(name => batch.getAttribute(name));
        for (let i = 0; i < places.getCount(); ++i) {
            const scale = scales === null ? 1 : scales.getElement(i, [])[0];
            const turned = rotated(turns === null ? [0, 0, 0, 1] : turns.getElement(i, []), centre);
            const at = move(transformed(matrix, places.getElement(i, []).map((x, k) => x + scale * turned[k])));
            const own = area * scale * scale;
            sums.area += own;
            at.forEach((x, k) => {
                sums.first[k] += own * x;
                sums.second[k] += own * x * x;
            });
        }
    }
};
const result = ({ area, first, second }) => ({
    area,
    centre: first.map(x => x / area),
    spread: second.map((x, k) => Math.sqrt(x / area - (first[k] / area) ** 2)),
});
const noSums = () => ({ area: 0, first: [0, 0, 0], second: [0, 0, 0] });

const ofForest = noSums();
addInstances(await io.read(forest), place => place, ofForest);

// The finest tiles, in the frames of their tilesets: +Z is up, -Y is the +Z of the scene.
const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const multiply = (a, b) => Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + i % 4] * b[4 * Math.floor(i / 4) + k], 0));
const ofTiles = noSums();
const visit = async (file, tile, matrix) => {
    const frame = multiply(matrix, tile.transform ?? identity);
    const uri = tile.content === undefined ? '' : path.posix.join(path.posix.dirname(file), tile.content.uri);
    if (uri.endsWith('.json')) {
        for (const child of JSON.parse(fs.readFileSync(path.join(folder, uri), 'utf8')).root.children) {
            await visit(uri, child, frame);
        }
    } else if ((tile.children ?? []).length > 0) {
        for (const child of tile.children) {
            await visit(file, child, frame);
        }
    } else {
        addInstances(await io.read(path.join(folder, uri)), ([x, y, z]) => {
            const [east, north, up] = transformed(frame, [x, -z, y]);
            return [east, up, -north];
        }, ofTiles);
    }
};
const { root } = JSON.parse(fs.readFileSync(path.join(folder, 'tileset.json'), 'utf8'));
await visit('tileset.json', root, identity);

const [expected, found] = [result(ofForest), result(ofTiles)];
const apart = Math.hypot(...subtract(found.centre, expected.centre));
const wider = Math.max(...subtract(found.spread, expected.spread).map(Math.abs));
const larger = Math.abs(found.area / expected.area - 1);
console.log(`areas ${expected.area.toFixed(2)} and ${found.area.toFixed(2)} m2, centres ${apart.toFixed(4)} m apart, ` +
    `spreads differ by ${wider.toFixed(4)} m`);
process.exit(larger < 0.01 && apart < 0.02 && wider < 0.02 ? 0 : 1);
