// Curves over two axes.
class PlaneChart extends Chart {
  constructor(picture) {
    super(picture);
    const data = this.panel.dataset;
    const [left, top, right, bottom] = this.area;
    const view = data.view.split(' ').map(Number), zone = data.zone.split(' ').map(Number);
    const exponent = data.exponent.split(' ').map(Number);
    this.x = new Axis(data.xName, zone[0], view.slice(0, 2), [left, right], exponent[0], 80);
    this.y = new Axis(data.yName, zone[1], view.slice(2), [bottom, top], exponent[1], 40);
    this.equal = data.equal === 'equal';
    this.overTime = this.curves.every((curve) => !curve.t);
    this.ratio = (bottom - top) / (right - left);
    this.xTicks = this.panel.querySelector('.x-ticks');
    this.yTicks = this.panel.querySelector('.y-ticks');
    this.xLine = this.xTicks.parentNode.querySelector(':scope > line');
    this.yLine = this.yTicks.parentNode.querySelector(':scope > line');
    this.xText = this.xTicks.parentNode.querySelector(':scope > text');
    this.yText = this.yTicks.parentNode.querySelector(':scope > text');
    this.heading = this.panel.querySelector(':scope > .heading');
    this.shade = this.panel.querySelector(':scope > .linear-zone');
    this.dots = Array.from(this.panel.querySelectorAll('.endpoints circle'),
      (circle) => ({circle, x: Number(circle.getAttribute('cx')), y: Number(circle.getAttribute('cy'))}));
    // What is outside of the area is cut off. It has its size from the beginning: a page that is printed at once is not drawn again.
    this.clip = svg('rect', {x: left - 1, y: top - 1, width: right - left + 2, height: bottom - top + 2});
    const id = 'area-' + PlaneChart.count++;
    this.panel.prepend(svg('clipPath', {id}, this.clip));
    for (const curve of this.curves) curve.element.setAttribute('clip-path', 'url' + '(#' + id + ')');
    this.rods = (data.rods || '').split(' ').filter(Boolean).map((rod) => rod.split('-').map((end) => end === '' ? null : Number(end)));
    this.drawings = this.curves.map((curve) => new PlaneCurve(this, curve));
  }

  get help() { return 'Arrow keys show values; plus, minus and 0 zoom.'; }

  // The picture is as wide as there is room, so that letters stay as large as they are.
  fit(room) {
    if (room <= 0) return;
    const natural = this.natural || (this.natural = {width: this.width, height: this.height, area: this.area.slice()});
    this.width = Math.max(240, Math.min(natural.width, Math.floor(room)));
    const area = natural.area.slice();
    area[2] -= natural.width - this.width;
    // A heading that would cover the name of the axis goes above it.
    const covered = this.heading && this.heading.getComputedTextLength() + this.yText.getComputedTextLength() + 20 > area[2] - area[0];
    if (covered) area[1] += 16, area[3] += 16;
    this.lift = covered ? 16 : 0;
    if (this.equal) area[3] = area[1] + this.ratio * (area[2] - area[0]);
    this.height = natural.height + area[3] - natural.area[3];
    this.area = area;
    set(this.picture, {width: this.width, height: this.height, viewBox: '0 0 ' + this.width + ' ' + Math.round(this.height * 100) / 100});
    this.x.pixels = [area[0], area[2]];
    this.y.pixels = [area[3], area[1]];
  }

  draw() {
    const [left, top, right, bottom] = this.area;
    set(this.clip, {x: left - 1, y: top - 1, width: right - left + 2, height: bottom - top + 2});
    const x = this.x.affine, y = this.y.affine;
    const zoomed = this.x.zoomed || this.y.zoomed;
    this.back.hidden = !zoomed;
    this.remark(this.drawings.map((drawing) => drawing.draw(zoomed)));
    for (const dot of this.dots) {
      const place = {x: x.factor * dot.x + x.shift, y: y.factor * dot.y + y.shift};
      set(dot.circle, {cx: place.x, cy: place.y, display: this.inside(place, 2) ? 'inline' : 'none'});
    }
    this.drawAxes();
    this.drawNow();
    this.drawCross();
    if (this.at) this.tell(this.at);
  }

