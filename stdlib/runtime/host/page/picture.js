// SPDX-License-Identifier: Apache-2.0
// A picture of a body while it runs: power flow in ladders, values on wires of function blocks, active steps and their
// time in charts. In: a picture of the monitor, whose attributes docs/monitor_page.md explains, and functions that know
// the values of paths as they are in the picture. Used by the page of the monitor and by the drawings of tools/vscode.
'use strict';

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

const boolOf = text => text === 'TRUE' ? true : text === 'FALSE' ? false : null;
const or = values => values.includes(true) ? true : values.every(value => value === false) ? false : null;

function labelAt(shape, x, y, anchor) {
  const label = document.createElementNS(kSvg, 'text');
  label.setAttribute('class', 'live');
  label.setAttribute('x', x);
  label.setAttribute('y', y);
  if (anchor) label.setAttribute('text-anchor', anchor);
  shape.append(label);
  return label;
}

class LivePicture {
  // `program`: {valueOf(path), isForced(path), open(path)}; the last one when an element with a value is chosen.
  constructor(svg, program) {
    this.program = program;
    this.elements = [...svg.querySelectorAll('[data-element]')].map(shape => this.elementOf(shape));
    this.nets = [...svg.querySelectorAll('g[data-x]')].map(shape => this.netOf(shape));
    this.by_number = new Map(this.elements.map(element => [element.shape.dataset.element, element]));
  }

  paths() {
    return [...this.elements.flatMap(element => [element.path, element.time]), ...this.nets.map(net => net.path)]
      .filter(path => path);
  }

  paint() {
    const power = this.powerOf();
    for (const net of this.nets) this.paintNet(net, power);
    for (const element of this.elements) this.paintElement(element);
  }

  valueOf(path) { return path ? this.program.valueOf(path) : undefined; }

  elementOf(shape) {
    const {kind, path, time, negated, edge} = shape.dataset;
    const element = {shape, kind, path, time, is_negated: negated === 'true', edge, label: null, area: null};
    if (path) {
      const open = () => this.program.open(path);
      shape.setAttribute('tabindex', 0);
      shape.setAttribute('role', 'button');
      shape.addEventListener('click', open);
      shape.addEventListener('keydown', event => { if (event.key === 'Enter') open(); });
    }
    return element;
  }

  netOf(shape) {
    const {from, to, path, negated} = shape.dataset;
    const list = text => text ? text.split(' ') : [];
    return {shape, from: list(from), to: list(to).map(end => end.split(':')[0]), path, is_negated: negated === 'true',
      label: null};
  }

  // Lines are too thin to be hit: the whole area of an element is. While it is not shown it has none.
  addArea(element) {
    const box = element.shape.getBBox();
    if (box.width === 0) return;
    element.area = document.createElementNS(kSvg, 'rect');
    element.area.setAttribute('class', 'area');
    for (const name of ['x', 'y', 'width', 'height']) element.area.setAttribute(name, box[name]);
    element.shape.prepend(element.area);
  }

  // What each wire of a ladder carries: true, false or null (not known). The value at its path is what the program has
  // computed; where there is none, it follows from the rail and the contacts. An edge is TRUE for one cycle only.
  powerOf() {
    const power = new Map();
    const into = number => this.nets.filter(net => net.to.includes(number));
    const ofNet = net => {
      if (power.has(net)) return power.get(net);
      power.set(net, null);  // a loop
      const known = boolOf(this.valueOf(net.path));
      power.set(net, known !== null ? known !== net.is_negated : or(net.from.map(ofEnd)));
      return power.get(net);
    };
    const ofEnd = end => {
      if (end === 'rail') return true;
      const element = this.by_number.get(end);
      if (!element || (element.kind !== 'contact' && element.kind !== 'coil')) return null;
      const incoming = or(into(end).map(ofNet));
      if (element.kind === 'coil') return incoming;
      const closed = this.conducts(element);
      return incoming === false || closed === false ? false : incoming === true && closed === true ? true : null;
    };
    for (const net of this.nets) ofNet(net);
    return power;
  }

  conducts(element) {
    if (element.edge) return false;
    const value = boolOf(this.valueOf(element.path));
    return value === null ? null : value !== element.is_negated;
  }

  mark(shape, is_on, path) {
    shape.classList.toggle('on', is_on === true);
    shape.classList.toggle('off', is_on === false);
    shape.classList.toggle('forced', path !== undefined && this.program.isForced(path));
  }

  paintElement(element) {
    const {shape, kind, path, time} = element;
    if (path && !element.area) this.addArea(element);
    if (kind === 'contact') return this.mark(shape, this.conducts(element), path);
    const value = boolOf(this.valueOf(path));
    if (kind === 'step') {
      this.mark(shape, value === true ? true : null, path);
      const box = shape.querySelector('rect:not(.area)');
      if (!element.label) element.label = labelAt(shape, Number(box.getAttribute('x')) - 5, Number(box.getAttribute('y')) + 19, 'end');
      element.label.textContent = value === true ? this.valueOf(time) || '' : '';
    } else {
      this.mark(shape, kind === 'action' || kind === 'transition' ? (value === true ? true : null) : value, path);
    }
  }

  paintNet(net, power) {
    const text = this.valueOf(net.path);
    const carried = power.get(net);
    this.mark(net.shape, carried, undefined);
    if (text === undefined || text === null || boolOf(text) !== null) return;
    if (!net.label) net.label = labelAt(net.shape, Number(net.shape.dataset.x) + 4, Number(net.shape.dataset.y) - 4);
    if (net.label.textContent !== text) net.label.textContent = text;
  }
}
