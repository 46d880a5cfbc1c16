// Everything that has to be drawn again is drawn once before the next picture of the screen.
const waiting = new Set();
function later(chart) {
  if (waiting.size === 0) {
    requestAnimationFrame(() => {
      const all = Array.from(waiting);
      waiting.clear();
      for (const one of all) one.draw();
    });
  }
  waiting.add(chart);
}

// A figure with its curves, a read-out and a mark at the instant. A subclass has `names` of what the
// read-out tells of a sample, draw(), place(curve, i) → {x, y} in pixels, read(curve, i) → rows of the
// read-out, and what happens when the pointer drags.
class Chart {
  constructor(picture) {
    this.picture = picture;
    this.panel = picture.querySelector('.panel');
    const data = this.panel.dataset;
    this.area = data.area.split(' ').map(Number);
    this.width = Number(picture.getAttribute('width'));
    this.height = Number(picture.getAttribute('height'));
    this.at = null;      // {curve, i}: what is read out
    this.pointers = new Map();
    this.drag = null;
    const origin = (data.origin || '0 0').split(' ').map(Number);
    this.curves = Array.from(this.panel.querySelectorAll('.series'), (element) => new Curve(element, origin))
      .filter((curve) => curve.size > 0);
    const title = picture.querySelector('title');
    this.name = title.textContent;
    title.remove();

    this.frame = html('div', {class: 'chart', tabindex: '0', role: 'group'});
    this.frame.setAttribute('aria-label', this.name + '. ' + this.help);
    this.frame.style.maxWidth = this.width + 'px';
    picture.replaceWith(this.frame);
    this.readout = html('div', {class: 'readout', role: 'status', hidden: ''});
    this.back = html('button', {class: 'whole', type: 'button', hidden: '', title: 'Show all again (double click)'}, '⤢ all');
    this.note = html('p', {class: 'note', hidden: ''});
    this.frame.append(picture, this.readout, this.back, this.note);
    this.cross = svg('g', {class: 'cross'});
    this.now = svg('g', {class: 'now'});
    this.selection = svg('rect', {class: 'selection', display: 'none'});
    this.panel.append(this.now, this.cross, this.selection);
    this.listen();
  }

  // Says once what the page does not have of its curves.
  remark(remarks) {
    const said = Array.from(new Set(remarks.filter((remark) => remark)));
    this.note.hidden = said.length === 0;
    this.note.textContent = said.length === 0 ? '' : 'Here the page has ' + said.join('; ') + '. All rows are in the files of the run.';
  }

  // The pixels of the picture under an event.
  pixel(event) {
    const box = this.picture.getBoundingClientRect();
    return {x: (event.clientX - box.left) * this.width / box.width,
            y: (event.clientY - box.top) * this.height / box.height};
  }

  inside(point, slack) {
    const [left, top, right, bottom] = this.area;
    return point.x >= left - slack && point.x <= right + slack && point.y >= top - slack && point.y <= bottom + slack;
  }

  listen() {
    const frame = this.frame;
    frame.addEventListener('pointermove', (event) => this.move(event));
    frame.addEventListener('pointerdown', (event) => this.down(event));
    frame.addEventListener('pointerup', (event) => this.up(event, true));
    frame.addEventListener('pointercancel', (event) => this.up(event, false));
    frame.addEventListener('pointerleave', (event) => {
      if (event.pointerType === 'mouse' && !this.drag) this.tell(null);
    });
    frame.addEventListener('blur', () => this.tell(null));
    frame.addEventListener('keydown', (event) => this.key(event));
    frame.addEventListener('dblclick', () => this.reset());
    frame.addEventListener('wheel', (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.zoom(2 ** (Math.max(-100, Math.min(100, event.deltaY)) / 150), this.pixel(event));
    }, {passive: false});
    this.back.addEventListener('click', () => { this.reset(); frame.focus({preventScroll: true}); });
    new ResizeObserver(() => { this.fit(frame.clientWidth); later(this); }).observe(frame);
  }

  move(event) {
    const point = this.pixel(event);
    if (this.pointers.has(event.pointerId)) {
      const before = Array.from(this.pointers.values());
      this.pointers.set(event.pointerId, point);
      const after = Array.from(this.pointers.values());
      if (after.length > 1) return this.pinch(before, after);
      if (this.drag) return this.dragged(this.drag, point, event);
    }
    this.tell(this.inside(point, 12) ? this.nearest(point) : null);
  }

  down(event) {
    if (event.target.closest('button') || event.button !== 0) return;
    const point = this.pixel(event);
    this.pointers.set(event.pointerId, point);
    if (event.isTrusted) this.frame.setPointerCapture(event.pointerId);
    this.drag = this.pointers.size > 1 ? null : {start: point, last: point, touch: event.pointerType !== 'mouse', far: false};
    if (this.drag && this.inside(point, 12)) this.tell(this.nearest(point));
  }

  up(event, done) {
    if (!this.pointers.delete(event.pointerId)) return;
    const drag = this.drag;
    this.drag = null;
    this.selection.setAttribute('display', 'none');
    if (!drag || !done) return;
    const point = this.pixel(event);
    if (drag.far) return this.dropped(drag, point);
    if (this.at && this.inside(point, 12)) instant.set(this.at.curve.time[this.at.i]);
  }

