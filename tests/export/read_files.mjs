// SPDX-License-Identifier: MIT
// Checks exported files with readers in JavaScript. Usage:
//   node read_files.mjs MODULES (validator | three | compressed | motion | growth | obj | svg | off+ | usda |
//                              usdz | usd-three | usd-motion | tinyusdz |
//                              forest-three | forest-transform | forest-usda) FOLDER
// MODULES is the node_modules of package.json beside this file. FOLDER has counts.txt, with a line
// `NAME VERTICES TRIANGLES PARTS` for each mesh, or `NAME FRAMES FPS METRES` for each moving mesh.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { distance, posedVertices, readPlyPositions, shownCorners } from './motion.mjs';
import { comparePrimitives, extentOf, primitivesOf } from './compressed.mjs';
import { instancedForest, readAccessors } from './forest.mjs';
import { readOffPlus, readUsda, readUsdaForest, readUsdz } from './own_readers.mjs';
import { instancedBox, posedCorners, readPlyTriangles, tinyUsdz, usdLoader } from './usd.mjs';

const [given, check, folder] = process.argv.slice(2);
const modules = resolve(given ?? '.');
if (!folder) {
    console.error('usage: node read_files.mjs MODULES (validator|three|compressed|motion|growth|obj|svg|off+|usda|usdz|usd-three|usd-motion|tinyusdz|forest-three|forest-transform|forest-usda) FOLDER');
    process.exit(2);
}
if (!existsSync(join(modules, 'three'))) {
    console.error(`${modules} is missing: run scripts/install-packages --tools`);
    process.exit(1);
}
const require = createRequire(join(modules, 'none.js'));
const module = path => import(pathToFileURL(join(modules, path)));

let failures = 0;
let files = 0;
function expect(file, what, found, expected) {
    if (found !== expected) {
        console.log(`${file}: ${what} is ${found}, not ${expected}`);
        ++failures;
    }
}

// Pictures made by lsc have 256 texels a side; pictures of the grammar keep their size.
const sizesOfSamples = [
    [/^teach-picture.*maple/, '64 x 64'],
    [/apple-twig.*(bark|bark_normals|bark normals)\b/, '128 x 128'],
    [/apple-twig.*sphere/, '128 x 64'],
    [/^cpfg-birch/, '64 x 64'],
    [/pipe-model-pine.*spray/, '448 x 512'],
    [/roots-in-soil.*soil_2|roots-in-soil.*soil 2/, '128 x 128'],
];
// The size of a JPEG, from its frame header, the segment SOF0, SOF1 or SOF2.
function sizeOfJpeg(bytes) {
    let at = 2;
    while (bytes[at + 1] < 0xc0 || bytes[at + 1] > 0xc2) {
        at += 2 + bytes.readUInt16BE(at + 2);
    }
    return `${bytes.readUInt16BE(at + 7)} x ${bytes.readUInt16BE(at + 5)}`;
}
// The sizes of the pictures of a species; no sizes for other samples.
function sizesOfSpecies(sample) {
    const pictures = join(dirname(fileURLToPath(import.meta.url)), '../../samples/species', sample);
    if (!existsSync(pictures)) {
        return [];
    }
    const read = extension => readdirSync(pictures).filter(name => name.endsWith(extension))
        .map(name => readFileSync(join(pictures, name)));
    return [...read('.png').map(png => `${png.readUInt32BE(16)} x ${png.readUInt32BE(20)}`),
            ...read('.jpg').map(sizeOfJpeg)];
}
function expectSize(file, name, png) {
    const found = `${png.width} x ${png.height}`;
    const [, size] = sizesOfSamples.find(([pattern]) => pattern.test(`${file} ${name}`)) ?? [, '256 x 256'];
    if (!sizesOfSpecies(file.split('.')[0]).includes(found)) {
        expect(file, `size of ${name}`, found, size);
    }
}

// Checks the size of a picture: a PNG in the folder, or `bytes`.
function expectPicture(file, name, bytes = readFileSync(join(folder, name))) {
    const { PNG } = require('pngjs');
    expectSize(file, name, PNG.sync.read(bytes));
}

function counts() {
    return readFileSync(join(folder, 'counts.txt'), 'utf8').trim().split('\n').filter(Boolean)
        .map(line => {
            const [name, ...numbers] = line.split(' ');
            const [vertices, triangles, parts] = numbers.map(Number);
            // The meaning of the columns for moving meshes.
            const [frames, fps, metres] = numbers.map(Number);
            return { name, vertices, triangles, parts, frames, fps, metres };
        });
}

