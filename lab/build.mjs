// Makes the page of the laboratory, one file that opens from a disk:
//
//   node build.mjs ENGINE OUTPUT      ENGINE: the folder with courant_engine.js and .wasm
//
// Exits with 1 if it is more than `most` bytes when compressed.
import * as esbuild from 'esbuild';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import zlib from 'node:zlib';

const most = 4_000_000;
const here = path.dirname(fileURLToPath(import.meta.url)), root = path.dirname(here);
const [engineFolder, output] = process.argv.slice(2);
if (!output) throw new Error('build.mjs: expected two arguments, the folder of the engine and the file to write');
const read = (...parts) => fs.readFileSync(path.join(...parts), 'utf8');
const packed = (bytes) => zlib.gzipSync(bytes, {level: 9}).toString('base64');

const program = fs.readFileSync(path.join(engineFolder, 'courant_engine.wasm'));
const script = read(engineFolder, 'courant_engine.js');

// What the engine knows and the page needs at once: chapters, kinds, the style of ladders and figures.
async function known() {
  const engine = await createRequire(import.meta.url)(path.resolve(engineFolder, 'courant_engine.js'))({wasmBinary: program});
  const question = JSON.stringify({task: 'start'}), size = engine.lengthBytesUTF8(question) + 1, memory = engine._malloc(size);
  engine.stringToUTF8(question, memory, size);
  return JSON.parse(engine.UTF8ToString(engine._courant_answer(memory)));
}

// The charts of reports are one script after the other, not modules.
const charts = {
  name: 'charts',
  setup(build) {
    build.onLoad({filter: /page\/charts\.js$/}, ({path: file}) => {
      const parts = ['text', 'axis', 'curve', 'chart', 'plane_curve', 'plane_chart', 'space_chart', 'instant'];
      return {contents: parts.map((part) => read(root, 'reporting/page', part + '.js')).join('\n') + read(file)};
    });
  },
};

// The tables that an experiment names, {name: text}.
function filesOf(folder, document) {
  const names = [];
  JSON.stringify(document, (key, value) => {
    if ((key === 'file' || key === 'table') && typeof value === 'string') names.push(value);
    return value;
  });
  return Object.fromEntries(names.map((name) => [name, read(folder, name)]));
}

// Those of a folder, `prefix` before their names.
function experiments(folder, prefix = '') {
  return fs.readdirSync(folder).filter((file) => file.endsWith('.json') && file !== 'schema.json').sort().map((file) => {
    const text = read(folder, file), document = JSON.parse(text), {title, description = '', system} = document;
    const files = filesOf(folder, document);
    return {name: prefix + path.basename(file, '.json'), title, description: description.replace(/\. .*/s, '.'), kind: typeof system === 'string' ? system : system.type,
            text: text.replace(/^\s*"\$schema":.*\n/m, ''), ...(Object.keys(files).length > 0 ? {files} : {})};
  });
}

const {style, chapters, kinds} = await known();
const bundle = await esbuild.build({
  entryPoints: [path.join(here, 'page/main.js')], bundle: true, minify: true, format: 'esm', target: 'es2022', charset: 'utf8',
  legalComments: 'inline', write: false, plugins: [charts], nodePaths: [path.join(here, 'node_modules')],
});
const css = await esbuild.transform(style.replace(/^<style>|<\/style>$/g, '') + read(here, 'page/lab.css'), {loader: 'css', minify: true});
const parts = {
  style: css.code,
  program: packed(program),
  script: packed(Buffer.from(script + '\n' + read(here, 'page/worker.js'))),
  library: packed(Buffer.from(JSON.stringify({schema: JSON.parse(read(root, 'experiments/schema.json')), chapters, kinds, experiments: experiments(path.join(root, 'experiments')),
    ladders: experiments(path.join(root, 'experiments/ladders'), 'ladders/')}))),
  page: bundle.outputFiles[0].text.replace(/<\/script/g, '<\\/script'),
};
const page = read(here, 'page/index.html').replace(/@(style|program|script|library|page)@/g, (_, part) => parts[part]);
fs.mkdirSync(path.dirname(output), {recursive: true});
fs.writeFileSync(output, page);
const compressed = zlib.gzipSync(page, {level: 9}).length;
console.log(`${output}: ${page.length.toLocaleString('en')} bytes, ${compressed.toLocaleString('en')} compressed`);
if (compressed > most) {
  console.error(`${output} is ${compressed} bytes when compressed; expected at most ${most}`);
  process.exit(1);
}
