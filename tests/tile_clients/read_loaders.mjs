// SPDX-License-Identifier: MIT
// Reads a tileset by loaders.gl: every tileset that it names, and the contents of its tiles.
// Usage: node read_loaders.mjs FOLDER
// Prints a line of JSON: counts of tilesets, tiles, instances, and instances of the finest tiles.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

const require = createRequire(join(process.cwd(), 'package.json'));
const { load } = require('@loaders.gl/core');
const { Tiles3DLoader } = require('@loaders.gl/3d-tiles');
const folder = process.argv[2];
const host = 'http://localhost/';

// Answers requests by files of the folder, also those of loaders.gl for buffers of meshes and pictures.
async function fetchFile(address) {
    const bytes = await readFile(join(folder, new URL(address).pathname));
    const response = new Response(bytes);
    Object.defineProperty(response, 'url', { value: String(address) });
    return response;
}

async function read(path, isTileset) {
    const options = {
        fetch: fetchFile,
        worker: false,
        '3d-tiles': { isTileset, loadGLTF: true },
        gltf: { loadBuffers: true, loadImages: false, decompressMeshes: true },
    };
    return load(host + path, Tiles3DLoader, options);
}

let tilesets = 0;
let tiles = 0;
let instances = 0;
let finest = 0; // instances of tiles without children: each tree once

async function visit(tile, base) {
    const uri = tile.content?.uri;
    if (uri?.endsWith('.json')) {
        await readTileset(join(base, uri));
    } else if (uri) {
        const { gltf } = await read(join(base, uri), false);
        if (!(gltf.meshes.length > 0) || gltf.meshes.some(mesh => mesh.primitives.some(part => !part.attributes.POSITION?.value))) {
            throw new Error(`${uri}: a mesh has no vertices`);
        }
        ++tiles;
        for (const node of gltf.nodes) {
            const attributes = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
            const count = attributes ? gltf.accessors[attributes.TRANSLATION].count : 0;
            instances += count;
            finest += tile.children?.length > 0 ? 0 : count;
        }
    }
    for (const child of tile.children ?? []) {
        await visit(child, base);
    }
}

async function readTileset(path) {
    const tileset = await read(path, true);
    ++tilesets;
    if (tileset.asset?.version !== '1.1' || tileset.root === undefined) {
        throw new Error(`${path}: no tileset`);
    }
    await visit(JSON.parse(await readFile(join(folder, path), 'utf8')).root, dirname(path));
}

await readTileset('tileset.json');
console.log(JSON.stringify({ tilesets, tiles, instances, finest }));