async function eachMesh(extensions, read) {
    for (const mesh of counts()) {
        for (const extension of extensions) {
            const file = `${mesh.name}.${extension}`;
            try {
                await read(file, mesh);
            } catch (error) {
                console.log(`${file}: ${error.stack ?? error}`);
                ++failures;
            }
            ++files;
        }
    }
}

function facts() {
    return JSON.parse(readFileSync(join(folder, 'facts.json'), 'utf8'));
}

// Max difference of bounds, m; positions of compressed trees are off by about one quantisation
// step.
function roundingOf(file) {
    return file.includes('meshopt') || file.includes('quantize') ? 3e-3 : 1e-3;
}

function expectFacts(file, found, most = 1e-3) {
    const wanted = facts();
    expect(file, 'number of branches', found.branches, wanted.branches);
    expect(file, 'number of triangles', found.triangles, wanted.triangles);
    for (const end of ['low', 'high']) {
        const off = Math.max(...found[end].map((x, i) => Math.abs(x - wanted[end][i])));
        expect(file, `${end} end of the bounds within ${most} m: ${found[end]}`, off < most, true);
    }
}

async function threeAndLoader() {
    globalThis.self = globalThis;
    globalThis.ProgressEvent ??= class extends Event {};
    const three = await module('three/build/three.module.js');
    const { GLTFLoader } = await module('three/examples/jsm/loaders/GLTFLoader.js');
    return { three, GLTFLoader };
}

// glTF-Transform with every extension, and functions that validate a file and the document decoded
// from it.
async function transformer() {
    const core = await module('@gltf-transform/core/dist/index.js');
    const { ALL_EXTENSIONS } = await module('@gltf-transform/extensions/dist/index.js');
    const { MeshoptDecoder } = await module('three/examples/jsm/libs/meshopt_decoder.module.js');
    const validator = require('gltf-validator');
    await MeshoptDecoder.ready;
    const io = new core.NodeIO().registerExtensions(ALL_EXTENSIONS)
        .registerDependencies({ 'meshopt.decoder': MeshoptDecoder });
    const expectValid = async (file, bytes, uri) => {
        const report = await validator.validateBytes(new Uint8Array(bytes), {
            uri, maxIssues: 0, // no limit, because the validator misses errors after the limit
            externalResourceFunction: async name =>
                new Uint8Array(readFileSync(join(folder, decodeURIComponent(name)))),
        });
        const { numErrors, numWarnings, messages, truncated } = report.issues;
        expect(file, `${uri} is validated as a whole`, truncated, false);
        const bad = messages.filter(issue => issue.severity < 2);
        expect(file, `errors and warnings of ${uri} ${JSON.stringify(bad.slice(0, 3))}`,
               numErrors + numWarnings, 0);
    };
    // Validates the document without EXT_meshopt_compression.
    const expectValidDecoded = async (file, document) => {
        for (const extension of document.getRoot().listExtensionsUsed()) {
            if (extension.extensionName === 'EXT_meshopt_compression') {
                extension.dispose();
            }
        }
        await expectValid(file, await io.writeBinary(document), `${file} decoded`);
    };
    return { io, MeshoptDecoder, expectValid, expectValidDecoded };
}

function arrayBuffer(file) {
    const bytes = readFileSync(join(folder, file));
    return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
}

