// SPDX-License-Identifier: MIT
// What the panel at the right controls, and what the legend says.

function makePanel(view) {
  const panel = view.root.querySelector('.panel');
  panel.open = view.stage.clientWidth > 700;
  panel.addEventListener('toggle', () => view.resize());
  if (view.cloud) panel.append(heading('Points'), ...pointControls(view, view.cloud));
  panel.append(heading('Path'), ...pathControls(view, view.path),
    heading('Moment'), ...momentControls(view), heading('View'), ...viewControls(view));
}

function pointControls(view, cloud) {
  const modes = cloud.modes();
  const color = choice('colour', modes, (name) => {
    cloud.setMode(name);
    view.changed();
  }, modes.map((name) => POINT_MODES[name].label));
  const size_m = view.viewer.radius / 400;
  const size = slide('point size', -1.5, 1.5, 0, (value) => lengthText(size_m * 2 ** value),
    (value) => { cloud.setSize(size_m * 2 ** value); view.redraw(); });
  cloud.setSize(size_m);
  return [color.row, cutControl(view, cloud), size.row];
}

// From half way down from the start to above everything, where nothing is hidden.
function cutControl(view, cloud) {
  const { low, high } = cloud.entry.height;
  const top = high + 0.15 * (high - low);
  const bottom = Math.max(low, view.path.places[2] - 0.5 * (high - low));
  const ceiling = cloud.entry.ceiling_m;
  const cutOf = (value) => (value >= top - 1e-6 ? Infinity : value);
  const cut = slide('hide above', bottom, top, ceiling === null ? top : Math.min(ceiling, top),
    (value) => (cutOf(value) === Infinity ? 'nothing' : `${value.toFixed(1)} m`),
    (value) => { cloud.setCut(cutOf(value)); view.changed(); });
  cloud.setCut(cutOf(Number(cut.input.value)));
  return cut.row;
}

function pathControls(view, path) {
  const color = choice('colour', [...path.quantities.map((item) => item.key), ''], (key) => {
    path.setQuantity(key);
    view.changed();
    view.timeline.draw();
  }, [...path.quantities.map((item) => item.label), 'none']);
  const switches = [['truth', path.truth], ['flagged stretches', path.flagged]];
  return [color.row, ...switches.filter(([, lines]) => lines).map(([label, lines]) =>
    check(label, true, (on) => { lines.visible = on; view.redraw(); }).row)];
}

function momentControls(view) {
  const set = (name) => (on) => {
    view.settings[name] = on;
    view.moveTo(view.timeline.time);
  };
  const rows = [check('follow the sensor', false, set('follow')).row];
  if (!view.cloud || !view.cloud.entry.moments_s.length) return rows;
  const scan = check('scan in its place', false, set('scan'));
  view.scanBox = scan.box;
  return [scan.row, check('only what was seen by then', false, set('seen')).row, ...rows];
}

function viewControls(view) {
  const buttons = Object.keys(DIRECTIONS).map((name) => element('button', {
    textContent: name, onclick: () => { view.viewer.look(name); view.redraw(); } }));
  const full = element('button', { textContent: 'Full screen', onclick: () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else view.root.requestFullscreen();
  } });
  const grid = check(`grid of ${lengthText(view.cell)}, axes of ${lengthText(view.axes.length)}`,
    true, (on) => {
      view.settings.grid = view.grid.visible = on;
      view.axes.show(on);
      view.redraw();
    });
  return [element('div', { className: 'buttons' }, ...buttons, full), grid.row];
}

function updateLegend(view) {
  const legend = view.root.querySelector('.legend');
  const { cloud, path } = view;
  legend.textContent = '';
  if (cloud) {
    const scale = cloud.scale();
    legend.append(bar({ ...scale, label: `points: ${scale.label}` }));
  }
  const item = path.quantity(path.key);
  if (item) {
    const colors = view.page.colors[item.colors];
    legend.append(bar({ ...item, label: `path: ${item.label}`, colors }));
  }
  const marks = [mark(PLAIN.start, 'start', 'dot'), mark(PLAIN.end, 'end', 'dot')];
  if (path.truth) marks.push(mark(PLAIN.truth, 'truth'));
  if (path.flagged) marks.push(mark(PLAIN.flag, `flagged: ${path.flagCounts()}`, 'band'));
  if (cloud && cloud.scan.visible) marks.push(mark(PLAIN.scan, 'scan at the moment', 'dot'));
  legend.append(element('div', { className: 'marks' }, ...marks));
}
