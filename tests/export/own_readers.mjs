// SPDX-License-Identifier: MIT
// Readers of OFF+, of the part of USDA that lsc writes, and of USDZ archives. They are written from
// the specifications of the formats.

function assert(condition, message) {
    if (!condition) {
        throw new Error(message);
    }
}

/// Parses OFF+: `OFF`, counts, `x y z u v` for each vertex, `3 a b c leaf` for each face.
export function readOffPlus(text) {
    const lines = text.split('\n');
    assert(lines[0] === 'OFF', 'no OFF in the first line');
    const [vertices, triangles] = lines[1].split(' ').map(Number);
    assert(lines.length === 2 + vertices + triangles + 1 && lines.at(-1) === '',
           'not as many lines as the counts say');
    for (let i = 0; i < vertices; ++i) {
        const numbers = lines[2 + i].split(' ').map(Number);
        assert(numbers.length === 5 && numbers.every(Number.isFinite), `vertex ${i}`);
    }
    for (let i = 0; i < triangles; ++i) {
        const numbers = lines[2 + vertices + i].split(' ').map(Number);
        assert(numbers.length === 5 && numbers[0] === 3 && (numbers[4] === 0 || numbers[4] === 1) &&
               numbers.slice(1, 4).every(n => Number.isInteger(n) && n >= 0 && n < vertices),
               `face ${i}`);
    }
    return { vertices, triangles };
}

const token = /\s*(?:(@@@(?:\\@@@|(?!@@@)[^\n])*@@@|@[^@\n]*@)|([A-Za-z_][\w:.]*(?:\[\])?)|(-?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)|("(?:[^"\\\n]|\\.)*")|(<[^<>]*>)|([()[\]{}=,:]))/gy;

/// Parser of USDA. A prim becomes an object with its `properties` and `children`, each by name.
class Parser {
    constructor(text) {
        this.text = text;
        token.lastIndex = 0;
        this.next();
    }
    next() {
        const begin = token.lastIndex;
        const match = token.exec(this.text);
        if (match === null) {
            assert(this.text.slice(begin).trim() === '', `no token at byte ${begin}`);
            this.kind = 'end';
            return;
        }
        this.kind = ['asset', 'name', 'number', 'string', 'path', 'sign'][match.slice(1).findIndex(
            m => m !== undefined)];
        this.value = match[0].trim();
    }
    take(value) {
        const taken = this.value;
        assert(this.kind !== 'end' && (value === undefined || taken === value),
               `${value} expected, ${taken} found`);
        this.next();
        return taken;
    }
    at(value) {
        return this.kind !== 'end' && this.value === value;
    }
    // Numbers, strings, paths, tuples, lists.
    literal() {
        if (this.kind === 'number') {
            return Number(this.take());
        }
        if (this.kind === 'asset') {
            const text = this.take();
            return text.startsWith('@@@') ? text.slice(3, -3).replaceAll('\\@@@', '@@@')
                                          : text.slice(1, -1);
        }
        for (const [open, close] of [['[', ']'], ['(', ')']]) {
            if (this.at(open)) {
                this.take();
                const items = [];
                while (!this.at(close)) {
                    items.push(this.literal());
                    if (!this.at(close)) {
                        this.take(',');
                    }
                }
                this.take();
                return items;
            }
        }
        assert(this.kind === 'string' || this.kind === 'path', `no value: ${this.value}`);
        return this.take().slice(1, -1);
    }
    // `name = value`, `type name = value`, dictionaries, up to `close`.
    fields(close) {
        const fields = {};
        while (!this.at(close)) {
            const words = [];
            while (this.kind === 'name') {
                words.push(this.take());
            }
            assert(words.length > 0, `no field: ${this.value}`);
            let value = null;
            if (this.at('=')) {
                this.take();
                if (this.at('{')) {
                    this.take();
                    value = this.fields('}');
                    this.take('}');
                } else {
                    value = this.literal();
                }
            }
            const field = { type: words.slice(0, -1).join(' '), value };
            if (this.at('(')) {
                this.take();
                field.metadata = this.fields(')');
                this.take(')');
            }
            assert(!(words.at(-1) in fields), `${words.at(-1)} twice`);
            fields[words.at(-1)] = field;
        }
        return fields;
    }
    prim() {
        this.take('def');
        const prim = { type: this.take(), name: this.literal(), metadata: {}, children: {} };
        if (this.at('(')) {
            this.take();
            prim.metadata = this.fields(')');
            this.take(')');
        }
        this.take('{');
        const properties = [];
        while (!this.at('}')) {
            if (this.at('def')) {
                const child = this.prim();
                assert(!(child.name in prim.children), `two prims ${child.name}`);
                assert(/^[A-Za-z_]\w*$/.test(child.name), `no name of a prim: ${child.name}`);
                prim.children[child.name] = child;
            } else {
                properties.push(this.property());
            }
        }
        this.take('}');
        prim.properties = Object.fromEntries(properties);
        assert(Object.keys(prim.properties).length === properties.length, 'a property twice');
        return prim;
    }
    // Values by their time code.
    samples() {
        const values = {};
        for (this.take('{'); !this.at('}'); this.take(',')) {
            const code = this.literal();
            this.take(':');
            values[code] = this.literal();
        }
        this.take('}');
        return values;
    }
    property() {
        // `uniform` or `custom`, the type and the name; a property without a value ends after the
        // name.
        const words = [];
        do {
            assert(this.kind === 'name', `no property: ${this.value}`);
            words.push(this.take());
        } while (words.length < (['uniform', 'custom'].includes(words[0]) ? 3 : 2));
        let value = null;
        if (this.at('=')) {
            this.take();
            value = this.at('{') ? this.samples() : this.literal();
        }
        const property = { type: words.slice(0, -1).join(' '), value };
        if (this.at('(')) {
            this.take();
            property.metadata = this.fields(')');
            this.take(')');
        }
        return [words.at(-1), property];
    }
}

