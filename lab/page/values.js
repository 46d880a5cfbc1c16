// Sliders: of initial values, which the certificate keeps on M_f, and of the numbers of the system.
import {modify, parseTree} from 'jsonc-parser';
import {element, mathematics} from './dom.js';

const format = {formattingOptions: {insertSpaces: true, tabSize: 2, keepLines: true}};
// So many at once: a page of thousands of sliders takes a browser seconds.
const slidersAtOnce = 24;

// Twelve digits: what is beyond is round-off of the certificate.
export function typed(value) { return Number(value.toPrecision(12)); }

// {"x[0]": 1, "x[1]": 2, "q": 3} as {x: [1, 2], q: 3}.
export function grouped(values) {
  const result = {};
  for (const [name, value] of Object.entries(values)) {
    const [head, ...indices] = name.replace(/\]/g, '').split('[');
    if (indices.length === 0) {
      result[head] = typed(value);
      continue;
    }
    let at = result[head] = result[head] || [];
    for (const index of indices.slice(0, -1)) at = at[Number(index)] = at[Number(index)] || [];
    at[Number(indices[indices.length - 1])] = typed(value);
  }
  return result;
}

// The text in which a key has another value; undefined takes it away.
export function editsOf(text, path, value) { return modify(text, path, value, format); }

function applied(text, edits) {
  for (const {offset, length, content} of [...edits].sort((a, b) => b.offset - a.offset))
    text = text.slice(0, offset) + content + text.slice(offset + length);
  return text;
}

export function withValue(text, path, value) { return applied(text, editsOf(text, path, value)); }

// Arrays of numbers and short objects stay in one line.
export function withCompactValue(text, path, value) {
  const marked = withValue(text, path, '\u0001');
  const compact = JSON.stringify(value, null, 1).replace(/\n\s*/g, ' ').replace(/\[ /g, '[').replace(/ \]/g, ']');
  return marked.replace('"\\u0001"', compact);
}

// The numbers that stand in the system: [{path, value}].
export function numbersOf(text) {
  const tree = parseTree(text), found = [];
  const visit = (node, path) => {
    if (!node) return;
    if (node.type === 'number' && path.length > 1) found.push({path, value: node.value});
    if (node.type === 'array') node.children.forEach((one, i) => visit(one, [...path, i]));
    if (node.type === 'object')
      for (const {children: [key, value]} of node.children)
        if (value && !key.value.startsWith('//') && !(path.length === 1 && /^(equations|structure|manifold|metric)$/.test(key.value))) visit(value, [...path, key.value]);
  };
  const system = tree && tree.children && tree.children.find(({children: [key]}) => key.value === 'system');
  if (system) visit(system.children[1], ['system']);
  return found;
}

function nameOf(path, text) {
  const parts = path.slice(1).filter((part) => part !== 'parameters');
  if (parts[0] === 'elements') {
    const named = parts.reduce((at, part) => ({holder: at.value, value: at.value && at.value[part]}), {value: JSON.parse(text).system}).holder;
    if (named && named.name) return named.name;
  }
  return parts.map((part, i) => typeof part === 'number' ? '[' + part + ']' : (i > 0 ? '_' : '') + part).join('');
}

export class Values {
  // ask(text) → answer of the ladder or null; set(text) puts a text into the editor; ladder(text) redraws.
  constructor(parent, host) {
    this.parent = parent;
    this.host = host;
    this.pinned = new Set();
    this.rows = new Map();
    this.latest = null;
    this.moving = false;
    this.most = slidersAtOnce;
  }

  // Shows the values of an experiment whose ladder is known.
  show(text, answer) {
    if (this.moving) return;
    const point = answer.ladder.consistent_point || {};
    const values = Object.keys(point), title = values.slice(0, slidersAtOnce).join();
    if (title !== this.title) this.most = slidersAtOnce;
    this.title = title;
    this.last = {text, answer};
    const names = values.slice(0, this.most);
    let document_;
    try { document_ = JSON.parse(text); } catch { return; }
    this.pinned = new Set((document_.hold || []).filter((name) => typeof name === 'string'));
    const allNumbers = numbersOf(text), numbers = allNumbers.slice(0, this.most);
    const signature = JSON.stringify([names, numbers.map(({path}) => path)]);
    if (signature !== this.signature) this.build(names, numbers, text);
    this.signature = signature;
    for (const name of names) this.put('start ' + name, point[name]);
    for (const {path, value} of numbers) this.put('number ' + path.join('/'), value);
    for (const name of names) {
      const {pin} = this.rows.get('start ' + name);
      pin.setAttribute('aria-pressed', String(this.isPinned(name)));
    }
    if (answer.ladder.verdict === 'inconsistent') this.parent.classList.add('none'); else this.parent.classList.remove('none');
    this.tellRest(this.restOfNames, names.length, values.length);
    this.tellRest(this.restOfNumbers, numbers.length, allNumbers.length);
  }

