// One time for all figures, with a slider and a button, which stand before an element of the page.
class Instant {
  constructor() {
    this.time = null;  // not before it is used
    this.playing = false;
  }

  build(before) {
    this.begin = Infinity;
    this.end = -Infinity;
    for (const chart of charts) {
      for (const {time} of chart.curves) {
        this.begin = Math.min(this.begin, time[0]);
        this.end = Math.max(this.end, time[time.length - 1]);
      }
    }
    if (!(this.end > this.begin) || !Number.isFinite(this.end - this.begin)) return;
    const {name, unit} = nameAndUnit(timeLabel);
    this.unit = unit;
    this.button = html('button', {type: 'button', class: 'play', 'aria-label': 'Play', title: 'Play'}, '▶');
    this.slider = html('input', {type: 'range', min: this.begin, max: this.end, step: (this.end - this.begin) / 1000,
                                 value: this.begin, 'aria-label': 'Instant of all figures'});
    this.output = html('output', {});
    const label = html('span', {class: 'time'}, typeset(name), ' = ', this.output);
    const bar = html('div', {class: 'instant', role: 'group', 'aria-label': 'Instant'}, this.button, this.slider, label);
    before.before(bar);
    this.slider.addEventListener('input', () => { this.pause(); this.set(Number(this.slider.value)); });
    this.button.addEventListener('click', () => this.playing ? this.pause() : this.play());
    this.write(this.begin);
  }

  write(time) {
    const step = (this.end - this.begin) / 1000;
    const digits = Math.max(0, Math.min(12, -Math.floor(Math.log10(step))));
    const fixed = Math.abs(this.end) < 1e7 && digits < 8;
    this.output.textContent = (fixed ? time.toFixed(digits).replace('-', minus) : readable(time, 5)) + this.unit;
  }

  set(time) {
    if (!this.slider || !Number.isFinite(time)) return;
    this.time = Math.min(this.end, Math.max(this.begin, time));
    this.slider.value = this.time;
    this.slider.setAttribute('aria-valuetext', readable(this.time, 5) + this.unit);
    this.write(this.time);
    for (const chart of charts) if (chart.shown !== false) chart.drawNow();
  }

  show(playing) {
    this.playing = playing;
    this.button.textContent = playing ? '❚❚' : '▶';
    this.button.title = playing ? 'Pause' : 'Play';
    this.button.setAttribute('aria-label', this.button.title);
  }

  // The whole in ten seconds; where motion is unwelcome, twenty still pictures.
  play() {
    const seconds = 10, stills = 20;
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (this.time === null || this.time >= this.end) this.set(this.begin);
    this.show(true);
    let before = null, passed = 0;
    const advance = (now) => {
      if (!this.playing) return;
      passed += before === null ? 0 : Math.min(now - before, 1000) / 1000;
      before = now;
      if (!still || passed >= seconds / stills) {
        const next = this.time + (this.end - this.begin) * passed / seconds;
        passed = 0;
        this.set(next);
        if (next >= this.end) return this.show(false);
      }
      requestAnimationFrame(advance);
    };
    requestAnimationFrame(advance);
  }
  pause() { if (this.playing) this.show(false); }
}
