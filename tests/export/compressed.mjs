// Compressed glTF files beside the plain file of the same plant, by the accessors of glTF-Transform.

/// Items of an accessor as arrays of numbers, normalised ones as fractions.
export function itemsOf(accessor) {
    return Array.from({ length: accessor.getCount() }, (_, i) => accessor.getElement(i, []));
}

/// Primitives with their arrays; positions where the nodes put them, texture coordinates where the
/// texture is read.
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
            });
        }
    }
    return found;
}

/// Whether each triangle has the corners of the other list's, in the same order, beginning with any.
export function sameTriangles(a, b) {
    if (a.length !== b.length) {
        return false;
    }
    for (let i = 0; i < a.length; i += 3) {
        const turns = [0, 1, 2].some(k => [0, 1, 2].every(c => a[i + c] === b[i + (c + k) % 3]));
        if (!turns) {
            return false;
        }
    }
    return true;
}

/// The greatest difference of two lists of items.
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
