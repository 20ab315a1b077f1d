// The recording: where everything is at a time.
"use strict";

class Replay {
  /** recording: of the page's data, or undefined for a page without a plan. */
  constructor(recording) {
    this.t = recording ? decodeSeries(recording.t) : new Float32Array([0]);
    this.q = recording ? recording.q.map(decodeSeries) : [];
    this.tracks = new Map();
    for (const [id, track] of Object.entries(recording ? recording.tracks : {}))
      this.tracks.set(Number(id), {
        pose: track.pose.map(decodeSeries), tilt: decodeSeries(track.tilt), speed: decodeSeries(track.speed),
      });
    this.contacts = recording ? recording.contacts : [];
    this.grasped = recording && recording.grasped !== undefined ? recording.grasped : Infinity;
    this.duration = this.t[this.t.length - 1];
  }

  /** Index of the last sample at or before a time, and the share of the way to the next one. */
  sample(time) {
    const t = this.t;
    if (time <= t[0]) return [0, 0];
    if (time >= t[t.length - 1]) return [t.length - 1, 0];
    let low = 0, high = t.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (t[middle] <= time) low = middle; else high = middle;
    }
    return [low, (time - t[low]) / (t[high] - t[low])];
  }

  static at(values, [k, share]) {
    return share > 0 ? values[k] + share * (values[k + 1] - values[k]) : values[k];
  }

  /** Group joints. */
  joints(sample) { return this.q.map((values) => Replay.at(values, sample)); }

  /** x y z qx qy qz qw of an object that moved (not normalised), else null. */
  pose(id, sample) {
    const track = this.tracks.get(id);
    return track ? track.pose.map((values) => Replay.at(values, sample)) : null;
  }
}
