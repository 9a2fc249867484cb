// SPDX-License-Identifier: Apache-2.0
// The page of the drawing. In: messages of the extension: a drawing, the elements at the cursor and of the debugger, a live picture, values.
// Out: which element or instance was chosen, which values are wanted. The picture has a document of its own (a shadow root) with
// style sheets that are made here, since the page allows none in the text of the picture. Keys: + - 0 zoom.
'use strict';

const vscode = acquireVsCodeApi();
const byId = id => document.getElementById(id);
const root = byId('drawing').attachShadow({mode: 'open'});
const kDark = /@media\s*\(prefers-color-scheme:\s*dark\)\s*\{((?:[^{}]*\{[^{}]*\})*)\s*\}/g;
const kMarkStyle = `
  svg { max-width: none; }
  svg > path.w[stroke-width="0"] { fill: none; }  /* the paper is the panel */
  [data-chosen] { cursor: pointer; }
  [data-chosen]:focus-visible { outline: 2px solid var(--vscode-focusBorder); }
  rect.area { fill: transparent; stroke: none; }
  rect.area.stop { fill: var(--vscode-editor-stackFrameHighlightBackground, #ffff6673); stroke: var(--vscode-debugIcon-breakpointCurrentStackframeForeground, #be8700); stroke-width: 2; }
  rect.area.cursor { fill: var(--vscode-editor-selectionBackground); fill-opacity: .45; stroke: var(--vscode-focusBorder); stroke-width: 1.5; }
`;

const shown = {
  style: '',         // the style of the picture, as it is in it
  elements: [],      // the ids of what comes from the text
  cursor: '',        // the id of the element at the cursor
  stop: '',          // and of the one where the debugger is
  live: null,        // a LivePicture
  values: {},        // by whole path
  zoom: 0,           // 0: as wide as the panel, but not larger than drawn
};

// The colours are those of the editor's theme, not of the system.
function ofTheme(css) {
  const kind = document.body.dataset.vscodeThemeKind || '';
  const is_dark = kind.includes('dark') || kind === 'vscode-high-contrast';
  return css.replace(kDark, is_dark ? '$1' : '');
}

function sheet(css) {
  const made = new CSSStyleSheet();
  made.replaceSync(ofTheme(css));
  return made;
}

function adoptStyles() {
  root.adoptedStyleSheets = [sheet(shown.style), ...(shown.live ? [sheet(kLiveStyle)] : []), sheet(kMarkStyle)];
}

function showPicture(text, elements) {
  const parsed = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
  if (parsed.localName !== 'svg') return;
  shown.style = [...parsed.querySelectorAll('style')].map(style => style.textContent).join('\n');
  for (const one of parsed.querySelectorAll('style, script, foreignObject')) one.remove();
  root.replaceChildren(document.importNode(parsed, true));
  shown.elements = elements;
  byId('notice').hidden = true;
  for (const id of elements) makeChoosable(id);
  zoomBy(1);
}

function elementOf(id) {
  return id === '' ? null : root.querySelector(`[id="${CSS.escape(id)}"]`);
}

function makeChoosable(id) {
  const shape = elementOf(id);
  if (!shape) return;
  shape.dataset.chosen = id;
  if (!shape.hasAttribute('tabindex')) shape.setAttribute('tabindex', 0);
  const choose = () => vscode.postMessage({type: 'reveal', id});
  shape.addEventListener('click', choose);
  shape.addEventListener('keydown', event => { if (event.key === 'Enter') choose(); });
  shape.prepend(boxOf(shape, 'area', 0));  // lines are too thin to be hit
}

function boxOf(shape, name, margin) {
  const box = shape.getBBox();
  const rect = document.createElementNS('http://www.w3.org/2000/svg', 'rect');
  rect.setAttribute('class', name);
  rect.setAttribute('x', box.x - margin);
  rect.setAttribute('y', box.y - margin);
  rect.setAttribute('width', box.width + 2 * margin);
  rect.setAttribute('height', box.height + 2 * margin);
  return rect;
}

function mark(kind, id, margin) {
  for (const old of root.querySelectorAll(`rect.${kind}`)) old.remove();
  shown[kind] = id;
  const shape = elementOf(id);
  if (!shape) return;
  shape.prepend(boxOf(shape, `area ${kind}`, margin));
  shape.scrollIntoView({block: 'nearest', inline: 'nearest'});
}

const markCursor = id => mark('cursor', id, 3);
const markStop = id => mark('stop', id, 6);

// ---- live

const fullPath = path => path.startsWith('.') ? byId('instance').value + path : path;

function showLive({svg, elements, instances, instance}) {
  showPicture(svg, elements);
  byId('instance').replaceChildren(...instances.map(path => new Option(path, path)));
  byId('instance').value = instance;
  byId('instances').hidden = instances.length < 2;
  byId('state').textContent = '● live';
  byId('head').hidden = false;
  shown.live = new LivePicture(root.querySelector('svg'), {
    valueOf: path => shown.values[fullPath(path)],
    isForced: () => false,
    open: () => {},
  });
  adoptStyles();
  watch();
}

function watch() {
  shown.values = {};
  vscode.postMessage({type: 'watch', paths: [...new Set(shown.live.paths().map(fullPath))].sort()});
}

function endLive() {
  shown.live = null;
  byId('head').hidden = true;
}

function showInstance({instance}) {
  if (!shown.live) return;
  byId('instance').value = instance;
  watch();
}

byId('instance').addEventListener('change', () => vscode.postMessage({type: 'choose', instance: byId('instance').value}));

// ---- zoom

function fittingZoom(width) {
  return Math.min(Math.max((byId('drawing').clientWidth - 16) / width, 0.6), 1);
}

function zoomBy(factor) {
  const svg = root.querySelector('svg');
  if (!svg || !svg.viewBox.baseVal) return;
  const {width, height} = svg.viewBox.baseVal;
  if (factor === 0) shown.zoom = 0;
  else if (factor !== 1) shown.zoom = Math.min(Math.max((shown.zoom || fittingZoom(width)) * factor, 0.2), 5);
  const zoom = shown.zoom || fittingZoom(width);
  svg.setAttribute('width', width * zoom);
  svg.setAttribute('height', height * zoom);
}
addEventListener('resize', () => zoomBy(1));

addEventListener('keydown', event => {
  if (event.target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey) return;
  if (event.key === '+') zoomBy(1.25);
  if (event.key === '-') zoomBy(0.8);
  if (event.key === '0') zoomBy(0);
});
addEventListener('wheel', event => {
  if (!event.ctrlKey) return;
  event.preventDefault();
  zoomBy(event.deltaY < 0 ? 1.1 : 1 / 1.1);
}, {passive: false});

// ---- messages

const kMessages = {
  drawing: ({svg, elements}) => {
    endLive();
    showPicture(svg, elements);
    adoptStyles();
    markCursor(shown.cursor);
    markStop(shown.stop);
  },
  live: showLive,
  instance: showInstance,
  cursor: ({id}) => markCursor(id),
  stop: ({id}) => markStop(id),
  values: ({values}) => {
    Object.assign(shown.values, values);
    if (shown.live) shown.live.paint();
  },
  notice: ({text}) => {
    byId('notice').textContent = text;
    byId('notice').hidden = false;
  },
};
addEventListener('message', ({data}) => kMessages[data.type]?.(data));
new MutationObserver(adoptStyles).observe(document.body, {attributes: true, attributeFilter: ['data-vscode-theme-kind']});
vscode.postMessage({type: 'ready'});
