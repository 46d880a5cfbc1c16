// Curves in space, which one can turn.
class SpaceChart extends Chart {
  constructor(picture) {
    super(picture);
    const data = this.panel.dataset;
    const [cx, cy, cz, size, x, y, scale, distance] = data.space.split(' ').map(Number);
    Object.assign(this, {centre: [cx, cy, cz], size, middleX: x, middleY: y, scale, distance, nearness: 1});
    this.start = data.camera.split(' ').map(Number);
    [this.azimuth, this.elevation] = this.start;
    this.names = [data.xName, data.yName, data.zName];
    this.scaffold = this.panel.querySelector('.scaffold');
    this.texts = Array.from(this.scaffold.querySelectorAll('text'));
    this.outline = this.scaffold.querySelector('circle');
    this.wires = Array.from(this.scaffold.querySelectorAll('path'));
    this.endpoints = Array.from(this.panel.querySelectorAll('.endpoints'));
    for (const curve of this.curves) {
      [curve.back, curve.front] = curve.element.querySelectorAll('path');
      curve.end = curve.x.length - 1;
    }
    this.points = data.points === 'points';
    this.turned = false;
  }

  get help() { return 'Arrow keys show values; shift and arrow keys turn it.'; }
  get sphere() { return this.distance === 0; }

  fit() {}

