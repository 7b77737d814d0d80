// SPDX-License-Identifier: MIT
// The parts that controls and legend are made of.

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

function row(kind, label, ...parts) {
  return element('label', { className: `row ${kind}` }, element('span', {}, label), ...parts);
}

function choice(label, names, onChange, texts = names) {
  const select = element('select', { onchange: () => onChange(select.value) },
    ...names.map((name, i) => element('option', { value: name, textContent: texts[i] })));
  return { row: row('', label, select), select };
}

function check(label, checked, onChange) {
  const onchange = () => onChange(box.checked);
  const box = element('input', { type: 'checkbox', checked, onchange });
  return { row: row('check', label, box), box };
}

function slide(label, low, high, value, textOf, onChange) {
  const text = element('output', {}, textOf(value));
  const oninput = () => {
    text.textContent = textOf(Number(input.value));
    onChange(Number(input.value));
  };
  const input = element('input', {
    type: 'range', min: low, max: high, step: (high - low) / 500, oninput });
  input.value = value;
  return { row: row('slide', label, text, input), input };
}

function heading(text) { return element('h4', {}, text); }

function bar({ label, unit, colors, low, high, is_log }) {
  const middle = is_log ? Math.sqrt(low * high) : (low + high) / 2;
  const textOf = is_log ? (value) => numberText(value, 2)
    : (value) => value.toFixed(decimalsOf(low, high)).replace(/^-(0\.?0*)$/, '$1');
  const ticks = [low, middle, high].map((value) => element('span', {}, textOf(value)));
  return element('div', { className: 'bar' },
    element('div', { className: 'name' }, unit ? `${label} [${unit}]` : label),
    element('div', { className: 'colors', style: `background: ${gradient(colors)}` }),
    element('div', { className: 'ticks' }, ...ticks));
}

function mark(color, text, kind = 'line') {
  return element('div', { className: 'mark' },
    element('i', { className: kind, style: `background: ${color}` }), text);
}
