// SPDX-License-Identifier: MIT
// Compares compressed glTF files with the plain file of the same plant, by the accessors of
// glTF-Transform.

/// Items of an accessor as arrays of numbers, normalised ones as fractions.
export function itemsOf(accessor) {
    return Array.from({ length: accessor.getCount() }, (_, i) => accessor.getElement(i, []));
}

/// Primitives with their arrays; positions with the transform of their node, texture coordinates
/// with the transform of their texture.
export function primitivesOf(document) {
    const found = [];
    for (const node of document.getRoot().listNodes()) {
        const [scale] = node.getScale();
        const shift = node.getTranslation();
        for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
            const items = name => {
                const accessor = primitive.getAttribute(name);
                return accessor === null ? undefined : itemsOf(accessor);
            };
            const material = primitive.getMaterial();
            const transform = material.getBaseColorTextureInfo()?.getExtension('KHR_texture_transform') ??
                material.getNormalTextureInfo()?.getExtension('KHR_texture_transform');
            found.push({
                primitive,
                // lsc quantised with floats; Math.fround() restores them from the decimal numbers
                // in the file.
                scale: Math.fround(scale),
                shift: shift.map(Math.fround),
                material,
                indices: [...primitive.getIndices().getArray()],
                POSITION: items('POSITION').map(p => p.map((x, axis) => shift[axis] + scale * x)),
                NORMAL: items('NORMAL'),
                TANGENT: items('TANGENT'),
                COLOR_0: items('COLOR_0'),
                TEXCOORD_1: items('TEXCOORD_1'),
                TEXCOORD_2: items('TEXCOORD_2'),
                TEXCOORD_0: items('TEXCOORD_0')?.map(uv => transform === null || transform === undefined
                    ? uv : uv.map((x, i) => transform.getOffset()[i] + transform.getScale()[i] * x)),
                // Number of tiles that the texture coordinates span.
                tiles: Math.max(...transform?.getScale() ?? [1]),
            });
        }
    }
    return found;
}

/// Triangles of a primitive by key. The key lists the grid cells of the three corners, rotated so
/// that the smallest comes first: equal triangles of two files have equal keys, in any order of
/// vertices.
function trianglesByKey(primitive, cellOf) {
    const found = new Map();
    const cells = primitive.POSITION.map(cellOf);
    for (let i = 0; i < primitive.indices.length; i += 3) {
        const corners = [0, 1, 2].map(c => primitive.indices[i + c]);
        const turns = [0, 1, 2].map(k => [0, 1, 2].map(c => corners[(c + k) % 3]));
        const keys = turns.map(turn => turn.map(corner => cells[corner]).join(' '));
        const first = keys.indexOf(keys.slice().sort()[0]);
        const same = turns.filter((_, k) => keys[k] === keys[first]);
        found.set(keys[first], [...(found.get(keys[first]) ?? []), ...same.slice(0, 1)]);
    }
    return found;
}

/// Compares two primitives triangle by triangle. `tolerances`: by attribute. Returns the counts of
/// triangles that only one file has, and of triangles that differ by more than the tolerances.
export function comparePrimitives(one, other, cellOf, tolerances) {
    const found = trianglesByKey(one, cellOf);
    const wanted = trianglesByKey(other, cellOf);
    const result = { missing: 0, off: 0 };
    const near = (a, b) => Object.entries(tolerances).every(([attribute, most]) =>
        one[attribute] === undefined || a.every((corner, c) => one[attribute][corner].every(
            (x, k) => Math.abs(x - other[attribute][b[c]][k]) <= most)));
    const turned = b => [0, 1, 2].map(k => [0, 1, 2].map(c => b[(c + k) % 3]));
    for (const key of new Set([...found.keys(), ...wanted.keys()])) {
        const [mine, theirs] = [found.get(key) ?? [], wanted.get(key) ?? []];
        result.missing += Math.abs(mine.length - theirs.length);
        result.off += mine.filter(a => !theirs.some(b => turned(b).some(t => near(a, t)))).length;
    }
    return result;
}

/// The greatest difference between corresponding numbers of two lists of items.
export function greatestDifference(a, b) {
    return a.reduce((most, item, i) =>
        item.reduce((m, x, k) => Math.max(m, Math.abs(x - b[i][k])), most), 0);
}

/// The greatest extent of positions along an axis.
export function extentOf(primitives) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const { POSITION } of primitives) {
        for (const p of POSITION) {
            p.forEach((x, axis) => {
                low[axis] = Math.min(low[axis], x);
                high[axis] = Math.max(high[axis], x);
            });
        }
    }
    return Math.max(...high.map((x, axis) => x - low[axis]));
}