const checks = {
    async validator() {
        const validator = require('gltf-validator');
        const notes = new Map();
        await eachMesh(['glb', 'gltf'], async file => {
            const report = await validator.validateBytes(
                new Uint8Array(readFileSync(join(folder, file))), { uri: file, maxIssues: 0 });
            expect(file, 'validated as a whole', report.issues.truncated, false);
            expect(file, 'number of errors', report.issues.numErrors, 0);
            expect(file, 'number of warnings', report.issues.numWarnings, 0);
            for (const issue of report.issues.messages) {
                if (issue.severity < 2) {
                    console.log(`${file}: ${issue.code} ${issue.pointer}: ${issue.message}`);
                } else {
                    notes.set(issue.code, (notes.get(issue.code) ?? 0) + 1);
                }
            }
        });
        for (const [code, count] of notes) {
            console.log(`information, no fault: ${code} ${count}`);
        }
    },

    async three() {
        const { three, GLTFLoader } = await threeAndLoader();
        const { PNG } = require('pngjs');
        await eachMesh(['glb', 'gltf'], async (file, mesh) => {
            const loader = new GLTFLoader();
            let textures = 0;
            // Node cannot decode images, so load empty textures.
            loader.register(parser => ({
                name: 'images',
                async loadTexture(index) {
                    const image = parser.json.images[parser.json.textures[index].source];
                    const bytes = await parser.getDependency('bufferView', image.bufferView);
                    expectSize(file, image.name, PNG.sync.read(Buffer.from(bytes)));
                    ++textures;
                    return new three.Texture();
                },
            }));
            const gltf = await loader.parseAsync(arrayBuffer(file), '');
            let vertices = 0;
            let triangles = 0;
            let parts = 0;
            let extras;
            gltf.scene.traverse(object => {
                extras = object.userData.grammar === undefined ? extras : object.userData;
                if (object.isMesh) {
                    const { index, attributes } = object.geometry;
                    const { count } = attributes.position;
                    vertices += count;
                    triangles += index.count / 3;
                    // A merged material counts as the materials that it replaces; they differ only
                    // in colour.
                    const merged = /, (\d+) colours$/.exec(object.material.name);
                    parts += Number(merged?.[1] ?? 1);
                    expect(file, 'colours of a merged material', !merged || !!attributes.color, true);
                    // Vertices come in the order of their first use.
                    let next = 0;
                    const ordered = index.array.every(i => i < next || i === next++);
                    expect(file, 'vertices in order of use', ordered && next === count, true);
                    expect(file, 'bytes of an index', index.array.BYTES_PER_ELEMENT,
                           count <= 65535 ? 2 : 4);
                    expect(file, 'tangents only for a normal map', !!attributes.tangent,
                           !!object.material.normalMap);
                }
            });
            expect(file, 'some vertices', vertices > 0, true);
            expect(file, 'number of triangles', triangles, mesh.triangles);
            expect(file, 'number of parts', parts, mesh.parts);
            expect(file, 'number of textures read', textures,
                   gltf.parser.json.textures?.length ?? 0);
            expect(file, 'type of extras.grammar', typeof extras?.grammar, 'string');
            expect(file, 'type of extras.n', typeof extras?.n, 'number');
            expect(file, 'extras.seed', /^[0-9]+$/.test(`${extras?.seed}`), true);
        });
    },

    // Compressed files hold the numbers of the plain file within half a quantisation step, files
    // with a separate buffer exactly. Decoded by glTF-Transform, they are valid without any
    // extension.
    async compressed() {
        const { io, MeshoptDecoder, expectValid, expectValidDecoded } = await transformer();
        const { three, GLTFLoader } = await threeAndLoader();
        // File ending, then tolerances: positions as a fraction of the extent, directions, texture
        // coordinates in tiles. Texture coordinates that span more than 128 tiles may be off by
        // half of their 16-bit step, at most 2 of 256 texels.
        const forms = [
            ['separate.gltf', 0, 0, 0],
            ['quantize.glb', 0.5001 / 65535, 0.5001 / 127, 1 / 1024 + 1e-5],
            ['quantize.gltf', 0.5001 / 65535, 0.5001 / 127, 1 / 1024 + 1e-5],
            ['meshopt.glb', 0.5001 / 16383, 0.5001 / 127, 1 / 1024 + 1e-5],
            ['meshopt.gltf', 0.5001 / 16383, 0.5001 / 127, 1 / 1024 + 1e-5],
        ];
        for (const { name } of counts()) {
            const plain = primitivesOf(await io.readBinary(readFileSync(join(folder, `${name}.glb`))));
            const extent = extentOf(plain);
            const largest = plain.flatMap(p => p.POSITION.flat())
                .reduce((most, x) => Math.max(most, Math.abs(x)), 0);
            for (const [ending, positionStep, directionStep, textureStep] of forms) {
                const file = `${name}.${ending}`;
                ++files;
                const document = await io.read(join(folder, file));
                const found = primitivesOf(document);
                expect(file, 'number of primitives', found.length, plain.length);
                found.forEach((one, i) => {
                    const other = plain[i];
                    const tolerances = {
                        // The node's scale and shift are floats, which adds a rounding error.
                        POSITION: positionStep * extent + (positionStep > 0 ? 3e-7 * largest : 0),
                        NORMAL: directionStep + (directionStep > 0 ? 5e-4 : 0),
                        TANGENT: directionStep + (directionStep > 0 ? 5e-4 : 0),
                        TEXCOORD_0: textureStep === 0 ? 0
                            : Math.min(Math.max(textureStep, 0.5001 * one.tiles / 65535), 2 / 256) +
                                3e-7 * one.tiles, // rounding of floats
                        COLOR_0: 0,
                    };
                    for (const attribute of Object.keys(tolerances)) {
                        const unread = attribute === 'TEXCOORD_0' && ending !== 'separate.gltf' &&
                            one.material.getBaseColorTexture() === null &&
                            one.material.getNormalTexture() === null;
                        expect(file, `${attribute} in primitive ${i}`, one[attribute] !== undefined,
                               other[attribute] !== undefined && !unread);
                    }
                    // The cell of a position in the quantisation grid; for exact files, the
                    // position itself.
                    const cellOf = position => position.map((x, axis) => positionStep === 0
                        ? x : Math.floor((x - one.shift[axis]) / one.scale + 0.5)).join(',');
                    const { missing, off } = comparePrimitives(one, other, cellOf, tolerances);
                    expect(file, `triangles of primitive ${i} that only one file has`, missing, 0);
                    expect(file, `triangles of primitive ${i} that are off`, off, 0);
                    if (!ending.startsWith('meshopt')) {
                        expect(file, `vertices of primitive ${i}`, one.POSITION.length,
                               other.POSITION.length);
                    }
                    expect(file, `colour of primitive ${i}`, `${one.material.getBaseColorFactor()}`,
                           `${other.material.getBaseColorFactor()}`);
                });
                if (!ending.startsWith('meshopt')) {
                    await expectValid(file, readFileSync(join(folder, file)), file);
                } else {
                    await expectValidDecoded(file, document);
                }
                if (ending === 'meshopt.glb') {
                    const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
                    loader.register(() => ({ name: 'images', loadTexture: async () => new three.Texture() }));
                    const gltf = await loader.parseAsync(arrayBuffer(file), '');
                    const size = new three.Box3().setFromObject(gltf.scene).getSize(new three.Vector3());
                    expect(file, 'extent in three.js', Math.abs(Math.max(...size.toArray()) - extent) <=
                           1e-4 * extent, true);
                }
            }
        }
    },

    // At each keyframe the skinned vertices match the mesh of that frame. Cylinders match exactly, so
    // every tip of a segment is right; joined tubes and boxes may deviate, because their rings turn at
    // bends and their surfaces are smoothed.
    async motion() {
        const { three, GLTFLoader } = await threeAndLoader();
        await eachMesh(['glb', 'gltf'], async (file, mesh) => {
            const loader = new GLTFLoader();
            loader.register(() => ({ name: 'images', loadTexture: async () => new three.Texture() }));
            const gltf = await loader.parseAsync(arrayBuffer(file), '');
            expect(file, 'number of animations', gltf.animations.length, 1);
            expect(file, 'duration in frames',
                   Math.round(gltf.animations[0].duration * mesh.fps * 1e3) / 1e3, mesh.frames - 1);
            const frame = number => readPlyPositions(readFileSync(
                join(folder, `${mesh.name}.${String(number + 1).padStart(4, '0')}.ply`)));
            const first = frame(0);
            const loops = ['looping', 'bones', 'bent'].includes(mesh.name);
            let moved = 0;
            for (const number of [0, 1, Math.floor(mesh.frames / 2), mesh.frames - 1]) {
                const expected = frame(number);
                // `at`: by place at rest, the indices of the vertices of the PLY.
                const found = posedVertices(three, gltf, number / mesh.fps);
                const at = new Map();
                first.forEach((place, i) => {
                    at.set(`${place}`, [...(at.get(`${place}`) ?? []), i]);
                });
                const used = new Set(found.flatMap(vertex => at.get(`${vertex.rest}`) ?? []));
                expect(file, `vertices in frame ${number}`, used.size > 0.9 * first.length, true);
                const off = found.map(vertex => Math.min(Infinity, ...(at.get(`${vertex.rest}`) ?? [])
                    .map(i => distance(vertex.at, expected[i]))));
                const most = mesh.name === 'cylinders' || number === 0 ? 1e-5 : mesh.metres || 1e-2;
                expect(file, `frame ${number}: off by more than ${most}`,
                       off.filter(d => !(d <= most)).length, 0);
                const [part, near] = mesh.metres ? [0.5, mesh.metres / 4] : [0.05, 1e-3];
                expect(file, `frame ${number}: ${part} of the vertices are off by ${near} m`,
                       off.filter(d => !(d <= near)).length > part * off.length, false);
                if (loops && number === mesh.frames - 1) {
                    const seam = Math.max(...expected.map((to, i) => distance(to, first[i])));
                    expect(file, 'the last frame is the first', seam < 1e-5, true);
                }
                moved = Math.max(moved, ...expected.map((to, i) => distance(to, first[i])));
            }
            expect(file, 'it moves', moved > (loops ? 0.01 : 0.1), true);
            const turns = gltf.animations[0].tracks.filter(t => t.name.endsWith('.quaternion'));
            expect(file, 'number of rotations', turns.length > 2, true);
            for (const { name, values } of turns) {
                for (let i = 4; i < values.length; i += 4) {
                    const dot = [0, 1, 2, 3].reduce((sum, k) => sum + values[i + k] * values[i + k - 4], 0);
                    expect(file, `key ${i / 4} of ${name} is on the side of the one before`, dot > 0, true);
                }
            }
        });
        // In a compressed file each vertex moves as in the plain file, and wind data agree within
        // their rounding.
        const { io, MeshoptDecoder, expectValid, expectValidDecoded } = await transformer();
        await eachMesh(['quantize.glb', 'meshopt.glb'], async (file, mesh) => {
            const load = name => {
                const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
                loader.register(() => ({ name: 'images', loadTexture: async () => new three.Texture() }));
                return loader.parseAsync(arrayBuffer(name), '');
            };
            const meshopt = file.endsWith('meshopt.glb');
            const plainDocument = await io.read(join(folder, `${mesh.name}.glb`));
            const document = await io.read(join(folder, file));
            const plain = primitivesOf(plainDocument);
            const step = extentOf(plain) / (meshopt ? 16383 : 65535);
            const gltf = await load(file);
            const other = await load(`${mesh.name}.glb`);
            // Vertices of the plain file by their cells in the grid of the compressed file.
            const [skin] = document.getRoot().listSkins();
            const decode = skin.getInverseBindMatrices().getElement(0, []);
            const cellOf = place => place.map(
                (x, axis) => Math.floor((x - decode[12 + axis]) / decode[0] + 0.5)).join(',');
            const rest = plain.flatMap(primitive => primitive.POSITION);
            const at = new Map();
            rest.forEach((place, i) => {
                at.set(cellOf(place), [...(at.get(cellOf(place)) ?? []), i]);
            });
            const leastOff = (items, wanted, off) => Math.max(...items.map(item =>
                Math.min(Infinity, ...(at.get(`${item.rest}`) ?? []).map(i => off(item, wanted[i])))));
            for (const number of [0, Math.floor(mesh.frames / 2), mesh.frames - 1]) {
                const expected = posedVertices(three, other, number / mesh.fps);
                const found = posedVertices(three, gltf, number / mesh.fps);
                const off = leastOff(found, expected, (a, b) => distance(a.at, b.at));
                expect(file, `frame ${number}: off by ${off}, steps are ${step}`,
                       // Half a step along each of three axes: sqrt(3) / 2 = 0.87.
                       off <= 0.87 * step + 1e-5, true);
            }
            const small = primitivesOf(document);
            for (const [attribute, most] of [['TEXCOORD_1', meshopt ? 0.5 * step : 0],
                                             ['TEXCOORD_2', 0.501 / 65535]]) {
                const wanted = plain.flatMap(primitive => primitive[attribute] ?? []);
                const found = small.flatMap(primitive => (primitive[attribute] ?? []).map(
                    (value, i) => ({ rest: primitive.POSITION[i], value })));
                expect(file, `it has ${attribute}`, found.length > 0, wanted.length > 0);
                const off = found.length === 0 ? 0 : leastOff(found, wanted, (a, b) =>
                    Math.max(...a.value.map((x, k) => Math.abs(x - b[k]))));
                expect(file, `${attribute} off by ${off} of ${most}`, off <= most, true);
            }
            if (meshopt) {
                await expectValidDecoded(file, document);
            } else {
                await expectValid(file, readFileSync(join(folder, file)), file);
            }
        });
    },

    // read_assimp counts vertices and triangles of an OBJ; this check is about its materials.
    async obj() {
        const { OBJLoader } = await module('three/examples/jsm/loaders/OBJLoader.js');
        const { MTLLoader } = await module('three/examples/jsm/loaders/MTLLoader.js');
        let textured = 0;
        await eachMesh(['obj'], (file, mesh) => {
            const group = new OBJLoader().parse(readFileSync(join(folder, file), 'utf8'));
            const [library] = group.materialLibraries;
            expect(file, 'mtllib', library, `${mesh.name}.mtl`);
            const { materialsInfo } = new MTLLoader().parse(
                readFileSync(join(folder, library), 'utf8'), '');
            let triangles = 0;
            let parts = 0;
            let pictures = 0;
            for (const child of group.children) {
                triangles += child.geometry.attributes.position.count / 3;
                const materials = [child.material].flat();
                parts += materials.length;
                for (const { name } of materials) {
                    const info = materialsInfo[name];
                    expect(file, `Kd of ${name}`, info?.kd?.length, 3);
                    expect(file, `Pr of ${name}`, Number(info?.pr) > 0 && Number(info?.pr) <= 1, true);
                    expect(file, `normals of ${name}`, info?.norm, info?.map_bump);
                    for (const picture of [info?.map_kd, info?.map_d, info?.norm].filter(Boolean)) {
                        expectPicture(file, picture);
                        ++pictures;
                    }
                }
            }
            expect(file, 'number of triangles', triangles, mesh.triangles);
            expect(file, 'number of parts', parts, mesh.parts);
            textured += pictures > 0 ? 1 : 0;
        });
        expect('obj', 'some have pictures', textured > 0, true);
    },

    async svg() {
        const { SaxesParser } = require('saxes');
        for (const file of readdirSync(folder).filter(name => name.endsWith('.svg'))) {
            const parser = new SaxesParser({ xmlns: true });
            const widths = [0];
            let box;
            let points = 0;
            parser.on('error', error => { throw error; });
            parser.on('closetag', () => widths.pop());
            parser.on('opentag', tag => {
                const value = name => tag.attributes[name]?.value;
                if (box === undefined) {
                    expect(file, 'first tag', `${tag.uri} ${tag.local}`,
                           'http://www.w3.org/2000/svg svg');
                    box = value('viewBox').split(' ').map(Number);
                    expect(file, 'view box has area', box.length === 4 && box[2] * box[3] > 0, true);
                }
                widths.push(Number(value('stroke-width') ?? widths.at(-1)));
                for (const point of value('points')?.split(' ') ?? []) {
                    const [x, y] = point.split(',').map(Number);
                    const half = widths.at(-1) / 2;
                    const inside = x - half >= box[0] && x + half <= box[0] + box[2] &&
                        y - half >= box[1] && y + half <= box[1] + box[3];
                    expect(file, `${point} in the view box`, inside, true);
                    ++points;
                }
                for (const number of value('d')?.match(/-?[\d.]+(e-?\d+)?,/g) ?? []) {
                    const x = parseFloat(number);
                    expect(file, `${x} in the view box`, x >= box[0] && x <= box[0] + box[2], true);
                    ++points;
                }
            });
            parser.write(readFileSync(join(folder, file), 'utf8')).close();
            expect(file, 'something drawn', points > 0, true);
            ++files;
        }
    },

    async 'off+'() {
        await eachMesh(['off+'], (file, mesh) => {
            const found = readOffPlus(readFileSync(join(folder, file), 'utf8'));
            expect(file, 'number of vertices', found.vertices, mesh.vertices);
            expect(file, 'number of triangles', found.triangles, mesh.triangles);
        });
    },

    async usda() {
        let textured = 0;
        await eachMesh(['usda'], (file, mesh) => {
            const found = readUsda(readFileSync(join(folder, file), 'utf8'));
            expect(file, 'number of vertices', found.vertices, mesh.vertices);
            expect(file, 'number of triangles', found.triangles, mesh.triangles);
            expect(file, 'number of parts', found.parts, mesh.parts);
            for (const picture of found.pictures) {
                expect(file, `${picture} lies beside it`, picture.startsWith('./'), true);
                expectPicture(file, picture);
            }
            textured += found.pictures.length > 0 ? 1 : 0;
        });
        expect('usda', 'some have pictures', textured > 0, true);
    },

    async usdz() {
        await eachMesh(['usdz'], (file, mesh) => {
            const entries = readUsdz(readFileSync(join(folder, file)));
            const [layer, ...pictures] = entries.keys();
            const found = readUsda(entries.get(layer).toString('utf8'));
            expect(file, 'number of vertices', found.vertices, mesh.vertices);
            expect(file, 'number of triangles', found.triangles, mesh.triangles);
            expect(file, 'pictures', [...new Set(found.pictures)].sort().join(' '),
                   pictures.map(name => `./${name}`).sort().join(' '));
            pictures.forEach(name => expectPicture(file, name, entries.get(name)));
        });
    },

    async 'usd-three'() {
        const { three, load } = await usdLoader(module);
        await eachMesh(['usda', 'usdz'], (file, mesh) => {
            const group = load(arrayBuffer(file), file);
            const box = new three.Box3();
            let corners = 0;
            group.traverse(object => {
                if (object.isMesh) {
                    const { index, attributes } = object.geometry;
                    corners += index?.count ?? attributes.position.count;
                    box.expandByObject(object);
                }
            });
            expect(file, 'number of triangles', corners / 3, mesh.triangles);
            expect(file, 'finite bounds', Number.isFinite(box.min.length() + box.max.length()), true);
        });
    },

    // At the time of each frame, the meshes that are shown have the triangles of that frame.
    async growth() {
        const { three, GLTFLoader } = await threeAndLoader();
        await eachMesh(['glb', 'gltf'], async (file, mesh) => {
            const loader = new GLTFLoader();
            loader.register(() => ({ name: 'images', loadTexture: async () => new three.Texture() }));
            const gltf = await loader.parseAsync(arrayBuffer(file), '');
            expect(file, 'number of animations', gltf.animations.length, 1);
            expect(file, 'duration in frames',
                   Math.round(gltf.animations[0].duration * mesh.fps * 1e3) / 1e3, mesh.frames - 1);
            let shapes = 0;
            gltf.scene.traverse(object => { shapes += object.isMesh && object.visible ? 1 : 0; });
            expect(file, 'several shapes', shapes > 1, true);
            let triangles = 0;
            for (let number = 0; number < mesh.frames; ++number) {
                const ply = readFileSync(
                    join(folder, `${mesh.name}.${String(number + 1).padStart(4, '0')}.ply`));
                const positions = readPlyPositions(ply);
                const expected = readPlyTriangles(ply).map(vertex => positions[vertex]);
                const found = shownCorners(three, gltf, Math.fround(number / mesh.fps)); // times are floats
                expect(file, `corners in frame ${number}`, found.length, expected.length);
                const size = Math.max(...expected.flat().map(Math.abs));
                const off = expected.map((at, i) => distance(at, found[i] ?? [NaN, NaN, NaN]));
                expect(file, `frame ${number}: corners that are off`,
                       off.filter(d => !(d <= 1e-5 * size)).length, 0);
                triangles = Math.max(triangles, expected.length / 3);
            }
            expect(file, 'it grows', triangles > 100, true);
        });
    },

    // The check of `motion`, by corners of triangles instead of vertices, because three.js splits
    // the vertices of USD.
    async 'usd-motion'() {
        const { three, load } = await usdLoader(module);
        await eachMesh(['usda', 'usdz'], (file, mesh) => {
            const group = load(arrayBuffer(file), file);
            expect(file, 'number of animations', group.animations.length, 1);
            expect(file, 'duration in frames',
                   Math.round(group.animations[0].duration * mesh.fps * 1e3) / 1e3, mesh.frames - 1);
            const frame = number => readFileSync(
                join(folder, `${mesh.name}.${String(number + 1).padStart(4, '0')}.ply`));
            // All frames use the triangles of the first one, because bent boxes split their faces
            // along other diagonals.
            const corners = readPlyTriangles(frame(0));
            for (const number of [0, 1, Math.floor(mesh.frames / 2), mesh.frames - 1]) {
                const positions = readPlyPositions(frame(number));
                const expected = corners.map(vertex => positions[vertex]);
                const found = posedCorners(three, group, number / mesh.fps);
                expect(file, `corners in frame ${number}`, found.length, expected.length);
                const off = expected.map((at, i) => distance(at, found[i]));
                const most = mesh.name === 'cylinders' || number === 0 ? 1e-5 : mesh.metres || 1e-2;
                expect(file, `frame ${number}: off by more than ${most}`,
                       off.filter(d => !(d <= most)).length, 0);
                const [part, near] = mesh.metres ? [0.5, mesh.metres / 4] : [0.05, 1e-3];
                expect(file, `frame ${number}: ${part} of the corners are off by ${near} m`,
                       off.filter(d => !(d <= near)).length > part * off.length, false);
            }
        });
    },

    async tinyusdz() {
        const { open, layer } = await tinyUsdz(module, modules);
        if (existsSync(join(folder, 'forest.usda'))) {
            const bytes = readFileSync(join(folder, 'forest.usda'));
            const found = instancedBox(open('forest.usda', bytes), layer('forest.usda', bytes));
            const { low, high, branches } = facts();
            const size = Math.max(...high.map((x, i) => x - low[i]));
            const off = [...low.map((x, i) => x - found.low[i]), ...high.map((x, i) => x - found.high[i])];
            expect('forest.usda', 'number of instances', found.instances, branches);
            expect('forest.usda', 'box within 0.1 %', Math.max(...off.map(Math.abs)) < 1e-3 * size, true);
            const zipped = open('forest.usdz', readFileSync(join(folder, 'forest.usdz')));
            expect('forest.usdz', 'it has the meshes of all prototypes', zipped.numMeshes(),
                   open('forest.usda', bytes).numMeshes());
            files += 2;
            return;
        }
        await eachMesh(['usda', 'usdz'], (file, mesh) => {
            const loader = open(file, readFileSync(join(folder, file)));
            expect(file, 'number of meshes', loader.numMeshes(), 1);
            const found = loader.getMesh(0);
            const frame = join(folder, `${mesh.name}.0001.ply`);
            const corners = existsSync(frame)
                ? readPlyTriangles(readFileSync(frame)).length : 3 * mesh.triangles;
            expect(file, 'number of corners', found.faceVertexIndices.length, corners);
            expect(file, 'points', found.points.length >= 9, true);
            loader.delete();
        });
    },

    // The number of instances is the number of branches, and their bounds are the bounds of the
    // forest as one mesh.
    async 'forest-three'() {
        const { three, GLTFLoader } = await threeAndLoader();
        const { MeshoptDecoder } = await transformer();
        for (const file of ['forest.glb', 'forest.gltf', 'forest.quantize.glb', 'forest.meshopt.glb']) {
            const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
            loader.register(() => ({ name: 'images', loadTexture: async () => new three.Texture() }));
            const gltf = await loader.parseAsync(arrayBuffer(file), '');
            expectFacts(file, await instancedForest(three, gltf), roundingOf(file));
            expect(file, 'extras.trees', gltf.scene.children[0].userData.trees, facts().trees);
            ++files;
        }
    },

    async 'forest-transform'() {
        const { io, expectValid, expectValidDecoded } = await transformer();
        for (const file of ['forest.glb', 'expanded.glb', 'forest.quantize.glb', 'forest.meshopt.glb',
                            'expanded.quantize.glb', 'expanded.meshopt.glb']) {
            const found = await readAccessors(io, readFileSync(join(folder, file)));
            expectFacts(file, found, roundingOf(file));
            expect(file, 'accessors with wrong numbers', found.wrong, 0);
            // Compressed rotations have 16 bits per component.
            expect(file, 'bytes of an instance', found.bytes,
                   file.startsWith('expanded') ? 0 : file.includes('meshopt') ? 32 : 40);
            if (file.includes('meshopt')) {
                await expectValidDecoded(file, found.document);
            } else {
                await expectValid(file, readFileSync(join(folder, file)), file);
            }
            ++files;
        }
    },

    async 'forest-usda'() {
        const found = readUsdaForest(readFileSync(join(folder, 'forest.usda'), 'utf8'));
        // Orientations are half floats.
        const { low, high } = facts();
        expectFacts('forest.usda', found, 1e-3 * Math.max(...high.map((x, i) => x - low[i])));
        expect('forest.usda', 'trees', found.trees, facts().trees);
        expect('forest.usda', 'it has pictures', found.pictures.length > 0, true);
        found.pictures.forEach(picture => expectPicture('forest.usda', picture));
        ++files;
    },
};

await checks[check]();
console.log(`${files} files read, ${failures} failures`);
process.exit(failures === 0 && files > 0 ? 0 : 1);
