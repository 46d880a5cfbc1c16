// A curve: the rows of it that went along. plotting/curve_data.hpp has the attributes.
class Curve {
  constructor(element, origin) {
    const data = element.dataset, title = element.querySelector('title');
    this.element = element;
    this.label = title.textContent;
    title.remove();  // it would cover the read-out
    this.colour = element.classList[1];
    this.y = numbers(data.y, origin[1]);
    this.rows = Number(data.rows);
    this.stretches = Number(data.stretches);
    this.row = this.rowNumbers(data.steps);
    this.z = data.z ? numbers(data.z, 0) : null;
    this.t = data.t ? numbers(data.t, 0) : null;
    this.x = data.x ? numbers(data.x, origin[0]) : null;
    if (data.times) {
      const [first, distance, last] = data.times.split(' ').map(Number);
      const times = Float64Array.from(this.row, (row) => row === this.rows - 1 ? last : first + row * distance);
      if (this.x) this.t = times; else this.x = times;
    }
    this.time = this.t || this.x;
  }

  get size() { return this.y.length; }
  get whole() { return this.size === this.rows; }
  // How many rows there are for one that went along; with stretches, for two.
  get thinning() { return this.stretches > 0 ? (this.rows - 2) / this.stretches : (this.rows - 1) / (this.size - 1); }

  rowNumbers(steps) {
    if (this.stretches === 0) return Float64Array.from(this.y, (_, i) => i === 0 ? 0 : Math.floor(i * (this.rows - 1) / (this.size - 1)));
    let row = 0;
    const rows = [row];
    for (const step of unsigned(steps, this.size - 1)) rows.push(row += step);
    return Float64Array.from(rows);
  }

  firstOf(stretch) { return 1 + Math.floor(stretch * (this.rows - 2) / this.stretches); }
  stretchOf(row) {
    let i = Math.floor((row - 1) * this.stretches / (this.rows - 2));
    while (this.firstOf(i + 1) <= row) ++i;
    while (this.firstOf(i) > row) --i;
    return i;
  }

  // The x of a row between the places i and i + 1.
  between(i, row) {
    const part = (row - this.row[i]) / (this.row[i + 1] - this.row[i]);
    return this.x[i] + part * (this.x[i + 1] - this.x[i]);
  }

  // The stretches that have rows at the places from `begin` to `end`: where each begins and ends, and
  // its two values of y between which all are.
  boxes(begin, end) {
    const all = [], last = this.size - 2;
    let i = Math.max(1, begin);
    if (i > 1 && this.stretchOf(this.row[i]) === this.stretchOf(this.row[i - 1])) --i;
    for (; i <= Math.min(end, last); ++i) {
      const stretch = this.stretchOf(this.row[i]), first = i;
      if (i < last && this.stretchOf(this.row[i + 1]) === stretch) ++i;
      all.push({left: this.between(first - 1, this.firstOf(stretch)), right: this.between(i, this.firstOf(stretch + 1) - 1),
                ends: [this.y[first], this.y[i]]});
    }
    return all;
  }
}
