// Renderer, camera, light and floor. Draws only when something changed, and with less care where that is slow.
"use strict";

THREE.Object3D.DefaultUp.set(0, 0, 1);
const kFloorReach = 3.2, kFloorTile = 0.2;  // m

class Stage {
  constructor(canvas, camera) {
    this.canvas = canvas;
    this.software = Stage.drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: !this.software});
    this.renderer.gammaOutput = true;
    this.renderer.gammaFactor = 2.2;
    this.renderer.shadowMap.enabled = !this.software;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(camera.fov * 180 / Math.PI, 1, 0.02, 60);
    this.orbit = new Orbit(canvas, camera, () => this.invalidate());
    this.beforeDraw = [];
    this.needsDraw = true;
    this.ratio = Math.min(this.software ? 1 : 2, window.devicePixelRatio || 1);
    this.slowFrames = 0;
    this.addLight(camera);
    this.addFloor(camera);
    this.paint();
    Theme.listeners.push(() => this.paint());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  /** Without graphics hardware smooth edges and shadows cost more than they show. */
  static drawsInSoftware() {
    const probe = document.createElement("canvas").getContext("webgl");
    const info = probe && probe.getExtension("WEBGL_debug_renderer_info");
    const name = info ? probe.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
    if (probe) probe.getExtension("WEBGL_lose_context").loseContext();
    return /swiftshader|llvmpipe|software|basic render/i.test(name);
  }

  invalidate() { this.needsDraw = true; }

  addLight(view) {
    this.sky = new THREE.HemisphereLight(0xffffff, 0x8d8778, 0.62);
    this.scene.add(this.sky);
    const sun = new THREE.DirectionalLight(0xffffff, 0.62);
    const [x, y, z] = view.target;
    sun.position.set(x - 0.9, y - 1.1, z + 2.6);
    sun.target.position.set(x, y, z);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.radius = 2.5;
    sun.shadow.bias = -0.0006;
    const reach = Math.min(2.2, Math.max(0.9, view.distance * 0.45));
    Object.assign(sun.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.3, far: 6});
    this.scene.add(sun, sun.target);
  }

  addFloor(view) {
    this.floorCanvas = document.createElement("canvas");
    this.floorCanvas.width = this.floorCanvas.height = 2048;
    const map = new THREE.CanvasTexture(this.floorCanvas);
    map.encoding = THREE.sRGBEncoding;
    if (!this.software) map.anisotropy = this.renderer.capabilities.getMaxAnisotropy();
    const Material = this.software ? THREE.MeshBasicMaterial : THREE.MeshLambertMaterial;
    const material = new Material({map, transparent: true});
    this.floor = new THREE.Mesh(new THREE.PlaneBufferGeometry(2 * kFloorReach, 2 * kFloorReach), material);
    const snap = (v) => Math.round(v / kFloorTile) * kFloorTile;
    this.floor.position.set(snap(view.target[0]), snap(view.target[1]), -0.002);
    this.floor.receiveShadow = true;
    this.floor.renderOrder = -1;
    this.scene.add(this.floor);
  }

  /** Tiles that fade away with distance. */
  paintFloor() {
    const size = this.floorCanvas.width, pen = this.floorCanvas.getContext("2d");
    pen.globalCompositeOperation = "source-over";
    pen.fillStyle = Theme.colour("floor");
    pen.fillRect(0, 0, size, size);
    pen.fillStyle = Theme.colour("tile");
    const step = size * kFloorTile / (2 * kFloorReach);
    for (let at = 0; at <= size; at += step) {
      pen.fillRect(at - 1, 0, 2, size);
      pen.fillRect(0, at - 1, size, 2);
    }
    const fade = pen.createRadialGradient(size / 2, size / 2, size * 0.2, size / 2, size / 2, size * 0.5);
    fade.addColorStop(0, "rgba(0,0,0,1)");
    fade.addColorStop(1, "rgba(0,0,0,0)");
    pen.globalCompositeOperation = "destination-in";
    pen.fillStyle = fade;
    pen.fillRect(0, 0, size, size);
    this.floor.material.map.needsUpdate = true;
  }

  paint() {
    this.scene.background = new THREE.Color(Theme.colour("sky"));
    this.paintFloor();
    this.invalidate();
  }

  resize() {
    const box = this.canvas.parentElement.getBoundingClientRect();
    if (box.width < 2 || box.height < 2) return;
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(box.width, box.height, false);
    this.camera.aspect = box.width / box.height;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  /** Called every animation frame. seconds: since the one before, while playing; else 0. */
  frame(seconds) {
    if (!this.needsDraw) return;
    this.needsDraw = false;
    this.orbit.apply(this.camera);
    for (const action of this.beforeDraw) action();
    this.renderer.render(this.scene, this.camera);
    this.adapt(seconds);
  }

  /** A machine that draws slowly (no graphics hardware) gives up soft shadows first, then fine pixels. */
  adapt(seconds) {
    if (seconds <= 0 || document.hidden) return;
    this.slowFrames = seconds > 0.036 ? this.slowFrames + 1 : Math.max(0, this.slowFrames - 0.25);
    if (this.slowFrames < 8) return;
    this.slowFrames = 0;
    if (this.renderer.shadowMap.enabled) {
      this.renderer.shadowMap.enabled = false;
      this.scene.traverse((node) => { if (node.material) node.material.needsUpdate = true; });
    } else if (this.ratio > 0.5) {
      this.ratio = Math.max(0.5, this.ratio * 0.75);
      this.resize();
    }
  }
}
