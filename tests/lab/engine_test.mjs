// The engine in WebAssembly: every experiment holds its expectations, with the digits of the native interpreter.
//
//   node engine_test.mjs [--brief] ENGINE [COURANT] [NAME...]
//
// ENGINE: the folder of courant_engine.js; COURANT: the command to compare with. --brief: without the runs of more than 2,000 steps
// and without systems with `repeat` or sums, which are large.
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import os from 'node:os';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

const given = process.argv.slice(2), brief = given[0] === '--brief';
const [engineFolder, courant, ...only] = brief ? given.slice(1) : given;
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

// ---- the experiments ----

function isLong({system, time = {}}) {
  const steps = time.step ? ((time.end ?? 0) - (time.start ?? 0)) / time.step : time.steps ?? 0;
  return !(steps <= 2000) || /"repeat"|sum\(/.test(JSON.stringify(system));
}

// Not in a browser: a table beside the experiment, and many runs at once.
const left = new Map([['port_hamiltonian_table', 'reads a file beside it'], ['ensemble_pendulum', 'reads a file beside it'], ['ensemble_dephasing', 'makes many runs']]);
const tolerance = 1e-12;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'lab-'));
const names = only.length > 0 ? only : fs.readdirSync(path.join(root, 'experiments')).filter((file) => file.endsWith('.json') && file !== 'schema.json').map((file) => file.slice(0, -5));
const started = Date.now();
let ran = 0, compared = 0, worst = 0, worstName = '';
const times = [];
for (const name of names) {
  if (left.has(name)) continue;
  const file = path.join(root, 'experiments', name + '.json'), text = fs.readFileSync(file, 'utf8');
  const document = JSON.parse(text);
  if (/_long$/.test(name)) continue; // the same systems in more steps
  if (brief && isLong(document)) continue;
  const began = Date.now();
  const ladder = ask({task: 'ladder', text});
  times.push({name, milliseconds: Date.now() - began});
  expect(name + ': has a ladder', ladder.ladder, JSON.stringify(ladder.problems));
  if (!document.method) continue;
  const answer = ask({task: 'run', texts: [text], rows: 16});
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
    lines[i].split(',').map(Number).forEach((native, k) => {
      const here = values[i * columns.length + k];
      if (Number.isFinite(native) || Number.isFinite(here)) greatest = Math.max(greatest, Math.abs(here - native) / Math.max(1, Math.abs(native)));
    });
  }
  if (greatest > worst) worst = greatest, worstName = name;
  expect(name + ': digits', greatest <= tolerance, greatest);
  fs.rmSync(digits, {recursive: true});
}
fs.rmSync(folder, {recursive: true});
times.sort((a, b) => a.milliseconds - b.milliseconds);
if (only.length === 0) expect('most experiments ran', ran > (brief ? 60 : 100), ran);
console.log(`${ran} runs as expected, ${compared} compared (greatest difference ${worst.toExponential(1)}, ${worstName}), ${times.length} ladders: median ` +
  `${times[Math.floor(times.length / 2)].milliseconds} ms, worst ${times[times.length - 1].milliseconds} ms (${times[times.length - 1].name}); ` +
  `${Math.round(engine.HEAPU8.length / 1e6)} MB, ${Math.round((Date.now() - started) / 1000)} s`);
process.exit(failures === 0 ? 0 : 1);
