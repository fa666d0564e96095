// SPDX-License-Identifier: MIT
// Tests the plugin for three.js of scripts/engines with levels of detail in one file.
// Usage: node lods.mjs MODULES PLUGIN FILE.glb FILE.lods.json
// FILE.lods.json has the triangles and the distance of each level.
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, plugin, file, list] = process.argv.slice(2).map(path => resolve(path));
const module = path => import(pathToFileURL(join(modules, path)));
globalThis.self = globalThis;
globalThis.ProgressEvent ??= class extends Event {};
const THREE = await module('three/build/three.module.js');
const { GLTFLoader } = await module('three/examples/jsm/loaders/GLTFLoader.js');
const { MeshoptDecoder } = await module('three/examples/jsm/libs/meshopt_decoder.module.js');
const { lods } = await import(pathToFileURL(plugin));

const bytes = readFileSync(file);
const data = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).register(lods(THREE));
loader.register(() => ({ name: 'images', loadTexture: async () => new THREE.Texture() }));
const { scene } = await loader.parseAsync(data, '');
const found = [];
scene.traverse(object => {
    if (object.isLOD) {
        for (const level of object.levels) {
            let triangles = 0;
            level.object.traverse(mesh => {
                triangles += mesh.isMesh ? mesh.geometry.index.count / 3 : 0;
            });
            found.push({ triangles, distance: level.distance });
        }
    }
});
const { levels } = JSON.parse(readFileSync(list, 'utf8'));
const fits = found.length > 3 && found.length === levels.length && levels.every((level, i) =>
    level.triangles === found[i].triangles &&
    Math.abs(level.distance - found[i].distance) <= 0.01 * level.distance);
if (!fits) {
    console.log('found', found, 'wanted', levels);
}
console.log(`${found.length} levels`);
process.exit(fits ? 0 : 1);
