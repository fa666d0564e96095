// SPDX-License-Identifier: MIT
#include "runtime/serve/impl/page.h"

namespace lsys {

std::string tile_page() {
    return R"html(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Forest</title>
<style>
  body { margin: 0; font: 14px/1.4 system-ui, sans-serif; background: #9fc0e0; overflow: hidden; }
  #text { position: fixed; left: 0; top: 0; padding: 8px 12px; color: #fff; background: #0008;
          border-bottom-right-radius: 6px; max-width: 34em; }
  a { color: inherit; }
</style>
<div id="text">Loading three.js and 3DTilesRendererJS from cdn.jsdelivr.net …
  Without that network, open <a href="tileset.json">tileset.json</a> in a viewer of 3D Tiles, such as Cesium.</div>
<script type="importmap">
{ "imports": {
  "three": "https://cdn.jsdelivr.net/npm/three@0.187.0/build/three.module.js",
  "three/examples/jsm/": "https://cdn.jsdelivr.net/npm/three@0.187.0/examples/jsm/",
  "3d-tiles-renderer": "https://cdn.jsdelivr.net/npm/3d-tiles-renderer@0.5.3/build/index.js",
  "3d-tiles-renderer/core": "https://cdn.jsdelivr.net/npm/3d-tiles-renderer@0.5.3/build/index.core.js",
  "3d-tiles-renderer/plugins": "https://cdn.jsdelivr.net/npm/3d-tiles-renderer@0.5.3/build/index.plugins.js",
  "3d-tiles-renderer/three": "https://cdn.jsdelivr.net/npm/3d-tiles-renderer@0.5.3/build/index.three.js"
} }
</script>
<script type="module">
import * as THREE from 'three';
import { MapControls } from 'three/examples/jsm/controls/MapControls.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';
import { TilesRenderer } from '3d-tiles-renderer';
import { GLTFExtensionsPlugin, ImplicitTilingPlugin } from '3d-tiles-renderer/plugins';

const renderer = new THREE.WebGLRenderer({ antialias: true, logarithmicDepthBuffer: true });
renderer.setPixelRatio(devicePixelRatio);
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x9fc0e0);
scene.add(new THREE.HemisphereLight(0xcfe4ff, 0x554433, 2.2));
const sun = new THREE.DirectionalLight(0xffffff, 2.5);
sun.position.set(1, 1.4, 2);
scene.add(sun);
const camera = new THREE.PerspectiveCamera(50, 1, 0.3, 2e6);
camera.up.set(0, 0, 1);
const controls = new MapControls(camera, renderer.domElement);
controls.maxPolarAngle = 0.49 * Math.PI;

const tiles = new TilesRenderer('tileset.json');
tiles.registerPlugin(new GLTFExtensionsPlugin({ meshoptDecoder: MeshoptDecoder }));
tiles.registerPlugin(new ImplicitTilingPlugin());
tiles.lruCache.minBytesSize = 1.5e9;
tiles.lruCache.maxBytesSize = 2e9;
tiles.setCamera(camera);
scene.add(tiles.group);
let isPlaced = false;
tiles.addEventListener('load-tileset', () => {
  const box = new THREE.Box3();
  const matrix = new THREE.Matrix4();
  if (isPlaced || !tiles.getOrientedBoundingBox(box, matrix)) {
    return;
  }
  isPlaced = true;
  // The middle of the forest at the origin, with +Z up there. The box of an implicit tileset has +Z down.
  const middle = new THREE.Vector3().setFromMatrixPosition(matrix);
  const up = middle.length() > 6e6 ? middle : new THREE.Vector3(0, 0, 1);
  if (new THREE.Vector3().setFromMatrixColumn(matrix, 2).dot(up) < 0) {
    matrix.multiply(new THREE.Matrix4().makeRotationX(Math.PI));
  }
  tiles.group.matrix.copy(matrix).invert().decompose(tiles.group.position, tiles.group.quaternion, tiles.group.scale);
  tiles.group.updateMatrixWorld(true);
  const size = box.getSize(new THREE.Vector3());
  const away = Math.min(0.35 * Math.max(size.x, size.y), 2000);
  camera.position.set(0, -away, 0.4 * away);
  controls.target.set(0, 0, box.min.z);
  controls.update();
});

const resize = () => {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  tiles.setResolutionFromRenderer(camera, renderer);
};
addEventListener('resize', resize);
resize();
const text = document.getElementById('text');
renderer.setAnimationLoop(() => {
  controls.update();
  camera.updateMatrixWorld();
  tiles.update();
  renderer.render(scene, camera);
  const { visible, downloading, parsing } = tiles.stats;
  text.textContent = `${visible} tiles, ${downloading + parsing} loading, ` +
    `${(renderer.info.render.triangles / 1e6).toFixed(1)} million triangles. ` +
    'Drag: move, right button: turn, wheel: nearer.';
});
</script>
</html>
)html";
}

} // namespace lsys