// File names of the pictures of a material at `path`. Checks that all connected shaders exist.
function readPictures(material, path) {
    const output = (connection, type) => {
        const [prim, name] = connection.split('.');
        assert(prim.startsWith(`${path}/`), `${connection} is in another material`);
        const shader = material.children[prim.slice(path.length + 1)];
        assert(shader?.type === 'Shader' && shader.properties[name].type.startsWith(type),
               `${connection} is no ${type}`);
        return shader.properties;
    };
    const pictures = [];
    const surface = material.children.Surface.properties;
    const inputs = { diffuseColor: 'float3', opacity: 'float', normal: 'float3' };
    for (const [input, type] of Object.entries(inputs)) {
        const connection = surface[`inputs:${input}.connect`];
        assert(connection === undefined || !(`inputs:${input}` in surface), `${input} twice`);
        if (connection === undefined) {
            continue;
        }
        const picture = output(connection.value, type);
        assert(picture['info:id'].value === 'UsdUVTexture', 'info:id of a picture');
        assert(picture['inputs:sourceColorSpace'].value === (input === 'normal' ? 'raw' : 'sRGB'),
               'color space');
        const place = output(picture['inputs:st.connect'].value, 'float2');
        assert(place['info:id'].value === 'UsdPrimvarReader_float2' &&
               place['inputs:varname'].value === 'st', 'reader of texture coordinates');
        pictures.push(picture['inputs:file'].value);
    }
    return pictures;
}

function readLayer(text) {
    assert(text.startsWith('#usda 1.0\n'), 'no #usda 1.0 in the first line');
    const parser = new Parser(text.slice('#usda 1.0'.length));
    parser.take('(');
    const layer = parser.fields(')');
    parser.take(')');
    assert(layer.upAxis.value === 'Y' && layer.metersPerUnit.value === 1, 'axis or unit');
    const root = parser.prim();
    assert(parser.kind === 'end', 'something behind the last prim');
    assert(root.name === layer.defaultPrim.value, 'defaultPrim');
    return { root, data: layer.customLayerData.value };
}

