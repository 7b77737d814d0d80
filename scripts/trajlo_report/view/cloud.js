// SPDX-License-Identifier: MIT
// The points: all of them, and again those of the scan at the moment.

const POINT_VERTEX = `
  attribute float moment;
  attribute float intensity;
  uniform int mode;             // 0 height, 1 intensity, 2 time, 3 one colour
  uniform vec2 heights;         // lowest and highest colour, m
  uniform float cut;            // nothing above, m
  uniform float lastMoment;
  uniform float untilMoment;    // nothing later
  uniform float size;           // of a point, m
  uniform float pixelsPerUnit;  // at distance 1
  uniform float leastPixels;
  uniform float lift;           // share of the way to the eye, to stand before others
  varying float share;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    vec4 seen = viewMatrix * world;
    gl_Position = projectionMatrix * vec4(seen.xyz * (1.0 - lift), 1.0);
    gl_PointSize = clamp(size * pixelsPerUnit / max(-seen.z, 1e-3), leastPixels, 40.0);
    if (world.z > cut || moment > untilMoment) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    share = mode == 0 ? (world.z - heights.x) / (heights.y - heights.x)
          : mode == 1 ? intensity : moment / max(lastMoment, 1.0);
  }`;
const POINT_FRAGMENT = `
  uniform int mode;
  uniform sampler2D colors;
  uniform vec3 color;
  uniform float fade;
  varying float share;
  void main() {
    vec2 offset = 2.0 * gl_PointCoord - 1.0;
    if (dot(offset, offset) > 1.0) discard;
    vec3 own = mode == 3 ? color : texture2D(colors, vec2(clamp(share, 0.01, 0.99), 0.5)).rgb;
    gl_FragColor = vec4(mix(own, vec3(0.93), fade), 1.0);
  }`;

const POINT_MODES = {
  height: { index: 0, colors: 'turbo', label: 'height', unit: 'm' },
  intensity: { index: 1, colors: 'gray', label: 'intensity', unit: 'as recorded' },
  time: { index: 2, colors: 'plasma', label: 'time of the scan', unit: 's' },
};

// Visits every index once, and after any number of them all parts evenly.
function spreadIndices(count) {
  const indices = new Uint32Array(count);
  const gcd = (a, b) => (b ? gcd(b, a % b) : a);
  let step = Math.max(1, Math.round(count * 0.6180339887));
  while (gcd(step, count) !== 1) ++step;
  for (let i = 0, at = 0; i < count; ++i, at = (at + step) % count) indices[i] = at;
  return indices;
}

function momentsOfPoints(entry, arrays) {
  const moments = new Uint16Array(entry.count);
  entry.moments_s.forEach((_, i) => moments.fill(i, entry.first[i], entry.first[i + 1]));
  if (arrays.cloud_moment) moments.set(arrays.cloud_moment, entry.scan_count);
  return moments;
}

class Cloud {
  constructor(entry, arrays, colorMaps) {
    this.entry = entry;
    this.colorMaps = colorMaps;
    this.textures = {};
    this.arrays = arrays;
    const geometry = this.makeGeometry(entry, arrays);
    this.all = this.makePoints(geometry, { leastPixels: 2.2 });
    this.all.geometry.setIndex(new THREE.BufferAttribute(spreadIndices(entry.count), 1));
    const scan = new THREE.BufferGeometry();
    for (const name of Object.keys(geometry.attributes)) {
      scan.setAttribute(name, geometry.attributes[name]);
    }
    this.scan = this.makePoints(scan, { leastPixels: 4, mode: 3, lift: 0.01 });
    this.scan.visible = false;
    this.cut = Infinity;
    this.setMode('height');
  }