  project(x, y, z) {
    const [px, py, pz] = [(x - this.centre[0]) / this.size, (y - this.centre[1]) / this.size, (z - this.centre[2]) / this.size];
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth);
    const ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    const right = py * ca - px * sa;
    const up = pz * ce - se * (px * ca + py * sa);
    const toward = ce * (px * ca + py * sa) + se * pz;
    const scale = this.nearness * this.scale * (this.sphere ? 1 : this.distance / (this.distance - toward));
    return {x: this.middleX + scale * right, y: this.middleY - scale * up, front: !this.sphere || toward >= 0};
  }
  place(curve, i) { return this.project(curve.x[i], curve.y[i], curve.z[i]); }
  middle() { return {x: this.middleX, y: this.middleY}; }

  draw() {
    if (this.turned) this.turn();
    this.remark(this.curves.map((curve) => curve.whole || this.nearness === 1 ? '' : 'one of ' + readable(curve.thinning, 2) + ' rows'));
    this.back.hidden = !this.turned;
    this.drawNow();
    this.drawCross();
    if (this.at) this.tell(this.at);
  }

  // The d attributes of what is in front and of what is behind: a line, or a point for each.
  sides(count, at, points) {
    const d = {true: '', false: ''};
    let before = null;
    for (let i = 0; i < count; ++i) {
      const place = at(i);
      if (!Number.isFinite(place.x) || !Number.isFinite(place.y)) {
        before = null;
        continue;
      }
      if (points) {
        d[place.front] += 'M' + point(place) + 'Z';
        continue;
      }
      if (before) d[before.front] += (before.pen === before.front ? '' : 'M' + point(before)) + 'L' + point(place);
      place.pen = before ? before.front : null;
      before = place;
    }
    return d;
  }

  turn() {
    for (const curve of this.curves) {
      const d = this.sides(curve.x.length, (i) => this.place(curve, i), this.points);
      curve.back.setAttribute('d', d.false);
      curve.front.setAttribute('d', d.true);
    }
    this.endpoints.forEach((group, k) => {
      const curve = this.curves[k];
      if (!curve) return;
      group.querySelectorAll('circle').forEach((circle, end) => {
        const place = this.place(curve, end === 0 ? 0 : curve.end);
        set(circle, {cx: place.x, cy: place.y});
      });
    });
    if (this.outline) this.outline.setAttribute('r', this.scale * this.nearness);
    if (this.sphere) this.graticule(); else this.cube();
  }

  graticule() {
    const d = {true: '', false: ''};
    const r = this.size, radian = Math.PI / 180;
    const circle = (at) => {
      const sides = this.sides(73, (i) => this.project(...at(2 * Math.PI * i / 72)));
      d.true += sides.true;
      d.false += sides.false;
    };
    for (let latitude = -60; latitude <= 60; latitude += 30) {
      const c = r * Math.cos(latitude * radian), s = r * Math.sin(latitude * radian);
      circle((angle) => [c * Math.cos(angle), c * Math.sin(angle), s]);
    }
    for (let longitude = 0; longitude < 180; longitude += 30) {
      const c = r * Math.cos(longitude * radian), s = r * Math.sin(longitude * radian);
      circle((angle) => [c * Math.cos(angle), s * Math.cos(angle), r * Math.sin(angle)]);
    }
    this.wires[0].setAttribute('d', d.false);
    this.wires[1].setAttribute('d', d.true);
    this.texts.forEach((text, axis) => {
      const at = [0, 1, 2].map((k) => this.centre[k] + (k === axis ? 1.12 * r : 0));
      const place = this.project(...at);
      set(text, {x: place.x, y: place.y + 4, opacity: place.front ? 1 : 0.4});
    });
  }

  cube() {
    let d = '';
    const h = this.size;
    for (let axis = 0; axis < 3; ++axis) {
      for (let corner = 0; corner < 4; ++corner) {
        const ends = [-h, h].map((along) => {
          const at = this.centre.slice();
          at[(axis + 1) % 3] += corner & 1 ? h : -h;
          at[(axis + 2) % 3] += corner & 2 ? h : -h;
          at[axis] += along;
          return this.project(...at);
        });
        d += 'M' + point(ends[0]) + 'L' + point(ends[1]);
      }
    }
    this.wires[0].setAttribute('d', d);
    this.texts.forEach((text, axis) => {
      const at = this.centre.slice();
      at[0] += (axis === 1 ? 1.12 : 1) * h;
      at[1] += (axis === 1 ? 1 : axis === 0 ? 1.12 : -1.08) * h;
      at[2] -= h;
      at[axis] = this.centre[axis];
      const place = this.project(...at);
      set(text, {x: place.x, y: place.y + 4});
    });
  }

  read(at) {
    const {curve, i} = at;
    const rows = [this.timeRow(at)];
    if (this.curves.length > 1) rows.push({colour: curve.colour, name: curve.label, value: '', unit: ''});
    [curve.x, curve.y, curve.z].forEach((values, k) => {
      const {name, unit} = nameAndUnit(this.names[k]);
      rows.push({name, value: readable(values[i], 6), unit});
    });
    return rows;
  }

  // From the centre of a sphere to the point.
  spoke(curve, place) {
    if (this.sphere && this.curves.length <= 3)
      this.now.append(svg('line', {class: 'spoke ' + curve.colour, x1: this.middleX, y1: this.middleY, x2: place.x, y2: place.y}));
  }

  rotate(right, up) {
    this.azimuth -= right;
    this.elevation = Math.min(1.57, Math.max(-1.57, this.elevation + up));
    this.turned = true;
    later(this);
  }

  key(event) {
    const turns = {ArrowRight: [0.1, 0], ArrowLeft: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
    if (!event.shiftKey || !turns[event.key] || event.target !== this.frame) return super.key(event);
    event.preventDefault();
    this.rotate(...turns[event.key]);
  }

  dragged(drag, point) {
    drag.far = drag.far || Math.hypot(point.x - drag.start.x, point.y - drag.start.y) > 4;
    if (!drag.far) return;
    this.tell(null);
    this.rotate((point.x - drag.last.x) / this.scale, (point.y - drag.last.y) / this.scale);
    drag.last = point;
  }
  dropped() {}

  zoom(factor) {
    this.nearness = Math.min(8, Math.max(1, this.nearness / factor));
    this.turned = true;
    later(this);
  }
  pinch(before, after) {
    const spread = (points) => Math.max(20, Math.hypot(points[0].x - points[1].x, points[0].y - points[1].y));
    this.zoom(spread(before) / spread(after));
  }
  reset() {
    if (!this.turned) return;
    [this.azimuth, this.elevation] = this.start;
    this.nearness = 1;
    this.turn();
    this.turned = false;
    later(this);
  }
}
