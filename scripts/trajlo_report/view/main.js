// SPDX-License-Identifier: MIT
// Puts the view together, and draws it whenever something changed.

class View {
  constructor(root, page, arrays) {
    this.root = root;
    this.page = page;
    this.canvas = root.querySelector('.stage canvas');
    this.stage = root.querySelector('.stage');
    this.labels = root.querySelector('.labels');
    this.renderer = this.makeRenderer();
    this.shading = new Shading(this.renderer);
    this.points = new THREE.Scene();
    this.drawing = new THREE.Scene();
    this.cloud = page.cloud ? new Cloud(page.cloud, arrays, page.colors) : null;
    if (this.cloud) this.points.add(this.cloud.all, this.cloud.scan);
    this.path = new Path(page, arrays, page.colors);
    this.drawing.add(this.path.lines.group);
    this.viewer = new Viewer(this.canvas, this.boxOfInterest(arrays), () => this.redraw());
    this.addScenery();
    this.settings = { scan: false, seen: false, follow: false, grid: true };
    this.timeline = new Timeline(root.querySelector('.time'), this.path,
      (time, byHand) => this.moveTo(time, byHand));
    this.share = 1;
    this.gl = this.renderer.getContext();
    makePanel(this);
    this.canvas.addEventListener('dblclick', (event) => this.turnAround(event));
    new ResizeObserver(() => this.resize()).observe(this.stage);
    this.resize();
    this.viewer.look('3-D');
    this.timeline.set(0, false);
    requestAnimationFrame((now) => this.tick(now));
  }

  makeRenderer() {
    const options = { alpha: true, antialias: true, powerPreference: 'high-performance' };
    const context = this.canvas.getContext('webgl2', options);
    if (!context) throw new Error('this browser offers no WebGL 2');
    const renderer = new THREE.WebGLRenderer({ canvas: this.canvas, context, ...options });
    renderer.setClearColor(0xffffff, 0);
    renderer.autoClear = false;
    return renderer;
  }

  // Path and truth, and most of the points: single far ones must not make the rest small.
  boxOfInterest(arrays) {
    const box = new THREE.Box3();
    const at = new THREE.Vector3();
    for (const places of [this.path.places, arrays.truth_xyz || []]) {
      for (let i = 0; i < places.length; i += 3) {
        if (Number.isFinite(places[i])) box.expandByPoint(at.fromArray(places, i));
      }
    }
    return this.cloud ? box.union(this.cloud.mostOf(arrays)) : box.expandByScalar(1);
  }

