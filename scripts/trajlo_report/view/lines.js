// SPDX-License-Identifier: MIT
// Lines of a width in pixels.

// Pairs of points: neighbours in `xyz`, without those next to a hole (NaN).
function segmentsOf(xyz, begin = 0, end = xyz.length / 3) {
  const places = [], indices = [];
  for (let i = begin; i + 1 < end; ++i) {
    const pair = Array.from(xyz.subarray(3 * i, 3 * i + 6));
    if (!pair.every(Number.isFinite)) continue;
    places.push(...pair);
    indices.push(i, i + 1);
  }
  return { places, indices };
}

class Lines {
  constructor() {
    this.group = new THREE.Group();
    this.materials = [];
  }

  // `colors` holds r, g, b for each of the places; without it all are `color`.
  add(places, { color = PLAIN.text, width = 2, colors = null, opacity = 1, order = 0,
                onTop = false, dash = 0 } = {}) {
    const geometry = new THREE.LineSegmentsGeometry();
    geometry.setPositions(places);
    if (colors) geometry.setColors(colors);
    const material = new THREE.LineMaterial({
      color: colors ? 0xffffff : new THREE.Color(color), linewidth: width,
      vertexColors: colors ? THREE.VertexColors : THREE.NoColors,
      // Lines hide each other by their order, and points hide lines by their depth.
      transparent: true, opacity, depthTest: !onTop, depthWrite: false });
    if (dash) {
      material.dashed = true;
      material.defines.USE_DASH = '';
      material.dashSize = dash;
      material.gapSize = 0.6 * dash;
    }
    const lines = new THREE.LineSegments2(geometry, material);
    if (dash) lines.computeLineDistances();
    lines.frustumCulled = false;
    lines.renderOrder = order;
    this.materials.push(material);
    this.group.add(lines);
    return lines;
  }

  setResolution(width, height) {
    for (const material of this.materials) material.resolution.set(width, height);
  }
}
