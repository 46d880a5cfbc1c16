// The map value → length → pixel. The length is the scale's; `window` is what is shown of `full`.
class Axis {
  constructor(label, zone, view, drawn, exponent, perLabel) {
    this.label = label;
    this.zone = zone;
    this.full = view.map((value) => this.length(value));
    this.window = this.full.slice();
    this.drawn = drawn;
    this.pixels = drawn.slice();
    this.exponent = exponent;
    this.perLabel = perLabel;
    const size = Math.max(Math.abs(view[0]), Math.abs(view[1]));
    // Six digits, or as many as show four of the differences.
    const lost = this.linear ? Math.log10(size / (view[1] - view[0])) : 0;
    this.digits = Math.min(15, Math.max(6, 4 + Math.ceil(lost)));
  }

  get linear() { return this.zone > 1e300; }

  length(value) {
    if (this.linear) return value;
    if (this.zone === 0) return value > 0 ? Math.log10(value) : -Infinity;
    const ratio = Math.abs(value) / this.zone;
    return Math.sign(value) * (ratio <= 1 ? ratio : 1 + Math.log10(ratio));
  }

  value(length) {
    if (this.linear) return length;
    if (this.zone === 0) return 10 ** length;
    const size = Math.abs(length);
    return Math.sign(length) * this.zone * (size <= 1 ? size : 10 ** (size - 1));
  }

  get pixelsPerLength() {
    return (this.pixels[1] - this.pixels[0]) / (this.window[1] - this.window[0]);
  }
  pixel(value) { return this.pixels[0] + this.pixelsPerLength * (this.length(value) - this.window[0]); }
  lengthAt(pixel) { return this.window[0] + (pixel - this.pixels[0]) / this.pixelsPerLength; }
  shows(value) {
    const length = this.length(value), slack = 1e-9 * (this.full[1] - this.full[0]);
    return length >= this.window[0] - slack && length <= this.window[1] + slack;
  }

  // Where a value is in the page's own drawing.
  drawnPixel(value) {
    return this.drawn[0] + (this.length(value) - this.full[0]) / (this.full[1] - this.full[0]) * (this.drawn[1] - this.drawn[0]);
  }
  // How many times larger than the whole.
  get magnification() { return (this.full[1] - this.full[0]) / (this.window[1] - this.window[0]); }
  get zoomed() { return this.window[0] !== this.full[0] || this.window[1] !== this.full[1]; }

  // Where a pixel of the page's own drawing is now: factor · pixel + shift.
  get affine() {
    const before = (this.drawn[1] - this.drawn[0]) / (this.full[1] - this.full[0]);
    const factor = this.pixelsPerLength / before;
    const shift = this.pixels[0] + this.pixelsPerLength * (this.full[0] - this.window[0]) - factor * this.drawn[0];
    return {factor, shift};
  }

  // Shows [lower, upper] in lengths, within the whole; at most thousandfold.
  show(lower, upper, mayLeave) {
    const whole = this.full[1] - this.full[0];
    const length = Math.max(Math.abs(upper - lower), whole / 1000);
    if (length >= whole * 0.999) return this.reset();
    let begin = Math.min(lower, upper);
    if (!mayLeave) begin = Math.min(Math.max(begin, this.full[0]), this.full[1] - length);
    this.window = [begin, begin + length];
  }
  reset() { this.window = this.full.slice(); }

  // {value, label} inside the window, as the C++ of each scale has them.
  ticks() {
    const pieces = Math.floor(Math.abs(this.pixels[1] - this.pixels[0]) / this.perLabel);
    const about = Math.max(this.perLabel > 40 ? 2 : 5, pieces);
    const marks = this.linear ? this.linearTicks(about, true) : this.decadeTicks(about);
    if (this.linear || marks.filter((mark) => mark.label).length > 1) return marks;
    return this.linearTicks(Math.min(about, 4), false);
  }

  linearTicks(about, fixed) {
    const [lower, upper] = this.window.map((length) => this.value(length));
    const step = niceStep(upper - lower, about);
    const decimals = Math.min(17, Math.max(0, this.exponent - Math.floor(Math.log10(step) + 1e-9)));
    const marks = [];
    const first = Math.ceil(lower / step - 1e-9), last = Math.floor(upper / step + 1e-9);
    for (let multiple = first; multiple <= last; ++multiple) {
      const value = multiple * step;
      const text = (Math.abs(value) / 10 ** this.exponent).toFixed(decimals);
      const sign = value < 0 && Number(text) !== 0 ? minus : '';
      marks.push({value, label: fixed ? sign + text : readable(value, 4)});
    }
    return marks;
  }

  decadeTicks(about) {
    const decades = this.window[1] - this.window[0];
    const stride = Math.max(1, Math.ceil(decades / about));
    const ends = this.window.map((length) => this.value(length));
    const marks = [];
    const mark = (value, label) => { if (this.shows(value)) marks.push({value, label}); };
    const greatest = Math.floor(Math.log10(Math.max(Math.abs(ends[0]), Math.abs(ends[1]), this.zone))) + 1;
    const symmetric = this.zone > 0;
    const least = symmetric ? Math.ceil(Math.log10(this.zone) - 1e-9) : Math.floor(Math.log10(ends[0]));
    if (symmetric) mark(0, '0');
    for (let power = least; power <= greatest; ++power) {
      const labelled = symmetric ? (power - least) % stride === 0 : power % stride === 0;
      for (const sign of symmetric ? [1, -1] : [1]) {
        const decade = sign * 10 ** power;
        mark(decade, labelled ? (sign < 0 ? minus : '') + powerOfTen(power) : '');
        for (let digit = 2; digit <= 9 && stride === 1; ++digit) {
          const few = !symmetric && decades < 2 && (digit === 2 || digit === 5);
          mark(digit * decade, few ? digit + '·' + powerOfTen(power) : '');
        }
      }
    }
    return marks;
  }
}

// The least of 1, 2, 5 times a power of ten that cuts the length into at most `pieces` steps.
function niceStep(length, pieces) {
  const coarsest = length / pieces;
  const decade = 10 ** Math.floor(Math.log10(coarsest));
  for (const multiple of [1, 2, 5])
    if (multiple * decade >= coarsest * (1 - 1e-9)) return multiple * decade;
  return 10 * decade;
}

// The index i of increasing numbers with all[i] ≤ value, at least 0.
function lastBefore(all, value) {
  let low = 0, high = all.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (all[middle] <= value) low = middle; else high = middle;
  }
  return low;
}

function nearestIndex(all, value) {
  const i = lastBefore(all, value);
  return i + 1 < all.length && all[i + 1] - value < value - all[i] ? i + 1 : i;
}
