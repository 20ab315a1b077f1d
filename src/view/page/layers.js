// Layers over the scene: lines, marks and cells, each layer switched on and off as a whole.
"use strict";

/** Layers that pages know: colour of the palette, and whether they are shown at first. */
const kKnownLayers = {
  "tip path": {colour: "arm", on: true},
  "motion of objects": {colour: "moved", on: true},
  "swept volume": {colour: "reach"},
  "negative goal region": {colour: "immovable"},
  "object paths": {colour: "approach"},
  "relevant objects": {colour: "relevant"},
  "failed pushes": {colour: "contact"},
  "failed motions": {colour: "contact"},
  "heuristic": {colour: "reach"},
};
const kSegmentKinds = ["approach", "push", "retreat", "reach", "grasp", "extract"];

class Layers {
  constructor(data, stage) {
    this.data = data;
    this.stage = stage;
    this.layers = data.layers.map((layer) => {
      const known = kKnownLayers[layer.name] || {colour: "goal"};
      const shown = {...layer, colour: known.colour, group: new THREE.Group(), paint: []};
      shown.group.visible = Boolean(known.on);
      for (const item of layer.items) this.addItem(shown, item);
      if (layer.cells) this.addCells(shown, layer.cells);
      stage.scene.add(shown.group);
      return shown;
    });
    const paint = () => { for (const layer of this.layers) for (const action of layer.paint) action(); };
    Theme.listeners.push(paint);
    paint();
  }

  toggle(layer, on = !layer.group.visible) {
    layer.group.visible = on;
    this.stage.invalidate();
  }

  painted(layer, material, colour) {
    layer.paint.push(() => Theme.paint(material, colour));
    return material;
  }

  /** What the planner noted is seen through bodies: its marks lie inside them. */
  line(layer, colour) {
    const through = !["tip path", "motion of objects"].includes(layer.name);
    return this.painted(layer, new THREE.MeshBasicMaterial({depthTest: !through, transparent: through}), colour);
  }

  addItem(layer, item) {
    const colour = kSegmentKinds.includes(item.text) ? item.text : layer.colour;
    const points = item.points.map((p) => new THREE.Vector3(...p));
    const name = layer.name + ": " + item.text;
    if (points.length > 1) {
      // A tube: lines are one pixel wide everywhere.
      const curve = new THREE.CurvePath();
      for (let i = 1; i < points.length; ++i) curve.add(new THREE.LineCurve3(points[i - 1], points[i]));
      const pieces = Math.min(600, Math.max(8, points.length * 2));
      const tube = new THREE.Mesh(new THREE.TubeBufferGeometry(curve, pieces, 0.0028, 5), this.line(layer, colour));
      tube.renderOrder = 5;
      tube.userData.name = name;
      layer.group.add(tube);
    }
    if (points.length === 0 || layer.name === "tip path") return;
    const radius = points.length > 1 ? 0.006 : 0.011;
    const mark = new THREE.Mesh(new THREE.SphereBufferGeometry(radius, 16, 10), this.line(layer, colour));
    mark.renderOrder = 5;
    mark.position.copy(points[points.length - 1]);
    mark.userData.name = name;
    layer.group.add(mark);
  }

  /** All cells as one mesh: the sides that no other cell hides. Values colour them from near (blue) to far (red). */
  addCells(layer, cells) {
    const [x, y, z] = cells.indices.map(decodeSeries);
    const values = cells.values ? decodeSeries(cells.values) : null;
    const key = (i, j, k) => i * 1048576 + j * 1024 + k;
    const taken = new Set();
    for (let n = 0; n < x.length; ++n) taken.add(key(x[n], y[n], z[n]));
    const points = [], colours = [], normals = [];
    const sides = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    const tint = new THREE.Color();
    for (let n = 0; n < x.length; ++n) {
      if (values) tint.setHSL(0.62 * (1 - values[n]), 0.75, 0.55);
      for (const side of sides) {
        if (taken.has(key(x[n] + side[0], y[n] + side[1], z[n] + side[2]))) continue;
        Layers.addSide(points, [x[n], y[n], z[n]], side, cells);
        for (let corner = 0; corner < 6; ++corner) {
          normals.push(...side);
          if (values) colours.push(tint.r, tint.g, tint.b);
        }
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
    const options = {transparent: true, opacity: values ? 0.2 : 0.3, depthWrite: false};
    if (values) {
      geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
      options.vertexColors = THREE.VertexColors;
    }
    const material = new THREE.MeshLambertMaterial(options);
    if (!values) this.painted(layer, material, layer.colour);
    const mesh = new THREE.Mesh(geometry, material);
    mesh.renderOrder = 3;
    mesh.userData.name = layer.name;
    layer.group.add(mesh);
  }

  /** Two triangles of one side of a cell, counter-clockwise from outside. */
  static addSide(points, index, side, {size, origin}) {
    const axis = side.findIndex((v) => v !== 0), u = (axis + 1) % 3, v = (axis + 2) % 3;
    const corner = (a, b) => {
      const p = index.slice();
      p[axis] += side[axis] > 0 ? 1 : 0;
      p[u] += a;
      p[v] += b;
      return p.map((c, i) => origin[i] + size * c);
    };
    const quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
    if (side[axis] < 0) quad.reverse();
    for (const i of [0, 1, 2, 0, 2, 3]) points.push(...quad[i]);
  }
}
