// What can be taken along: files, made when they are asked for.
import {element} from './dom.js';

function save(name, content, type) {
  const address = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], {type}));
  element('a', {href: address, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

// A picture as a browser paints it, at 300 dots an inch.
function painted(svg) {
  return new Promise((resolve, reject) => {
    const image = new Image();
    image.onload = () => {
      const scale = 300 / 96, canvas = element('canvas', {width: Math.round(image.width * scale), height: Math.round(image.height * scale)});
      canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => blob ? resolve(blob) : reject(new Error('The picture is too large for this browser.')), 'image/png');
    };
    image.onerror = () => reject(new Error('This browser does not paint the figure.'));
    image.src = 'data:image/svg+xml;charset=utf-8,' + encodeURIComponent(svg);
  });
}

export function exportItems({text, files, title, ask, runs, notice}) {
  const name = () => title().toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '').slice(0, 40) || 'experiment';
  const item = (label, hint, work) => element('button', {type: 'button', onclick: async () => {
    document.getElementById('export').open = false;
    try {
      await work();
    } catch (error) {
      notice(error.message);
    }
  }}, element('b', {}, label), ' ', element('span', {}, hint));
  const documentItem = (label, hint, form, ending, type) => item(label, hint, async () => {
    const answer = await ask({task: 'document', form, text: text()});
    if (answer.problems) throw new Error(label + ': ' + answer.problems[0].what);
    save(name() + ending, answer.document, type);
  });
  const figures = () => {
    if (!runs.last || runs.last.answer.figures.length === 0) throw new Error('There is no figure yet: run the experiment first.');
    return runs.last.answer.figures;
  };
  return [
    item('JSON', 'the experiment, and its files', () => {
      save(name() + '.json', text(), 'application/json');
      for (const [file, content] of Object.entries(files.namedIn(text()))) save(file, content, 'text/csv');
    }),
    documentItem('C', 'the integrator, one file of C99', 'c', '.c', 'text/x-c'),
    documentItem('LaTeX', 'the ladder', 'latex', '.tex', 'application/x-tex'),
    documentItem('Markdown', 'the ladder', 'markdown', '.md', 'text/markdown'),
    documentItem('HTML', 'the ladder, a page', 'html', '.html', 'text/html'),
    item('SVG', 'the figures of the run', () => { for (const {name: figure, svg} of figures()) save(name() + '-' + figure + '.svg', svg, 'image/svg+xml'); }),
    item('PNG', 'the figures of the run', async () => { for (const {name: figure, svg} of figures()) save(name() + '-' + figure + '.png', await painted(svg)); }),
    item('CSV', 'the rows of the run', () => {
      if (!runs.last) throw new Error('There are no rows yet: run the experiment first.');
      runs.last.answer.runs.forEach((_, i, all) => save(name() + (all.length > 1 ? '-' + (i + 1) : '') + '.csv', runs.table(i), 'text/csv'));
    }),
  ];
}
