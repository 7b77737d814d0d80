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
    this.timeline = new Timeline(root.querySelector('.time'), this.path, (t) => this.moveTo(t));
    this.share = 1;
    this.gl = this.renderer.getContext();
    this.makePanel();
    this.canvas.addEventListener('dblclick', (event) => this.turnAround(event));
    new ResizeObserver(() => this.resize()).observe(this.stage);
    this.resize();
    this.viewer.look('3-D');
    this.timeline.set(0);
    this.settings.touched = true;  // from here on it is the reader who moves the slider
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

  // The path, and most of the points: single far ones must not make the rest small.
  boxOfInterest(arrays) {
    const box = new THREE.Box3();
    const at = new THREE.Vector3();
    for (let i = 0; i < this.path.times.length; ++i) {
      box.expandByPoint(at.fromArray(this.path.places, 3 * i));
    }
    if (!this.cloud) return box.expandByScalar(1);
    const { corner, step_m } = this.cloud.entry;
    const bounds = ['x', 'y', 'z'].map((axis, k) => {
      const sorted = arrays[`cloud_${axis}`].filter((_, i) => i % 50 === 0).sort();
      const at = (share) => corner[k] + step_m * sorted[Math.floor(share * (sorted.length - 1))];
      return [at(0.02), at(0.98)];
    });
    box.expandByPoint(new THREE.Vector3(...bounds.map((pair) => pair[0])));
    box.expandByPoint(new THREE.Vector3(...bounds.map((pair) => pair[1])));
    return box;
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
    this.axes.place(new THREE.Vector3().fromArray(this.page.origin).negate(), unit);
    this.body = new AxesCross(this.path.lines, this.viewer.radius / 25, 4, true);
    this.axisLabels = ['x', 'y', 'z'].map((name) => element('span', {}, name));
    this.labels.append(...this.axisLabels);
  }

  makePanel() {
    const panel = this.root.querySelector('.panel');
    panel.open = this.stage.clientWidth > 700;
    panel.addEventListener('toggle', () => this.resize());
    panel.append(...this.pointControls(), ...this.pathControls(), ...this.momentControls(),
      ...this.viewControls());
    this.updateLegend();
  }

  pointControls() {
    if (!this.cloud) return [];
    const modes = this.cloud.modes();
    const color = choice('colour', modes, (name) => {
      this.cloud.setMode(name);
      this.changed();
    }, modes.map((name) => POINT_MODES[name].label));
    const { low, high } = this.page.cloud.height;
    const top = high + 0.15 * (high - low);
    const bottom = Math.max(low, this.path.places[2] - 0.5 * (high - low));
    const heightOf = (value) => (value >= top - 1e-6 ? Infinity : value);
    const cut = slide('hide above', bottom, top,
      Math.min(this.page.cloud.ceiling_m === null ? top : this.page.cloud.ceiling_m, top),
      (value) => (heightOf(value) === Infinity ? 'nothing' : `${value.toFixed(1)} m`),
      (value) => { this.cloud.setCut(heightOf(value)); this.changed(); });
    this.cloud.setCut(heightOf(Number(cut.input.value)));
    const spacing = this.viewer.radius / 400;
    const size = slide('point size', -1.5, 1.5, 0, (value) => lengthText(spacing * 2 ** value),
      (value) => { this.cloud.setSize(spacing * 2 ** value); this.redraw(); });
    this.cloud.setSize(spacing);
    return [heading('Points'), color.row, cut.row, size.row];
  }

  pathControls() {
    const keys = [...this.path.quantities.map((item) => item.key), ''];
    const color = choice('colour', keys, (key) => {
      this.path.setQuantity(key);
      this.changed();
      this.timeline.draw();
    }, [...this.path.quantities.map((item) => item.label), 'none']);
    const rows = [heading('Path'), color.row];
    const switches = [['truth', this.path.truth], ['flagged stretches', this.path.flagged]];
    for (const [label, lines] of switches) {
      if (!lines) continue;
      rows.push(check(label, true, (on) => { lines.visible = on; this.redraw(); }).row);
    }
    return rows;
  }

  momentControls() {
    const set = (name) => (on) => {
      this.settings[name] = on;
      this.moveTo(this.timeline.time);
    };
    const rows = [heading('Moment')];
    if (this.cloud && this.page.cloud.moments_s.length) {
      this.scanBox = check('scan in its place', false, set('scan'));
      rows.push(this.scanBox.row, check('only what was seen by then', false, set('seen')).row);
    }
    rows.push(check('follow the sensor', false, set('follow')).row);
    return rows;
  }

  viewControls() {
    const buttons = Object.keys(DIRECTIONS).map((name) => element('button', {
      textContent: name, onclick: () => { this.viewer.look(name); this.redraw(); } }));
    const full = element('button', { textContent: 'Full screen', onclick: () => {
      if (document.fullscreenElement) document.exitFullscreen();
      else this.root.requestFullscreen();
    } });
    const grid = check(`grid of ${lengthText(this.cell)}, axes of ${lengthText(this.axes.length)}`,
      true, (on) => {
        this.settings.grid = on;
        this.grid.visible = on;
        this.axes.show(on);
        this.redraw();
      });
    return [heading('View'), element('div', { className: 'buttons' }, ...buttons, full), grid.row];
  }

  updateLegend() {
    const legend = this.root.querySelector('.legend');
    legend.textContent = '';
    if (this.cloud) {
      const scale = this.cloud.scale();
      legend.append(bar({ ...scale, label: `points: ${scale.label}` }));
    }
    const item = this.path.quantity(this.path.key);
    if (item) {
      legend.append(bar({ ...item, label: `path: ${item.label}`,
                          colors: this.page.colors[item.colors] }));
    }
    legend.append(element('div', { className: 'marks' },
      mark(PLAIN.start, 'start', 'dot'), mark(PLAIN.end, 'end', 'dot'),
      ...(this.path.truth ? [mark(PLAIN.truth, 'truth')] : []),
      ...(this.path.flagged ? [mark(PLAIN.flag, `flagged: ${this.path.flagCounts()}`, 'band')] : []),
      ...(this.cloud && this.cloud.scan.visible ? [mark(PLAIN.scan, 'scan at the moment', 'dot')]
                                                : [])));
  }

  changed() {
    this.updateLegend();
    this.redraw();
  }

  moveTo(time) {
    const pose = this.path.poseAt(time);
    if (this.settings.follow && this.lastPlace) {
      this.viewer.move(pose.at.clone().sub(this.lastPlace));
    }
    this.lastPlace = pose.at;
    // Whoever moves the slider wants to see the scan.
    if (this.settings.touched && this.scanBox && !this.settings.untouchedScan) {
      this.settings.untouchedScan = true;
      this.settings.scan = this.scanBox.box.checked = true;
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
      return `${item.label} ${Number.isFinite(value) ? value.toFixed(item.digits) : '–'} ${item.unit}`;
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
    this.drawnSince = moving ? now : undefined;
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
  }

  // Whether the graphics card is done with the last picture; learns from how long that took.
  isDrawn(now) {
    if (this.gl.clientWaitSync(this.fence, 0, 0) === this.gl.TIMEOUT_EXPIRED) return false;
    this.gl.deleteSync(this.fence);
    this.frame_ms = now - this.drawnSince;
    this.drawnSince = undefined;
    if (this.frame_ms > 50) this.share = Math.max(0.04, this.share * Math.max(0.5, 40 / this.frame_ms));
    if (this.frame_ms < 25) this.share = Math.min(1, 1.15 * this.share);
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