  makeGeometry(entry, arrays) {
    const packed = new Uint16Array(4 * entry.count);
    const moments = momentsOfPoints(entry, arrays);
    for (let i = 0; i < entry.count; ++i) {
      packed[4 * i] = arrays.cloud_x[i];
      packed[4 * i + 1] = arrays.cloud_y[i];
      packed[4 * i + 2] = arrays.cloud_z[i];
      packed[4 * i + 3] = moments[i];
    }
    const buffer = new THREE.InterleavedBuffer(packed, 4);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(buffer, 3, 0, false));
    geometry.setAttribute('moment', new THREE.InterleavedBufferAttribute(buffer, 1, 3, false));
    geometry.setAttribute('intensity', new THREE.BufferAttribute(
      arrays.cloud_intensity || new Uint8Array(entry.count), 1, true));
    return geometry;
  }

  makePoints(geometry, { leastPixels, mode = 0, lift = 0 }) {
    const material = new THREE.ShaderMaterial({
      vertexShader: POINT_VERTEX, fragmentShader: POINT_FRAGMENT,
      uniforms: {
        mode: { value: mode }, heights: { value: new THREE.Vector2(0, 1) },
        cut: { value: 1e9 }, lastMoment: { value: Math.max(this.entry.moments_s.length - 1, 1) },
        untilMoment: { value: 1e9 }, size: { value: 0.05 }, pixelsPerUnit: { value: 1 },
        leastPixels: { value: leastPixels }, lift: { value: lift },
        colors: { value: null }, fade: { value: 0 },
        color: { value: new THREE.Color(PLAIN.scan) },
      },
    });
    const points = new THREE.Points(geometry, material);
    points.frustumCulled = false;
    points.scale.setScalar(this.entry.step_m);
    points.position.fromArray(this.entry.corner);
    points.updateMatrixWorld();
    return points;
  }

  uniforms() { return [this.all.material.uniforms, this.scan.material.uniforms]; }

  // Which of POINT_MODES there are values for.
  modes() {
    return Object.keys(POINT_MODES).filter((name) => name === 'height' ||
      (name === 'intensity' && this.entry.intensity) ||
      (name === 'time' && this.entry.moments_s.length > 1));
  }

  setMode(name) {
    this.mode = name;
    const { index, colors } = POINT_MODES[name];
    this.textures[colors] = this.textures[colors] || colorTexture(this.colorMaps[colors]);
    this.all.material.uniforms.mode.value = index;
    this.all.material.uniforms.colors.value = this.textures[colors];
    this.setCut(this.cut);
  }

  setCut(height) {
    this.cut = height;
    const { low, high } = this.entry.height;
    for (const uniforms of this.uniforms()) {
      uniforms.cut.value = Math.min(height, 1e9);
      uniforms.heights.value.set(low, Math.max(Math.min(high, height), low + 0.01));
    }
  }

  setSize(metres) { for (const uniforms of this.uniforms()) uniforms.size.value = metres; }

  setPixelsPerUnit(pixels, ratio) {
    for (const uniforms of this.uniforms()) uniforms.pixelsPerUnit.value = pixels;
    this.all.material.uniforms.leastPixels.value = 2.2 * ratio;
    this.scan.material.uniforms.leastPixels.value = 4 * ratio;
  }

  // The moment that began last before `t_s`.
  momentAt(t_s) {
    const moments = this.entry.moments_s;
    let low = 0, high = moments.length - 1;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (moments[middle] <= t_s + 1e-3) low = middle; else high = middle - 1;
    }
    return low;
  }

  setTime(t_s, showScan, onlySeen) {
    const has = this.entry.moments_s.length > 0;
    const moment = has ? this.momentAt(t_s) : 0;
    this.all.material.uniforms.untilMoment.value = has && onlySeen ? moment + 0.5 : 1e9;
    this.scan.visible = has && showScan;
    this.all.material.uniforms.fade.value = this.scan.visible ? 0.55 : 0;
    if (!has) return;
    const begin = this.entry.first[moment];
    this.scan.geometry.setDrawRange(begin, this.entry.first[moment + 1] - begin);
  }

  // Draws only this share of the points: enough while the picture moves.
  setShare(share) {
    this.all.geometry.setDrawRange(0, Math.ceil(share * this.entry.count));
  }

  // What the legend says.
  scale() {
    const { label, unit, colors } = POINT_MODES[this.mode];
    const heights = this.all.material.uniforms.heights.value;
    const moments = this.entry.moments_s;
    const [low, high] = this.mode === 'height' ? [heights.x, heights.y]
      : this.mode === 'time' ? [moments[0], moments[moments.length - 1]]
      : [this.entry.intensity.low, this.entry.intensity.high];
    return { label, unit, colors: this.colorMaps[colors], low, high };
  }

  // A box around all points but the outermost of each axis.
  mostOf(arrays) {
    const { corner, step_m } = this.entry;
    const ends = ['x', 'y', 'z'].map((axis, k) => {
      const sorted = arrays[`cloud_${axis}`].filter((_, i) => i % 50 === 0).sort();
      return [0.02, 0.98].map((share) =>
        corner[k] + step_m * sorted[Math.floor(share * (sorted.length - 1))]);
    });
    return new THREE.Box3(new THREE.Vector3(...ends.map((pair) => pair[0])),
                          new THREE.Vector3(...ends.map((pair) => pair[1])));
  }

  place(i) {
    const { corner, step_m } = this.entry;
    const { cloud_x, cloud_y, cloud_z } = this.arrays;
    return [corner[0] + step_m * cloud_x[i], corner[1] + step_m * cloud_y[i],
            corner[2] + step_m * cloud_z[i]];
  }
}
