// SPDX-License-Identifier: MIT
// Where the viewer stands.

const DIRECTIONS = {
  '3-D': [-0.55, -0.85, 0.75], 'Top': [0, -1e-4, 1],
  'Along y': [0, -1, 0.02], 'Along x': [-1, 0, 0.02],
};

class Viewer {
  constructor(canvas, box, redraw) {
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.1, 1000);
    this.camera.up.set(0, 0, 1);
    this.box = box;
    this.radius = box.getSize(new THREE.Vector3()).length() / 2;
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.screenSpacePanning = true;
    this.controls.rotateSpeed = 0.8;
    this.controls.minDistance = 0.2;
    this.controls.maxDistance = 20 * this.radius;
    this.controls.addEventListener('change', redraw);
  }

  // `covered`: pixels at the right that show something else; the middle is that of the rest.
  setSize(width, height, covered) {
    this.height = height;
    this.camera.aspect = (width + covered) / height;
    this.camera.setViewOffset(width + covered, height, covered, 0, width, height);
    this.free_aspect = (width - covered) / height;
  }

  // Stands where the whole box fits into the picture, looking against `direction`.
  look(name) {
    const direction = new THREE.Vector3(...DIRECTIONS[name]).normalize();
    const center = this.box.getCenter(new THREE.Vector3());
    this.controls.target.copy(center);
    this.camera.position.copy(center).add(direction);
    this.camera.lookAt(center);
    this.camera.updateMatrixWorld();
    const tan = Math.tan(THREE.Math.degToRad(this.camera.fov / 2));
    let distance = 0.5;
    for (const corner of this.corners()) {
      // In the camera's axes, from the centre.
      const p = corner.sub(center).applyQuaternion(this.camera.quaternion.clone().conjugate());
      distance = Math.max(distance, p.z + Math.abs(p.y) / tan,
        p.z + Math.abs(p.x) / (tan * this.free_aspect));
    }
    this.camera.position.copy(center).addScaledVector(direction, 1.03 * distance);
    this.controls.update();
  }

  corners() {
    const { min, max } = this.box;
    return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new THREE.Vector3(
      i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z));
  }

  move(step) {
    this.controls.target.add(step);
    this.camera.position.add(step);
    this.controls.update();
  }

  distance() { return this.camera.position.distanceTo(this.controls.target); }

  // Near and far planes around what is looked at.
  update() {
    const distance = this.distance();
    this.camera.near = Math.max(distance / 200, 0.02);
    this.camera.far = distance + 12 * this.radius + 10;
    this.camera.updateProjectionMatrix();
  }

  pixelsPerUnit() { return this.height / (2 * Math.tan(THREE.Math.degToRad(this.camera.fov / 2))); }

  // On the screen, in pixels from the left and the top; nothing if it is behind the camera.
  project(point, width) {
    const p = point.clone().project(this.camera);
    return p.z < 1 ? [(0.5 + 0.5 * p.x) * width, (0.5 - 0.5 * p.y) * this.height] : null;
  }

  // The nearest point of the cloud within a few pixels of (x, y).
  pick(cloud, x, y, width) {
    this.camera.updateMatrixWorld();
    const m = new THREE.Matrix4().multiplyMatrices(
      this.camera.projectionMatrix, this.camera.matrixWorldInverse).elements;
    const reach = 7;
    let best = null, nearest = Infinity;
    for (let i = 0; i < cloud.entry.count; ++i) {
      const [px, py, pz] = cloud.place(i);
      if (pz > cloud.cut) continue;
      const w = m[3] * px + m[7] * py + m[11] * pz + m[15];
      if (w <= this.camera.near || w >= nearest) continue;
      const sx = (0.5 + 0.5 * (m[0] * px + m[4] * py + m[8] * pz + m[12]) / w) * width;
      const sy = (0.5 - 0.5 * (m[1] * px + m[5] * py + m[9] * pz + m[13]) / w) * this.height;
      if (Math.abs(sx - x) > reach || Math.abs(sy - y) > reach) continue;
      [best, nearest] = [new THREE.Vector3(px, py, pz), w];
    }
    return best;
  }
}