  drawAxes() {
    const [left, top, right, bottom] = this.area;
    set(this.xLine, {x1: left, x2: right, y1: bottom, y2: bottom});
    set(this.yLine, {x1: left, x2: left, y1: top, y2: bottom});
    set(this.xText, {x: (left + right) / 2, y: bottom + 36});
    set(this.yText, {y: top - 10});
    if (this.heading) set(this.heading, {x: right, y: top - 10 - this.lift});
    this.xTicks.replaceChildren();
    for (const {value, label} of this.x.ticks()) {
      const x = this.x.pixel(value);
      this.xTicks.append(svg('line', {class: 'frame', x1: x, x2: x, y1: bottom, y2: bottom + (label ? 5 : 2.5)}));
      if (label) this.xTicks.append(svg('text', {x, y: bottom + 18, 'text-anchor': 'middle'}, label));
    }
    this.yTicks.replaceChildren();
    for (const {value, label} of this.y.ticks()) {
      const y = this.y.pixel(value);
      if (label) {
        const style = value === 0 && !this.equal ? 'zero' : 'grid';
        this.yTicks.append(svg('line', {class: style, x1: left, x2: right, y1: y, y2: y}));
        this.yTicks.append(svg('text', {x: left - 8, y: y + 4, 'text-anchor': 'end'}, label));
      }
      this.yTicks.append(svg('line', {class: 'frame', x1: left - (label ? 5 : 2.5), x2: left, y1: y, y2: y}));
    }
    if (this.shade) {
      const edge = (value) => Math.min(bottom, Math.max(top, this.y.pixel(value)));
      const upper = edge(this.y.zone), lower = edge(-this.y.zone);
      set(this.shade, {width: right - left, y: upper, height: Math.max(0, lower - upper)});
    }
  }

  place(curve, i) { return {x: this.x.pixel(curve.x[i]), y: this.y.pixel(curve.y[i])}; }

  // Over time: of each curve the sample at the time of the nearest one.
  nearest(point) {
    if (!this.overTime) return super.nearest(point);
    const x = this.x.value(this.x.lengthAt(Math.min(this.area[2], Math.max(this.area[0], point.x))));
    let best = null, least = Infinity;
    for (const curve of this.curves) {
      const i = nearestIndex(curve.x, x);
      const place = this.place(curve, i);
      const distance = Number.isFinite(place.y) ? Math.abs(place.x - point.x) + Math.abs(place.y - point.y) / 1e3 : 1e6;
      if (distance < least) least = distance, best = {curve, i};
    }
    return best;
  }

  samples(at) {
    if (!this.overTime) return [at];
    const x = at.curve.x[at.i];
    return this.curves
      .map((curve) => ({curve, i: curve === at.curve ? at.i : nearestIndex(curve.x, x)}))
      .filter(({curve}) => x >= curve.x[0] && x <= curve.x[curve.x.length - 1]);
  }

  read(at) {
    const y = nameAndUnit(this.y.label);
    if (this.overTime) {
      const x = nameAndUnit(this.x.label);
      const rows = [{name: x.name, value: readable(at.curve.x[at.i], Math.max(6, this.x.digits)), unit: x.unit, strong: true}];
      const several = this.curves.length > 1;
      if (several) rows.push({name: y.name, value: '', unit: ''});
      for (const {curve, i} of this.samples(at))
        rows.push({colour: curve.colour, name: several ? curve.label : y.name, value: readable(curve.y[i], this.y.digits), unit: y.unit});
      return rows;
    }
    const x = nameAndUnit(this.x.label);
    const rows = [this.timeRow(at)];
    if (this.curves.length > 1) rows.push({colour: at.curve.colour, name: at.curve.label, value: '', unit: ''});
    rows.push({name: x.name, value: readable(at.curve.x[at.i], this.x.digits), unit: x.unit});
    rows.push({name: y.name, value: readable(at.curve.y[at.i], this.y.digits), unit: y.unit});
    return rows;
  }

  beforeCross() {
    const [left, top, right, bottom] = this.area;
    const place = this.place(this.at.curve, this.at.i);
    if (!Number.isFinite(place.x)) return;
    this.cross.append(svg('line', {x1: place.x, x2: place.x, y1: top, y2: bottom}));
    if (Number.isFinite(place.y) && (!this.overTime || this.curves.length === 1) && this.inside(place, 1))
      this.cross.append(svg('line', {x1: left, x2: right, y1: place.y, y2: place.y}));
  }

  beforeNow() {
    for (const ends of this.rods) {
      const [a, b] = ends.map((end) => end === null ? {x: this.x.pixel(0), y: this.y.pixel(0)} : this.placeAt(this.curves[end], instant.time));
      if (a && b) this.now.append(svg('line', {class: 'bar', x1: a.x, y1: a.y, x2: b.x, y2: b.y}));
    }
    if (!this.overTime || !this.x.shows(instant.time)) return;
    const x = this.x.pixel(instant.time);
    this.now.append(svg('line', {x1: x, x2: x, y1: this.area[1], y2: this.area[3]}));
  }

  firstShown(curve) { return this.overTime ? nearestIndex(curve.x, this.x.value(this.x.lengthAt(this.middle().x))) : 0; }

  walk(steps) {
    super.walk(steps);
    if (!this.at || !this.overTime || !this.x.zoomed) return;
    // What is shown follows what is read out.
    const length = this.x.length(this.at.curve.x[this.at.i]), [lower, upper] = this.x.window;
    if (length >= lower && length <= upper) return;
    const half = (upper - lower) / 2;
    this.show(length - half, length + half, null);
  }

