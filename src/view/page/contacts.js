// Contacts flash where they happen; the place where a plan failed stays marked.
"use strict";

const kAfterglow = 0.35;  // s of the recording

class Contacts {
  constructor(data, replay, stage) {
    this.replay = replay;
    this.data = data;
    this.group = new THREE.Group();
    stage.scene.add(this.group);
    this.texture = Contacts.glow();
    this.sprites = replay.contacts.map((contact) => {
      const sprite = this.sprite("contact");
      sprite.position.set(...contact.p);
      sprite.visible = false;
      return sprite;
    });
    this.failure = null;
    const place = data.outcome.findings.find((finding) => finding.p);
    if (place) this.markFailure(place);
    const paint = () => this.group.traverse((node) => {
      if (node.material) Theme.paint(node.material, node.userData.colour);
    });
    Theme.listeners.push(paint);
    paint();
  }

  static glow() {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 64;
    const pen = canvas.getContext("2d");
    const shade = pen.createRadialGradient(32, 32, 2, 32, 32, 30);
    shade.addColorStop(0, "rgba(255,255,255,1)");
    shade.addColorStop(0.35, "rgba(255,255,255,0.85)");
    shade.addColorStop(0.5, "rgba(255,255,255,0.3)");
    shade.addColorStop(1, "rgba(255,255,255,0)");
    pen.fillStyle = shade;
    pen.fillRect(0, 0, 64, 64);
    return new THREE.CanvasTexture(canvas);
  }

  sprite(colour) {
    const material = new THREE.SpriteMaterial({map: this.texture, transparent: true, depthTest: false});
    const sprite = new THREE.Sprite(material);
    sprite.renderOrder = 10;
    sprite.userData.colour = colour;
    this.group.add(sprite);
    return sprite;
  }

  markFailure(finding) {
    const ring = new THREE.Mesh(new THREE.TorusBufferGeometry(0.05, 0.004, 8, 40),
                                new THREE.MeshBasicMaterial({depthTest: false, transparent: true}));
    ring.position.set(...finding.p);
    ring.renderOrder = 11;
    ring.userData.colour = "contact";
    this.group.add(ring);
    this.failure = {ring, time: finding.t};
  }

  /** Contacts that hold at a time. */
  at(time) { return this.replay.contacts.filter((c) => c.from <= time && time <= c.to + 1e-3); }

  apply(time, camera) {
    this.replay.contacts.forEach((contact, i) => {
      const sprite = this.sprites[i];
      const since = time - contact.from, left = contact.to + kAfterglow - time;
      sprite.visible = since >= -1e-4 && left > 0;
      if (!sprite.visible) return;
      const size = 0.05 + 0.12 * Math.exp(-Math.max(0, since) * 6);  // a flash, then an ember
      sprite.scale.set(size, size, 1);
      sprite.material.opacity = Math.min(1, left / kAfterglow) * 0.9;
    });
    if (this.failure) {
      this.failure.ring.quaternion.copy(camera.quaternion);
      this.failure.ring.visible = time >= this.failure.time - 1;
    }
  }
}
