// Elements.

export const $ = (id) => document.getElementById(id);

export function element(tag, attributes = {}, ...content) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...content);
  return made;
}

const greek = {alpha: 'α', beta: 'β', gamma: 'γ', delta: 'δ', theta: 'θ', lambda: 'λ', mu: 'μ', omega: 'ω', phi: 'φ', psi: 'ψ', sigma: 'σ', tau: 'τ', xi: 'ξ', eta: 'η', rho: 'ρ', kappa: 'κ', Omega: 'Ω', Gamma: 'Γ'};

// A name of a coordinate as mathematics: p_x[0] is p with the subscript x₀.
export function mathematics(name) {
  const [, head, rest] = /^([A-Za-z]+)(.*)$/.exec(name) || [, name, ''];
  const below = rest.replace(/^_/, '').replace(/\]\[/g, ',').replace(/[[\]]/g, ' ').trim().replace(/\s+/g, ' ');
  const letter = greek[head] || head;
  const italic = (one) => element('i', /[α-ω]/.test(one) ? {class: 'greek'} : {}, one);
  const made = element('span', {class: 'math'}, letter.length === 1 ? italic(letter) : letter);
  if (below) made.append(element('sub', {}, ...below.split(/([A-Za-z]+)/).map((part) => /^[A-Za-z]$/.test(part) ? italic(part) : greek[part] ? italic(greek[part]) : part)));
  return made;
}

export function shortNumber(value, digits = 4) {
  if (!Number.isFinite(value)) return String(value);
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}
