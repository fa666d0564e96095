// Holds exported files against readers in JavaScript. Usage:
//   node read_files.mjs MODULES (validator | three | motion | obj | svg | off+ | usda |
//                              forest-three | forest-transform | forest-usda) FOLDER
// MODULES is the node_modules of package.json beside this file. FOLDER has counts.txt, with a line
// `NAME VERTICES TRIANGLES PARTS` for each mesh, or `NAME FRAMES FPS METRES` for each that moves.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { distance, posedVertices, readPlyPositions } from './motion.mjs';
import { instancedForest, readAccessors } from './forest.mjs';
import { readOffPlus, readUsda, readUsdaForest } from './own_readers.mjs';

const [given, check, folder] = process.argv.slice(2);
const modules = resolve(given ?? '.');
if (!folder) {
    console.error('usage: node read_files.mjs MODULES (validator|three|motion|obj|svg|off+|usda|forest-three|forest-transform|forest-usda) FOLDER');
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

// Pictures of ours have 256 texels a side; those of mesh files ("picture 1") keep their size, which is
// 64 in the only sample that has one, samples/teach-picture.
function expectSize(file, name, png) {
    const side = /picture.\d/.test(name) ? 64 : 256;
    expect(file, `size of ${name}`, `${png.width} x ${png.height}`, `${side} x ${side}`);
}

// A PNG in the folder.
function expectPicture(file, name) {
    const { PNG } = require('pngjs');
    expectSize(file, name, PNG.sync.read(readFileSync(join(folder, name))));
}

function counts() {
    return readFileSync(join(folder, 'counts.txt'), 'utf8').trim().split('\n').filter(Boolean)
        .map(line => {
            const [name, ...numbers] = line.split(' ');
            const [vertices, triangles, parts] = numbers.map(Number);
            const [frames, fps, metres] = numbers.map(Number); // of those that move
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

function expectFacts(file, found) {
    const wanted = facts();
    expect(file, 'number of branches', found.branches, wanted.branches);
    expect(file, 'number of triangles', found.triangles, wanted.triangles);
    for (const end of ['low', 'high']) {
        const off = Math.max(...found[end].map((x, i) => Math.abs(x - wanted[end][i])));
        expect(file, `${end} end of the bounds within a millimetre: ${found[end]}`, off < 1e-3, true);
    }
}

async function threeAndLoader() {
    globalThis.self = globalThis;
    globalThis.ProgressEvent ??= class extends Event {};
    const three = await module('three/build/three.module.js');
    const { GLTFLoader } = await module('three/examples/jsm/loaders/GLTFLoader.js');
    return { three, GLTFLoader };
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
                new Uint8Array(readFileSync(join(folder, file))), { uri: file, maxIssues: 1000 });
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
            // There is no browser to decode images.
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
            const positions = new Map();
            let triangles = 0;
            let parts = 0;
            let extras;
            gltf.scene.traverse(object => {
                extras = object.userData.grammar === undefined ? extras : object.userData;
                if (object.isMesh) {
                    const { array, count } = object.geometry.attributes.position;
                    positions.set(array, count);
                    triangles += object.geometry.index.count / 3;
                    ++parts;
                    const largest = object.geometry.index.array.reduce((a, b) => Math.max(a, b), 0);
                    expect(file, 'an index within the vertices', largest < count, true);
                }
            });
            const vertices = [...positions.values()].reduce((a, b) => a + b, 0);
            expect(file, 'number of vertices', vertices, mesh.vertices);
            expect(file, 'number of triangles', triangles, mesh.triangles);
            expect(file, 'number of parts', parts, mesh.parts);
            expect(file, 'number of textures read', textures,
                   gltf.parser.json.textures?.length ?? 0);
            expect(file, 'type of extras.grammar', typeof extras?.grammar, 'string');
            expect(file, 'type of extras.n', typeof extras?.n, 'number');
            expect(file, 'extras.seed', /^[0-9]+$/.test(`${extras?.seed}`), true);
        });
    },

    // At each key a skin has its vertices where the mesh of that frame has them: those of cylinders
    // exactly, so that every tip of a segment is right; those of joined tubes and boxes within what
    // their rings turn and smooth.
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
                const found = posedVertices(three, gltf, number / mesh.fps);
                expect(file, `number of vertices in frame ${number}`, found.length, expected.length);
                const off = expected.map((at, i) => distance(at, found[i].at));
                const most = mesh.name === 'cylinders' || number === 0 ? 1e-5 : mesh.metres || 1e-2;
                expect(file, `frame ${number}: off by more than ${most}`,
                       off.filter(d => !(d <= most)).length, 0);
                const [part, near] = mesh.metres ? [0.5, mesh.metres / 4] : [0.05, 1e-3];
                expect(file, `frame ${number}: ${part} of the vertices are off by ${near} m`,
                       off.filter(d => !(d <= near)).length > part * off.length, false);
                if (loops && number === mesh.frames - 1) {
                    const seam = Math.max(...expected.map((at, i) => distance(at, first[i])));
                    expect(file, 'the last frame is the first', seam < 1e-5, true);
                }
                moved = Math.max(moved, ...expected.map((at, i) => distance(at, first[i])));
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
    },

    // assimp counts what is in an OBJ; this is about its materials.
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
                    for (const picture of [info?.map_kd, info?.map_d].filter(Boolean)) {
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

    // Instances: as many as there are branches, where the forest as one mesh has its vertices.
    async 'forest-three'() {
        const { three, GLTFLoader } = await threeAndLoader();
        for (const file of ['forest.glb', 'forest.gltf']) {
            const loader = new GLTFLoader();
            loader.register(() => ({ name: 'images', loadTexture: async () => new three.Texture() }));
            const gltf = await loader.parseAsync(arrayBuffer(file), '');
            expectFacts(file, await instancedForest(three, gltf));
            expect(file, 'extras.trees', gltf.scene.children[0].userData.trees, facts().trees);
            ++files;
        }
    },

    async 'forest-transform'() {
        const core = await module('@gltf-transform/core/dist/index.js');
        const extensions = await module('@gltf-transform/extensions/dist/index.js');
        for (const file of ['forest.glb', 'expanded.glb']) {
            const found = await readAccessors(core, extensions, readFileSync(join(folder, file)));
            expectFacts(file, found);
            expect(file, 'accessors with wrong numbers', found.wrong, 0);
            expect(file, 'bytes of an instance', found.bytes, file === 'forest.glb' ? 40 : 0);
            ++files;
        }
    },

    async 'forest-usda'() {
        const found = readUsdaForest(readFileSync(join(folder, 'forest.usda'), 'utf8'));
        expectFacts('forest.usda', found);
        expect('forest.usda', 'trees', found.trees, facts().trees);
        expect('forest.usda', 'it has pictures', found.pictures.length > 0, true);
        found.pictures.forEach(picture => expectPicture('forest.usda', picture));
        ++files;
    },
};

await checks[check]();
console.log(`${files} files read, ${failures} failures`);
process.exit(failures === 0 && files > 0 ? 0 : 1);
