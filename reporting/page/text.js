// Numbers, names and elements.

const minus = '\u2212';

function fromBase64(text) { return Uint8Array.from(atob(text || ''), (letter) => letter.charCodeAt(0)); }

// float32, little-endian, in base64.
function numbers(text, origin) {
  const bytes = fromBase64(text);
  const view = new DataView(bytes.buffer);
  return Float64Array.from({length: bytes.length / 4}, (_, i) => view.getFloat32(4 * i, true) + origin);
}

// `count` whole numbers of one, two or four bytes, little-endian, in base64.
function unsigned(text, count) {
  const bytes = fromBase64(text), width = count > 0 ? bytes.length / count : 1;
  const all = new Array(count).fill(0);
  for (let k = 0; k < bytes.length; ++k) all[Math.floor(k / width)] += bytes[k] * 256 ** (k % width);
  return all;
}

function superscript(number) {
  const raised = {'-': '⁻', 0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹'};
  return Array.from(String(number), (digit) => raised[digit]).join('');
}

function powerOfTen(exponent) { return '10' + superscript(exponent); }

// As plot::readable: "0.697421", "−1.16 × 10⁻⁴".
function readable(value, digits) {
  if (Number.isNaN(value)) return 'NaN';
  const sign = value < 0 ? minus : '';
  const size = Math.abs(value);
  if (size === Infinity) return sign + '∞';
  if (size === 0) return '0';
  const trimmed = (text) => text.includes('.') ? text.replace(/\.?0+$/, '') : text;
  const [mantissa, exponent] = size.toExponential(digits - 1).split('e');
  const power = Number(exponent);
  if (power >= -3 && power < Math.max(digits, 6))
    return sign + trimmed(size.toFixed(Math.max(0, digits - 1 - power)));
  return sign + trimmed(mantissa) + ' × ' + powerOfTen(power);
}

// As plot::mathematics: single letters in italics, with what follows an underscore as a subscript.
function typeset(text) {
  const all = document.createDocumentFragment();
  for (const [piece, letters, index] of text.matchAll(/([A-Za-z]+)(?:_([A-Za-z]+))?|[^A-Za-z]+/g)) {
    if (!letters || letters.length > 1) {
      all.append(piece);
      continue;
    }
    all.append(html('i', {}, letters));
    if (index) all.append(html('sub', {}, html('i', {}, index)));
  }
  return all;
}

// "area [m^2]" as its name and its unit, "m²".
function nameAndUnit(label) {
  const found = label.match(/^(.*) \[([^\]]*)\]$/);
  if (!found) return {name: label, unit: ''};
  return {name: found[1], unit: ' ' + found[2].replace(/\^(-?\d+)/g, (_, power) => superscript(power))};
}

function html(tag, attributes, ...content) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...content);
  return made;
}

const svgNamespace = (document.querySelector('svg') || {}).namespaceURI;

function svg(tag, attributes, ...content) {
  const made = document.createElementNS(svgNamespace, tag);
  set(made, attributes);
  made.append(...content);
  return made;
}

function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes))
    element.setAttribute(name, typeof value === 'number' ? Math.round(value * 100) / 100 : value);
}
