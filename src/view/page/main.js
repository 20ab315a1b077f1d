// Puts the page together and runs the clock.
//
// Data (src/view/page_data.cpp): title; robot (links with shapes, joints); objects (id, role, shapes, limits); geometry
// (shapes by index); segments; outcome (kind, headline, reason, findings with time and place); facts; layers; camera;
// goal; recording (samples of joints and of the objects that moved, contacts).
"use strict";

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 4, 8];

class Player {
  constructor(data) {
    this.data = data;
    this.replay = new Replay(data.recording);
    this.time = 0;
    this.speed = 1;
    this.playing = false;
    this.frames = 0;  // drawn so far
    const find = (id) => document.getElementById(id);
    try {
      this.stage = new Stage(find("canvas"), data.camera);
    } catch (error) {
      find("no-webgl").hidden = false;
      throw error;
    }
    this.bodies = new Bodies(data, this.stage);
    this.contacts = new Contacts(data, this.replay, this.stage);
    this.layers = new Layers(data, this.stage);
    this.stage.beforeDraw.push(() => this.contacts.apply(this.time, this.stage.camera));
    this.timeline = new Timeline(find("timeline"), data, this.replay, (time) => this.seek(time));
    this.curves = new Curves(find("curves"), data, this.replay, (time) => this.seek(time));
    this.panel = new Panel(find("panel"), data, this);
    this.head(find);
    this.controls(find);
    this.pointer(find("tip"));
    addEventListener("keydown", (event) => this.key(event));
    this.seek(data.outcome.kind === "failed" ? this.replay.duration : 0);
    requestAnimationFrame((now) => this.tick(now, now));
  }

  get moves() { return this.replay.duration > 0; }

  head(find) {
    const {outcome} = this.data;
    find("title").textContent = this.data.title;
    find("badge").textContent = outcome.headline;
    find("badge").classList.add(outcome.kind);
    find("reason").textContent = outcome.kind === "failed" ? outcome.reason : "";
  }

  controls(find) {
    find("transport").hidden = !this.moves;
    this.playButton = find("play");
    this.playButton.addEventListener("click", () => this.play(!this.playing));
    find("before").addEventListener("click", () => this.jump(-1));
    find("after").addEventListener("click", () => this.jump(1));
    this.speedChoice = find("speed");
    for (const speed of kSpeeds) this.speedChoice.append(element("option", {value: speed}, `${speed} ×`));
    this.speedChoice.value = 1;
    this.speedChoice.addEventListener("change", () => { this.speed = Number(this.speedChoice.value); });
    this.clock = find("clock");
    find("theme").addEventListener("click", () => Theme.toggle());
    find("column").addEventListener("click", () => this.toggleColumn());
    find("view").addEventListener("click", () => this.stage.orbit.reset());
    if (innerWidth < 760) this.toggleColumn(false);
  }

  toggleColumn(on = document.body.classList.contains("wide")) {
    document.body.classList.toggle("wide", !on);
  }

  pointer(tip) {
    const canvas = this.stage.canvas;
    const look = (event) => {
      const box = canvas.getBoundingClientRect();
      const x = (event.clientX - box.left) / box.width * 2 - 1, y = 1 - (event.clientY - box.top) / box.height * 2;
      const found = this.bodies.pick(x, y);
      tip.hidden = !found;
      if (!found) return;
      tip.textContent = found.name;
      if (found.object !== undefined) tip.append(element("div", {class: "soft"}, this.describe(found.object)));
      tip.style.left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8) + "px";
      tip.style.top = event.clientY + 16 + "px";
    };
    canvas.addEventListener("pointermove", (event) => { if (!event.buttons) look(event); });
    canvas.addEventListener("pointerup", (event) => { if (this.stage.orbit.moved < 6) look(event); });
    canvas.addEventListener("pointerleave", () => { tip.hidden = true; });
  }

  describe(id) {
    const object = this.data.objects[id];
    const parts = [object.role === "target" ? "object of interest" : object.kind];
    if (object.kind !== "fixture" && object.mass > 0) parts.push(`${object.mass.toFixed(2)} kg`);
    if (object.relevant) parts.push(`relevant (${object.relevant}.)`);
    if (object.touched) parts.push("touched");
    return parts.join(", ");
  }

  key(event) {
    if (event.target.closest("select") || event.altKey || event.metaKey || event.ctrlKey) return;
    const step = event.shiftKey ? 1 : 0.1;
    const actions = {
      " ": () => this.play(!this.playing), ArrowLeft: () => this.nudge(-step), ArrowRight: () => this.nudge(step),
      "[": () => this.jump(-1), "]": () => this.jump(1), Home: () => this.seek(0), End: () => this.seek(this.replay.duration),
      "-": () => this.faster(-1), "+": () => this.faster(1), "=": () => this.faster(1), r: () => this.stage.orbit.reset(),
      t: () => Theme.toggle(), p: () => this.toggleColumn(),
    };
    const layer = this.layers.layers[Number(event.key) - 1];
    if (actions[event.key]) actions[event.key]();
    else if (layer) layer.box.click();
    else return;
    event.preventDefault();
  }

  play(on) {
    if (!this.moves) return;
    if (on && this.time >= this.replay.duration - 1e-3) this.seek(0);
    this.playing = on;
    this.playButton.classList.toggle("on", on);
    this.playButton.setAttribute("aria-label", on ? "pause" : "play");
    this.stage.invalidate();
  }

  faster(by) {
    const index = kSpeeds.indexOf(this.speed) + by;
    this.speed = kSpeeds[Math.min(kSpeeds.length - 1, Math.max(0, index))];
    this.speedChoice.value = this.speed;
  }

  nudge(seconds) {
    this.play(false);
    this.seek(this.time + seconds);
  }

  /** To the start of the segment before or after this moment. */
  jump(by) {
    const starts = [...this.data.segments.map((segment) => segment.from), this.replay.duration];
    const next = by > 0 ? starts.find((t) => t > this.time + 0.02) : starts.reverse().find((t) => t < this.time - 0.25);
    this.seek(next === undefined ? (by > 0 ? this.replay.duration : 0) : next);
  }

  seek(time) {
    this.time = Math.min(this.replay.duration, Math.max(0, time));
    this.bodies.apply(this.replay, this.time);
    this.timeline.show(this.time);
    this.curves.show(this.time, this.playing);
    this.clock.textContent = `${this.time.toFixed(1)} / ${this.replay.duration.toFixed(1)} s`;
  }

  redraw() { this.stage.invalidate(); }

  tick(now, before) {
    const seconds = (now - before) / 1000;
    if (this.playing) {
      this.seek(this.time + Math.min(0.25, seconds) * this.speed);
      if (this.time >= this.replay.duration) this.play(false);
    }
    if (this.stage.needsDraw) ++this.frames;
    this.stage.frame(this.playing ? seconds : 0);
    requestAnimationFrame((next) => this.tick(next, now));
  }
}

const player = new Player(JSON.parse(document.getElementById("data").textContent));