  // A grid on the ground, the axes at the origin, and those of the body at the moment.
  addScenery() {
    const size = this.viewer.box.getSize(new THREE.Vector3());
    const center = this.viewer.box.getCenter(new THREE.Vector3());
    const reach = 0.7 * Math.max(size.x, size.y);
    this.cell = roundDown(reach / 5);
    const cells = 2 * Math.ceil(reach / this.cell);
    this.grid = new THREE.GridHelper(cells * this.cell, cells, PLAIN.grid, PLAIN.grid);
    this.grid.rotation.x = Math.PI / 2;
    const ground = this.cloud ? this.cloud.entry.height.low : this.viewer.box.min.z;
    this.grid.position.set(this.cell * Math.round(center.x / this.cell),
      this.cell * Math.round(center.y / this.cell), ground - 0.02 * size.z);
    this.grid.material.transparent = true;
    this.grid.material.opacity = 0.7;
    this.grid.renderOrder = -1;
    this.drawing.add(this.grid);
    const unit = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => new THREE.Vector3(...axis));
    const arm = roundDown(Math.max(this.viewer.radius / 8, 0.2));
    this.axes = new AxesCross(this.path.lines, arm, 3, false);
    this.axes.place(new THREE.Vector3(), unit);
    this.body = new AxesCross(this.path.lines, this.viewer.radius / 25, 4, true);
    this.axisLabels = ['x', 'y', 'z'].map((name) => element('span', {}, name));
    this.labels.append(...this.axisLabels);
  }

  changed() {
    updateLegend(this);
    this.redraw();
  }

  moveTo(time, byHand) {
    const pose = this.path.poseAt(time);
    if (this.settings.follow && this.lastPlace) {
      this.viewer.move(pose.at.clone().sub(this.lastPlace));
    }
    this.lastPlace = pose.at;
    // Whoever moves the slider for the first time wants to see the scan.
    if (byHand && this.scanBox && !this.wasMoved) {
      this.wasMoved = true;
      this.settings.scan = this.scanBox.checked = true;
    }
    this.body.place(pose.at, pose.axes);
    if (this.cloud) this.cloud.setTime(time, this.settings.scan, this.settings.seen);
    this.timeline.say(this.words(time, pose));
    this.changed();
  }

  words(time, pose) {
    const place = pose.at.toArray().map((value, k) => (value + this.page.origin[k]).toFixed(2));
    const values = this.path.quantities.map((item) => {
      const value = this.path.valueAt(item.key, pose.index);
      const text = Number.isFinite(value) ? value.toFixed(item.digits) : '–';
      return `${item.label} ${text} ${item.unit}`;
    });
    const flags = this.path.flagsAt(time);
    return [`${time.toFixed(2)} s of ${this.path.duration().toFixed(2)} s`,
            `at (${place.join(', ')}) m`, ...values,
            ...(flags.length ? [`flagged: ${flags.join(', ')}`] : [])].join('  ·  ');
  }

  turnAround(event) {
    if (!this.cloud) return;
    const frame = this.canvas.getBoundingClientRect();
    const point = this.viewer.pick(this.cloud, event.clientX - frame.left,
      event.clientY - frame.top, frame.width);
    if (!point) return;
    this.viewer.move(point.clone().sub(this.viewer.controls.target));
    const place = point.toArray().map((value, k) => (value + this.page.origin[k]).toFixed(2));
    this.root.querySelector('.hint').textContent = `turning around (${place.join(', ')}) m`;
  }

  resize() {
    const width = this.stage.clientWidth, height = this.stage.clientHeight;
    if (!width || !height) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.shading.setSize(width, height, ratio);
    const panel = this.root.querySelector('.panel');
    this.viewer.setSize(width, height, panel.open && width > 800 ? panel.offsetWidth : 0);
    this.path.lines.setResolution(width, height);
    if (this.cloud) this.cloud.setPixelsPerUnit(this.viewer.pixelsPerUnit() * ratio, ratio);
    this.timeline.draw();
    this.redraw();
  }

  redraw() {
    this.dirty = true;
    this.lastChange = performance.now();
  }

  // While the picture moves, as many points as the machine can turn; all of them when it rests.
  tick(now) {
    requestAnimationFrame((next) => this.tick(next));
    if (this.drawnSince !== undefined && !this.isDrawn(now)) return;
    const moving = now - this.lastChange < 250;
    if (!this.dirty) return;
    this.draw(moving ? this.share : 1);
    this.dirty = moving && this.share < 1;
    if (!moving) return;
    this.drawnSince = now;
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
  }

  // Whether the graphics card is done with the last picture; learns from how long that took.
  isDrawn(now) {
    if (this.gl.clientWaitSync(this.fence, 0, 0) === this.gl.TIMEOUT_EXPIRED) return false;
    this.gl.deleteSync(this.fence);
    const took_ms = now - this.drawnSince;
    this.drawnSince = undefined;
    if (took_ms > 50) this.share = Math.max(0.04, this.share * Math.max(0.5, 40 / took_ms));
    if (took_ms < 25) this.share = Math.min(1, 1.15 * this.share);
    return true;
  }

  draw(share) {
    if (this.cloud) this.cloud.setShare(share);
    this.viewer.update();
    this.path.lines.setResolution(this.stage.clientWidth, this.stage.clientHeight);
    this.shading.render(this.points, this.viewer.camera);
    this.renderer.render(this.drawing, this.viewer.camera);
    this.drawLabels();
  }

  drawLabels() {
    const width = this.stage.clientWidth;
    this.axisLabels.forEach((label, k) => {
      const at = this.settings.grid ? this.viewer.project(this.axes.ends[k], width) : null;
      label.style.display = at ? '' : 'none';
      if (at) label.style.transform = `translate(${at[0] + 4}px, ${at[1] - 8}px)`;
    });
    const pixels = this.viewer.pixelsPerUnit() / this.viewer.distance();
    const length = roundDown(140 / pixels);
    const scale = this.root.querySelector('.scale');
    scale.style.width = `${length * pixels}px`;
    scale.textContent = lengthText(length);
  }
}

async function startView() {
  const root = document.getElementById('view');
  const message = root.querySelector('.message');
  const begin = performance.now();
  try {
    const page = JSON.parse(document.getElementById('view-description').textContent);
    const arrays = await readArrays(document.getElementById('view-arrays').textContent.trim(),
      page.arrays);
    const view = new View(root, page, arrays);
    view.draw(1);
    message.remove();
    view.load_ms = performance.now() - begin;
    root.view = view;
    root.dataset.state = 'ready';
  } catch (error) {
    message.textContent = `The 3-D view cannot be shown: ${error.message}.`;
    root.dataset.state = 'failed';
    console.warn(error);
  }
}

startView();
