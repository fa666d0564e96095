// SPDX-License-Identifier: MIT
// PlantView: shows the GLB of `lsys/plant` by three.js. Does not depend on VS Code.
//
// The attribute `_ITEMS` of the GLB has two numbers per vertex: indexes in `Plant.sources` of the
// two parts of the plant that meet there. A triangle belongs to the source that all its corners
// share.

import {
  BufferAttribute,
  BufferGeometry,
  Box3,
  Color,
  DirectionalLight,
  DoubleSide,
  Group,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  Object3D,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Texture,
  Vector2,
  Vector3,
  WebGLRenderer,
  type Material,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

const highlightColour = 0xff8800;

/** The source of a triangle; -1 if it has none. */
function sourceOfCorners(items: BufferAttribute, corners: [number, number, number]): number {
  const carries = (corner: number, source: number): boolean =>
    items.getX(corner) === source || items.getY(corner) === source;
  const [first, second, third] = corners;
  for (const source of [items.getX(first), items.getY(first)]) {
    if (carries(second, source) && carries(third, source)) {
      return source;
    }
  }
  return items.getX(first);
}

function cornersOf(geometry: BufferGeometry, triangle: number): [number, number, number] {
  const { index } = geometry;
  const corner = (k: number): number =>
    index === null ? 3 * triangle + k : index.getX(3 * triangle + k);
  return [corner(0), corner(1), corner(2)];
}

function meshesOf(object: Object3D): Mesh[] {
  const meshes: Mesh[] = [];
  object.traverse((each) => {
    if (each instanceof Mesh && !each.userData['highlights']) {
      meshes.push(each);
    }
  });
  return meshes;
}

function dispose(object: Object3D): void {
  object.traverse((each) => {
    if (!(each instanceof Mesh)) {
      return;
    }
    (each.geometry as BufferGeometry).dispose();
    const materials = Array.isArray(each.material) ? each.material : [each.material];
    for (const material of materials as Material[]) {
      for (const value of Object.values(material)) {
        if (value instanceof Texture) {
          value.dispose();
        }
      }
      material.dispose();
    }
  });
}

export class PlantView {
  /** Called with the number of a source when its part of the plant is clicked. */
  onPick: (source: number, event: MouseEvent) => void = () => {};

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly loader = new GLTFLoader();
  private readonly highlightMaterial = new MeshBasicMaterial({
    color: highlightColour,
    side: DoubleSide,
    transparent: true,
    opacity: 0.8,
    polygonOffset: true,
    polygonOffsetFactor: -2,
    polygonOffsetUnits: -2,
  });
  private plant: Group | undefined;
  private bounds = new Box3();
  /** Numbers of the highlighted sources. */
  private highlighted: number[] = [];
  /** Whether the user has moved the camera since fit(). */
  private cameraIsOfUser = false;
  /** The number of calls of show(). */
  private loads = 0;
  private isDrawRequested = false;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.scene.add(new HemisphereLight(0xffffff, 0x8a7f70, 2.2));
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(2, 4, 3);
    this.scene.add(sun);
    this.controls = new OrbitControls(this.camera, canvas);
    let isHeld = false;
    this.controls.addEventListener('start', () => {
      isHeld = true;
    });
    this.controls.addEventListener('end', () => {
      isHeld = false;
    });
    this.controls.addEventListener('change', () => {
      this.cameraIsOfUser ||= isHeld; // a click alone moves nothing
      this.requestDraw();
    });
    let pressed: [number, number] | undefined;
    canvas.addEventListener('pointerdown', (event) => {
      pressed = [event.clientX, event.clientY];
    });
    canvas.addEventListener('click', (event) => {
      const moved =
        pressed !== undefined &&
        Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4;
      if (!moved) {
        const source = this.sourceAt(event.clientX, event.clientY);
        if (source >= 0) {
          this.onPick(source, event);
        }
      }
    });
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  /** Replaces the plant. Returns false if a newer one was shown meanwhile. */
  async show(glb: ArrayBuffer): Promise<boolean> {
    const load = ++this.loads;
    const plant = glb.byteLength === 0 ? new Group() : (await this.loader.parseAsync(glb, '')).scene;
    if (load !== this.loads) {
      dispose(plant);
      return false;
    }
    if (this.plant !== undefined) {
      this.scene.remove(this.plant);
      dispose(this.plant);
    }
    this.plant = plant as Group;
    this.scene.add(plant);
    this.bounds = new Box3().setFromObject(plant);
    this.showHighlight();
    if (!this.cameraIsOfUser) {
      this.fit();
    }
    this.draw();
    return true;
  }

  /** Highlights the parts of these sources, and no others. */
  highlight(sources: number[]): void {
    this.highlighted = sources;
    this.showHighlight();
    this.requestDraw();
  }

  /** Places the camera so that the plant fills the picture. */
  fit(): void {
    this.cameraIsOfUser = false;
    if (this.bounds.isEmpty()) {
      return;
    }
    const centre = this.bounds.getCenter(new Vector3());
    const radius = Math.max(this.bounds.getSize(new Vector3()).length() / 2, 1e-6);
    const half = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    const direction = new Vector3(0.35, 0.15, 1).normalize();
    this.camera.position.copy(centre).addScaledVector(direction, (1.02 * radius) / Math.sin(narrow));
    this.camera.near = radius / 100;
    this.camera.far = radius * 100;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.controls.update();
    this.requestDraw();
  }

  /** The source of the part of the plant at a place of the window; -1: none. */
  sourceAt(clientX: number, clientY: number): number {
    if (this.plant === undefined) {
      return -1;
    }
    const box = this.canvas.getBoundingClientRect();
    const place = new Vector2(
      (2 * (clientX - box.left)) / box.width - 1,
      1 - (2 * (clientY - box.top)) / box.height,
    );
    const ray = new Raycaster();
    this.camera.updateMatrixWorld();
    ray.setFromCamera(place, this.camera);
    const hit = ray.intersectObjects(meshesOf(this.plant), false)[0];
    if (hit === undefined || hit.faceIndex === undefined || hit.faceIndex === null) {
      return -1;
    }
    const geometry = (hit.object as Mesh).geometry as BufferGeometry;
    const items = geometry.getAttribute('_items') as BufferAttribute | undefined;
    return items === undefined ? -1 : sourceOfCorners(items, cornersOf(geometry, hit.faceIndex));
  }

  /** The number of triangles that are highlighted. */
  highlightedTriangles(): number {
    let count = 0;
    this.plant?.traverse((each) => {
      if (each instanceof Mesh && each.userData['highlights']) {
        count += (each.geometry.index?.count ?? 0) / 3;
      }
    });
    return count;
  }

  /** Whether the user has moved the camera since fit(). */
  isMovedByUser(): boolean {
    return this.cameraIsOfUser;
  }

  /** Draws now. */
  draw(): void {
    this.isDrawRequested = false;
    this.renderer.render(this.scene, this.camera);
  }

  setBackground(colour: string | null): void {
    this.scene.background = colour === null ? null : new Color(colour);
    this.requestDraw();
  }

  private requestDraw(): void {
    if (!this.isDrawRequested) {
      this.isDrawRequested = true;
      requestAnimationFrame(() => this.draw());
    }
  }

  private resize(): void {
    const width = Math.max(this.canvas.clientWidth, 1);
    const height = Math.max(this.canvas.clientHeight, 1);
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.cameraIsOfUser) {
      this.fit();
    }
    this.draw();
  }

  private showHighlight(): void {
    if (this.plant === undefined) {
      return;
    }
    const old: Mesh[] = [];
    this.plant.traverse((each) => {
      if (each instanceof Mesh && each.userData['highlights']) {
        old.push(each);
      }
    });
    for (const each of old) {
      each.removeFromParent();
      // dispose() must not free the attributes, which the plant still uses.
      (each.geometry as BufferGeometry).attributes = {};
      (each.geometry as BufferGeometry).dispose();
    }
    if (this.highlighted.length === 0) {
      return;
    }
    const wanted = new Set(this.highlighted);
    for (const mesh of meshesOf(this.plant)) {
      const geometry = mesh.geometry as BufferGeometry;
      const items = geometry.getAttribute('_items') as BufferAttribute | undefined;
      const position = geometry.getAttribute('position');
      if (items === undefined) {
        continue;
      }
      const triangles = (geometry.index?.count ?? position.count) / 3;
      const indices: number[] = [];
      for (let triangle = 0; triangle < triangles; ++triangle) {
        const corners = cornersOf(geometry, triangle);
        if (wanted.has(sourceOfCorners(items, corners))) {
          indices.push(...corners);
        }
      }
      if (indices.length > 0) {
        const part = new BufferGeometry();
        part.setAttribute('position', position);
        part.setIndex(indices);
        const shown = new Mesh(part, this.highlightMaterial);
        shown.userData['highlights'] = true;
        mesh.add(shown);
      }
    }
  }
}