  // ---- zoom ----

  // Shows lengths; of charts over the same times all show the same.
  show(lower, upper, vertical) {
    const together = this.overTime ? charts.filter((chart) => chart.overTime && sameRange(chart.x.full, this.x.full)) : [this];
    for (const chart of together) {
      chart.x.show(lower, upper, this.equal);
      later(chart);
    }
    if (vertical) this.y.show(vertical[0], vertical[1], this.equal);
    if (this.equal && !this.x.zoomed) this.y.reset();
  }

  zoom(factor, centre) {
    const scaled = (axis, pixel) => {
      const fixed = axis.lengthAt(pixel);
      return axis.window.map((length) => fixed + factor * (length - fixed));
    };
    const [lower, upper] = scaled(this.x, centre.x);
    this.show(lower, upper, this.overTime ? null : scaled(this.y, centre.y));
  }

  reset() {
    this.y.reset();
    this.show(this.x.full[0], this.x.full[1], null);
    later(this);
  }

  pinch(before, after) {
    const spread = (points) => Math.max(20, Math.hypot(points[0].x - points[1].x, points[0].y - points[1].y));
    const middle = (points) => ({x: (points[0].x + points[1].x) / 2, y: (points[0].y + points[1].y) / 2});
    this.tell(null);
    const from = middle(before), to = middle(after), factor = spread(before) / spread(after);
    const moved = (axis, a, b) => {
      const fixed = axis.lengthAt(a), shift = (b - a) / axis.pixelsPerLength;
      return axis.window.map((length) => fixed + factor * (length - fixed) - shift);
    };
    const [lower, upper] = moved(this.x, from.x, to.x);
    this.show(lower, upper, this.overTime ? null : moved(this.y, from.y, to.y));
  }

  // A mouse selects a range; with shift, and on planes by touch, it moves what is shown.
  dragged(drag, point, event) {
    if (drag.touch && this.overTime) return this.tell(this.nearest(point));
    drag.far = drag.far || Math.hypot(point.x - drag.start.x, point.y - drag.start.y) > 6;
    if (!drag.far) return;
    this.tell(null);
    if (drag.touch || event.shiftKey || drag.moves) {
      drag.moves = true;
      const moved = (axis, pixels) => axis.window.map((length) => length - pixels / axis.pixelsPerLength);
      if (this.x.zoomed || this.y.zoomed) {
        const [lower, upper] = moved(this.x, point.x - drag.last.x);
        this.show(lower, upper, moved(this.y, point.y - drag.last.y));
      }
      drag.last = point;
      later(this);
      return;
    }
    const box = this.box(drag.start, point);
    set(this.selection, {x: box.left, y: box.top, width: box.right - box.left, height: box.bottom - box.top, display: 'inline'});
  }

  // The rectangle between two points; one that is flat is as high as the area, one that is thin as wide.
  box(a, b) {
    const [left, top, right, bottom] = this.area;
    const clampX = (x) => Math.min(right, Math.max(left, x)), clampY = (y) => Math.min(bottom, Math.max(top, y));
    const box = {left: clampX(Math.min(a.x, b.x)), right: clampX(Math.max(a.x, b.x)),
                 top: clampY(Math.min(a.y, b.y)), bottom: clampY(Math.max(a.y, b.y))};
    const thin = box.right - box.left < 12, flat = box.bottom - box.top < 20;
    if (this.equal || !(thin && flat)) {
      if (flat && !this.equal) box.top = top, box.bottom = bottom;
      if (thin && !this.equal) box.left = left, box.right = right;
    }
    if (this.equal) {
      // As wide as it is high, in the proportions of the area.
      const width = Math.max(box.right - box.left, (box.bottom - box.top) / this.ratio);
      const x = (box.left + box.right) / 2, y = (box.top + box.bottom) / 2;
      return {left: x - width / 2, right: x + width / 2, top: y - width * this.ratio / 2, bottom: y + width * this.ratio / 2};
    }
    return box;
  }

  dropped(drag, point) {
    if (drag.touch || drag.moves) return;
    const box = this.box(drag.start, point);
    if (box.right - box.left < 6 || box.bottom - box.top < 6) return;
    const whole = box.top <= this.area[1] + 0.5 && box.bottom >= this.area[3] - 0.5;
    const vertical = [this.y.lengthAt(box.bottom), this.y.lengthAt(box.top)];
    this.show(this.x.lengthAt(box.left), this.x.lengthAt(box.right), whole ? null : vertical);
  }
}
PlaneChart.count = 0;

function sameRange(a, b) {
  const slack = 1e-6 * (a[1] - a[0]);
  return Math.abs(a[0] - b[0]) <= slack && Math.abs(a[1] - b[1]) <= slack;
}
