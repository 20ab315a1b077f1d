// Tilt and speed of every touched or moved object against its limits, under the timeline and on its scale.
"use strict";

const kCurveWidth = 1000, kCurveHeight = 34, kColumns = 500;

class Curves {
  constructor(element, data, replay, seek) {
    this.element = element;
    this.replay = replay;
    this.duration = Math.max(replay.duration, 1e-6);
    this.values = [];
    this.told = 0;
    for (const [id, track] of replay.tracks) {
      const object = data.objects[id];
      if (object.kind === "fixture") continue;
      const moves = Math.max(...track.tilt) > 0.005 || Math.max(...track.speed) > 0.005;
      if (!object.touched && !moves) continue;
      this.addRow(object, "tilt", track.tilt, object.maxTilt, 180 / Math.PI, "°", 5);
      this.addRow(object, "speed", track.speed, object.maxSpeed, 1, " m/s", 0.1);
    }
    this.head = document.createElement("div");  // one line over all rows: moving it redraws no curve
    this.head.className = "head";
    const rows = document.createElement("div");
    rows.className = "heads";
    rows.append(this.head);
    element.append(rows);
    rows.hidden = !this.values.length;
    element.addEventListener("pointerdown", (event) => {
      const plot = event.target.closest("svg");
      if (!plot) return;
      const box = plot.getBoundingClientRect();
      seek((event.clientX - box.left) / box.width * this.duration);
    });
  }

  /** factor: from the recording's unit to the one shown; least: the smallest range, in that unit. */
  addRow(object, what, values, limit, factor, unit, least) {
    const most = Math.max(...values) * factor;
    const bound = limit === null ? null : limit * factor;
    const scale = Math.max(least, most, bound === null || bound > 4 * Math.max(most, least) ? 0 : bound) * 1.12;
    const row = document.createElement("div");
    row.className = "curve" + (bound !== null && most > bound ? " over" : "");
    const digits = unit === "°" ? 1 : 2;
    const title = what === "tilt" ? `<b></b> tilt` : `<b></b> speed`;
    row.innerHTML = `<span class="name"><i style="background:var(--${object.role})"></i>${title}</span>` +
        `<svg viewBox="0 0 ${kCurveWidth} ${kCurveHeight}" preserveAspectRatio="none">${this.plot(values, factor, scale, bound)}</svg>` +
        `<span class="now"></span><span class="most soft">most ${most.toFixed(digits)}` +
        `${bound === null ? ", no limit" : ` of ${bound.toFixed(digits)}${unit}`}</span>`;
    row.querySelector("b").textContent = object.id;
    this.element.append(row);
    this.values.push({cell: row.querySelector(".now"), values, factor, unit, digits});
  }

  plot(values, factor, scale, bound) {
    const y = (value) => (kCurveHeight - 2 - (kCurveHeight - 4) * Math.min(1, value / scale)).toFixed(1);
    const t = this.replay.t;
    const highest = new Float32Array(kColumns + 1).fill(-1);
    for (let k = 0; k < values.length; ++k) {
      const column = Math.round(t[k] / this.duration * kColumns);
      highest[column] = Math.max(highest[column], values[k] * factor);
    }
    let line = "";
    for (let c = 0; c <= kColumns; ++c)
      if (highest[c] >= 0) line += (line ? "L" : "M") + (c * kCurveWidth / kColumns) + "," + y(highest[c]);
    const limit = bound !== null && bound <= scale
        ? `<path class="limit" d="M0,${y(bound)}H${kCurveWidth}"/>` : "";
    const area = line ? `<path class="area" d="${line}V${kCurveHeight}H0Z"/><path class="line" d="${line}"/>` : "";
    return area + limit;
  }

  show(time, playing) {
    this.head.style.transform = `translateX(${(100 * time / this.duration).toFixed(3)}%)`;
    const now = performance.now();
    if (playing && now - this.told < 100) return;  // numbers that change faster cannot be read
    this.told = now;
    const sample = this.replay.sample(time);
    for (const {cell, values, factor, unit, digits} of this.values)
      cell.textContent = (Replay.at(values, sample) * factor).toFixed(digits) + unit;
  }
}