  isPinned(name) { return this.pinned.has(name) || this.pinned.has(name.replace(/\[.*/, '')); }

  tellRest(line, shown, count) {
    line.replaceChildren();
    if (shown >= count) return;
    line.append('The first ' + shown + ' of ' + count + '. ', element('button', {type: 'button', class: 'more', onclick: () => {
      this.most += slidersAtOnce;
      this.show(this.last.text, this.last.answer);
    }}, Math.min(slidersAtOnce, count - shown) + ' more'));
  }

  build(names, numbers, text) {
    this.rows.clear();
    this.restOfNames = element('p', {class: 'hint'});
    this.restOfNumbers = element('p', {class: 'hint'});
    const groups = [];
    // Where there is little room long lists are folded.
    const wide = matchMedia('(min-width: 62rem)').matches;
    const group = (title, count, ...content) => element('details', {class: 'group', open: wide || count <= 4}, element('summary', {}, title), ...content);
    if (names.length > 0)
      groups.push(group('Start', names.length,
        element('p', {class: 'hint'}, 'A slider moves its value; the others follow to the nearest point of ', element('i', {}, 'M'), element('sub', {}, element('i', {}, 'f')), '. A held value does not move.'),
        ...names.map((name) => this.row('start ' + name, name, (value) => this.moveStart(name, value), () => this.pin(name))), this.restOfNames));
    if (numbers.length > 0)
      groups.push(group('Parameters', numbers.length,
        ...numbers.map(({path}) => this.row('number ' + path.join('/'), nameOf(path, text), (value) => this.moveNumber(path, value))), this.restOfNumbers));
    this.parent.replaceChildren(...groups);
  }

  row(key, name, move, pin) {
    const slider = element('input', {type: 'range', step: 'any', 'aria-label': name, oninput: () => move(Number(slider.value)), onchange: () => this.settle(key)});
    const number = element('input', {type: 'number', step: 'any', 'aria-label': name + ', the number',
      onchange: () => { if (Number.isFinite(number.valueAsNumber)) { move(number.valueAsNumber); this.settle(key); } }});
    const button = pin && element('button', {type: 'button', class: 'pin', 'aria-pressed': 'false', 'aria-label': 'Hold ' + name, title: 'Hold ' + name, onclick: pin}, 'hold');
    const made = element('div', {class: 'value'}, element('span', {class: 'name', title: name}, mathematics(name)), slider, number, button || '');
    this.rows.set(key, {slider, number, pin: button, centre: null});
    return made;
  }

  put(key, value) {
    const row = this.rows.get(key);
    const {slider, number} = row;
    if (row.centre === null || value < Number(slider.min) || value > Number(slider.max)) this.span(row, key, value);
    slider.value = value;
    if (document.activeElement !== number) number.value = typed(Number(value.toPrecision(6)));
    slider.setAttribute('aria-valuetext', String(Number(value.toPrecision(4))));
  }

  // Of a start as far to both sides; a parameter from 0 to twice its size.
  span(row, key, value) {
    row.centre = value;
    const reach = key.startsWith('start') ? Math.max(1, Math.abs(value)) : Math.abs(value) || 1;
    row.slider.min = key.startsWith('start') || value === 0 ? value - reach : Math.min(0, 2 * value);
    row.slider.max = key.startsWith('start') || value === 0 ? value + reach : Math.max(0, 2 * value);
  }

  settle() { this.moving = false; this.host.settled(); }

  // One question at a time; of many moves the last.
  async sweep(make) {
    this.moving = true;
    this.latest = make;
    if (this.working) return;
    this.working = true;
    while (this.latest) {
      const next = this.latest;
      this.latest = null;
      await next();
    }
    this.working = false;
    this.moving = false;
  }

  moveStart(name, value) {
    this.sweep(async () => {
      const text = this.host.text();
      const point = {...this.host.point(), [name]: value};
      let asked = withCompactValue(text, ['initial'], grouped(point));
      asked = withCompactValue(asked, ['hold'], [...new Set([...this.pinned, name])]);
      const answer = await this.host.ask(asked);
      if (!answer) return;
      if (answer.problems) {
        this.host.refused(name, answer.problems);
        return;
      }
      const found = answer.ladder.consistent_point;
      this.host.moved(withCompactValue(text, ['initial'], grouped(found)), answer);
      for (const [one, at] of Object.entries(found)) if (this.rows.has('start ' + one) && one !== name) this.put('start ' + one, at);
      const row = this.rows.get('start ' + name);
      row.number.value = typed(Number(found[name].toPrecision(6)));
    });
  }

  moveNumber(path, value) {
    this.sweep(async () => {
      const text = withValue(this.host.text(), path, typed(Number(value.toPrecision(4))));
      const answer = await this.host.ask(text);
      if (!answer) return;
      this.host.changed(text, answer);
      if (!answer.problems) {
        const row = this.rows.get('number ' + path.join('/'));
        row.number.value = Number(value.toPrecision(4));
        for (const [one, at] of Object.entries(answer.ladder.consistent_point || {})) if (this.rows.has('start ' + one)) this.put('start ' + one, at);
      }
    });
  }

  pin(name) {
    const names = [...this.pinned];
    const array = name.replace(/\[.*/, '');
    let held;
    if (this.pinned.has(name)) held = names.filter((one) => one !== name);
    else if (this.pinned.has(array)) held = names.filter((one) => one !== array);
    else held = [...names, name];
    this.pinned = new Set(held);
    // What is held is what is shown.
    let text = this.host.text();
    if (held.length > names.length) text = withCompactValue(text, ['initial'], grouped(this.host.point()));
    text = held.length > 0 ? withCompactValue(text, ['hold'], held) : withValue(text, ['hold'], undefined);
    this.host.replaced(text);
  }
}
