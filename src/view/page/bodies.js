// The robot as a tree of links, the objects as rigid bodies; names under the pointer.
"use strict";

function placed(node, [x, y, z, qx, qy, qz, qw]) {
  node.position.set(x, y, z);
  node.quaternion.set(qx, qy, qz, qw).normalize();
  return node;
}

class Bodies {
  constructor(data, stage) {
    this.data = data;
    this.stage = stage;
    this.geometry = data.geometry.map(Bodies.makeGeometry);
    this.edges = new Map();
    this.materials = [];
    this.pickable = [];
    this.addRobot();
    this.objects = data.objects.map((object, id) => this.addObject(object, id));
    this.addGoal();
    Theme.listeners.push(() => this.paint());
    this.paint();
  }

  static makeGeometry(entry) {
    if (entry.type === "box") return new THREE.BoxBufferGeometry(...entry.size);
    if (entry.type === "sphere") return new THREE.SphereBufferGeometry(entry.radius, 24, 16);
    if (entry.type === "cylinder") {  // three.js cylinders stand along y
      return new THREE.CylinderBufferGeometry(entry.radius, entry.radius, entry.length, 32).rotateX(Math.PI / 2);
    }
    const coded = new Uint16Array(bytesOf(entry.points).buffer);
    const points = new Float32Array(coded.length);
    for (let i = 0; i < coded.length; ++i) points[i] = entry.low[i % 3] + entry.size[i % 3] * coded[i] / 65535;
    const corners = bytesOf(entry.corners).buffer;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    geometry.setIndex(new THREE.BufferAttribute(entry.wide ? new Uint32Array(corners) : new Uint16Array(corners), 1));
    const flat = geometry.toNonIndexed();
    flat.computeVertexNormals();
    return flat;
  }

  /** A material in a colour of the palette, repainted with the theme. */
  material(colour, options) {
    const material = new THREE.MeshLambertMaterial(options);
    this.materials.push({material, colour});
    return material;
  }

  paint() {
    for (const {material, colour} of this.materials) Theme.paint(material, colour);
    this.stage.invalidate();
  }

  shape(parent, [geometry, X], material, name) {
    const mesh = placed(new THREE.Mesh(this.geometry[geometry], material), X);
    mesh.castShadow = mesh.receiveShadow = !material.transparent;
    mesh.userData.name = name;
    parent.add(mesh);
    this.pickable.push(mesh);
    return mesh;
  }

  outline(parent, [geometry, X], colour, opacity) {
    if (!this.edges.has(geometry)) this.edges.set(geometry, new THREE.EdgesGeometry(this.geometry[geometry], 35));
    const material = new THREE.LineBasicMaterial({transparent: true, opacity});
    this.materials.push({material, colour});
    parent.add(placed(new THREE.LineSegments(this.edges.get(geometry), material), X));
  }

  addRobot() {
    const robot = this.data.robot;
    const arm = this.material("arm"), body = this.material("body");
    this.collisionShapes = [];
    this.visualShapes = [];
    this.links = robot.links.map((link, index) => {
      const node = new THREE.Group();
      const material = link.moves ? arm : body;
      const name = robot.name + ": " + link.name;
      for (const shape of link.collision) {
        const mesh = this.shape(node, shape, material, name);
        (link.visual ? this.collisionShapes : this.visualShapes).push(mesh);
        mesh.visible = !link.visual;
      }
      for (const [geometry, X, rgb] of link.visual || []) {
        const own = new THREE.MeshLambertMaterial({side: THREE.DoubleSide});
        own.color.setRGB(...rgb).convertSRGBToLinear();
        const mesh = this.shape(node, [geometry, X], own, name);
        this.visualShapes.push(mesh);
      }
      if (index > 0) node.matrixAutoUpdate = false;
      return node;
    });
    robot.links.forEach((link, index) => {
      if (index === 0) return;
      const node = this.links[index];
      node.userData.fixed = placed(new THREE.Object3D(), link.X);
      node.userData.fixed.updateMatrix();
      if (link.axis) node.userData.axis = new THREE.Vector3(...link.axis);
      this.links[link.parent].add(node);
    });
    placed(this.links[0], robot.base);
    this.stage.scene.add(this.links[0]);
    this.hasVisuals = robot.links.some((link) => link.visual);
    this.moveRobot(null);
  }

