// The bar of segments: what runs when, where contacts begin, and the hand that scrubs.
"use strict";

class Timeline {
  constructor(element, data, replay, seek) {
    this.element = element;
    this.duration = Math.max(replay.duration, 1e-6);
    this.seek = seek;
    // A plan that failed ends before its segments do.
    for (const segment of data.segments) if (segment.from < this.duration) this.addSegment(segment);
    const rest = data.segments.length ? data.segments[data.segments.length - 1].to : 0;
    if (replay.duration - rest > 0.02) this.addBlock("settle", rest, replay.duration, "settling", "until everything rests");
    for (const contact of replay.contacts) this.addTick(contact, data);
    for (const finding of data.outcome.findings) {
      const mark = this.add("finding", finding.t);
      mark.title = finding.text;
    }
    this.head = this.add("playhead", 0);
    this.head.style.left = "0";
    element.addEventListener("pointerdown", (event) => {
      element.setPointerCapture(event.pointerId);
      this.scrub(event);
    });
    element.addEventListener("pointermove", (event) => { if (event.buttons) this.scrub(event); });
    element.setAttribute("aria-valuemin", "0");
    element.setAttribute("aria-valuemax", replay.duration.toFixed(2));
  }

  percent(time) { return Math.min(100, 100 * time / this.duration); }

  add(css, time) {
    const mark = document.createElement("div");
    mark.className = css;
    mark.style.left = this.percent(time) + "%";
    this.element.append(mark);
    return mark;
  }

  addBlock(kind, from, to, text, title) {
    const block = this.add("segment " + kind, from);
    block.style.width = this.percent(to) - this.percent(from) + "%";
    block.title = title;
    const label = document.createElement("span");
    label.textContent = text;
    block.append(label);
    return block;
  }

  addSegment(segment) {
    const what = segment.kind + (segment.object ? " " + segment.object : "");
    const block = this.addBlock(segment.kind, segment.from, segment.to, what,
                                `${what}, ${segment.from.toFixed(1)} to ${segment.to.toFixed(1)} s`);
    block.style.background = `var(--${segment.kind})`;
  }

  addTick(contact, data) {
    const tick = this.add("tick", contact.from);
    tick.style.width = `max(3px, ${this.percent(contact.to - contact.from)}%)`;
    tick.title = nameOf(data, contact.a) + " touches " + nameOf(data, contact.b);
  }

  scrub(event) {
    const box = this.element.getBoundingClientRect();
    this.seek(Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)) * this.duration);
  }

  show(time) {
    this.head.style.transform = `translateX(${this.percent(time).toFixed(3)}%)`;
    this.element.setAttribute("aria-valuenow", time.toFixed(2));
  }
}

/** Names of the bodies that are no objects: see ids.hpp. */
function nameOf(data, id) {
  return id >= 0 ? data.objects[id].id : id === -2 ? "robot" : id === -3 ? "floor" : "";
}
