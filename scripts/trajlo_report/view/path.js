// SPDX-License-Identifier: MIT
// The trajectory with its colours, the truth, flagged stretches, and the sensor at the moment.

class Path {
  constructor(page, arrays, colorMaps) {
    this.times = arrays.path_t;
    this.places = arrays.path_xyz;
    this.rotations = arrays.path_rotation;
    this.quantities = page.path.quantities;
    this.flags = page.flags;
    this.arrays = arrays;
    this.colorMaps = colorMaps;
    this.lines = new Lines();
    this.segments = segmentsOf(this.places);
    this.halo = this.lines.add(this.segments.places, { color: '#ffffff', width: 9.5, order: 2 });
    // What is behind walls shines through.
    this.ghost = this.lines.add(this.segments.places,
      { color: PLAIN.path, width: 2.5, opacity: 0.3, onTop: true, order: 0 });
    this.addFlags();
    // Below the coloured path: an outline where both agree.
    this.addTruth();
    this.addEnds();
    this.setQuantity(this.quantities.length ? this.quantities[0].key : '');
  }

  duration() { return this.times[this.times.length - 1]; }

  quantity(key) { return this.quantities.find((item) => item.key === key); }

  shareOf(item, value) {
    if (!item.is_log) return (value - item.low) / (item.high - item.low);
    return Math.log(value / item.low) / Math.log(item.high / item.low);
  }

  colorOf(item, value) {
    if (!item) return new THREE.Color(PLAIN.path);
    if (!Number.isFinite(value)) return new THREE.Color(PLAIN.unknown);
    return colorAt(this.colorMaps[item.colors], this.shareOf(item, value));
  }

  setQuantity(key) {
    this.key = key;
    const item = this.quantity(key);
    const values = item ? this.arrays[`path_${key}`] : null;
    const colors = this.segments.indices.flatMap((i) =>
      this.colorOf(item, values ? values[i] : 0).toArray());
    if (this.colored) {
      this.lines.group.remove(this.colored);
      this.colored.geometry.dispose();
      this.lines.materials.splice(this.lines.materials.indexOf(this.colored.material), 1);
    }
    this.colored = this.lines.add(this.segments.places, { colors, width: 4.2, order: 4 });
  }

  addFlags() {
    const places = [];
    for (const stretch of this.flags) {
      const begin = Math.max(this.indexAt(stretch.from), 0);
      const end = Math.max(this.indexAt(stretch.to), begin + 1);
      places.push(...segmentsOf(this.places, begin,
        Math.min(end, this.times.length - 1) + 1).places);
    }
    this.flagged = places.length
      ? this.lines.add(places, { color: PLAIN.flag, width: 17, opacity: 0.8, order: 1 }) : null;
  }

  addTruth() {
    if (!this.arrays.truth_xyz) return;
    const { places } = segmentsOf(this.arrays.truth_xyz);
    this.truth = this.lines.add(places, { color: PLAIN.truth, width: 6.5, order: 3 });
  }

  addEnds() {
    const last = this.times.length - 1;
    for (const [index, color] of [[0, PLAIN.start], [last, PLAIN.end]]) {
      const place = Array.from(this.places.subarray(3 * index, 3 * index + 3));
      // A line without length is a disc.
      const dot = [...place, place[0], place[1], place[2] + 1e-4];
      this.lines.add(dot, { color: '#ffffff', width: 17, order: 5, onTop: true });
      this.lines.add(dot, { color, width: 12, order: 6, onTop: true });
    }
  }

  // The pose that came last before t_s.
  indexAt(t_s) {
    let low = 0, high = this.times.length - 1;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.times[middle] <= t_s) low = middle; else high = middle - 1;
    }
    return low;
  }

  poseAt(t_s) {
    const i = this.indexAt(t_s);
    const next = Math.min(i + 1, this.times.length - 1);
    const span = this.times[next] - this.times[i];
    const share = span > 0 ? Math.min(Math.max((t_s - this.times[i]) / span, 0), 1) : 0;
    const at = new THREE.Vector3().fromArray(this.places, 3 * i)
      .lerp(new THREE.Vector3().fromArray(this.places, 3 * next), share);
    const r = this.rotations.subarray(9 * i, 9 * i + 9);
    const axes = [0, 1, 2].map((k) => new THREE.Vector3(r[k], r[3 + k], r[6 + k]));
    return { at, index: i, axes };
  }

  valueAt(key, index) { return this.arrays[`path_${key}`][index]; }

  flagsAt(t_s) {
    const names = this.flags.filter((item) => item.from <= t_s && t_s <= item.to)
      .flatMap((item) => item.names);
    return [...new Set(names)];
  }

  // "not converged 2×, gap 1×"
  flagCounts() {
    const counts = {};
    for (const name of this.flags.flatMap((item) => item.names)) {
      counts[name] = (counts[name] || 0) + 1;
    }
    return Object.entries(counts).map(([name, count]) => `${name} ${count}×`).join(', ');
  }
}

// Three arms, red, green and blue, along x, y and z.
class AxesCross {
  constructor(lines, length, width, onTop) {
    const colors = ['#d1242f', '#1a7f37', '#0969da'];
    this.arms = colors.map((color) =>
      lines.add([0, 0, 0, 0, 0, 1], { color, width, onTop, order: 7 }));
    this.length = length;
  }

  place(at, axes) {
    this.ends = axes.map((axis) => at.clone().addScaledVector(axis, this.length));
    this.arms.forEach((arm, k) => {
      arm.geometry.setPositions([...at.toArray(), ...this.ends[k].toArray()]);
    });
  }

  show(visible) { for (const arm of this.arms) arm.visible = visible; }
}
