// SPDX-License-Identifier: MIT
// Readers of USD from other projects: three.js, with motion, and tinyusdz.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Box, composed } from './forest.mjs';

/// three.js and a function that reads the bytes of a file. Pictures are not decoded.
export async function usdLoader(module) {
    globalThis.self = globalThis;
    globalThis.ProgressEvent ??= class extends Event {};
    globalThis.document ??= {
        createElementNS: () => ({ addEventListener() {}, removeEventListener() {} }),
    };
    const three = await module('three/build/three.module.js');
    const { USDLoader } = await module('three/examples/jsm/loaders/USDLoader.js');
    return { three, load: bytes => new USDLoader().parse(bytes, '') };
}

/// Positions, computed by three.js, of the corners of the triangles of `group` at `time` (s).
export function posedCorners(three, group, time) {
    const mixer = new three.AnimationMixer(group);
    const action = mixer.clipAction(group.animations[0]);
    action.setLoop(three.LoopOnce);
    action.clampWhenFinished = true; // shows the last key at the end, not the first again
    action.play();
    mixer.setTime(time);
    group.updateMatrixWorld(true);
    const corners = [];
    group.traverse(object => {
        if (!object.isSkinnedMesh) {
            return;
        }
        const { position } = object.geometry.attributes;
        const { index } = object.geometry;
        for (let i = 0; i < (index?.count ?? position.count); ++i) {
            const vertex = index?.getX(i) ?? i;
            const at = new three.Vector3().fromBufferAttribute(position, vertex);
            object.applyBoneTransform(vertex, at);
            corners.push(at.applyMatrix4(object.matrixWorld).toArray());
        }
    });
    return corners;
}

/// Index of the vertex of each triangle corner of a binary PLY as lsc writes it.
export function readPlyTriangles(bytes) {
    const end = bytes.indexOf('end_header\n') + 'end_header\n'.length;
    const header = bytes.subarray(0, end).toString('latin1');
    const count = Number(/element face (\d+)/.exec(header)[1]);
    const first = bytes.length - 13 * count;
    const corners = [];
    for (let i = 0; i < count; ++i) {
        corners.push(...[1, 5, 9].map(at => bytes.readUInt32LE(first + 13 * i + at)));
    }
    return corners;
}

/// Functions that read the bytes of a file: `open` returns its meshes, `layer` its text, `composed`
/// its text with the variants selected.
/// tinyusdz is built for web workers, so this function defines the global objects of a web worker.
export async function tinyUsdz(module, modules) {
    process.type = 'renderer';
    globalThis.WorkerGlobalScope ??= class {};
    globalThis.self ??= globalThis;
    globalThis.location ??= { href: 'file:///' };
    const { default: start } = await module('tinyusdz/tinyusdz.js');
    const wasmBinary = readFileSync(join(modules, 'tinyusdz/tinyusdz.wasm'));
    const { TinyUSDZLoaderNative } = await start({ wasmBinary });
    const loaded = (load, file, bytes) => {
        const loader = new TinyUSDZLoaderNative();
        if (!loader[load](new Uint8Array(bytes), file)) {
            throw new Error(`tinyusdz refuses it: ${loader.error()}`);
        }
        return loader;
    };
    return {
        open: (file, bytes) => loaded('loadFromBinary', file, bytes),
        layer: (file, bytes) => {
            const loader = loaded('loadAsLayerFromBinary', file, bytes);
            const text = loader.layerToString();
            loader.delete();
            return text;
        },
        composed: (file, bytes) => {
            const loader = loaded('loadAsLayerFromBinary', file, bytes);
            if (!loader.composeVariants()) {
                throw new Error(`tinyusdz does not compose it: ${loader.error()}`);
            }
            const text = loader.layerToString();
            loader.delete();
            return text;
        },
    };
}

/// Number of instances and bounding box of a forest. The points come from `loader`, the instances
/// from `text`, the text of the layer, because tinyusdz does not expand instances.
export function instancedBox(loader, text, { ground = true } = {}) {
    const meshes = new Map();
    for (let i = 0; i < loader.numMeshes(); ++i) {
        const mesh = loader.getMesh(i);
        meshes.set(mesh.absPath, mesh.points);
    }
    const box = new Box();
    box.add(ground ? meshes.get('/Forest/Ground') ?? [] : [], composed([0, 0, 0], [0, 0, 0, 1], [1, 1, 1]));
    let instances = 0;
    for (const instancer of text.split('def PointInstancer').slice(1)) {
        const value = name => new RegExp(` ${name} = \\[([^\\]]*)\\]`).exec(instancer)?.[1];
        const numbers = name => value(name)?.match(/-?[\d.]+(?:e[-+]?\d+)?/g).map(Number);
        const prototypes = value('prototypes').match(/[^<>]+(?=>)/g).map(path => meshes.get(path));
        const [at, turns, sizes] = ['positions', 'orientations', 'scales'].map(numbers);
        numbers('protoIndices').forEach((prototype, i) => {
            const q = turns.slice(4 * i, 4 * i + 4);
            const length = Math.hypot(...q);
            const [w, x, y, z] = q.map(part => part / length);
            const size = sizes?.slice(3 * i, 3 * i + 3) ?? [1, 1, 1]; // without scales, all are 1
            box.add(prototypes[prototype], composed(at.slice(3 * i, 3 * i + 3), [x, y, z, w], size));
            ++instances;
        });
    }
    return { instances, low: box.low, high: box.high };
}
