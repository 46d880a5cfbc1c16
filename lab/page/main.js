// The laboratory: one text, its ladder, its runs.
import {$, element} from './dom.js';
import {Editor} from './editor.js';
import {Engine, Stopped, unpacked} from './engine.js';
import {exportItems} from './exports.js';
import {Files} from './files.js';
import {placed} from './place.js';
import {Runs} from './runs.js';
import {Schema} from './schema.js';
import {asked, linkTo} from './share.js';
import {showChapter} from './tour.js';
import {Values} from './values.js';

const stored = 'courant-laboratory';
const wait = 120;       // ms after the last key
const patience = 400;   // ms until a Stop is offered

let library, editor, values, runs, files;
const engine = new Engine();
const state = {
  good: null,      // {text, answer}: the last one without problems
  chapter: 0,
  asking: 0,
  timer: null,
  veiled: false,
};

function notice(text) {
  $('notice').textContent = text;
  clearTimeout(notice.timer);
  if (text) notice.timer = setTimeout(() => { $('notice').textContent = ''; }, 6000);
}

// ---- what is kept ----

function keep() {
  const kept = {text: editor.text, good: state.good && state.good.text, chapter: state.chapter, predict: $('predict').checked};
  // A browser may keep nothing, or no files of this size.
  for (const more of [{files: files.all}, {}]) {
    try {
      localStorage.setItem(stored, JSON.stringify({...kept, ...more}));
      return;
    } catch { /* the next is shorter */ }
  }
}

function kept() {
  try {
    return JSON.parse(localStorage.getItem(stored)) || {};
  } catch {
    return {};
  }
}

// ---- the ladder ----

function problemsOf(text, problems) { return problems.map((one) => placed(text, one)); }

function showProblems(text, problems) {
  editor.mark(problemsOf(text, problems));
  $('ladder').classList.toggle('stale', problems.length > 0 && state.good !== null);
  if (problems.length === 0) return;
  const first = problems[0];
  $('verdict').className = 'bad';
  const said = (first.where ? first.where + ': ' : '') + first.what;
  $('verdict').textContent = (said.length > 200 ? said.slice(0, 200) + ' …' : said) + (problems.length > 1 ? ' (and ' + (problems.length - 1) + ' more)' : '') +
    (state.good ? ' Below is the ladder before.' : '');
}

function inShort(ladder) {
  const parts = [ladder.verdict.replace('-', ' ')];
  if (ladder.index !== null && ladder.index !== undefined) parts.push('index ' + ladder.index);
  const free = ladder.degrees_of_freedom;
  if (free !== null && free !== undefined) parts.push(free + (free === 1 ? ' degree of freedom' : ' degrees of freedom'));
  if (ladder.gauge_dimension > 0) parts.push('gauge ' + ladder.gauge_dimension);
  if (ladder.ambiguous) parts.push('doubted');
  return parts.join(' · ');
}

// Draws an answer; its text is the good one from now on.
function draw(text, answer) {
  const title = answer.title;
  state.good = {text, answer};
  $('ladder').classList.remove('stale');
  $('title').textContent = title === 'Constraint algorithm' ? 'Experiment' : title;
  document.title = (title === 'Constraint algorithm' ? '' : title + ' – ') + 'Courant: laboratory';
  let written = {};
  try { written = JSON.parse(text); } catch { /* what the engine reads is JSON */ }
  if (!state.veiled) reveal();
  $('remarks').replaceChildren(...answer.remarks.map(({where, what}) => element('li', {}, (where ? where + ': ' : '') + what)));
  runs.settingsOf(written, answer);
  $('discrete').hidden = !(written.method && written.time);
  if ($('discrete').open) showDiscrete();
  keep();
}

function reveal() {
  state.veiled = false;
  const {answer} = state.good;
  $('prediction').hidden = true;
  $('ladder').classList.remove('veiled');
  const {verdict, ambiguous} = answer.ladder;
  $('verdict').className = (verdict === 'regular' || verdict === 'gauge') && !ambiguous ? 'good' : 'bad';
  $('verdict').textContent = inShort(answer.ladder);
  $('page').innerHTML = answer.page;
}