// A mesh whose subsets are bound to materials below `root`.
function readMesh(mesh, root) {
    const value = name => mesh.properties[name].value;
    const vertices = value('points').length;
    const indices = value('faceVertexIndices');
    const triangles = value('faceVertexCounts').length;
    assert(value('faceVertexCounts').every(n => n === 3), 'a face that is no triangle');
    assert(indices.length === 3 * triangles, 'faceVertexIndices');
    assert(indices.every(n => Number.isInteger(n) && n >= 0 && n < vertices), 'an index');
    const widths = { points: 3, normals: 3, 'primvars:st': 2 };
    for (const [name, width] of Object.entries(widths)) {
        if (name in mesh.properties) {
            assert(value(name).length === vertices &&
                   value(name).every(t => t.length === width && t.every(Number.isFinite)), name);
            assert(name === 'points' ||
                   mesh.properties[name].metadata.interpolation.value === 'vertex',
                   `interpolation of ${name}`);
        }
    }
    if ('primvars:displayColor' in mesh.properties) {
        const colours = value('primvars:displayColor');
        assert(colours.every(c => c.length === 3 && c.every(x => x >= 0 && x <= 1)), 'a colour');
        const interpolation = colours.length === 1 ? 'constant' : 'vertex';
        assert(mesh.properties['primvars:displayColor'].metadata.interpolation.value ===
               interpolation, 'interpolation of colours');
        const places = mesh.properties['primvars:displayColor:indices']?.value;
        assert(colours.length === 1 ? places === undefined :
               places.length === vertices && places.every(i => i >= 0 && i < colours.length),
               'indices of colours');
    }
    const [low, high] = value('extent');
    assert(value('points').every(p => p.every((x, i) => x >= low[i] && x <= high[i])), 'extent');

    // Each face is in exactly one subset, and each subset names an existing material.
    const pictures = new Set();
    const owned = new Uint8Array(triangles);
    const subsets = Object.values(mesh.children);
    for (const subset of subsets) {
        assert(subset.type === 'GeomSubset', subset.type);
        for (const face of subset.properties.indices.value) {
            assert(face < triangles && owned[face] === 0, `face ${face} of ${subset.name}`);
            owned[face] = 1;
        }
        const path = subset.properties['material:binding'].value.split('/').slice(2);
        const material = path.reduce((prim, name) => prim.children[name], root);
        assert(material.type === 'Material', 'material:binding');
        const shader = `/${root.name}/${path.join('/')}/Surface.outputs:surface`;
        assert(material.properties['outputs:surface.connect'].value === shader &&
               material.children.Surface.type === 'Shader', 'connection of the surface');
        for (const picture of readPictures(material, `/${root.name}/${path.join('/')}`)) {
            assert('primvars:st' in mesh.properties, 'a picture without texture coordinates');
            pictures.add(picture);
        }
    }
    assert(owned.every(n => n === 1), 'a face without a subset');
    return { vertices, triangles, parts: subsets.length, pictures: [...pictures] };
}

export function readUsda(text) {
    const { root, data } = readLayer(text);
    assert(typeof data.grammar.value === 'string', 'grammar');
    return readMesh(root.children.Mesh, root);
}

const crcTable = Array.from({ length: 256 }, (_, byte) => {
    let crc = byte;
    for (let bit = 0; bit < 8; ++bit) {
        crc = crc & 1 ? crc >>> 1 ^ 0xEDB88320 : crc >>> 1;
    }
    return crc >>> 0;
});

function crc32(bytes) {
    let crc = 0xFFFFFFFF;
    for (const byte of bytes) {
        crc = crcTable[(crc ^ byte) & 255] ^ crc >>> 8;
    }
    return (crc ^ 0xFFFFFFFF) >>> 0;
}

