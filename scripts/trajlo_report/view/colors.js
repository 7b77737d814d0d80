// SPDX-License-Identifier: MIT
// Colour maps, as lists of colours that the page brings along.

const PLAIN = {
  background: '#ffffff', text: '#1f2328', quiet: '#59636e', grid: '#c9d1d9',
  truth: '#111111', flag: '#d1242f', start: '#009e73', end: '#d55e00', scan: '#c2006b',
  path: '#0072b2', unknown: '#8c959f',
};

function colorAt(list, share) {
  const at = Math.min(Math.max(share, 0), 1) * (list.length - 1);
  const i = Math.min(Math.floor(at), list.length - 2);
  return new THREE.Color(list[i]).lerp(new THREE.Color(list[i + 1]), at - i);
}

function gradient(list) {
  return `linear-gradient(to right, ${list.filter((_, i) => i % 7 === 0).join(', ')})`;
}

function colorTexture(list) {
  const texels = new Uint8Array(4 * list.length);
  list.forEach((text, i) => {
    const color = new THREE.Color(text);
    texels.set([255 * color.r, 255 * color.g, 255 * color.b, 255].map(Math.round), 4 * i);
  });
  const texture = new THREE.DataTexture(texels, list.length, 1, THREE.RGBAFormat);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

// 1, 2 or 5 times a power of ten, at most `value`.
function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [5, 2, 1].find((step) => step * power <= value * 1.000001);
}

function numberText(value, digits = 3) {
  if (!Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 10 ** digits) return value.toFixed(0);
  if (size < 0.001) return value.toExponential(0);
  return String(Number(value.toPrecision(digits)));
}

// Decimals that tell two ends of a scale apart.
function decimalsOf(low, high) {
  return Math.min(Math.max(1 - Math.floor(Math.log10(Math.max(high - low, 1e-9))), 0), 6);
}

function lengthText(metres) {
  if (metres >= 1000) return `${numberText(metres / 1000)} km`;
  return metres >= 1 ? `${numberText(metres)} m` : `${numberText(100 * metres)} cm`;
}