  /** Either what the robot looks like or what collides. */
  showCollision(on) {
    for (const mesh of this.collisionShapes) mesh.visible = on;
    const replaced = new Set(this.collisionShapes.map((mesh) => mesh.parent));
    for (const mesh of this.visualShapes) mesh.visible = !on || !replaced.has(mesh.parent);
    this.stage.invalidate();
  }

  /** q: group joints, or null for the start. */
  moveRobot(q) {
    const robot = this.data.robot;
    const full = robot.posture.slice();
    if (q) robot.group.forEach((variable, i) => { full[variable] = q[i]; });
    const motion = new THREE.Matrix4();
    robot.links.forEach((link, index) => {
      const node = this.links[index];
      if (index === 0) return;
      node.matrix.copy(node.userData.fixed.matrix);
      if (link.axis) {
        const value = full[link.variable] * link.times + link.plus;
        const axis = node.userData.axis;
        if (link.slides) motion.makeTranslation(axis.x * value, axis.y * value, axis.z * value);
        else motion.makeRotationAxis(axis, value);
        node.matrix.multiply(motion);
      }
      node.matrixWorldNeedsUpdate = true;
    });
  }

  addObject(object, id) {
    const node = placed(new THREE.Group(), object.X);
    const wall = object.seeThrough;
    const material = this.material(object.role, wall ? {transparent: true, opacity: 0.12, depthWrite: false} : {});
    for (const shape of object.shapes) {
      const mesh = this.shape(node, shape, material, object.id);
      mesh.userData.object = id;
      if (wall) mesh.renderOrder = 2;
      if (wall) this.outline(node, shape, "fixture", 0.7);
      else if (object.relevant) this.outline(node, shape, "relevant", 0.9);
      else this.outline(node, shape, "ink", 0.22);
    }
    this.stage.scene.add(node);
    return node;
  }

  /** Where the tip shall go: its axes as thin arrows. */
  addGoal() {
    if (!this.data.goal) return;
    this.goal = placed(new THREE.Group(), this.data.goal);
    const material = new THREE.MeshBasicMaterial();
    this.materials.push({material, colour: "goal"});
    const stick = new THREE.CylinderBufferGeometry(0.0035, 0.0035, 0.1, 8);
    const head = new THREE.ConeBufferGeometry(0.011, 0.03, 12);
    const forward = new THREE.Group();
    const shaft = new THREE.Mesh(stick, material), tip = new THREE.Mesh(head, material);
    shaft.position.y = -0.065;
    tip.position.y = -0.015;
    forward.add(shaft, tip);
    forward.rotation.z = -Math.PI / 2;
    const ring = new THREE.Mesh(new THREE.TorusBufferGeometry(0.022, 0.003, 8, 32), material);
    ring.rotation.y = Math.PI / 2;
    this.goal.add(forward, ring);
    for (const mesh of [shaft, tip, ring]) mesh.userData.name = "goal of the tip";
    this.pickable.push(shaft, tip, ring);
    this.stage.scene.add(this.goal);
  }

  apply(replay, time) {
    const sample = replay.sample(time);
    if (replay.q.length) this.moveRobot(replay.joints(sample));
    for (const id of replay.tracks.keys()) placed(this.objects[id], replay.pose(id, sample));
    this.stage.invalidate();
  }

  /** The nearest body under a point of the canvas in [-1, 1] x [-1, 1], or null. */
  pick(x, y) {
    const ray = new THREE.Raycaster();
    ray.setFromCamera({x, y}, this.stage.camera);
    const shown = (node) => { for (; node; node = node.parent) if (!node.visible) return false; return true; };
    const hits = ray.intersectObjects(this.pickable).filter((hit) => shown(hit.object));
    const solid = hits.find((hit) => !hit.object.material.transparent) || hits[0];
    return solid ? solid.object.userData : null;
  }
}
