// SPDX-License-Identifier: MIT
// Draws a plant in daylight on level ground, or a plane drawing in front of a light wall.
import * as THREE from 'three';
import { GLTFLoader } from '/node_modules/three/examples/jsm/loaders/GLTFLoader.js';

const canvas = document.getElementById('canvas');
const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
renderer.setSize(canvas.width, canvas.height, false);
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = THREE.PCFSoftShadowMap;
renderer.toneMapping = THREE.ACESFilmicToneMapping;

const radians = (degrees) => (degrees * Math.PI) / 180;
const kMargin = 1.06;

/** The nearest camera that sees all of the box, on the ray from the centre of the box along `direction`. */
function frame(box, direction) {
  const camera = new THREE.PerspectiveCamera(26, canvas.width / canvas.height, 1, 1000);
  const centre = box.getCenter(new THREE.Vector3());
  const tangent = Math.tan(radians(camera.fov / 2));
  camera.position.copy(centre).add(direction);
  camera.lookAt(centre);
  camera.updateMatrixWorld();
  let distance = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const point = new THREE.Vector3(
      corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z);
    const seen = point.sub(centre).applyQuaternion(camera.quaternion.clone().invert());
    distance = Math.max(distance, seen.z + (Math.max(Math.abs(seen.x), Math.abs(seen.y)) * kMargin) / tangent);
  }
  camera.position.copy(centre).addScaledVector(direction, distance);
  camera.near = distance * 0.01;
  camera.far = distance * 20;
  camera.updateProjectionMatrix();
  return camera;
}

window.draw = async (url, azimuth, elevation, seconds) => {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xe9eef2);
  const { scene: plant, animations } = await new GLTFLoader().loadAsync(url);
  scene.add(plant);
  if (animations.length > 0) {
    const mixer = new THREE.AnimationMixer(plant);
    mixer.clipAction(animations[0]).setLoop(THREE.LoopOnce).play().clampWhenFinished = true;
    mixer.setTime(seconds ?? 0);
    plant.updateMatrixWorld(true);
  }
  plant.traverse((node) => {
    node.castShadow = node.receiveShadow = Boolean(node.isMesh);
  });
  const box = new THREE.Box3().setFromObject(plant);
  const { center: centre, radius } = box.getBoundingSphere(new THREE.Sphere());
  const extent = box.getSize(new THREE.Vector3());
  const isDrawing = extent.z < 0.05 * Math.max(extent.x, extent.y);
  const azimuthRadians = radians(azimuth ?? (isDrawing ? 0 : 35));
  const elevationRadians = radians(elevation ?? (isDrawing ? 0 : 10));
  const camera = frame(box, new THREE.Vector3(
    Math.sin(azimuthRadians) * Math.cos(elevationRadians), Math.sin(elevationRadians),
    Math.cos(azimuthRadians) * Math.cos(elevationRadians)));

  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8478, 1.7));
  const sun = new THREE.DirectionalLight(0xfff4e0, 2.8);
  sun.position.copy(centre).add(new THREE.Vector3(0.6, 1.1, 0.9).multiplyScalar(radius * 2));
  sun.target.position.copy(centre);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.normalBias = radius * 0.002;
  const light = sun.shadow.camera;
  light.left = light.bottom = -radius;
  light.right = light.top = radius;
  light.near = 0.01 * radius;
  light.far = 8 * radius;
  scene.add(sun, sun.target);
  if (!isDrawing) {
    const ground = new THREE.Mesh(
      new THREE.CircleGeometry(radius * 12, 64), new THREE.MeshStandardMaterial({ color: 0xcfd3c8, roughness: 1 }));
    ground.rotation.x = -Math.PI / 2;
    ground.position.set(centre.x, box.min.y - 1e-3 * radius, centre.z);
    ground.receiveShadow = true;
    scene.add(ground);
  }
  renderer.render(scene, camera);
  return renderer.info.render.triangles;
};