function veil() {
  state.veiled = true;
  $('prediction').reset();
  $('score').textContent = '';
  $('prediction').hidden = false;
  $('ladder').classList.add('veiled');
  $('verdict').className = '';
  $('verdict').textContent = 'The ladder is known. What do you expect?';
}

function dimensionOf(ladder) {
  const last = ladder.levels[ladder.levels.length - 1];
  return last ? last.dim_M : null;
}

function judge() {
  const {ladder} = state.good.answer;
  const marks = [];
  const compare = (name, guess, truth) => {
    if (guess === '') return;
    const is = truth === null || truth === undefined ? 'none' : String(truth);
    marks.push(guess === is ? '✓ ' + name + ' ' + is : '✗ ' + name + ' is ' + is + ', not ' + guess);
  };
  compare('verdict', $('guess-verdict').value, ladder.verdict);
  compare('dim M', $('guess-dimension').value, dimensionOf(ladder));
  compare('index', $('guess-index').value, ladder.index);
  $('score').textContent = marks.join('   ');
  reveal();
  $('ladder').focus({preventScroll: true});
}

async function answered(question) {
  const patient = setTimeout(() => { $('stop-ladder').hidden = false; }, patience);
  try {
    const told = await engine.ask({files: files.namedIn(question.text), ...question});
    $('memory').textContent = 'The engine has ' + Math.round(told.bytes / 1e6) + ' MB of memory; the last answer took ' + Math.round(told.milliseconds) + ' ms.';
    return told.answer;
  } finally {
    clearTimeout(patient);
    $('stop-ladder').hidden = !engine.busy;
  }
}

// Asks for the ladder of a text, unless another one comes first. {ladder, …} or {problems}; null if it was stopped.
async function ask(text) {
  try {
    return await answered({task: 'ladder', text});
  } catch (error) {
    if (error instanceof Stopped) return null;
    return {problems: [{where: '', what: error.message}]};
  }
}

async function redraw() {
  const text = editor.text, number = ++state.asking;
  keep();
  // A netlist that was written or pasted, to its end.
  if (/^\s*[^\s{]/.test(text) && /^\.end\s*$/im.test(text)) return openNetlist(text);
  // Nobody waits for the ladder of a text that is no longer there.
  if (engine.busy) engine.stop();
  const began = performance.now();
  const answer = await ask(text);
  if (number !== state.asking) return;
  if (!answer) {
    $('verdict').className = 'bad';
    $('verdict').textContent = 'Stopped. The ladder below is the one before.';
    return;
  }
  if (answer.problems) {
    showProblems(text, answer.problems);
  } else {
    editor.mark([]);
    draw(text, answer);
    values.show(text, answer);
  }
  window.courantLaboratory.lastRedraw = performance.now() - began;
}

function forget() {
  ++state.asking;
  clearTimeout(state.timer);
}

function edited() {
  clearTimeout(state.timer);
  state.timer = setTimeout(redraw, wait);
}

// A text from elsewhere: a chapter, the library, a link.
async function load(text, {chapter = 0, predict = $('predict').checked, beside = {}} = {}) {
  files.put(beside);
  editor.text = text;
  editor.mark([]);
  state.chapter = chapter;
  $('chapter').hidden = chapter === 0;
  $('score').textContent = '';
  runs.clear();
  showTab('ladder');
  $('discrete').open = chapter > 0 && library.chapters[chapter - 1].arguments.includes('--discrete');
  if (predict) veil();
  else {
    state.veiled = false;
    $('prediction').hidden = true;
    $('ladder').classList.remove('veiled');
  }
  await redraw();
  if (state.veiled && $('ladder').classList.contains('stale')) reveal();
}

async function showDiscrete() {
  const page = $('discrete-page');
  try {
    const answer = await answered({task: 'discrete', text: state.good.text});
    page.innerHTML = answer.page || '';
    if (answer.problems) page.textContent = answer.problems.map(({what}) => what).join(' ');
  } catch (error) {
    page.textContent = error instanceof Stopped ? 'Stopped.' : error.message;
  }
}

function openChapter(number) {
  const chapter = library.chapters[number - 1];
  if (!chapter) return notice('There is no chapter ' + number + '; the tour has ' + library.chapters.length + '.');
  showChapter($('chapter'), library.chapters, number, {
    show: openChapter,
    again: () => load(chapter.experiment, {chapter: number, predict: false}),
    close: () => { $('chapter').hidden = true; state.chapter = 0; keep(); },
  });
  return load(chapter.experiment, {chapter: number, predict: true});
}

function openExperiment(name) {
  const found = [...library.experiments, ...library.ladders].find((one) => one.name === name);
  if (!found) return notice('There is no experiment “' + name + '” in the library.');
  return load(found.text, {beside: found.files});
}

// A netlist in the editor becomes an experiment, unless lines are wrong, which are marked. It may include any of the files.
async function openNetlist(text) {
  editor.text = text;
  const answer = await answered({task: 'import', text, files: files.all}).catch((error) => ({problems: [{where: '', what: error.message}]}));
  if (answer.problems) return showProblems(text, answer.problems);
  await load(answer.document);
  $('remarks').append(...answer.remarks.map(({where, what}) => element('li', {}, 'The netlist, ' + where + ': ' + what)));
}

// ---- what is shown ----

function showTab(name) {
  for (const one of ['ladder', 'motion']) {
    $(one).hidden = one !== name;
    $('tab-' + one).setAttribute('aria-selected', String(one === name));
    $('tab-' + one).tabIndex = one === name ? 0 : -1;
  }
}

function listenToTabs() {
  for (const one of ['ladder', 'motion']) {
    $('tab-' + one).addEventListener('click', () => showTab(one));
    $('tab-' + one).addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
      const other = one === 'ladder' ? 'motion' : 'ladder';
      showTab(other);
      $('tab-' + other).focus();
    });
  }
}

