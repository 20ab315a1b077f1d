// Numbers as src/view/series.cpp wrote them.
"use strict";

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** {n, u, d} -> Float32Array: differences in groups of seven bits, a zero followed by how many more zeros follow. */
function decodeSeries(series) {
  const bytes = bytesOf(series.d);
  const out = new Float32Array(series.n);
  let at = 0, last = 0;
  const next = () => {
    let value = 0, factor = 1;
    for (;;) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
      factor *= 128;
    }
  };
  for (let i = 0; i < series.n;) {
    const coded = next();
    if (coded === 0) {
      for (let more = next() + 1; more > 0; --more) out[i++] = last * series.u;
    } else {
      last += coded % 2 ? -(coded + 1) / 2 : coded / 2;
      out[i++] = last * series.u;
    }
  }
  return out;
}