  key(event) {
    if (event.target !== this.frame || event.altKey || event.ctrlKey || event.metaKey) return;
    const step = event.shiftKey ? 10 : 1;
    const centre = this.at ? this.place(this.at.curve, this.at.i) : this.middle();
    const actions = {
      ArrowRight: () => this.walk(step),
      ArrowLeft: () => this.walk(-step),
      Home: () => this.walk(-Infinity),
      End: () => this.walk(Infinity),
      ArrowUp: () => this.change(-1),
      ArrowDown: () => this.change(1),
      Escape: () => { this.tell(null); this.reset(); },
      Enter: () => { if (this.at) instant.set(this.at.curve.time[this.at.i]); },
      '+': () => this.zoom(0.5, centre),
      '=': () => this.zoom(0.5, centre),
      '-': () => this.zoom(2, centre),
      0: () => this.reset(),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }

  middle() {
    const [left, top, right, bottom] = this.area;
    return {x: (left + right) / 2, y: (top + bottom) / 2};
  }

  // Goes along the curve that is read out.
  walk(steps) {
    if (this.curves.length === 0) return;
    if (!this.at) return this.tell({curve: this.curves[0], i: Math.max(0, this.firstShown(this.curves[0]))});
    const {curve, i} = this.at;
    const end = curve.x.length - 1;
    this.tell({curve, i: Math.min(end, Math.max(0, i + steps))});
  }

  firstShown() { return 0; }

  // Reads out another curve.
  change(by) {
    if (this.curves.length === 0) return;
    if (!this.at) return this.walk(0);
    const count = this.curves.length;
    const curve = this.curves[(this.curves.indexOf(this.at.curve) + by + count) % count];
    this.tell({curve, i: nearestIndex(curve.time, this.at.curve.time[this.at.i])});
  }

  // Reads out a sample, or nothing.
  tell(at) {
    if (!at && !this.at) return;
    this.at = at;
    this.drawCross();
    this.readout.hidden = !at;
    if (!at) return;
    const rows = this.read(at);
    const table = html('table', {});
    for (const {colour, name, value, unit, strong} of rows) {
      const swatch = html('span', {class: 'swatch' + (colour ? ' ' + colour : ' none')});
      const head = html('th', strong ? {class: 'strong'} : {}, swatch, typeset(name));
      table.append(html('tr', {}, head, html('td', {}, value + unit)));
    }
    this.readout.replaceChildren(table);
    const place = this.place(at.curve, at.i);
    const scale = this.picture.getBoundingClientRect().width / this.width;
    const x = place.x * scale, room = this.frame.clientWidth, own = this.readout.offsetWidth;
    const left = x + 14 + own <= room ? x + 14 : x - 14 - own;
    this.readout.style.left = Math.max(0, Math.min(left, room - own)) + 'px';
    this.readout.style.top = (Number.isFinite(place.y) ? place.y : this.area[1]) * scale - this.readout.offsetHeight - 10 + 'px';
  }

  // The place of a curve at a time between two samples.
  placeAt(curve, time) {
    const times = curve.time, last = times.length - 1;
    if (!(time >= times[0] && time <= times[last])) return null;
    const i = Math.min(lastBefore(times, time), Math.max(0, last - 1)), j = Math.min(i + 1, last);
    const part = !curve.scattered && j > i && times[j] > times[i] ? (time - times[i]) / (times[j] - times[i]) : 0;
    const a = this.place(curve, i), b = this.place(curve, j);
    const place = {x: a.x + part * (b.x - a.x), y: a.y + part * (b.y - a.y), front: a.front};
    return Number.isFinite(place.x) && Number.isFinite(place.y) ? place : null;
  }

  drawNow() {
    this.now.replaceChildren();
    if (instant.time === null) return;
    this.beforeNow();
    for (const curve of this.curves) {
      const place = this.placeAt(curve, instant.time);
      if (!place || !this.inside(place, 2)) continue;
      this.spoke(curve, place);
      this.now.append(svg('circle', {class: 'dot ' + curve.colour, cx: place.x, cy: place.y, r: 5}));
    }
  }
  beforeNow() {}
  spoke() {}

  drawCross() {
    this.cross.replaceChildren();
    if (!this.at) return;
    this.beforeCross();
    for (const {curve, i} of this.samples(this.at)) {
      const place = this.place(curve, i);
      if (Number.isFinite(place.x) && Number.isFinite(place.y) && this.inside(place, 2))
        this.cross.append(svg('circle', {class: 'dot ' + curve.colour, cx: place.x, cy: place.y, r: 3.5}));
    }
  }
  beforeCross() {}
  samples(at) { return [at]; }

  // The sample that is nearest in the picture.
  nearest(point) {
    let best = null, least = Infinity;
    for (const curve of this.curves) {
      for (let i = 0; i < curve.x.length; ++i) {
        const place = this.place(curve, i);
        const distance = Math.hypot(place.x - point.x, place.y - point.y) + (place.front === false ? 8 : 0);
        if (distance < least) least = distance, best = {curve, i};
      }
    }
    return best;
  }

  timeRow(at) {
    const {name, unit} = nameAndUnit(timeLabel);
    return {name, value: readable(at.curve.time[at.i], 6), unit, strong: true};
  }
}
