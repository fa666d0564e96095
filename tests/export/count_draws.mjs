// SPDX-License-Identifier: MIT
// Counts the draw calls and triangles of a GLB in a viewer that makes no levels of detail: one call for each primitive
// of each node of the scene, instanced or not. Usage: node count_draws.mjs FILE [MAX_CALLS MAX_TRIANGLES]
// Fails if a count is above its limit.
import { readFileSync } from 'node:fs';

const [file, maxCalls, maxTriangles] = process.argv.slice(2);
if (!file) {
    console.error('usage: node count_draws.mjs FILE [MAX_CALLS MAX_TRIANGLES]');
    process.exit(2);
}
const bytes = readFileSync(file);
const document = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());

let calls = 0;
let triangles = 0;
let instances = 0;
function visit(number) {
    const node = document.nodes[number];
    if (node.mesh !== undefined) {
        const attributes = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
        const copies = attributes ? document.accessors[Object.values(attributes)[0]].count : 1;
        instances += copies;
        for (const primitive of document.meshes[node.mesh].primitives) {
            ++calls;
            triangles += copies * document.accessors[primitive.indices].count / 3;
        }
    }
    for (const child of node.children ?? []) {
        visit(child);
    }
}
for (const root of document.scenes[document.scene ?? 0].nodes) {
    visit(root);
}
console.log(`${calls} draw calls, ${triangles} triangles, ${instances} instances, ${bytes.length} bytes`);
if (calls > Number(maxCalls ?? Infinity) || triangles > Number(maxTriangles ?? Infinity)) {
    console.log(`more than ${maxCalls} draw calls or ${maxTriangles} triangles`);
    process.exit(1);
}
