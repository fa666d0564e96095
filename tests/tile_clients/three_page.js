// SPDX-License-Identifier: MIT
// Shows a tileset in 3DTilesRendererJS. Sets window.isSettled when the view is complete.
import * as THREE from 'three';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';
import { TilesRenderer, WGS84_ELLIPSOID } from '3d-tiles-renderer';
import { GLTFExtensionsPlugin, ImplicitTilingPlugin } from '3d-tiles-renderer/plugins';
import { readView } from './scene_frame.js';

const view = readView();
const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setSize(innerWidth, innerHeight);
document.getElementById('view').append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color('#a9c3d6');
scene.add(new THREE.HemisphereLight(0xddeeff, 0x556644, 1.5));
const sun = new THREE.DirectionalLight(0xffffff, 2.0);
sun.position.set(0.4, 0.8, 0.5);
scene.add(sun);
const camera = new THREE.PerspectiveCamera(60, innerWidth / innerHeight, 0.5, 1e6);
camera.position.set(...view.eye);
camera.lookAt(...view.at);

if (view.tileset === '') {
    window.isSettled = true; // an empty page, to compare times with
} else {
    const tiles = new TilesRenderer(view.tileset);
    tiles.registerPlugin(new GLTFExtensionsPlugin({ meshoptDecoder: MeshoptDecoder }));
    tiles.registerPlugin(new ImplicitTilingPlugin());
    tiles.errorTarget = view.error;
    tiles.setCamera(camera);
    tiles.setResolutionFromRenderer(camera, renderer);
    window.failures = [];
    tiles.addEventListener('load-error', failure => window.failures.push(`${failure.url}: ${failure.error}`));
    // From the Earth's axes to those of the scene.
    const [longitude, latitude, height] = view.origin;
    const frame = new THREE.Matrix4();
    const radians = Math.PI / 180;
    WGS84_ELLIPSOID.getEastNorthUpFrame(latitude * radians, longitude * radians, height, frame);
    const sceneAxes = new THREE.Matrix4().makeRotationX(-Math.PI / 2); // east, north, up to x, y, z
    tiles.group.matrixAutoUpdate = false;
    tiles.group.matrix.copy(sceneAxes).multiply(frame.invert());
    tiles.group.updateMatrixWorld(true);
    scene.add(tiles.group);
    let stillFrames = 0;
    const draw = () => {
        camera.updateMatrixWorld();
        tiles.update();
        renderer.render(scene, camera);
        const { downloading, parsing, queued, visible } = tiles.stats;
        const isStill = tiles.root !== null && downloading === 0 && parsing === 0 && (queued ?? 0) === 0;
        stillFrames = isStill ? stillFrames + 1 : 0;
        window.isSettled = stillFrames > 10;
        window.tileCounts = { visible, triangles: renderer.info.render.triangles };
        requestAnimationFrame(draw);
    };
    requestAnimationFrame(draw);
}
