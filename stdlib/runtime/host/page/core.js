// SPDX-License-Identifier: Apache-2.0
// What all parts of the page share: questions to the monitor, elements, the program as it is known, its live values, and
// what the URL keeps. Text of the program becomes text nodes, never HTML.
'use strict';

const token = new URLSearchParams(location.search).get('token') || '';
const byId = id => document.getElementById(id);

// The answer of the monitor; what it refuses is an error with its sentence.
async function ask(path, body) {
  const reply = await fetch(path, {
    method: body === undefined ? 'GET' : 'POST',
    headers: {Authorization: 'Bearer ' + token},
    body: body === undefined ? undefined : JSON.stringify(body),
  });
  const is_json = (reply.headers.get('Content-Type') || '').startsWith('application/json');
  const answer = is_json ? await reply.json() : await reply.text();
  if (!reply.ok) throw new Error(answer.error || reply.statusText);
  return answer;
}

// An element with attributes and children. Functions are listeners; text becomes a text node.
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (typeof value === 'function') element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

let notice_timer = 0;
function notify(sentence) {
  const notice = byId('notice');
  notice.textContent = sentence;
  notice.hidden = false;
  clearTimeout(notice_timer);
  notice_timer = setTimeout(() => { notice.hidden = true; }, 8000);
}
// A listener whose errors are shown.
const guarded = act => async (...parameters) => {
  try {
    await act(...parameters);
  } catch (error) {
    notify(error.message);
  }
};

// ---- the program

const program = {
  symbols: new Map(),   // by path: {path, type, kind, writable}
  by_name: new Map(),   // the same, by the path in lower case
  values: new Map(),    // by path: the text of the last sample
  forces: new Map(),    // by path in lower case: [path, value]
  tasks: [],
  pous: [],
  time_ms: 0,
};
const symbolOf = path => program.by_name.get(path.toLowerCase());
const isLeaf = symbol => symbol.kind !== 'record' && symbol.kind !== 'array';
const isForced = path => program.forces.has(path.toLowerCase());

async function readSymbols() {
  const kPage = 20000;
  for (let from = 0, total = 1; from < total; from += kPage) {
    const page = await ask(`/api/symbols?from=${from}&count=${kPage}`);
    total = page.total;
    for (const symbol of page.symbols) {
      program.symbols.set(symbol.path, symbol);
      program.by_name.set(symbol.path.toLowerCase(), symbol);
    }
  }
}

async function readForces() {
  const {values} = await ask('/api/forces');
  program.forces = new Map(Object.entries(values).map(([path, value]) => [path.toLowerCase(), [path, value]]));
  for (const view of views) if (view.onForces) view.onForces();
}

async function assign(kind, path, text) {
  await ask('/api/' + kind, {values: {[path]: text}});
  if (kind === 'force') await readForces();
}
async function unforce(path) {
  await ask('/api/unforce', path === undefined ? {all: true} : {paths: [path]});
  await readForces();
}

// A value as a number; NaN: it is not one. Durations in seconds.
function numberOf(text) {
  if (text === 'TRUE' || text === 'FALSE') return text === 'TRUE' ? 1 : 0;
  const duration = /^L?TIME#|^L?T#/i.exec(text);
  if (!duration) return text === '' || text === undefined || text === null ? NaN : Number(text);
  const rest = text.slice(duration[0].length);
  const seconds = {d: 86400, h: 3600, m: 60, s: 1, ms: 1e-3, us: 1e-6, ns: 1e-9};
  let sum = 0;
  for (const [, count, unit] of rest.matchAll(/([0-9.]+)(d|h|ms|m|s|us|ns)/g)) sum += Number(count) * seconds[unit];
  return rest.startsWith('-') ? -sum : sum;
}

// ---- views: {tab, paths(): the values it shows, onValues(), onForces(), onShow(), onHide()}

const views = [];
const isShown = view => !view.tab || url.tab === view.tab;

// ---- live values: one stream for all that is shown

const live = {source: null, timer: 0, key: null};

function refreshStream() {
  clearTimeout(live.timer);
  live.timer = setTimeout(guarded(openStream), 80);
}

async function openStream() {
  const paths = [...new Set(views.filter(isShown).flatMap(view => view.paths ? view.paths() : []))].sort();
  const key = paths.join('\n');
  if (key === live.key) return;
  live.key = key;
  if (live.source) live.source.close();
  live.source = null;
  if (paths.length === 0) return;
  const {id} = await ask('/api/watch', {paths, skip_unknown: true});
  if (key !== live.key) return;
  const source = new EventSource(`/api/stream?watch=${id}&rate=10&token=${encodeURIComponent(token)}`);
  live.source = source;
  source.onmessage = event => takeSample(JSON.parse(event.data));
  source.onerror = () => {
    source.close();
    if (live.source !== source) return;
    live.key = null;
    setTimeout(refreshStream, 1000);
  };
}

function takeSample(sample) {
  program.time_ms = sample.time_ms;
  for (const path in sample.values) program.values.set(path, sample.values[path]);
  for (const view of views) if (view.onValues && isShown(view)) view.onValues();
}

// ---- what the URL keeps, after #

const url = {
  tab: 'watch',
  lists: [{name: 'Watch', paths: []}],
  list: 0,
  pou: '',
  instance: '',
  lanes: [],
};

function readUrl() {
  const kept = new URLSearchParams(location.hash.slice(1));
  const lists = kept.getAll('w').map(text => {
    const [name, ...paths] = text.split(';');
    return {name: name || 'Watch', paths};
  });
  if (lists.length > 0) url.lists = lists;
  url.list = Math.min(Math.max(Number(kept.get('list')) || 0, 0), url.lists.length - 1);
  url.tab = kept.get('tab') || 'watch';
  url.pou = kept.get('pou') || '';
  url.instance = kept.get('instance') || '';
  url.lanes = (kept.get('scope') || '').split(';').filter(path => path);
}

function writeUrl() {
  const kept = new URLSearchParams();
  kept.set('tab', url.tab);
  for (const list of url.lists) kept.append('w', [list.name, ...list.paths].join(';'));
  if (url.list > 0) kept.set('list', url.list);
  if (url.pou) kept.set('pou', url.pou);
  if (url.instance) kept.set('instance', url.instance);
  if (url.lanes.length > 0) kept.set('scope', url.lanes.join(';'));
  history.replaceState(null, '', location.pathname + location.search + '#' + kept);
}