// ---- the library ----

function buildLibrary() {
  const entry = (title, summary, go) => {
    const button = element('button', {type: 'button', onclick: () => { $('library').close(); go(); }}, element('b', {}, title), ' ', element('span', {}, summary));
    button.dataset.words = (title + ' ' + summary).toLowerCase();
    return element('li', {}, button);
  };
  const shelf = (title, items) => element('section', {}, element('h3', {}, title), element('ul', {}, ...items));
  $('shelves').replaceChildren(
    shelf('The tour', library.chapters.map((chapter, i) => entry(i + 1 + '. ' + chapter.title, '', () => openChapter(i + 1)))),
    shelf('A beginning of each kind', library.kinds.map(({type, summary}) => entry(type, summary, async () => {
      const told = await engine.ask({task: 'new', kind: type});
      if (told.answer.document) load(told.answer.document);
      else notice(told.answer.problems[0].what);
    }))),
    shelf('Ladders that are known', library.ladders.map(({name, title, description}) => entry(title || name, description, () => openExperiment(name)))),
    shelf('Experiments', library.experiments.map(({name, title, description}) => entry(title || name, description, () => openExperiment(name)))));
  $('search').addEventListener('input', () => {
    const words = $('search').value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const button of $('shelves').querySelectorAll('button'))
      button.parentNode.hidden = !words.every((word) => button.dataset.words.includes(word));
    for (const section of $('shelves').querySelectorAll('section'))
      section.hidden = !section.querySelector('li:not([hidden])');
  });
}

// ---- links ----

