// Renderer, camera, light and floor. Draws only when something changed, and with less care where that is slow.
"use strict";

THREE.Object3D.DefaultUp.set(0, 0, 1);

class Stage {
  constructor(canvas, camera) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true});
    this.renderer.gammaOutput = true;
    this.renderer.gammaFactor = 2.2;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(camera.fov * 180 / Math.PI, 1, 0.02, 60);
    this.orbit = new Orbit(canvas, camera, () => this.invalidate());
    this.beforeDraw = [];
    this.needsDraw = true;
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    this.slowFrames = 0;
    this.addLight(camera);
    this.addFloor(camera);
    this.paint();
    Theme.listeners.push(() => this.paint());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
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
    const [x, y] = view.target;
    const material = new THREE.MeshBasicMaterial();
    this.floor = new THREE.Mesh(new THREE.CircleBufferGeometry(3.2, 64), material);
    this.floor.position.set(x, y, -0.002);
    this.grid = new THREE.GridHelper(6, 30);
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.set(Math.round(x / 0.2) * 0.2, Math.round(y / 0.2) * 0.2, 0);
    this.grid.material.transparent = true;
    this.grid.material.opacity = 0.28;
    this.scene.add(this.floor, this.grid);
  }

  paint() {
    const dark = Theme.dark();
    this.scene.background = new THREE.Color(Theme.colour("sky"));
    this.floor.material.color.set(Theme.colour("floor"));
    this.grid.material.opacity = dark ? 0.16 : 0.28;
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
