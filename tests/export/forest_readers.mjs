// SPDX-License-Identifier: MIT
// Reads a forest with each reader in JavaScript and prints seconds and memory of reading, number of
// instances, and the bounding box of the trees by the positions and matrices of the reader. Pictures
// are not decoded, because Node has no browser to do it.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Box, composed } from './forest.mjs';
import { instancedBox, tinyUsdz } from './usd.mjs';

function product(a, b) {
    return Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce(
        (sum, k) => sum + a[4 * k + i % 4] * b[4 * (i >> 2) + k], 0));
}

// started() and measured() enclose the reading of a file, so the memory and time for the bounding
// box are not included.
function started() {
    return { at: performance.now(), processor: process.cpuUsage() };
}

function measured(start) {
    const { user, system } = process.cpuUsage(start.processor);
    return { seconds: (performance.now() - start.at) / 1e3, processor: (user + system) / 1e6,
             megabytes: process.resourceUsage().maxRSS / 1024 };
}

// Defines the browser objects that readers need and Node lacks.
function pretendBrowser() {
    const element = () => ({
        style: {}, width: 64, height: 64, getContext: () => null, addEventListener() {}, removeEventListener() {},
        getBoundingClientRect: () => ({ left: 0, top: 0, width: 64, height: 64 }), setAttribute() {}, appendChild() {},
    });
    Object.defineProperty(globalThis, 'navigator', { value: { userAgent: '', platform: '', maxTouchPoints: 0 } });
    globalThis.document = { createElement: element, body: element(), documentElement: element(),
                            addEventListener() {}, removeEventListener() {}, visibilityState: 'visible' };
    globalThis.window = globalThis;
    globalThis.addEventListener ??= () => {};
    globalThis.removeEventListener ??= () => {};
    globalThis.createImageBitmap = async () => ({ width: 4, height: 4, close() {} });
    for (const name of ['Image', 'HTMLImageElement', 'ImageBitmap', 'HTMLCanvasElement', 'HTMLVideoElement']) {
        globalThis[name] = class {};
    }
    globalThis.location = { href: 'http://localhost/' };
}

const isGround = name => /^ground/.test(name ?? '');