async function share() {
  const {fragment, left} = await linkTo(editor.text, files.namedIn(editor.text));
  const address = location.href.replace(/#.*/, '') + fragment;
  history.replaceState(null, '', address);
  const carries = address.length + ' characters, with the whole experiment.' +
    (left.length > 0 ? ' It has no room for ' + left.join(', ') + ': hand that along, to be added under Files.' : '');
  try {
    await navigator.clipboard.writeText(address);
    notice('The link is in the clipboard: ' + carries);
  } catch {
    notice('The address of this page is the link now: ' + carries);
  }
}

async function followAddress() {
  const wanted = await asked(location.hash).catch(() => ({broken: true}));
  if (wanted.broken) notice('The link is damaged: it has no experiment.');
  else if (wanted.text) await load(wanted.text, {predict: false, beside: wanted.files});
  else if (wanted.chapter) await openChapter(wanted.chapter);
  else if (wanted.experiment) await openExperiment(wanted.experiment);
  else return false;
  return !wanted.broken;
}

async function begin() {
  library = JSON.parse(new TextDecoder().decode(await unpacked('library-texts')));
  const schema = new Schema(library.schema);
  editor = new Editor($('editor'), schema, {onEdit: edited, onRun: () => runs.start()});
  files = new Files($('files'), document.querySelector('.desk'), {
    changed: () => redraw(),
    experiment: (text) => load(text),
    netlist: openNetlist,
    robot: (name) => showProblems(editor.text, [{where: name, what: 'is a robot, which the laboratory cannot read. The command can: courant import ' + name + ' -o robot.json writes an experiment that opens here.'}]),
  });
  runs = new Runs({
    schema,
    files,
    text: () => editor.text,
    replaced: (text) => { editor.text = text; return redraw(); },
    problems: (problems) => showProblems(editor.text, problems),
    shown: () => showTab('motion'),
  });
  listenToTabs();
  values = new Values($('values'), {
    text: () => editor.text,
    point: () => state.good.answer.ladder.consistent_point,
    ask,
    // From now on the text is this one, whose ladder is known; what was asked of others does not matter any more.
    moved: (text, answer) => { forget(); editor.text = text; draw(text, answer); editor.mark([]); },
    changed: (text, answer) => {
      forget();
      editor.text = text;
      if (answer.problems) return showProblems(text, answer.problems);
      editor.mark([]);
      draw(text, answer);
    },
    refused: (name, problems) => notice(name + ' cannot be moved there: ' + problems[0].what),
    replaced: (text) => { editor.text = text; redraw(); },
    settled: () => { keep(); },
  });
  // For tests, and for who looks into the console.
  window.courantLaboratory = {engine, library, state, runs, files, load, ask, get text() { return editor.text; },
    type: (text) => { editor.text = text; edited(); }};
  buildLibrary();

  $('open').addEventListener('click', () => { $('library').showModal(); $('search').focus(); });
  $('close').addEventListener('click', () => $('library').close());
  $('library').addEventListener('click', (event) => { if (event.target === $('library')) $('library').close(); });
  $('share').addEventListener('click', share);
  $('stop-ladder').addEventListener('click', () => engine.stop());
  $('prediction').addEventListener('submit', (event) => { event.preventDefault(); judge(); });
  $('predict').addEventListener('change', () => {
    if (!$('predict').checked && state.veiled && state.good) reveal();
    keep();
  });
  $('values').addEventListener('submit', (event) => event.preventDefault());
  $('discrete').addEventListener('toggle', () => { if ($('discrete').open && state.good) showDiscrete(); });
  $('exports').replaceChildren(...exportItems({text: () => editor.text, files, title: () => $('title').textContent, ask: (question) => answered(question), runs, notice}));
  document.addEventListener('click', (event) => { if (!event.target.closest('#export')) $('export').open = false; });
  document.addEventListener('keydown', (event) => { if (event.key === 'Escape') $('export').open = false; });
  window.addEventListener('hashchange', followAddress);

  const before = kept();
  $('predict').checked = before.predict === true;
  files.put(before.files);
  if (await followAddress()) return;
  if (!before.text) return openChapter(1);
  // The last good one first, so that there is a picture beside what is being written.
  if (before.good && before.good !== before.text) await load(before.good, {predict: false});
  if (before.chapter > 0 && library.chapters[before.chapter - 1])
    showChapter($('chapter'), library.chapters, before.chapter, {
      show: openChapter,
      again: () => load(library.chapters[before.chapter - 1].experiment, {chapter: before.chapter, predict: false}),
      close: () => { $('chapter').hidden = true; state.chapter = 0; keep(); },
    });
  await load(before.text, {chapter: before.chapter || 0, predict: false});
}

begin().catch((error) => {
  $('verdict').className = 'bad';
  $('verdict').textContent = 'This browser cannot show the laboratory: ' + error.message + '. It needs WebAssembly with exceptions: Chromium 95, Firefox 113, Safari 16.4 or later.';
});
