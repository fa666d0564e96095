// SPDX-License-Identifier: MIT
// Draws one tree before the sky and the ground that both trees of a pair have.
// window.draw({ preset }) shows a preset of ez-tree in the light of its own program. window.draw({ model }) shows the
// shadow of a GLB file alone: the plant itself is drawn by lsview. Both return the camera.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { Tree } from '@dgreenheck/ez-tree';

const fov = 30;
const filled = 0.9; // fraction of the picture that the tree fills, in height or width
const width = 1280;
const height = 720;

const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setPixelRatio(devicePixelRatio);
renderer.setSize(width, height);
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = THREE.PCFShadowMap;
renderer.toneMapping = THREE.NeutralToneMapping; // tone mapping, exposure and lights: src/app of ez-tree
renderer.toneMappingExposure = 2;
document.body.append(renderer.domElement);

function gradient(colours, isRadial) {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 512;
    const context = canvas.getContext('2d');
    const fill = isRadial ? context.createRadialGradient(256, 256, 0, 256, 256, 256)
        : context.createLinearGradient(0, 0, 0, 512);
    colours.forEach(([place, colour]) => fill.addColorStop(place, colour));
    context.fillStyle = fill;
    context.fillRect(0, 0, 512, 512);
    const texture = new THREE.CanvasTexture(canvas);
    texture.colorSpace = isRadial ? THREE.NoColorSpace : THREE.SRGBColorSpace;
    return texture;
}

function addSurroundings(scene, box, sunDirection) {
    const size = box.getSize(new THREE.Vector3());
    const radius = 0.5 * size.length();
    const centre = box.getCenter(new THREE.Vector3());
    scene.background = gradient([[0, '#a9c6e6'], [0.75, '#dfe8ee'], [1, '#dfe8ee']], false);
    const ground = new THREE.Mesh(
        new THREE.CircleGeometry(12 * size.y, 96),
        new THREE.MeshLambertMaterial({
            color: 0x626a56, transparent: true,
            alphaMap: gradient([[0, '#fff'], [0.15, '#fff'], [0.5, '#777'], [1, '#000']], true),
        }),
    );
    ground.rotation.x = -Math.PI / 2;
    ground.receiveShadow = true;
    scene.add(ground);
    const sun = new THREE.DirectionalLight(new THREE.Color(0xffe5b0).convertLinearToSRGB(), 5);
    sun.position.copy(centre).addScaledVector(sunDirection, 3 * radius);
    sun.target.position.copy(centre);
    sun.castShadow = true;
    Object.assign(sun.shadow.camera,
        { left: -radius, right: radius, top: radius, bottom: -radius, near: radius, far: 12 * radius });
    sun.shadow.mapSize.set(4096, 4096);
    sun.shadow.radius = 5;
    sun.shadow.bias = -0.001;
    sun.shadow.normalBias = 0.002 * radius;
    scene.add(sun, sun.target, new THREE.AmbientLight(0xffffff, 0.4));
}

function placeCamera(box) {
    const size = box.getSize(new THREE.Vector3());
    const centre = box.getCenter(new THREE.Vector3());
    const across = Math.max(size.y, size.x * height / width);
    const distance = 0.5 * across / (filled * Math.tan(0.5 * fov * Math.PI / 180)) + 0.5 * size.z;
    const camera = new THREE.PerspectiveCamera(fov, width / height, 0.01 * distance, 20 * distance);
    camera.position.set(centre.x, 0.3 * size.y, distance + centre.z);
    camera.lookAt(centre.x, 0.46 * size.y, centre.z);
    const target = [centre.x, 0.46 * size.y, centre.z];
    return [camera, `eye ${camera.position.toArray().join()} target ${target.join()} fov ${fov}`];
}

window.draw = async ({ preset, model, sun }) => {
    const scene = new THREE.Scene();
    let tree;
    if (preset) {
        tree = new Tree();
        tree.loadPreset(preset);
        await new Promise(ready => setTimeout(ready, 1500)); // for the pictures in the library, which have no callback
    } else {
        tree = (await new GLTFLoader().loadAsync(model)).scene;
    }
    tree.traverse(part => {
        if (part.isMesh) {
            part.castShadow = part.receiveShadow = true;
            if (model) {
                part.material.side = part.material.shadowSide = THREE.DoubleSide;
                part.material.colorWrite = part.material.depthWrite = false;
            }
        }
    });
    const box = new THREE.Box3().setFromObject(tree, true);
    const [azimuth, elevation] = sun.map(degrees => degrees * Math.PI / 180); // as --sun of lsview
    addSurroundings(scene, box, new THREE.Vector3(Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation),
        -Math.cos(azimuth) * Math.cos(elevation)));
    scene.add(tree);
    const [camera, words] = placeCamera(box);
    renderer.render(scene, camera);
    return { camera: words, triangles: renderer.info.render.triangles };
};
window.isReady = true;
