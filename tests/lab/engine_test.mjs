// The engine in WebAssembly: every experiment holds its expectations, with the digits of the native interpreter.
//
//   node engine_test.mjs [--brief] ENGINE [COURANT] [NAME...]
//
// ENGINE: the folder of courant_engine.js; COURANT: the command to compare with. --brief: without the runs of more than 2,000 steps
// and without systems with `repeat` or sums, which are large; of the others those of the part of a campaign that
// COURANT_CAMPAIGN names, "2/4" (tests/core/campaign.hpp), or all.
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import os from 'node:os';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

const given = process.argv.slice(2), brief = given[0] === '--brief';
const [engineFolder, courant, ...only] = brief ? given.slice(1) : given;
const [part, parts] = brief && /^\d+\/\d+$/.test(process.env.COURANT_CAMPAIGN) ? process.env.COURANT_CAMPAIGN.split('/').map(Number) : [0, 1];
const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const program = fs.readFileSync(path.join(engineFolder, 'courant_engine.wasm'));
const load = createRequire(import.meta.url)(path.resolve(engineFolder, 'courant_engine.js'));
const engine = await load({wasmBinary: program});

let failures = 0;
function expect(what, condition, found = '') {
  if (condition) return;
  ++failures;
  console.log(`${what}: failed\n    ${found}`);
}

function ask(question) {
  const text = JSON.stringify(question), size = engine.lengthBytesUTF8(text) + 1, memory = engine._malloc(size);
  engine.stringToUTF8(text, memory, size);
  const answer = JSON.parse(engine.UTF8ToString(engine._courant_answer(memory)));
  engine._free(memory);
  return answer;
}

function rows() {
  const first = engine._courant_rows(0) / 8;
  return engine.HEAPF64.slice(first, first + engine._courant_row_values(0));
}

// ---- what must go wrong ----

const wrong = ask({task: 'ladder', text: '{"system": {"type": "lagrangian", "coordinates": ["q"], "lagrangian": "qq\'^2"}, "initial": {"q": 0}}'});
expect('a wrong formula has its place', (wrong.problems || [{}])[0].where === '/system/lagrangian' && /qq/.test(wrong.problems[0].what), JSON.stringify(wrong));
expect('no JSON has its line', /^line 1/.test((ask({task: 'ladder', text: '{'}).problems || [{}])[0].where), JSON.stringify(ask({task: 'ladder', text: '{'})));
expect('an unknown task is said', (ask({task: 'dance'}).problems || []).length === 1);
expect('a run without a method is said', /method/.test((ask({task: 'run', texts: ['{"system": {"type": "lagrangian", "coordinates": ["q"], "lagrangian": "q\'^2/2"}, "initial": {"q": 0, "q\'": 1}}']}).problems || [{what: ''}])[0].what));

// ---- files beside an experiment ----

const blown = JSON.stringify({
  system: {type: 'port-hamiltonian', tables: {wind: {file: 'wind.csv'}}, coordinates: ['x'], J: [[0]], R: [[1]], B: [1], hamiltonian: 'x^2/2', ports: 'open', inputs: ['2*wind']},
  initial: {x: 1}, method: 'discretize-first', time: {step: 0.1, end: 1}, observe: {wind: 'wind'},
});
const files = {'wind.csv': 't,speed\n0,2\n1,5\n'};
const unread = ask({task: 'ladder', text: blown, files: {'winds.csv': ''}}).problems || [{}];
expect('a table that is not there is said', unread[0].where === '/system/tables/wind/file' && /wind\.csv, which is not here.*did you mean "winds\.csv"/.test(unread[0].what), JSON.stringify(unread));
const broken = ask({task: 'ladder', text: blown, files: {'wind.csv': 't,speed\n0,2\n1,fast\n'}}).problems || [{}];
expect('what is wrong in a table has its line', /wind\.csv:3 has "fast"/.test(broken[0].what), JSON.stringify(broken));
expect('a table is read', ask({task: 'ladder', text: blown, files}).ladder.verdict === 'regular');
const {names: columnsOfWind} = ask({task: 'run', texts: [blown], files, rows: 16}).runs[0];
const wind = [...rows()].filter((_, i) => i % columnsOfWind.length === columnsOfWind.indexOf('wind'));
expect('a run has the table', wind.length === 11 && wind.every((value, i) => Math.abs(value - (2 + 0.3 * i)) < 1e-12), wind.join());

// ---- netlists ----

const circuit = ask({task: 'import', text: 'low pass\nV1 in 0 DC 5\n.include parts.lib\nC1 out 0 1u ic=0\n.tran 1u 1m uic\n.end\n', files: {'parts.lib': 'R1 in out 1k\n'}});
expect('a netlist becomes an experiment', JSON.parse(circuit.document || '{}').system.type === 'network' && /"R1"/i.test(circuit.document), JSON.stringify(circuit));
expect('which has a ladder', ask({task: 'ladder', text: circuit.document}).ladder.verdict === 'regular');
for (const [line, wrong, what] of [[3, 'Y1 in 0 3', /Y1/i], [3, '.include other.lib', /other\.lib is not here/]]) {
  const [slip = {}] = ask({task: 'import', text: 'slip\nR1 in 0 1k\n' + wrong + '\nC1 in 0 1u\n.tran 1u 1m\n.end\n'}).problems || [];
  expect('a wrong line of a netlist is named: ' + wrong, slip.where === 'line ' + line && what.test(slip.what), JSON.stringify(slip));
}

// ---- the catalogue ----

