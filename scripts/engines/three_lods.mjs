// SPDX-License-Identifier: MIT
// Shows the levels of detail of a plant in three.js: a plugin of GLTFLoader for the files of
// `lsc export -o tree.glb --lods N`, whose node has MSFT_lod and MSFT_screencoverage.
//
//     import * as THREE from 'three';
//     loader.register(lods(THREE)); // or lods(THREE, 45): vertical field of view in degrees
//
// The node becomes a THREE.LOD, which shows the level for its distance from the camera.

/// Default vertical field of view in degrees.
const VIEW = 60;
/// Width / height of the screen to which the fractions of MSFT_screencoverage in the file refer.
const ASPECT = 16 / 9;

export function lods(THREE, view = VIEW) {
    const cotangent = 1 / (2 * Math.tan(view * Math.PI / 360));
    return parser => ({
        name: 'MSFT_lod',
        loadNode(index) {
            const node = parser.json.nodes[index];
            const ids = node.extensions?.MSFT_lod?.ids;
            if (!ids) {
                return null;
            }
            const levels = [parser.loadNode(index), ...ids.map(id => parser.getDependency('node', id))];
            return Promise.all(levels).then(objects => {
                const size = new THREE.Box3().setFromObject(objects[0]).getSize(new THREE.Vector3());
                const faceArea = size.y * Math.max(size.x, size.z);
                // A level begins at the distance from which the box covers a smaller fraction of the
                // screen than the coverage of the previous level.
                const coverages = node.extras.MSFT_screencoverage;
                const lod = new THREE.LOD();
                lod.name = node.name;
                objects.forEach((object, i) => lod.addLevel(
                    object, i === 0 ? 0 : cotangent * Math.sqrt(faceArea / (ASPECT * coverages[i - 1]))));
                return lod;
            });
        },
    });
}
