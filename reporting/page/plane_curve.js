// A curve over two axes as it is drawn. The whole is the page's own drawing. Where one zooms, the curve is
// drawn anew from its rows, or, if these are coarser than that drawing, the drawing is enlarged.
class PlaneCurve {
  constructor(chart, curve) {
    this.chart = chart;
    this.curve = curve;
    this.drawn = Array.from(curve.element.children);
    curve.scattered = this.drawn.some((path) => path.classList.contains('dots'));
    this.errors = curve.whole ? {rows: 0, drawing: 1} : {rows: this.errorOfRows(), drawing: this.drawn.some(isBand) ? 1 : 0.1};
  }

  // By how many pixels of the whole the rows that went along may miss the others. (The page's own drawing
  // misses them by the width of a band's columns, a pixel, or a tenth: plotting/figure.cpp.)
  errorOfRows() {
    const {x, y, overTime} = this.chart, {curve} = this;
    if (curve.scattered) return 0;
    if (overTime) return (x.drawn[1] - x.drawn[0]) / curve.stretches;
    // How far a smooth curve is from its chords.
    let error = 0;
    for (let i = 1; i + 1 < curve.size; ++i) {
      const bend = (axis, all) => axis.drawnPixel(all[i - 1]) - 2 * axis.drawnPixel(all[i]) + axis.drawnPixel(all[i + 1]);
      const size = Math.hypot(bend(x, curve.x), bend(y, curve.y)) / 8;
      if (size > error) error = size;
    }
    return error;
  }

  // Draws it, and returns what the rows that went along do not show, in words, or ''.
  draw(zoomed) {
    const {chart, curve, errors, magnification} = this;
    if (!zoomed || errors.drawing < errors.rows) {
      curve.element.replaceChildren(...this.drawn);
      const [x, y] = [chart.x.affine, chart.y.affine];
      for (const path of this.drawn)
        path.setAttribute('transform', 'matrix(' + [x.factor, 0, 0, y.factor, x.shift, y.shift].join(' ') + ')');
      return zoomed && errors.drawing * magnification >= 2 ? 'this curve only as it is drawn in the whole' : '';
    }
    const [begin, end] = chart.overTime ? this.shown() : [0, curve.size - 1];
    const many = chart.overTime && end - begin > 4 * (chart.x.pixels[1] - chart.x.pixels[0]);
    const coarse = errors.rows * magnification >= 1;
    const paths = [];
    const add = (attributes) => { if (attributes.d) paths.push(svg('path', attributes)); };
    if (many) add({class: 'band', 'fill-opacity': 0.35, 'stroke-width': 0.8, d: this.envelope(begin, end)});
    if (coarse && chart.overTime) add({class: 'rest', 'fill-opacity': 0.2, d: this.boxes(begin, end)});
    if (curve.scattered) add({class: 'dots', fill: 'none', 'stroke-width': 3, 'stroke-linecap': 'round', d: this.dots()});
    else if (!many) add({class: 'line', fill: 'none', 'stroke-width': 1.4, d: this.polyline(begin, end)});
    curve.element.replaceChildren(...paths);
    if (!coarse) return '';
    const count = readable(curve.thinning, 2);
    return chart.overTime ? 'the least and the greatest of every ' + count + ' rows; the shade holds the others' : 'one of ' + count + ' rows';
  }

  // How many times larger it is than in the whole.
  get magnification() {
    const {x, y, overTime} = this.chart;
    return overTime ? x.magnification : Math.max(x.magnification, y.magnification);
  }

  // Of a function of x: the places inside the area and the ones beside it.
  shown() {
    const {x} = this.chart, all = this.curve.x;
    const [lower, upper] = x.window.map((length) => lastBefore(all, x.value(length)));
    return [lower, Math.min(all.length - 1, upper + 1)];
  }

  polyline(begin, end) {
    const [left, top, right, bottom] = this.chart.area;
    let d = '', pen = false, before = null;
    for (let i = begin; i <= end; ++i) {
      const place = this.chart.place(this.curve, i);
      if (!Number.isFinite(place.x) || !Number.isFinite(place.y)) {
        pen = false;
        before = null;
        continue;
      }
      const outside = before !== null && (Math.max(before.x, place.x) < left - 2 || Math.min(before.x, place.x) > right + 2 ||
                                          Math.max(before.y, place.y) < top - 2 || Math.min(before.y, place.y) > bottom + 2);
      if (outside) {
        pen = false;
      } else if (before) {
        d += (pen ? '' : 'M' + point(before)) + 'L' + point(place);
        pen = true;
      }
      before = place;
    }
    return d;
  }

  // Lines without length at the rows inside the area.
  dots() {
    let d = '';
    for (let i = 0; i < this.curve.size; ++i) {
      const place = this.chart.place(this.curve, i);
      if (Number.isFinite(place.x) && Number.isFinite(place.y) && this.chart.inside(place, 0)) d += 'M' + point(place) + 'Z';
    }
    return d;
  }

  // For each column of pixels the least and the greatest, as plotting/figure.cpp draws them.
  envelope(begin, end) {
    let d = '', columns = [];
    const finish = () => {
      if (columns.length > 0)
        d += 'M' + columns.map(({x, top}) => point({x, y: top})).join('L') + 'L' + columns.reverse().map(({x, bottom}) => point({x, y: bottom})).join('L') + 'Z';
      columns = [];
    };
    for (let i = begin; i <= end; ++i) {
      const {x, y} = this.chart.place(this.curve, i);
      if (!Number.isFinite(x) || !Number.isFinite(y)) {
        finish();
        continue;
      }
      const column = Math.floor(x) + 0.5, last = columns[columns.length - 1];
      if (!last || last.x !== column) columns.push({x: column, top: y, bottom: y});
      else last.top = Math.min(last.top, y), last.bottom = Math.max(last.bottom, y);
    }
    finish();
    return d;
  }

  // Where the rows are that did not go along.
  boxes(begin, end) {
    let d = '';
    for (const {left, right, ends} of this.curve.boxes(begin, end)) {
      const [a, b] = [left, right].map((x) => this.chart.x.pixel(x)), [c, e] = ends.map((y) => this.chart.y.pixel(y));
      if ([a, b, c, e].every(Number.isFinite))
        d += 'M' + point({x: a, y: c}) + 'L' + point({x: b, y: c}) + 'L' + point({x: b, y: e}) + 'L' + point({x: a, y: e}) + 'Z';
    }
    return d;
  }
}

function isBand(path) { return path.classList.contains('band'); }
function point(place) { return Math.round(place.x * 100) / 100 + ' ' + Math.round(place.y * 100) / 100; }