/// Readers by their package in npm: functions of the path of node_modules and a file, which give
/// { seconds, megabytes, instances, low, high }; low and high are corners of the bounding box.
export const forestReaders = {
    async three(modules, file) {
        globalThis.self = globalThis;
        globalThis.ProgressEvent ??= class extends Event {};
        const three = await moduleAt(modules, 'three/build/three.module.js');
        const { GLTFLoader } = await moduleAt(modules, 'three/examples/jsm/loaders/GLTFLoader.js');
        const bytes = bytesOf(file);
        const start = started();
        const loader = new GLTFLoader().setMeshoptDecoder(await meshoptDecoder(modules));
        loader.register(() => ({ name: 'images', loadTexture: async () => new three.Texture() }));
        const { scene } = await loader.parseAsync(bytes, '');
        const found = { ...measured(start), instances: 0 };
        const box = new Box();
        const trees = new Set(); // parent nodes: a tree has a mesh for each material
        scene.updateMatrixWorld(true);
        scene.traverse(object => {
            if (!object.isMesh || isGround(object.name)) {
                return;
            }
            const { position } = object.geometry.attributes;
            const points = new Float64Array(3 * position.count);
            for (let i = 0; i < position.count; ++i) {
                points.set([position.getX(i), position.getY(i), position.getZ(i)], 3 * i);
            }
            const matrices = object.isInstancedMesh
                ? Array.from({ length: object.count }, (_, i) =>
                    product(object.matrixWorld.elements, object.instanceMatrix.array.slice(16 * i, 16 * i + 16)))
                : [object.matrixWorld.elements];
            matrices.forEach(matrix => box.add(points, matrix));
            matrices.forEach(matrix => trees.add(matrix.join()));
        });
        return { ...found, instances: trees.size, ...box };
    },

    async babylon(modules, file) {
        globalThis.self = globalThis;
        globalThis.XMLHttpRequest ??= class {};
        const babylon = await moduleAt(modules, '@babylonjs/core/index.js');
        await moduleAt(modules, '@babylonjs/loaders/glTF/index.js');
        const decoder = await meshoptDecoder(modules);
        babylon.MeshoptCompression._Default = { // its built-in decoder is loaded from the network
            decodeGltfBufferAsync: async (source, count, stride, mode, filter) => {
                const target = new Uint8Array(count * stride);
                decoder.decodeGltfBuffer(target, count, stride, source, mode, filter);
                return target;
            },
        };
        const scene = new babylon.Scene(new babylon.NullEngine());
        scene.useRightHandedSystem = true;
        babylon.SceneLoader.OnPluginActivatedObservable.addOnce(plugin => { plugin.skipMaterials = true; });
        const base64 = `base64,${readFileSync(file).toString('base64')}`;
        const start = started();
        await babylon.SceneLoader.AppendAsync('data:', base64, scene, undefined, '.glb');
        const found = measured(start);
        const box = new Box();
        const trees = new Set();
        for (const mesh of scene.meshes.filter(m => m.getTotalVertices() > 0 && !isGround(m.name))) {
            const world = mesh.computeWorldMatrix(true);
            const points = mesh.getVerticesData('position');
            const matrices = mesh.thinInstanceCount > 0
                ? mesh.thinInstanceGetWorldMatrices().map(matrix => matrix.multiply(world)) : [world];
            matrices.forEach(matrix => box.add(points, matrix.m));
            matrices.forEach(matrix => trees.add([...matrix.m].join()));
        }
        return { ...found, instances: trees.size, ...box };
    },

    async playcanvas(modules, file) {
        pretendBrowser();
        const pc = await moduleAt(modules, 'playcanvas/build/playcanvas.mjs');
        const decoder = await meshoptDecoder(modules);
        const canvas = document.createElement('canvas');
        const app = new pc.AppBase(canvas);
        const options = new pc.AppOptions();
        options.graphicsDevice = new pc.NullGraphicsDevice(canvas, {});
        options.componentSystems = [pc.RenderComponentSystem];
        options.resourceHandlers = [pc.TextureHandler, pc.ContainerHandler, pc.MaterialHandler, pc.RenderHandler];
        app.init(options);
        const picture = new pc.Asset('none', 'texture', null);
        picture.resource = new pc.Texture(app.graphicsDevice, { width: 4, height: 4 });
        picture.loaded = true;
        const contents = bytesOf(file);
        const start = started();
        const decode = (view, buffers, next) => {
            const packed = view.extensions?.EXT_meshopt_compression;
            if (packed === undefined) {
                return next(null, null);
            }
            buffers[packed.buffer].then(buffer => {
                const source = new Uint8Array(buffer.buffer, buffer.byteOffset + (packed.byteOffset ?? 0),
                                              packed.byteLength);
                const target = new Uint8Array(packed.count * packed.byteStride);
                decoder.decodeGltfBuffer(target, packed.count, packed.byteStride, source, packed.mode, packed.filter);
                next(null, target);
            }).catch(next);
        };
        const asset = new pc.Asset('forest', 'container', { url: 'forest.glb', filename: 'forest.glb', contents }, null,
                                   { bufferView: { processAsync: decode },
                                     image: { processAsync: (image, next) => next(null, picture) } });
        await new Promise((resolve, reject) => {
            asset.ready(resolve);
            asset.on('error', reject);
            app.assets.add(asset);
            app.assets.load(asset);
        });
        const root = asset.resource.instantiateRenderEntity();
        const found = measured(start);
        const box = new Box();
        const trees = new Set();
        for (const { meshInstances } of root.findComponents('render')) {
            for (const instance of meshInstances.filter(of => !isGround(of.node.name))) {
                const points = [];
                instance.mesh.getPositions(points);
                const world = instance.node.getWorldTransform().data;
                const buffer = instance.instancingData?.vertexBuffer;
                const numbers = buffer && new Float32Array(buffer.lock());
                const matrices = buffer
                    ? Array.from({ length: buffer.numVertices }, (_, i) =>
                        product(world, numbers.subarray(16 * i, 16 * i + 16)))
                    : [world];
                matrices.forEach(matrix => box.add(points, matrix));
                matrices.forEach(matrix => trees.add([...matrix].join()));
            }
        }
        return { ...found, instances: trees.size, ...box };
    },

    // loaders.gl returns arrays of numbers as they are stored; normalised numbers and node
    // transforms are left to the caller.
    async 'loaders.gl'(modules, file) {
        const require = createRequire(join(modules, 'none.js'));
        const { parse } = require('@loaders.gl/core');
        const { GLTFLoader, postProcessGLTF } = require('@loaders.gl/gltf');
        const bytes = bytesOf(file);
        const start = started();
        const read = await parse(bytes, GLTFLoader, { gltf: { loadImages: false }, worker: false });
        const document = postProcessGLTF(read);
        const found = measured(start);
        return { ...found, ...boxOfDocument(document, accessor => accessor) };
    },

    async 'gltf-transform'(modules, file) {
        const { NodeIO } = await moduleAt(modules, '@gltf-transform/core/dist/index.js');
        const { ALL_EXTENSIONS } = await moduleAt(modules, '@gltf-transform/extensions/dist/index.js');
        const bytes = new Uint8Array(bytesOf(file));
        const start = started();
        const io = new NodeIO().registerExtensions(ALL_EXTENSIONS)
            .registerDependencies({ 'meshopt.decoder': await meshoptDecoder(modules) });
        const document = await io.readBinary(bytes);
        const found = { ...measured(start), instances: 0 };
        const box = new Box();
        for (const node of document.getRoot().listNodes()) {
            const mesh = node.getMesh();
            if (mesh === null || isGround(node.getName())) {
                continue;
            }
            const world = node.getWorldMatrix();
            const batch = node.getExtension('EXT_mesh_gpu_instancing');
            const item = (name, i) => batch.getAttribute(name).getElement(i, []);
            const matrices = batch === null ? [world] : Array.from(
                { length: batch.getAttribute('TRANSLATION').getCount() },
                (_, i) => product(world, composed(item('TRANSLATION', i), item('ROTATION', i), item('SCALE', i))));
            found.instances += matrices.length;
            for (const primitive of mesh.listPrimitives()) {
                const points = primitive.getAttribute('POSITION').getArray();
                matrices.forEach(matrix => box.add(points, matrix));
            }
        }
        return { ...found, ...box };
    },

    // tinyusdz does not instantiate; the arrays of instances are read from its layer.
    async tinyusdz(modules, file) {
        const { open, layer } = await tinyUsdz(path => moduleAt(modules, path), modules);
        const bytes = readFileSync(file);
        const start = started();
        const loader = open('forest.usda', bytes);
        const found = measured(start);
        return { ...found, ...instancedBox(loader, layer('forest.usda', bytes), { ground: false }) };
    },
};

