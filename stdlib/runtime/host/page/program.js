// SPDX-License-Identifier: Apache-2.0
// Bodies of the program while it runs: power flow in ladders, values on wires of function blocks, active steps and their
// time in charts, and text with the values of each line beside it. A picture has its own document (a shadow root), since
// its style sheet is for itself; docs/monitor.md says what its attributes mean.
'use strict';

const body = {
  root: null,      // the shadow root of the picture
  elements: [],    // {shape, kind, path, time, is_negated, edge, label, area}
  by_number: new Map(),
  nets: [],        // {shape, from, to, path, is_negated, label}
  chips: [],       // of text: {chip, path, name}
};
const kSvg = 'http://www.w3.org/2000/svg';

const kLiveStyle = `
  :host { --on: #1a7f37; --on-back: #dafbe1; --off: #8c959f; --value: #0969da; --force: #9a4b00; }
  @media (prefers-color-scheme: dark) {
    :host { --on: #3fb950; --on-back: #12261e; --off: #656c76; --value: #4493f8; --force: #e8a33d; }
  }
  svg { max-width: none; }
  [data-path] { cursor: pointer; }
  rect.area { fill: transparent; stroke: none; }
  [data-path]:focus-visible { outline: 2px solid var(--value); }
  .on > path, .on > circle { stroke: var(--on); stroke-width: 2.5; }
  .on > circle.d { fill: var(--on); }
  .on > path.k { stroke-width: 3.5; }
  .off > path, .off > circle { stroke: var(--off); }
  .off > circle.d { fill: var(--off); }
  .on > text { fill: var(--on); font-weight: bold; }
  .on > rect:not(.area) { stroke: var(--on); fill: var(--on-back); stroke-width: 2; }
  .forced > text { fill: var(--force); font-weight: bold; }
  text.live { fill: var(--value); font-size: 10px; font-weight: bold; }
`;

// `.x` is a variable of the chosen instance; all others are paths as they are.
const fullPath = path => path.startsWith('.') ? url.instance + path : path;

// ---- choosing

function choosePou(name) {
  const pou = program.pous.find(other => other.name === name) || program.pous[0];
  if (!pou) return;
  url.pou = pou.name;
  byId('pou').value = pou.name;
  byId('pou-language').textContent = pou.language;
  byId('instance').replaceChildren(...pou.instances.map(path => make('option', {value: path}, path)));
  byId('instance').parentElement.hidden = pou.instances.length === 0;
  if (!pou.instances.includes(url.instance)) url.instance = pou.instances[0] || '';
  byId('instance').value = url.instance;
  writeUrl();
  showBody(pou);
}

const showBody = guarded(async pou => {
  const content = await (await fetch('/api/diagram?pou=' + encodeURIComponent(pou.name),
    {headers: {Authorization: 'Bearer ' + token}})).text();
  if (url.pou !== pou.name) return;
  body.elements = [];
  body.nets = [];
  body.chips = [];
  const is_picture = content.startsWith('<');
  byId('picture').hidden = !is_picture;
  byId('lines').hidden = is_picture;
  if (is_picture) showPicture(content);
  else showLines(JSON.parse(content));
  paintBody();
  refreshStream();
});

// ---- pictures

function showPicture(content) {
  const parsed = new DOMParser().parseFromString(content, 'image/svg+xml').documentElement;
  for (const script of parsed.querySelectorAll('script, foreignObject')) script.remove();
  const style = make('style', {}, kLiveStyle);
  body.root.replaceChildren(document.importNode(parsed, true), style);
  const svg = body.root.firstChild;
  for (const shape of svg.querySelectorAll('[data-element]')) body.elements.push(elementOf(shape));
  for (const shape of svg.querySelectorAll('g[data-x]')) body.nets.push(netOf(shape));
  body.by_number = new Map(body.elements.map(element => [element.shape.dataset.element, element]));
}

function elementOf(shape) {
  const {kind, path, time, negated, edge} = shape.dataset;
  const element = {shape, kind, path, time, is_negated: negated === 'true', edge, label: null, area: null};
  if (path) {
    const open = () => openDialog(fullPath(path));
    shape.setAttribute('tabindex', 0);
    shape.setAttribute('role', 'button');
    shape.addEventListener('click', open);
    shape.addEventListener('keydown', event => { if (event.key === 'Enter') open(); });
  }
  return element;
}

function netOf(shape) {
  const {from, to, path, negated} = shape.dataset;
  const list = text => text ? text.split(' ') : [];
  return {shape, from: list(from), to: list(to).map(end => end.split(':')[0]), path, is_negated: negated === 'true',
    label: null};
}

// Lines are too thin to be hit: the whole area of an element is. While it is not shown it has none.
function addArea(element) {
  const box = element.shape.getBBox();
  if (box.width === 0) return;
  element.area = document.createElementNS(kSvg, 'rect');
  element.area.setAttribute('class', 'area');
  for (const name of ['x', 'y', 'width', 'height']) element.area.setAttribute(name, box[name]);
  element.shape.prepend(element.area);
}

