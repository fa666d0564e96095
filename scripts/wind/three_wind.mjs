// SPDX-License-Identifier: MIT
// Wind for plants of `lsc export --wind-data` in three.js. README.md has the formulas.
//
//     const { scene } = await new GLTFLoader().loadAsync('tree.glb');
//     const wind = addWind(scene);
//     wind.windVector.value.set(0.5, 0, 0);              // direction; its length is the strength, 1 a storm
//     wind.windTime.value = clock.getElapsedTime();      // in every frame
//
// The direction of the wind is in the axes of the plant.
import * as THREE from 'three';

const declarations = `
uniform float windTime;
uniform vec3 windVector;
uniform float windHeight;
uniform vec2 windSway;
#ifndef USE_UV1
attribute vec2 uv1;
#endif
#ifndef USE_UV2
attribute vec2 uv2;
#endif
vec3 inWind(vec3 at) {
    const float TWO_PI = 6.283185307;
    float relativeHeight = max(at.y, 0.0) / windHeight;
    vec3 trunk = windSway.x * windHeight * relativeHeight * relativeHeight *
        (0.7 + 0.3 * sin(TWO_PI * windTime / 3.1)) * windVector;
    vec3 bough = windSway.y * windHeight * (1.0 - uv2.y) * (0.5 + 0.5 * uv1.x / windHeight) *
        (0.5 + 0.5 * sin(TWO_PI * (windTime / 1.3 + uv2.x))) * windVector;
    float minLength = 0.01 * windHeight;
    at += trunk + bough;
    at.y -= 0.5 * dot(trunk, trunk) / max(relativeHeight * windHeight, minLength) +
        0.5 * dot(bough, bough) / max(uv1.y, minLength);
    return at;
}
`;

function change(material, uniforms) {
    const before = material.onBeforeCompile;
    material.onBeforeCompile = (shader, renderer) => {
        before?.call(material, shader, renderer);
        Object.assign(shader.uniforms, uniforms);
        shader.vertexShader = shader.vertexShader
            .replace('#include <common>', `#include <common>\n${declarations}`)
            .replace('#include <begin_vertex>',
                     '#include <begin_vertex>\ntransformed = inWind(transformed);');
    };
    material.customProgramCacheKey = () => 'lsys wind';
    material.needsUpdate = true;
}

/// Changes the materials of all meshes of `object`, and the depth materials of their shadows. Returns
/// the uniforms. `sway`: displacements of the top and of the most flexible bough in a wind of strength 1,
/// as fractions of the height.
export function addWind(object, { sway = [0.1, 0.05] } = {}) {
    const box = new THREE.Box3().setFromObject(object);
    const uniforms = {
        windTime: { value: 0 },
        windVector: { value: new THREE.Vector3(0.5, 0, 0) },
        windHeight: { value: Math.max(box.max.y, 1e-3) },
        windSway: { value: new THREE.Vector2(...sway) },
    };
    const changed = new Set();
    object.traverse(mesh => {
        if (!mesh.isMesh || !mesh.geometry.attributes.uv1 || !mesh.geometry.attributes.uv2) {
            return;
        }
        for (const material of [mesh.material].flat()) {
            if (!changed.has(material)) {
                changed.add(material);
                change(material, uniforms);
            }
        }
        const { map = null, alphaTest = 0, side } = [mesh.material].flat()[0];
        mesh.customDepthMaterial = new THREE.MeshDepthMaterial(
            { depthPacking: THREE.RGBADepthPacking, map, alphaTest, side });
        change(mesh.customDepthMaterial, uniforms);
    });
    return uniforms;
}
