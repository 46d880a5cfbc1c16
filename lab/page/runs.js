// Runs: by which method, what they gave, and what of it can be taken along.
import {playMotion, startCharts} from './charts.js';
import {$, element, shortNumber} from './dom.js';
import {Engine, Stopped} from './engine.js';
import {withCompactValue, withValue} from './values.js';

const methods = {'constrain-first': 'Method 2 (constrain first)', 'discretize-first': 'Method 1 (discretize first)', 'discrete-gradient': 'Discrete gradient',
                 rk4: 'Runge–Kutta 4', rk2: 'Runge–Kutta 2', dopri5: 'Dormand–Prince 5'};
const rows = 4000;  // of each curve, for the charts

function typeOf(value) { return typeof value === 'string' ? value : value && value.type; }

export class Runs {
  constructor({schema, files, text, replaced, problems, shown}) {
    this.schema = schema;
    this.files = files;
    this.text = text;
    this.replaced = replaced;
    this.problems = problems;
    this.shown = shown;
    this.engine = new Engine();
    this.last = null;  // {answer, rows}
    $('settings').addEventListener('submit', (event) => { event.preventDefault(); this.start(); });
    $('stop').addEventListener('click', () => this.engine.stop());
    $('method').addEventListener('change', () => this.write(['method'], this.withMethod($('method').value)));
    $('discretization').addEventListener('change', () => this.write(['method'], {...this.methodAsObject(), discretization: $('discretization').value}));
    for (const name of ['step', 'end'])
      $(name).addEventListener('change', () => { if ($(name).valueAsNumber) this.write(['time', name], $(name).valueAsNumber); });
    this.written = {};
    this.waveforms = [];  // what a circuit shows that observes nothing
  }

  methodAsObject() {
    const method = this.written.method || {type: 'constrain-first'};
    return typeof method === 'string' ? {type: method} : method;
  }

  // What of a method another one has too.
  withMethod(type) {
    if (type === this.methodAsObject().type) return this.methodAsObject();
    const {discretization} = this.methodAsObject();
    const takes = /^(constrain-first|discretize-first)$/.test(type);
    return {type, ...(takes && discretization ? {discretization} : {})};
  }

  write(path, value) {
    let text = this.text();
    for (const [key, missing] of [['method', {type: 'constrain-first'}], ['time', this.time()]])
      if (!this.written[key]) text = withCompactValue(text, [key], missing);
    this.replaced(withCompactValue(text, path, value));
  }

  time() { return this.written.time || {step: 0.05, end: 10}; }

  // Shows what the text says, or what a run would take where it says nothing.
  settingsOf(written, {waveforms = []} = {}) {
    this.written = written;
    this.waveforms = waveforms;
    const type = typeOf(written.method) || 'constrain-first';
    const known = Object.entries(methods);
    if (!methods[type]) known.push([type, type]);
    $('method').replaceChildren(...known.map(([value, name]) => element('option', {value, selected: value === type}, name)));
    const discretizations = this.schema.words(['method', 'discretization'], {method: {type: 'constrain-first', discretization: ''}}).map(({value}) => value);
    const discretization = typeOf(this.methodAsObject().discretization) || 'midpoint';
    if (!discretizations.includes(discretization)) discretizations.push(discretization);
    $('discretization').replaceChildren(...discretizations.map((value) => element('option', {value, selected: value === discretization}, value)));
    $('discretization').disabled = !/^(constrain-first|discretize-first)$/.test(type);
    const {step, end} = this.time();
    if (document.activeElement !== $('step')) $('step').value = typeof step === 'number' ? step : '';
    if (document.activeElement !== $('end')) $('end').value = typeof end === 'number' ? end : '';
  }

  texts() {
    let text = this.text();
    if (!this.written.method) text = withCompactValue(text, ['method'], {type: 'constrain-first'});
    if (!this.written.time) text = withCompactValue(text, ['time'], this.time());
    if (!this.written.observe && this.waveforms.length > 0) text = withCompactValue(text, ['observe'], Object.fromEntries(this.waveforms.map((name) => [name, name])));
    if (!$('both').checked) return [text];
    // What is expected is expected of the method of the text.
    const bare = withValue(text, ['expect'], undefined);
    return ['discretize-first', 'constrain-first'].map((type) => withCompactValue(bare, ['method'], this.withMethod(type)));
  }