function moduleAt(modules, path) {
    return import(pathToFileURL(join(modules, path)));
}

function bytesOf(file) {
    const bytes = readFileSync(file);
    return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
}

async function meshoptDecoder(modules) {
    const { MeshoptDecoder } = await moduleAt(modules, 'three/examples/jsm/libs/meshopt_decoder.module.js');
    await MeshoptDecoder.ready;
    return MeshoptDecoder;
}

// Number of instances and bounding box of a glTF document in which references are objects.
// `arrayOf(accessor).value` is the array of an accessor.
function boxOfDocument(document, arrayOf) {
    const numbers = accessor => {
        const { value } = arrayOf(accessor);
        const most = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535 }[accessor.componentType];
        return accessor.normalized ? Float64Array.from(value, x => Math.max(x / most, -1)) : value;
    };
    const parents = new Map(document.nodes.flatMap(node => (node.children ?? []).map(child => [child, node])));
    const matrixOf = ({ translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }) =>
        composed(translation, rotation, scale);
    const box = new Box();
    let instances = 0;
    for (const node of document.nodes.filter(n => n.mesh !== undefined && !isGround(n.name))) {
        let world = matrixOf(node);
        for (let parent = parents.get(node); parent !== undefined; parent = parents.get(parent)) {
            world = product(matrixOf(parent), world);
        }
        const attributes = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
        let matrices = [world];
        if (attributes !== undefined) {
            const [at, turn, size] = ['TRANSLATION', 'ROTATION', 'SCALE'].map(
                name => numbers(document.accessors[attributes[name]]));
            matrices = Array.from({ length: at.length / 3 }, (_, i) => product(world, composed(
                at.slice(3 * i, 3 * i + 3), turn.slice(4 * i, 4 * i + 4), size.slice(3 * i, 3 * i + 3))));
        }
        instances += matrices.length;
        for (const primitive of node.mesh.primitives) {
            const points = numbers(primitive.attributes.POSITION);
            matrices.forEach(matrix => box.add(points, matrix));
        }
    }
    return { instances, ...box };
}

/// The box of a GLB without compression and with packed items, read byte by byte; the results of the readers are
/// compared with it.
export function boxOfPlainGlb(file) {
    const bytes = readFileSync(file);
    const documentBytes = bytes.readUInt32LE(12);
    const document = JSON.parse(bytes.subarray(20, 20 + documentBytes).toString());
    const data = bytes.subarray(20 + documentBytes + 8);
    const widths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
    const cache = new Map();
    const arrayOf = accessor => {
        if (!cache.has(accessor)) {
            const view = document.bufferViews[accessor.bufferView];
            const width = widths[accessor.type];
            const stride = view.byteStride ?? 4 * width;
            const first = (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
            const value = new Float64Array(accessor.count * width);
            for (let i = 0; i < value.length; ++i) {
                value[i] = data.readFloatLE(first + stride * Math.floor(i / width) + 4 * (i % width));
            }
            cache.set(accessor, { value });
        }
        return cache.get(accessor);
    };
    for (const mesh of document.meshes) {
        for (const { attributes } of mesh.primitives) {
            attributes.POSITION = document.accessors[attributes.POSITION];
        }
    }
    for (const node of document.nodes) {
        node.mesh = node.mesh === undefined ? undefined : document.meshes[node.mesh];
        node.children = node.children?.map(child => document.nodes[child]);
    }
    return boxOfDocument(document, arrayOf);
}