function labelAt(shape, x, y, anchor) {
  const label = document.createElementNS(kSvg, 'text');
  label.setAttribute('class', 'live');
  label.setAttribute('x', x);
  label.setAttribute('y', y);
  if (anchor) label.setAttribute('text-anchor', anchor);
  shape.append(label);
  return label;
}

const valueOf = path => path ? program.values.get(fullPath(path)) : undefined;
const boolOf = text => text === 'TRUE' ? true : text === 'FALSE' ? false : null;
const or = values => values.includes(true) ? true : values.every(value => value === false) ? false : null;

// What each wire of a ladder carries: true, false or null (not known). The value at its path is what the program has
// computed; where there is none, it follows from the rail and the contacts. An edge is TRUE for one cycle only.
function powerOf() {
  const power = new Map();
  const into = number => body.nets.filter(net => net.to.includes(number));
  const ofNet = net => {
    if (power.has(net)) return power.get(net);
    power.set(net, null);  // a loop
    const known = boolOf(valueOf(net.path));
    power.set(net, known !== null ? known !== net.is_negated : or(net.from.map(ofEnd)));
    return power.get(net);
  };
  const ofEnd = end => {
    if (end === 'rail') return true;
    const element = body.by_number.get(end);
    if (!element || (element.kind !== 'contact' && element.kind !== 'coil')) return null;
    const incoming = or(into(end).map(ofNet));
    if (element.kind === 'coil') return incoming;
    const closed = conducts(element);
    return incoming === false || closed === false ? false : incoming === true && closed === true ? true : null;
  };
  for (const net of body.nets) ofNet(net);
  return power;
}

function conducts(element) {
  if (element.edge) return false;
  const value = boolOf(valueOf(element.path));
  return value === null ? null : value !== element.is_negated;
}

function mark(shape, is_on, path) {
  shape.classList.toggle('on', is_on === true);
  shape.classList.toggle('off', is_on === false);
  shape.classList.toggle('forced', path !== undefined && isForced(fullPath(path)));
}

function paintElement(element) {
  const {shape, kind, path, time} = element;
  if (path && !element.area) addArea(element);
  if (kind === 'contact') return mark(shape, conducts(element), path);
  const value = boolOf(valueOf(path));
  if (kind === 'step') {
    mark(shape, value === true ? true : null, path);
    const box = shape.querySelector('rect:not(.area)');
    if (!element.label) element.label = labelAt(shape, Number(box.getAttribute('x')) - 5, Number(box.getAttribute('y')) + 19, 'end');
    element.label.textContent = value === true ? valueOf(time) || '' : '';
  } else {
    mark(shape, kind === 'action' || kind === 'transition' ? (value === true ? true : null) : value, path);
  }
}

function paintNet(net, power) {
  const text = valueOf(net.path);
  const carried = power.get(net);
  mark(net.shape, carried, undefined);
  if (text === undefined || text === null || boolOf(text) !== null) return;
  if (!net.label) net.label = labelAt(net.shape, Number(net.shape.dataset.x) + 4, Number(net.shape.dataset.y) - 4);
  if (net.label.textContent !== text) net.label.textContent = text;
}

// ---- text

function showLines(text) {
  const rows = text.lines.map(({line, text: code, paths}) => {
    const cell = make('td', {});
    for (const path of paths) cell.append(chipOf(path));
    return make('tr', {}, make('td', {}, String(line)), make('td', {}, code), cell);
  });
  byId('lines').tBodies[0].replaceChildren(...rows);
}

function chipOf(path) {
  const chip = make('button', {type: 'button', class: 'chip', hidden: true, title: fullPath(path), click: () => openDialog(fullPath(path))});
  body.chips.push({chip, path, name: path.replace(/^\./, ''), text: null});
  return chip;
}

function paintChip(entry) {
  const text = valueOf(entry.path);
  entry.chip.classList.toggle('is-forced', isForced(fullPath(entry.path)));
  if (text === entry.text) return;
  entry.text = text;
  entry.chip.hidden = text === undefined || text === null;
  entry.chip.textContent = `${entry.name} = ${text}`;
  entry.chip.classList.toggle('true', text === 'TRUE');
}

function paintBody() {
  const power = powerOf();
  for (const net of body.nets) paintNet(net, power);
  body.elements.forEach(paintElement);
  body.chips.forEach(paintChip);
}

views.push({
  tab: 'program',
  paths: () => [...body.elements.flatMap(element => [element.path, element.time]), ...body.nets.map(net => net.path),
    ...body.chips.map(entry => entry.path)].filter(path => path).map(fullPath),
  onValues: paintBody,
  onForces: paintBody,
  onShow: paintBody,
});

async function startProgram() {
  program.pous = await ask('/api/pous');
  body.root = byId('picture').attachShadow({mode: 'open'});
  byId('program-empty').hidden = program.pous.length > 0;
  byId('pou').replaceChildren(...program.pous.map(pou => make('option', {value: pou.name}, `${pou.name} (${pou.language})`)));
  byId('pou').addEventListener('change', () => choosePou(byId('pou').value));
  byId('instance').addEventListener('change', () => {
    url.instance = byId('instance').value;
    choosePou(url.pou);
  });
  choosePou(url.pou);
}