/// The entries of a USDZ by name, in order. Checks that they are uncompressed, begin at multiples of
/// 64 bytes and have correct checksums.
export function readUsdz(bytes) {
    const end = bytes.length - 22;
    assert(bytes.readUInt32LE(end) === 0x06054b50, 'no end of an archive');
    const count = bytes.readUInt16LE(end + 10);
    let at = bytes.readUInt32LE(end + 16);
    assert(at + bytes.readUInt32LE(end + 12) === end, 'size of the list');
    const entries = new Map();
    for (let i = 0; i < count; ++i) {
        assert(bytes.readUInt32LE(at) === 0x02014b50, 'entry of the list');
        const nameBytes = bytes.readUInt16LE(at + 28);
        const name = bytes.toString('utf8', at + 46, at + 46 + nameBytes);
        const header = bytes.readUInt32LE(at + 42);
        assert(bytes.readUInt32LE(header) === 0x04034b50, `header of ${name}`);
        // These bytes are version, flags, method, time, date, checksum, sizes and length of the
        // name.
        assert(bytes.subarray(header + 4, header + 28).equals(bytes.subarray(at + 6, at + 30)),
               `${name}: two headers`);
        assert(bytes.readUInt16LE(header + 8) === 0, `${name} is compressed`);
        const begin = header + 30 + nameBytes + bytes.readUInt16LE(header + 28);
        assert(begin % 64 === 0, `${name} begins at ${begin}`);
        const size = bytes.readUInt32LE(header + 18);
        const entry = bytes.subarray(begin, begin + size);
        assert(size === bytes.readUInt32LE(header + 22) && entry.length === size, `size of ${name}`);
        assert(crc32(entry) === bytes.readUInt32LE(header + 14), `checksum of ${name}`);
        assert(!entries.has(name), `${name} twice`);
        entries.set(name, entry);
        at += 46 + nameBytes;
    }
    assert(at === end, 'something in the list');
    return entries;
}

function turned([w, x, y, z], [a, b, c]) {
    const t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
    return [a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2],
            c + w * t[2] + x * t[1] - y * t[0]];
}

// The nearest half float, because USD stores quath values as half floats.
function halfFloat(x) {
    const step = 2 ** (Math.max(Math.floor(Math.log2(Math.abs(x) || 1e-9)), -14) - 10);
    return Math.round(x / step) * step;
}

/// Reads a ground and a PointInstancer for each kind of plant; returns counts, pictures and bounds.
export function readUsdaForest(text) {
    const { root, data } = readLayer(text);
    const found = { branches: 0, triangles: 0, pictures: new Set(),
                    low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
    const add = point => point.forEach((x, i) => {
        found.low[i] = Math.min(found.low[i], x);
        found.high[i] = Math.max(found.high[i], x);
    });
    const read = mesh => {
        const { triangles, pictures } = readMesh(mesh, root);
        pictures.forEach(picture => found.pictures.add(picture));
        return { triangles, points: mesh.properties.points.value };
    };
    for (const prim of Object.values(root.children)) {
        if (prim.type === 'Mesh') {
            const ground = read(prim);
            found.triangles += ground.triangles;
            ground.points.forEach(add);
        }
        if (prim.type !== 'PointInstancer') {
            continue;
        }
        const value = name => prim.properties[name].value;
        const prototypes = value('prototypes').map(path => {
            const names = path.split('/').slice(2);
            const mesh = names.reduce((at, name) => at.children[name], root);
            assert(mesh?.type === 'Mesh', `no prototype ${path}`);
            return read(mesh);
        });
        assert(prototypes.length === Object.keys(prim.children.Prototypes.children).length,
               'a prototype that is not named');
        assert(!('orientationsf' in prim.properties), 'orientations in two arrays');
        const count = value('protoIndices').length;
        const widths = { positions: 3, orientations: 4, scales: 3 };
        const scaled = 'scales' in prim.properties; // without scales, all are 1
        for (const [name, width] of Object.entries(widths).slice(0, scaled ? 3 : 2)) {
            assert(value(name).length === count &&
                   value(name).every(t => t.length === width && t.every(Number.isFinite)), name);
        }
        value('protoIndices').forEach((number, i) => {
            const { triangles, points } = prototypes[number];
            const half = value('orientations')[i].map(halfFloat);
            const length = Math.hypot(...half);
            assert(Math.abs(length - 1) < 2e-3, 'an orientation of another length');
            const q = half.map(x => x / length);
            const [s, p] = [scaled ? value('scales')[i] : [1, 1, 1], value('positions')[i]];
            found.triangles += triangles;
            points.forEach(v => add(turned(q, v.map((x, k) => x * s[k])).map((x, k) => x + p[k])));
        });
        found.branches += count;
    }
    assert(data.branches.value === found.branches, 'branches in customLayerData');
    return { ...found, trees: data.trees.value, pictures: [...found.pictures] };
}
