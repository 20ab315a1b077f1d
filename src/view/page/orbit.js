// The camera around a point: drag turns, right drag or two fingers move, wheel or pinch zooms.
"use strict";

class Orbit {
  constructor(element, start, changed) {
    this.element = element;
    this.start = start;
    this.changed = changed;
    this.pointers = new Map();
    this.moved = 0;  // px since the pointer went down: a click moves less than a few
    this.reset();
    element.addEventListener("pointerdown", (event) => this.down(event));
    element.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, (event) => this.up(event));
    element.addEventListener("contextmenu", (event) => event.preventDefault());
    element.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * (event.deltaMode ? 0.03 : 0.001)));
    }, {passive: false});
  }

  reset() {
    const {target, yaw, pitch, distance} = this.start;
    this.target = new THREE.Vector3(...target);
    this.yaw = yaw;
    this.pitch = pitch;
    this.distance = distance;
    this.changed();
  }

  apply(camera) {
    // A narrow canvas sees as much to the sides as a square one.
    const distance = this.distance * Math.max(1, 0.95 / camera.aspect);
    const flat = Math.cos(this.pitch) * distance;
    camera.position.set(Math.cos(this.yaw) * flat, Math.sin(this.yaw) * flat, Math.sin(this.pitch) * distance);
    camera.position.add(this.target);
    camera.lookAt(this.target);
  }

  turn(dx, dy) {
    this.yaw -= dx * 0.006;
    this.pitch = Math.min(1.55, Math.max(-0.3, this.pitch + dy * 0.006));
    this.changed();
  }

  zoom(factor) {
    this.distance = Math.min(12, Math.max(0.15, this.distance * factor));
    this.changed();
  }

  /** By pixels of the canvas, in the camera's plane. */
  shift(dx, dy) {
    const metres = 2 * this.distance * Math.tan(this.start.fov / 2) / this.element.clientHeight;
    const right = new THREE.Vector3(-Math.sin(this.yaw), Math.cos(this.yaw), 0);
    const up = new THREE.Vector3(-Math.cos(this.yaw) * Math.sin(this.pitch), -Math.sin(this.yaw) * Math.sin(this.pitch),
                                 Math.cos(this.pitch));
    this.target.addScaledVector(right, -dx * metres).addScaledVector(up, dy * metres);
    this.changed();
  }

  down(event) {
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size === 1) this.moved = 0;
  }

  up(event) { this.pointers.delete(event.pointerId); }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before[0], dy = event.clientY - before[1];
    this.moved += Math.abs(dx) + Math.abs(dy);
    if (this.pointers.size === 1) {
      if (event.buttons & 2 || event.shiftKey || event.ctrlKey) this.shift(dx, dy); else this.turn(dx, dy);
    } else if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const span = (x, y) => Math.max(1, Math.hypot(x - other[0], y - other[1]));
      this.zoom(span(...before) / span(event.clientX, event.clientY));
      this.shift(dx / 2, dy / 2);
    }
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }
}
