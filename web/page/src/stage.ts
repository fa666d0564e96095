// SPDX-License-Identifier: MIT
// Stage: shows a plant or a forest with three.js. Draws only when something has changed.
import {
  AmbientLight,
  Box3,
  BufferAttribute,
  BufferGeometry,
  CircleGeometry,
  Color,
  DataTexture,
  DirectionalLight,
  DoubleSide,
  FrontSide,
  Group,
  HemisphereLight,
  LinearFilter,
  LinearMipmapLinearFilter,
  type Material as ThreeMaterial,
  Mesh as ThreeMesh,
  MeshStandardMaterial,
  NoColorSpace,
  type Object3D,
  PCFSoftShadowMap,
  PerspectiveCamera,
  RepeatWrapping,
  RGBAFormat,
  Scene,
  ShadowMaterial,
  Sphere,
  SRGBColorSpace,
  type Texture,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Material, Mesh, Picture } from 'lsys';

export class Stage {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight(0xfff2dd, 3.4);
  private readonly ground: ThreeMesh<CircleGeometry, ShadowMaterial>;
  private readonly textures = new Map<string, DataTexture>(); // of pictures with an id
  private shown: Object3D | null = null; // the plant or forest
  private bounds = new Sphere(); // of `shown`
  private box = new Box3(); // of `shown`
  private isForest = false; // `shown` is a forest
  private framed = 0; // radius that the camera was last fitted to; 0: never
  private readonly framedCenter = new Vector3();
  private pending = false; // a frame is requested

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: true, // for pictures to download
    });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFSoftShadowMap;
    this.scene.add(new HemisphereLight(0xe6eff8, 0x9a9c84, 2.4), new AmbientLight(0xffffff, 0.5));
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.bias = -0.002;
    this.sun.shadow.normalBias = 0.02;
    this.scene.add(this.sun, this.sun.target);
    this.ground = new ThreeMesh(
      new CircleGeometry(1, 64).rotateX(-Math.PI / 2),
      new ShadowMaterial({ opacity: 0.28 }),
    );
    this.ground.receiveShadow = true;
    this.scene.add(this.ground);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    canvas.addEventListener('keydown', (event) => this.turnByKey(event));
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  /** Shows a plant. `fit`: moves the camera to it; else only if its size differs much. */
  showPlant(mesh: Mesh, fit: boolean): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(mesh.positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(mesh.normals, 3));
    if (mesh.textureCoordinates.length > 0)
      geometry.setAttribute('uv', new BufferAttribute(mesh.textureCoordinates, 2));
    geometry.setIndex(new BufferAttribute(mesh.indices, 1));
    mesh.parts.forEach((part) => geometry.addGroup(part.first, part.count, part.material));
    const pictures = mesh.pictures.map((picture) => this.texture(picture));
    const materials = mesh.materials.map((material) => this.material(material, pictures, mesh));
    const object = new ThreeMesh(geometry, materials);
    object.castShadow = true;
    object.receiveShadow = true;
    this.isForest = false;
    this.replace(object, fit);
  }

  /** Shows the forest of a GLB file. */
  async showForest(glb: Uint8Array): Promise<void> {
    const { GLTFLoader } = await import('three/examples/jsm/loaders/GLTFLoader.js');
    const file = await new GLTFLoader().parseAsync(glb.buffer as ArrayBuffer, '');
    this.isForest = true;
    this.replace(file.scene, true);
  }

  clear(): void {
    this.replace(new Group(), false);
  }

  /** Moves the camera so that everything is in view, above the bar of the growth. */
  fit(): void {
    const { center, radius } = this.bounds;
    if (!(radius > 0)) return;
    this.framed = radius;
    this.framedCenter.copy(center);
    const size = this.box.getSize(new Vector3());
    if (this.isForest) {
      // From a little above the front edge, near which trees have the finest levels.
      this.controls.target.set(center.x, this.box.min.y + size.y * 0.4, center.z + size.z * 0.1);
      this.camera.position.set(
        center.x + size.x * 0.1,
        this.box.min.y + Math.max(size.x * 0.13, size.y * 1.25),
        this.box.max.z + size.z * 0.12,
      );
      this.controls.update();
      this.draw();
      return;
    }
    const kTop = 55; // pixels that the buttons cover
    const kBottom = 85; // pixels that the slider of generations covers
    const kMargin = 1.02;
    const { clientHeight } = this.canvas;
    const free = Math.max(1 - (kTop + kBottom) / clientHeight, 0.5); // part of the height
    const slope = Math.tan((this.camera.fov * Math.PI) / 360);
    const width = Math.hypot(size.x, size.z);
    const direction = new Vector3(0.35, 0.14, 1).normalize();
    const distance =
      width * 0.12 +
      Math.max(
        (size.y * kMargin) / free / (2 * slope),
        (width * kMargin) / (2 * slope * this.camera.aspect),
      );
    const down = (distance * slope * (kBottom - kTop)) / clientHeight;
    this.controls.target.copy(center);
    this.controls.target.y -= down;
    this.camera.position.copy(this.controls.target).add(direction.multiplyScalar(distance));
    this.controls.update();
    this.draw();
  }

  /** The view as a PNG. */
  picture(): Promise<Blob> {
    this.render();
    return new Promise((resolve, reject) =>
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('no picture')))),
    );
  }

  /** Replaces what is shown, and adapts ground and lights. `fit`: as in showPlant(). */
  private replace(object: Object3D, fit: boolean): void {
    const old = this.shown;
    this.shown = object;
    if (old) this.scene.remove(old);
    this.scene.add(object);
    if (old) this.dispose(old);
    const box = this.box.setFromObject(object);
    this.bounds = box.isEmpty() ? new Sphere() : box.getBoundingSphere(new Sphere());
    const { center, radius } = this.bounds;
    this.ground.position.set(center.x, box.isEmpty() ? 0 : box.min.y, center.z);
    this.ground.scale.setScalar(radius * 4 || 1);
    this.sun.position.copy(center).add(new Vector3(-0.5, 1.1, 0.6).multiplyScalar(radius * 2 || 1));
    this.sun.target.position.copy(center);
    const shadow = this.sun.shadow.camera;
    shadow.left = shadow.bottom = -radius * 1.15;
    shadow.right = shadow.top = radius * 1.15;
    shadow.near = 0.01 * radius;
    shadow.far = radius * 6 || 1;
    shadow.updateProjectionMatrix();
    this.camera.near = Math.max(radius / 500, 1e-5);
    this.camera.far = radius * 60 || 1000;
    this.camera.updateProjectionMatrix();
    const changed =
      radius > this.framed * 1.7 ||
      radius < this.framed * 0.45 ||
      center.distanceTo(this.framedCenter) > this.framed * 0.6;
    if (radius > 0 && (fit || this.framed === 0 || changed)) this.fit();
    this.draw();
  }

  private dispose(object: Object3D): void {
    object.traverse((each) => {
      if (!(each instanceof ThreeMesh)) return;
      each.geometry.dispose();
      for (const material of [each.material].flat() as ThreeMaterial[]) {
        const { map, normalMap } = material as MeshStandardMaterial;
        for (const texture of [map, normalMap])
          if (texture && !texture.userData.kept) texture.dispose();
        material.dispose();
      }
    });
  }

  private texture(picture: Picture): DataTexture {
    const known = picture.id ? this.textures.get(picture.id) : undefined;
    if (known) return known;
    const texture = new DataTexture(picture.texels, picture.width, picture.height, RGBAFormat);
    texture.wrapS = texture.wrapT = RepeatWrapping;
    texture.generateMipmaps = true;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.magFilter = LinearFilter;
    texture.anisotropy = 4;
    texture.colorSpace = NoColorSpace;
    texture.needsUpdate = true;
    if (picture.id) {
      texture.userData.kept = true; // for later plants; dispose() leaves it
      this.textures.set(picture.id, texture);
    }
    return texture;
  }

  private material(material: Material, pictures: Texture[], mesh: Mesh): ThreeMaterial {
    const [red, green, blue] = material.colour;
    const map = material.picture === null ? null : pictures[material.picture]!;
    const normalMap = material.normals === null ? null : pictures[material.normals]!;
    if (map) map.colorSpace = SRGBColorSpace;
    const result = new MeshStandardMaterial({
      color: new Color(red, green, blue),
      roughness: material.roughness,
      metalness: 0,
      map,
      normalMap,
      normalScale: new Vector2(1, -1), // rows go down, as in glTF
      side: material.twoSided ? DoubleSide : FrontSide,
      alphaTest: material.cutOut ? 0.5 : 0,
    });
    result.name = material.name || String(mesh.materials.indexOf(material));
    return result;
  }

  private turnByKey(event: KeyboardEvent): void {
    const step = Math.PI / 24;
    const offset = this.camera.position.clone().sub(this.controls.target);
    const up = new Vector3(0, 1, 0);
    const right = new Vector3().crossVectors(up, offset).normalize();
    const steep = offset.angleTo(up);
    switch (event.key) {
      case 'ArrowLeft':
        offset.applyAxisAngle(up, -step);
        break;
      case 'ArrowRight':
        offset.applyAxisAngle(up, step);
        break;
      case 'ArrowUp':
        if (steep > 2 * step) offset.applyAxisAngle(right, -step);
        break;
      case 'ArrowDown':
        if (steep < Math.PI - 2 * step) offset.applyAxisAngle(right, step);
        break;
      case '+':
      case '=':
        offset.multiplyScalar(0.85);
        break;
      case '-':
        offset.multiplyScalar(1 / 0.85);
        break;
      case 'Home':
        this.fit();
        event.preventDefault();
        return;
      default:
        return;
    }
    event.preventDefault();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    const before = this.camera.aspect;
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    if (this.framed > 0 && Math.abs(before - this.camera.aspect) > 0.2) this.fit();
    this.draw();
  }

  private draw(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.render();
    });
  }

  private render(): void {
    this.renderer.render(this.scene, this.camera);
  }
}
