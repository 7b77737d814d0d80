// SPDX-License-Identifier: MIT
// Under the picture: what the path is coloured by, over time, and the moment.

class Timeline {
  constructor(root, path, onChange) {
    this.path = path;
    this.slider = root.querySelector('input');
    this.strip = root.querySelector('canvas');
    this.button = root.querySelector('button');
    this.readout = root.querySelector('output');
    this.onChange = onChange;
    this.duration = path.duration();
    this.time = 0;
    this.slider.max = this.duration;
    this.slider.step = this.duration / 2000;
    this.slider.addEventListener('input', () => this.set(Number(this.slider.value), true));
    this.button.addEventListener('click', () => this.play(!this.playing));
    this.strip.addEventListener('pointerdown', (event) => this.seek(event));
    this.strip.addEventListener('pointermove', (event) => { if (event.buttons) this.seek(event); });
  }

  seek(event) {
    const frame = this.strip.getBoundingClientRect();
    const share = (event.clientX - frame.left) / frame.width;
    this.set(Math.min(Math.max(share, 0), 1) * this.duration, true);
  }

  // `byHand`: the reader wants it.
  set(time, byHand) {
    this.time = time;
    this.slider.value = time;
    this.draw();
    this.onChange(time, byHand);
  }

  play(start) {
    this.playing = start;
    this.button.textContent = start ? '❚❚' : '►';
    this.button.title = start ? 'Stop' : 'Play';
    if (!start) return;
    if (this.time >= this.duration) this.time = 0;
    // In real time, but no run for longer than a minute.
    const rate = Math.max(1, this.duration / 60);
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      const time = this.time + rate * Math.min(now - before, 200) / 1000;
      before = now;
      this.set(Math.min(time, this.duration), true);
      if (time >= this.duration) this.play(false); else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  draw() {
    const ratio = window.devicePixelRatio || 1;
    const width = this.strip.clientWidth, height = this.strip.clientHeight;
    this.strip.width = width * ratio;
    this.strip.height = height * ratio;
    const pen = this.strip.getContext('2d');
    pen.scale(ratio, ratio);
    this.drawValues(pen, width, height);
    pen.fillStyle = `${PLAIN.flag}55`;
    for (const stretch of this.path.flags) {
      const begin = width * stretch.from / this.duration;
      pen.fillRect(begin - 1, 0, Math.max(width * stretch.to / this.duration - begin, 2), height);
    }
    this.drawName(pen);
    pen.fillStyle = PLAIN.text;
    pen.fillRect(width * this.time / this.duration - 1, 0, 2, height);
  }

  drawValues(pen, width, height) {
    const item = this.path.quantity(this.path.key);
    if (!item) return;
    for (let x = 0; x < width; ++x) {
      const index = this.path.indexAt(this.duration * (x + 0.5) / width);
      const value = this.path.valueAt(item.key, index);
      if (!Number.isFinite(value)) continue;
      const share = Math.min(Math.max(this.path.shareOf(item, value), 0), 1);
      pen.fillStyle = `#${this.path.colorOf(item, value).getHexString()}`;
      pen.fillRect(x, height, 1, -(2 + (height - 3) * share));
    }
  }

  drawName(pen) {
    const item = this.path.quantity(this.path.key);
    if (!item) return;
    const text = `${item.label} [${item.unit}]`;
    pen.font = '11px "DejaVu Sans", system-ui, sans-serif';
    pen.fillStyle = '#ffffffcc';
    pen.fillRect(0, 0, pen.measureText(text).width + 8, 15);
    pen.fillStyle = PLAIN.quiet;
    pen.fillText(text, 4, 11);
  }

  say(text) { this.readout.textContent = text; }
}