  clear() {
    if (this.running) this.engine.stop();
    this.last = null;
    $('results').replaceChildren();
    $('told').textContent = '';
  }

  async start() {
    if (this.running) return;
    this.running = true;
    this.shown();
    $('start').disabled = true;
    $('stop').hidden = false;
    $('progress').hidden = false;
    $('progress').removeAttribute('value');
    $('told').textContent = 'Preparing …';
    const began = performance.now();
    let seen = null;
    try {
      const texts = this.texts();
      const told = await this.engine.ask({task: 'run', texts, files: this.files.namedIn(...texts), rows}, ({step, steps, drift}) => {
        seen = {step, steps};
        $('progress').value = steps > 0 ? step / steps : 0;
        $('told').textContent = 'step ' + step.toLocaleString('en') + ' of ' + steps.toLocaleString('en') + (Number.isFinite(drift) ? ', energy off by ' + shortNumber(drift, 2) : '');
      });
      if (told.answer.problems) {
        this.problems(told.answer.problems);
        $('told').textContent = 'Not run: ' + told.answer.problems[0].what;
      } else {
        this.show(told, performance.now() - began);
      }
    } catch (error) {
      $('told').textContent = error instanceof Stopped
        ? 'Stopped' + (seen ? ' at step ' + seen.step.toLocaleString('en') + ' of ' + seen.steps.toLocaleString('en') : '') + '.' + (this.last ? ' Below is the run before.' : '')
        : error.message;
    }
    this.running = false;
    $('start').disabled = false;
    $('stop').hidden = true;
    $('progress').hidden = true;
  }

  show(told, milliseconds) {
    this.last = told;
    const {answer} = told;
    const lines = answer.runs.map(({status, message, expected, summary}) => {
      const parts = [status.replace('-', ' '), summary.steps.toLocaleString('en') + ' steps'];
      if (summary.expectations.length > 0) parts.push(summary.expectations.filter(({passed}) => passed).length + ' of ' + summary.expectations.length + ' expectations passed');
      if (summary.constraints && Number.isFinite(summary.constraints.max_violation)) parts.push('constraints to ' + shortNumber(summary.constraints.max_violation, 2));
      const good = status === 'completed' && expected;
      return element('p', {class: good ? 'outcome' : 'outcome bad'}, (answer.runs.length > 1 ? summary.method.replace(/[ ,(].*/, '') + ': ' : '') + parts.join(' · ') + (message ? '. ' + message : ''));
    });
    $('told').textContent = 'Done in ' + (milliseconds / 1000).toPrecision(2) + ' s.';
    const figures = answer.figures.map(({name, markup, caption}) => {
      const figure = element('figure', {'data-name': name});
      figure.innerHTML = markup;
      // Two methods stand side by side where there is room.
      const panels = figure.querySelector('.panels');
      if (answer.runs.length > 1 && panels.children.length === answer.runs.length) panels.classList.add('abreast');
      figure.append(element('figcaption', {}, caption));
      return figure;
    });
    const first = element('div', {class: 'figures'}, ...figures);
    const tables = element('details', {}, element('summary', {}, 'Numbers'));
    const content = element('div', {class: 'tables'});
    content.innerHTML = answer.tables;
    tables.append(content);
    $('results').replaceChildren(...lines, first, tables);
    startCharts(first, first);
    if (matchMedia('(prefers-reduced-motion: no-preference)').matches) playMotion();
  }

  // The rows of a run as comma-separated values.
  table(i = 0) {
    const {names} = this.last.answer.runs[i], values = this.last.rows[i];
    const cell = (name) => /[",\n]/.test(name) ? '"' + name.replace(/"/g, '""') + '"' : name;
    const lines = [names.map(cell).join(',')];
    for (let at = 0; at < values.length; at += names.length) lines.push(Array.from(values.subarray(at, at + names.length)).join(','));
    return lines.join('\n') + '\n';
  }
}
