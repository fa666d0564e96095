// SPDX-License-Identifier: MIT
// Compares an animated glTF file with the frames of the same motion, one PLY each.

/// Vertices of a binary PLY as lsc writes it: positions and normals first.
export function readPlyPositions(bytes) {
    const end = bytes.indexOf('end_header\n') + 'end_header\n'.length;
    const header = bytes.subarray(0, end).toString('latin1');
    const count = Number(/element vertex (\d+)/.exec(header)[1]);
    const stride = 24 + (header.includes('property float s') ? 8 : 0) +
        (header.includes('property uchar red') ? 3 : 0);
    const positions = [];
    for (let i = 0; i < count; ++i) {
        positions.push([0, 4, 8].map(at => bytes.readFloatLE(end + i * stride + at)));
    }
    return positions;
}

/// For each vertex of `gltf`, as computed by three.js: its position at rest, its position at `time`
/// (s), and the number of joints that move it.
export function posedVertices(three, gltf, time) {
    const mixer = new three.AnimationMixer(gltf.scene);
    const action = mixer.clipAction(gltf.animations[0]);
    action.setLoop(three.LoopOnce);
    action.clampWhenFinished = true; // shows the last key at the end, not the first again
    action.play();
    mixer.setTime(time);
    gltf.scene.updateMatrixWorld(true);
    const vertices = [];
    gltf.scene.traverse(object => {
        if (!object.isSkinnedMesh) {
            return;
        }
        const { position, skinWeight } = object.geometry.attributes;
        for (let i = 0; i < position.count; ++i) {
            const at = new three.Vector3().fromBufferAttribute(position, i);
            const rest = at.toArray();
            object.applyBoneTransform(i, at);
            at.applyMatrix4(object.matrixWorld);
            vertices.push({ rest, at: at.toArray(), joints: skinWeight.getY(i) > 0 ? 2 : 1 });
        }
    });
    return vertices;
}

/// Positions, computed by three.js, of the corners of the triangles that a film shows at `time` (s).
export function shownCorners(three, gltf, time) {
    const mixer = new three.AnimationMixer(gltf.scene);
    const action = mixer.clipAction(gltf.animations[0]);
    action.setLoop(three.LoopOnce);
    action.clampWhenFinished = true; // shows the last key at the end, not the first again
    action.play();
    mixer.setTime(time);
    gltf.scene.updateMatrixWorld(true);
    const corners = [];
    gltf.scene.traverse(object => {
        // A mesh whose node has scale 0 is hidden.
        if (!object.isMesh || object.matrixWorld.elements[0] === 0) {
            return;
        }
        const { index } = object.geometry;
        for (let i = 0; i < index.count; ++i) {
            const at = object.getVertexPosition(index.getX(i), new three.Vector3());
            corners.push(at.applyMatrix4(object.matrixWorld).toArray());
        }
    });
    return corners;
}

export function distance(a, b) {
    return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
