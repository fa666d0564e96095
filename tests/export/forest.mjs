// SPDX-License-Identifier: MIT
// Reads an instanced forest by readers of other projects: branches, triangles and bounds in world
// space.

class Extent {
    low = [Infinity, Infinity, Infinity];
    high = [-Infinity, -Infinity, -Infinity];
    add(point) {
        point.forEach((x, i) => {
            this.low[i] = Math.min(this.low[i], x);
            this.high[i] = Math.max(this.high[i], x);
        });
    }
}

/// The box around transformed points, in doubles.
export class Box {
    low = [Infinity, Infinity, Infinity];
    high = [-Infinity, -Infinity, -Infinity];

    /// Adds points x y z x y z ..., transformed by a matrix of 16 numbers, column by column.
    add(points, m) {
        const { low, high } = this;
        for (let p = 0; p < points.length; p += 3) {
            for (let row = 0; row < 3; ++row) {
                const x = points[p] * m[row] + points[p + 1] * m[4 + row] + points[p + 2] * m[8 + row] + m[12 + row];
                low[row] = x < low[row] ? x : low[row];
                high[row] = x > high[row] ? x : high[row];
            }
        }
    }
}

/// Matrix of a scale, a turn by a quaternion, then a shift.
export function composed([tx, ty, tz], [x, y, z, w], [sx, sy, sz]) {
    return [sx * (1 - 2 * (y * y + z * z)), sx * 2 * (x * y + z * w), sx * 2 * (x * z - y * w), 0,
            sy * 2 * (x * y - z * w), sy * (1 - 2 * (x * x + z * z)), sy * 2 * (y * z + x * w), 0,
            sz * 2 * (x * z + y * w), sz * 2 * (y * z - x * w), sz * (1 - 2 * (x * x + y * y)), 0,
            tx, ty, tz, 1];
}

/// Measures of a forest as three.js loads it. An instance counts once, however many primitives it
/// has.
export async function instancedForest(three, gltf) {
    const extent = new Extent();
    let branches = 0;
    let triangles = 0;
    const at = new three.Vector3();
    const matrix = new three.Matrix4();
    gltf.scene.updateMatrixWorld(true);
    const nodes = gltf.parser.json.nodes;
    for (let n = 0; n < nodes.length; ++n) {
        if (nodes[n].mesh === undefined) {
            continue;
        }
        const instancing = nodes[n].extensions?.EXT_mesh_gpu_instancing;
        const count = instancing === undefined
            ? 1 : gltf.parser.json.accessors[instancing.attributes.TRANSLATION].count;
        branches += instancing === undefined ? 0 : count;
        const object = await gltf.parser.getDependency('node', n);
        let meshes = 0;
        object.traverse(mesh => {
            if (!mesh.isMesh) {
                return;
            }
            ++meshes;
            if (instancing !== undefined && !(mesh.isInstancedMesh && mesh.count === count)) {
                throw new Error(`node ${n} has no ${count} instances`);
            }
            const { geometry } = mesh;
            const { index, attributes } = geometry;
            triangles += index.count / 3 * count;
            const vertices = [...new Set(index.array)];
            const own = new three.Box3().setFromPoints(vertices.map(
                vertex => new three.Vector3().fromBufferAttribute(attributes.position, vertex)));
            if (!own.equals(geometry.boundingBox)) { // bounds of the accessor
                throw new Error(`node ${n} has the bounds of more than its vertices`);
            }
            for (let i = 0; i < count; ++i) {
                matrix.copy(mesh.matrixWorld);
                if (mesh.isInstancedMesh) {
                    const placed = new three.Matrix4();
                    mesh.getMatrixAt(i, placed);
                    matrix.multiply(placed);
                }
                for (const vertex of vertices) {
                    at.fromBufferAttribute(attributes.position, vertex).applyMatrix4(matrix);
                    extent.add([at.x, at.y, at.z]);
                }
            }
        });
        if (meshes !== gltf.parser.json.meshes[nodes[n].mesh].primitives.length) {
            throw new Error(`node ${n} has ${meshes} meshes`);
        }
    }
    return { branches, triangles, low: extent.low, high: extent.high };
}

function turned([x, y, z, w], [a, b, c]) {
    const t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
    return [a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2],
            c + w * t[2] + x * t[1] - y * t[0]];
}

/// Measures of a forest as glTF-Transform reads it, with or without instances. `bytes`: size of the
/// attributes of an instance.
export async function readAccessors(io, file) {
    const document = await io.readBinary(new Uint8Array(file));
    const root = document.getRoot();
    const found = { branches: 0, triangles: 0, wrong: 0, bytes: 0 };
    for (const accessor of root.listAccessors()) {
        const array = accessor.getArray();
        const fits = array.length === accessor.getCount() * accessor.getElementSize();
        found.wrong += fits && array.every(Number.isFinite) ? 0 : 1;
    }
    const extent = new Extent();
    const vertices = new Map(); // of each mesh
    const verticesOf = mesh => {
        if (!vertices.has(mesh)) {
            vertices.set(mesh, mesh.listPrimitives().flatMap(primitive => {
                const position = primitive.getAttribute('POSITION');
                return [...new Set(primitive.getIndices().getArray())].map(
                    i => position.getElement(i, []));
            }));
        }
        return vertices.get(mesh);
    };
    const place = (mesh, translation, rotation, scale) => {
        found.triangles += mesh.listPrimitives().reduce(
            (sum, primitive) => sum + primitive.getIndices().getCount() / 3, 0);
        // Tolerance of a unit quaternion with 16 bits per component.
        found.wrong += Math.abs(Math.hypot(...rotation) - 1) < 5e-5 ? 0 : 1;
        for (const vertex of verticesOf(mesh)) {
            extent.add(turned(rotation, vertex.map((x, k) => x * scale[k])).map(
                (x, k) => x + translation[k]));
        }
    };
    for (const node of root.listNodes()) {
        const mesh = node.getMesh();
        if (mesh === null) {
            continue;
        }
        const batch = node.getExtension('EXT_mesh_gpu_instancing');
        if (batch === null) {
            found.branches += mesh.getName() === 'ground' ? 0 : 1;
            place(mesh, node.getTranslation(), node.getRotation(), node.getScale());
            continue;
        }
        const attributes = ['TRANSLATION', 'ROTATION', 'SCALE'].map(name => batch.getAttribute(name));
        const count = attributes[0].getCount();
        found.branches += count;
        found.wrong += attributes.every(a => a.getCount() === count) ? 0 : 1;
        found.bytes = attributes.reduce(
            (sum, a) => sum + a.getElementSize() * a.getComponentSize(), 0);
        for (let i = 0; i < count; ++i) {
            place(mesh, ...attributes.map(a => a.getElement(i, [])));
        }
    }
    return { ...found, document, low: extent.low, high: extent.high };
}
