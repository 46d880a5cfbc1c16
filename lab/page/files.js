// Files beside the experiment: tables that it names, netlists that become experiments.
import {element} from './dom.js';

const netlist = /\.(cir|ckt|net|netlist|sp|spi|spice)$/i;

// URDF, SDF and MJCF, which are XML.
const robot = /<(robot|sdf|mujoco)[\s>]/;

// A JSON text that is an experiment.
function isExperiment(text) {
  try {
    return typeof JSON.parse(text).system !== 'undefined';
  } catch {
    return false;
  }
}

export class Files {
  // changed(): a file came, or went; experiment(text); netlist(text); robot(name): one that cannot be read here; all by what
  // its user adds.
  constructor(parent, desk, {changed, experiment, netlist, robot}) {
    this.texts = new Map();
    this.host = {changed, experiment, netlist, robot};
    this.parent = parent;
    this.list = element('ul', {});
    const chosen = element('input', {type: 'file', multiple: true, hidden: true, 'aria-label': 'Files to add', onchange: () => {
      this.add([...chosen.files]);
      chosen.value = '';
    }});
    const summary = this.summary = element('summary', {}, 'Files');
    parent.append(summary,
      element('p', {class: 'hint'}, 'Tables in CSV that the experiment names, as ', element('code', {}, '"file": "wind.csv"'),
        '. An experiment or a netlist of SPICE is opened. They can be dropped here too; none of them leaves this page.'),
      this.list, element('button', {type: 'button', onclick: () => chosen.click()}, 'Add files'), chosen);
    // Before the editor, which would write the text of a file into the experiment.
    desk.addEventListener('dragover', (event) => {
      if (event.dataTransfer.types.includes('Files')) event.preventDefault();
    }, true);
    desk.addEventListener('drop', (event) => {
      if (event.dataTransfer.files.length === 0) return;
      event.preventDefault();
      event.stopPropagation();
      this.add([...event.dataTransfer.files]);
    }, true);
  }

  async add(files) {
    const all = await Promise.all(files.map(async (file) => ({name: file.name, text: await file.text()})));
    const robots = all.filter(({text}) => robot.test(text.slice(0, 10000))), read = all.filter((one) => !robots.includes(one));
    if (robots.length > 0) this.host.robot(robots[0].name);
    if (read.length === 0) return;
    const experiments = read.filter(({text}) => isExperiment(text)), others = read.filter((one) => !experiments.includes(one));
    for (const {name, text} of others) this.texts.set(name, text);
    if (others.length > 0) this.parent.open = true;
    this.draw();
    const circuit = others.find(({name}) => netlist.test(name));
    if (experiments.length > 0) this.host.experiment(experiments[0].text);
    else if (circuit) this.host.netlist(circuit.text);
    else this.host.changed();
  }

  // What comes with an experiment: {name: text}.
  put(texts = {}) {
    for (const [name, text] of Object.entries(texts)) this.texts.set(name, text);
    this.draw();
  }

  get all() { return Object.fromEntries(this.texts); }

  // Those that texts of experiments name.
  namedIn(...texts) {
    return Object.fromEntries([...this.texts].filter(([name]) => texts.some((text) => text.includes(JSON.stringify(name)))));
  }

  draw() {
    this.summary.textContent = this.texts.size === 0 ? 'Files' : 'Files (' + this.texts.size + ')';
    this.list.replaceChildren(...[...this.texts].map(([name, text]) => element('li', {}, element('code', {}, name), ' ',
      element('span', {class: 'soft'}, text.split('\n').filter((line) => line.trim()).length.toLocaleString('en') + ' lines'), ' ',
      element('button', {type: 'button', class: 'pin', 'aria-label': 'Take ' + name + ' away', onclick: () => {
        this.texts.delete(name);
        this.draw();
        this.host.changed();
      }}, 'remove'))));
  }
}