for (const {type} of ask({task: 'start'}).kinds) {
  const made = ask({task: 'new', kind: type});
  const found = made.document ? ask({task: 'ladder', text: made.document}) : made;
  expect('a beginning of ' + type + ' has a ladder', found.ladder, JSON.stringify(found.problems));
}
const ladders = path.join(root, 'experiments', 'ladders');
let known = 0;
for (const file of fs.readdirSync(ladders).filter((one) => one.endsWith('.json'))) {
  const text = fs.readFileSync(path.join(ladders, file), 'utf8'), {expect: given = []} = JSON.parse(text);
  const found = ask({task: 'ladder', text}), verdicts = [given].flat().map(({verdict}) => verdict).filter(Boolean);
  expect(file + ': has a ladder', found.ladder, JSON.stringify(found.problems));
  for (const verdict of verdicts) expect(file + ': as expected', found.ladder.verdict === verdict, found.ladder.verdict + ', not ' + verdict);
  known += verdicts.length;
}
expect('known ladders have verdicts', known > 40, known);

// ---- the experiments ----

function isLong({system, time = {}}) {
  const steps = time.step ? ((time.end ?? 0) - (time.start ?? 0)) / time.step : time.steps ?? 0;
  return !(steps <= 2000) || /"repeat"|sum\(/.test(JSON.stringify(system));
}

// The tables that an experiment names.
function filesOf(document) {
  const found = {};
  JSON.stringify(document, (key, value) => {
    if ((key === 'file' || key === 'table') && typeof value === 'string') found[value] = fs.readFileSync(path.join(root, 'experiments', value), 'utf8');
    return value;
  });
  return found;
}

// Not in a browser: many runs at once.
const left = new Set(['ensemble_pendulum', 'ensemble_dephasing']);
const tolerance = 1e-12;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'lab-'));
const names = only.length > 0 ? only : fs.readdirSync(path.join(root, 'experiments')).filter((file) => file.endsWith('.json') && file !== 'schema.json').map((file) => file.slice(0, -5))
  .sort().filter((_, k) => k % parts === part);
const started = Date.now();
let ran = 0, compared = 0, worst = 0, worstName = '';
const times = [];
for (const name of names) {
  if (left.has(name)) continue;
  const file = path.join(root, 'experiments', name + '.json'), text = fs.readFileSync(file, 'utf8');
  const document = JSON.parse(text), beside = filesOf(document);
  if (/_long$/.test(name)) continue; // the same systems in more steps
  if (brief && isLong(document)) continue;
  const began = Date.now();
  const ladder = ask({task: 'ladder', text, files: beside});
  times.push({name, milliseconds: Date.now() - began});
  expect(name + ': has a ladder', ladder.ladder, JSON.stringify(ladder.problems));
  if (!document.method) continue;
  const answer = ask({task: 'run', texts: [text], files: beside, rows: 16});
  if (answer.problems) {
    expect(name + ': runs', false, JSON.stringify(answer.problems));
    continue;
  }
  ++ran;
  const [{status, message, expected, summary, names: columns}] = answer.runs;
  const failed = summary.expectations.filter(({passed}) => !passed);
  expect(name + ': as expected', expected, status + ' ' + message + JSON.stringify(failed));
  if (!courant) continue;
  const digits = path.join(folder, name);
  try {
    execFileSync(courant, ['run', file, '-o', digits, '--backend', 'interpreter', '--force', '--quiet'], {stdio: 'ignore'});
  } catch (error) { /* what fails natively is compared too */ }
  if (!fs.existsSync(path.join(digits, 'trajectory.csv'))) continue;
  const lines = fs.readFileSync(path.join(digits, 'trajectory.csv'), 'utf8').trim().split('\n').slice(1);
  const values = rows();
  expect(name + ': as many rows', lines.length * columns.length === values.length, `${lines.length} rows natively, ${values.length / columns.length} here`);
  // At the beginning: what follows is chaotic in some.
  ++compared;
  const upTo = Math.min(lines.length, 5);
  let greatest = 0;
  for (let i = 0; i < upTo; ++i) {
    const row = lines[i].split(',').map(Number);
    // What is a sum or a difference of energies has their round-off.
    const energy = Math.abs(row[columns.indexOf('H')] || 0);
    row.forEach((native, k) => {
      const here = values[i * columns.length + k];
      const size = Math.max(1, Math.abs(native), /^(supplied|dissipated|balance)$/.test(columns[k]) ? energy : 0);
      if (Number.isFinite(native) || Number.isFinite(here)) greatest = Math.max(greatest, Math.abs(here - native) / size);
    });
  }
  if (greatest > worst) worst = greatest, worstName = name;
  expect(name + ': digits', greatest <= tolerance, greatest);
  fs.rmSync(digits, {recursive: true});
}
fs.rmSync(folder, {recursive: true});
times.sort((a, b) => a.milliseconds - b.milliseconds);
if (only.length === 0) expect('most experiments ran', ran > (brief ? 60 : 100) / parts, ran);
console.log(`${ran} runs as expected, ${compared} compared (greatest difference ${worst.toExponential(1)}, ${worstName}), ${times.length} ladders: median ` +
  `${times[Math.floor(times.length / 2)].milliseconds} ms, worst ${times[times.length - 1].milliseconds} ms (${times[times.length - 1].name}); ` +
  `${Math.round(engine.HEAPU8.length / 1e6)} MB, ${Math.round((Date.now() - started) / 1000)} s`);
process.exit(failures === 0 ? 0 : 1);
