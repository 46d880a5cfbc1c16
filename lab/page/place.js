// Where in the text of an experiment a problem is.
import {findNodeAtLocation, parseTree} from 'jsonc-parser';

function segments(pointer) {
  return pointer.split('/').slice(1).map((part) => part.replace(/~1/g, '/').replace(/~0/g, '~'));
}

// The node of a pointer; or the nearest one above it and the first name that is missing there.
function nodeAt(text, pointer) {
  const tree = parseTree(text);
  if (!tree) return {node: null};
  let node = tree;
  for (const part of segments(pointer)) {
    const step = node.type === 'array' ? Number(part) : part;
    const next = findNodeAtLocation(node, [step]);
    if (!next) return {node, missing: part};
    node = next;
  }
  return {node};
}

// {from, to, what}: places in the text. A formula's problem has its column within the formula.
export function placed(text, {where, what}) {
  const line = /^line (\d+)(?:, column (\d+))?/.exec(where);
  if (line) {
    const lines = text.split('\n');
    const before = lines.slice(0, Number(line[1]) - 1).reduce((sum, one) => sum + one.length + 1, 0);
    const from = Math.min(text.length, before + Math.max(0, Number(line[2] || 1) - 1));
    return {from, to: Math.min(text.length, from + (line[2] ? 1 : (lines[line[1] - 1] || ' ').length)), what};
  }
  const {node, missing} = where.startsWith('/') ? nodeAt(text, where) : {node: null};
  if (!node) return {from: 0, to: 0, what: where && !where.startsWith('/') ? where + ': ' + what : what};
  let from = node.offset, to = node.offset + node.length;
  const column = /^column (\d+): /.exec(what);
  if (column && node.type === 'string') {
    from = Math.min(to - 1, node.offset + Number(column[1]));
    to = Math.min(to - 1, from + (/^\w+/.exec(text.slice(from)) || [' '])[0].length);
  } else if (node.type === 'object' || node.type === 'array') {
    to = from + 1;
  }
  return {from, to, what: missing ? '“' + missing + '” ' + what : what};
}
