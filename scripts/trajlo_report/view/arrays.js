// SPDX-License-Identifier: MIT
// Reads back what view_arrays.py put into the page.

async function inflate(text) {
  const packed = atob(text);
  const bytes = new Uint8Array(packed.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = packed.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Byte b of value i stands at b * length + i.
function joinPlanes(bytes, entry, size) {
  const joined = new Uint8Array(size * entry.length);
  for (let b = 0; b < size; ++b) {
    const plane = entry.offset + b * entry.length;
    for (let i = 0; i < entry.length; ++i) joined[size * i + b] = bytes[plane + i];
  }
  return joined.buffer;
}

function readArray(bytes, entry) {
  if (entry.kind === 'uint8') return bytes.subarray(entry.offset, entry.offset + entry.length);
  if (entry.kind === 'float32') return new Float32Array(joinPlanes(bytes, entry, 4));
  const values = new Uint16Array(joinPlanes(bytes, entry, 2));
  for (let i = 1; i < values.length; ++i) values[i] += values[i - 1];  // modulo 2^16
  return values;
}

async function readArrays(text, index) {
  const bytes = await inflate(text);
  const arrays = {};
  for (const [name, entry] of Object.entries(index)) arrays[name] = readArray(bytes, entry);
  return arrays;
}
