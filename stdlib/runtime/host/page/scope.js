// SPDX-License-Identifier: Apache-2.0
// The scope: the controller records each activation of a task, and this page fetches the rows. A lane for each variable,
// a cursor with the values at its time, zoom by wheel, drag and keys, and all rows as CSV.
'use strict';

const scope = {
  state: 'off',
  next: 0,         // the number of the next row to fetch
  lost: 0,         // rows that were replaced before they were fetched
  times: [],       // in milliseconds
  rows: {},        // by path: texts, parallel to times
  numbers: {},     // by path: the same as numbers
  trigger_ms: null,
  from: 0, to: 0,  // the times that are shown; equal: all
  cursor: null,    // a time
  lanes: [],       // {path, canvas, output}
  timer: 0,
};
const kKeptRows = 1000000;

function addLane(path) {
  const symbol = symbolOf(path);
  const name = symbol ? symbol.path : path;
  if (symbol && !isLeaf(symbol)) return notify(`${name} has no value of its own; choose a variable in it`);
  if (!url.lanes.includes(name)) url.lanes.push(name);
  showLanes();
}

function showLanes() {
  scope.lanes = url.lanes.map((path, i) => {
    const canvas = make('canvas', {role: 'img', 'aria-label': 'Values of ' + path});
    const output = make('output', {});
    const lane = make('div', {class: 'lane'},
      make('div', {class: 'legend', title: path}, path, output,
        make('button', {type: 'button', class: 'chip', 'aria-label': 'Remove lane ' + path, click: () => {
          url.lanes = url.lanes.filter(other => other !== path);
          showLanes();
        }}, 'Remove')), canvas);
    listenToCanvas(canvas);
    return {path, canvas, output, lane, colour: `--lane${i % 4 + 1}`};
  });
  byId('lanes').replaceChildren(...scope.lanes.map(lane => lane.lane));
  if (scope.lanes.length === 0) byId('lanes').replaceChildren(make('p', {class: 'quiet'}, 'Add the variables to record: each gets a lane.'));
  writeUrl();
  paintLanes();
}

// ---- recording

const record = guarded(async event => {
  event.preventDefault();
  const condition = byId('scope-condition').value;
  const order = {
    paths: url.lanes,
    task: byId('scope-task').value,
    rows: Number(byId('scope-rows').value),
    divider: Number(byId('scope-divider').value),
  };
  if (condition) order.trigger = {path: byId('scope-path').value, condition, level: byId('scope-level').value, before: Number(byId('scope-before').value)};
  if (order.paths.length === 0) throw new Error('add a variable to record first');
  const state = await ask('/api/scope', order);
  clearRows();
  takeState(state);
  fetchRows();
});

function clearRows() {
  Object.assign(scope, {next: 0, lost: 0, times: [], rows: {}, numbers: {}, trigger_ms: null, from: 0, to: 0, cursor: null});
}

function takeState(state) {
  scope.state = state.state;
  byId('scope-state').textContent = state.state;
  byId('scope-state').dataset.state = state.state;
  byId('scope-stop').disabled = state.state === 'off' || state.state === 'complete';
}

// Fetches what is new, in several steps where it is much.
const fetchRows = guarded(async () => {
  clearTimeout(scope.timer);
  for (let more = true; more;) {
    const data = await ask(`/api/scope/data?from=${scope.next}&count=5000`);
    takeState(data);
    takeRows(data);
    more = data.times_ms.length > 0 && scope.next < data.next;
  }
  paintLanes();
  const goes_on = scope.state !== 'off' && scope.state !== 'complete';
  if (goes_on && url.tab === 'scope') scope.timer = setTimeout(fetchRows, 250);
});

function takeRows(data) {
  const count = data.times_ms.length;
  if (data.trigger_row !== null && data.trigger_row >= data.from && data.trigger_row < data.from + count)
    scope.trigger_ms = data.times_ms[data.trigger_row - data.from];
  scope.lost += data.from - scope.next;
  scope.next = data.from + count;
  scope.times.push(...data.times_ms);
  for (const path in data.values) {
    (scope.rows[path] = scope.rows[path] || []).push(...data.values[path]);
    (scope.numbers[path] = scope.numbers[path] || []).push(...data.values[path].map(valueAsNumber));
  }
  const surplus = scope.times.length - kKeptRows;
  if (surplus <= 0) return;
  scope.times.splice(0, surplus);
  for (const path in scope.rows) scope.rows[path].splice(0, surplus), scope.numbers[path].splice(0, surplus);
}

// The items of an enumeration get numbers in the order in which they are seen.
const items = new Map();
function valueAsNumber(text) {
  const number = numberOf(text);
  if (!Number.isNaN(number) || text === 'NaN' || text === '') return number;
  if (!items.has(text)) items.set(text, items.size);
  return items.get(text);
}

// ---- drawing

// The times that are shown.
function span() {
  const first = scope.times[0] || 0, last = scope.times[scope.times.length - 1] || 0;
  return scope.from < scope.to ? [scope.from, scope.to] : [first, Math.max(last, first + 1)];
}

// The first row at this time or after it.
function rowAt(time) {
  let low = 0, high = scope.times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (scope.times[middle] < time) low = middle + 1;
    else high = middle;
  }
  return low;
}

function contextOf(canvas) {
  const ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return {context, width, height, style: getComputedStyle(document.documentElement)};
}

// Of a stretch of values the least and the greatest.
function limitsOf(numbers, from, to) {
  let low = Infinity, high = -Infinity;
  for (let i = from; i < to; ++i) {
    if (numbers[i] < low) low = numbers[i];
    if (numbers[i] > high) high = numbers[i];
  }
  if (low > high) return [0, 1];
  return low === high ? [low - 0.5, high + 0.5] : [low, high];
}

// Steps, as a task makes them. Of many rows in one pixel the first, the least and the greatest are drawn.
function drawSteps(context, numbers, from, to, x, y) {
  context.beginPath();
  let column = NaN, low = 0, high = 0, last = 0;
  for (let i = from; i < to; ++i) {
    const at = Math.round(x(scope.times[i])), value = numbers[i];
    if (Number.isNaN(value)) continue;
    if (at !== column) {
      if (!Number.isNaN(column)) context.lineTo(column, y(low)), context.lineTo(column, y(high)), context.lineTo(column, y(last)), context.lineTo(at, y(last));
      else context.moveTo(at, y(value));
      column = at;
      low = high = value;
    }
    low = Math.min(low, value);
    high = Math.max(high, value);
    last = value;
  }
  if (!Number.isNaN(column)) context.lineTo(column, y(low)), context.lineTo(column, y(high)), context.lineTo(column, y(last));
  context.stroke();
}

function paintLane(lane) {
  const {context, width, height, style} = contextOf(lane.canvas);
  const numbers = scope.numbers[lane.path] || [];
  const [from_ms, to_ms] = span();
  const first = Math.max(rowAt(from_ms) - 1, 0), end = Math.min(rowAt(to_ms) + 1, numbers.length);
  const is_bool = /^(TRUE|FALSE)$/.test(lastOf(lane.path));
  const [low, high] = is_bool ? [0, 1] : limitsOf(numbers, first, end);
  const x = time => (time - from_ms) / (to_ms - from_ms) * width;
  const y = value => height - 14 - (value - low) / (high - low) * (height - 28);
  const vertical = (time, colour) => {
    context.strokeStyle = style.getPropertyValue(colour);
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x(time), 0);
    context.lineTo(x(time), height);
    context.stroke();
  };
  if (scope.trigger_ms !== null) vertical(scope.trigger_ms, '--danger');
  context.strokeStyle = style.getPropertyValue(lane.colour);
  context.lineWidth = 1.5;
  drawSteps(context, numbers, first, end, x, y);
  context.fillStyle = style.getPropertyValue('--quiet');
  context.font = '11px ui-monospace, monospace';
  if (numbers.length > 0) context.fillText(is_bool ? 'TRUE' : shortNumber(high), 4, 11), context.fillText(is_bool ? 'FALSE' : shortNumber(low), 4, height - 3);
  if (scope.cursor === null) return lane.output.textContent = lastOf(lane.path), undefined;
  vertical(scope.cursor, '--quiet');
  lane.output.textContent = (scope.rows[lane.path] || [])[cursorRow()] ?? '';
}

const shortNumber = number => String(Math.round(number * 1e6) / 1e6);
const lastOf = path => (scope.rows[path] || [])[scope.times.length - 1] ?? '';
const cursorRow = () => Math.max(Math.min(rowAt(scope.cursor + 1e-9), scope.times.length) - 1, 0);

function paintLanes() {
  if (byId('scope').hidden) return;
  scope.lanes.forEach(paintLane);
  const [from_ms, to_ms] = span();
  const lost = scope.lost > 0 ? ` (${scope.lost} were lost)` : '';
  const count = `${scope.times.length} rows${lost}, ${shortNumber((to_ms - from_ms) / 1000)} s shown from ${shortNumber(from_ms / 1000)} s`;
  byId('scope-cursor').textContent = scope.cursor === null ? count : `${count}, cursor at ${shortNumber(scope.cursor)} ms`;
}

// ---- cursor and zoom

function zoom(factor, around) {
  const [from_ms, to_ms] = span();
  const centre = around ?? scope.cursor ?? (from_ms + to_ms) / 2;
  scope.from = centre - (centre - from_ms) * factor;
  scope.to = centre + (to_ms - centre) * factor;
  const first = scope.times[0] || 0, last = scope.times[scope.times.length - 1] || 0;
  if (scope.from <= first && scope.to >= last) scope.from = scope.to = 0;
  paintLanes();
}

function move(by_ms) {
  const [from_ms, to_ms] = span();
  scope.from = from_ms + by_ms;
  scope.to = to_ms + by_ms;
  paintLanes();
}

function listenToCanvas(canvas) {
  const timeAt = event => {
    const [from_ms, to_ms] = span();
    return from_ms + event.offsetX / canvas.clientWidth * (to_ms - from_ms);
  };
  let dragged_from = null;
  canvas.addEventListener('pointerdown', event => {
    dragged_from = timeAt(event);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointerup', () => { dragged_from = null; });
  canvas.addEventListener('pointermove', event => {
    if (dragged_from !== null) return move(dragged_from - timeAt(event));
    scope.cursor = timeAt(event);
    paintLanes();
  });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    zoom(event.deltaY < 0 ? 0.8 : 1.25, timeAt(event));
  }, {passive: false});
}

function moveCursor(rows) {
  if (scope.times.length === 0) return;
  const row = scope.cursor === null ? scope.times.length - 1 : cursorRow() + rows;
  scope.cursor = scope.times[Math.max(0, Math.min(row, scope.times.length - 1))];
  const [from_ms, to_ms] = span();
  if (scope.cursor < from_ms || scope.cursor > to_ms) move(scope.cursor - (from_ms + to_ms) / 2);
  paintLanes();
}

function onScopeKey(event) {
  const keys = {
    ArrowLeft: () => moveCursor(event.shiftKey ? -100 : -1),
    ArrowRight: () => moveCursor(event.shiftKey ? 100 : 1),
    '+': () => zoom(0.5),
    '-': () => zoom(2),
    Escape: () => { scope.cursor = null; paintLanes(); },
  };
  if (!keys[event.key]) return;
  event.preventDefault();
  keys[event.key]();
}

// ---- CSV, as traces have it

function csvOf() {
  const quoted = text => /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  const paths = Object.keys(scope.rows);
  const lines = [['time_ms', ...paths].map(quoted).join(',')];
  scope.times.forEach((time, i) => lines.push([String(time), ...paths.map(path => quoted(scope.rows[path][i]))].join(',')));
  return lines.join('\n') + '\n';
}

function saveCsv() {
  const link = make('a', {href: URL.createObjectURL(new Blob([csvOf()], {type: 'text/csv'})), download: 'scope.csv'});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

views.push({tab: 'scope', onShow: () => { paintLanes(); fetchRows(); }});

async function startScope() {
  byId('scope-task').replaceChildren(...program.tasks.map(task => make('option', {value: task.name}, task.name)));
  byId('scope-condition').addEventListener('change', () => { byId('scope-trigger').hidden = byId('scope-condition').value === ''; });
  byId('scope-form').addEventListener('submit', record);
  byId('scope-stop').addEventListener('click', guarded(async () => takeState(await ask('/api/scope/stop', {}))));
  byId('scope-add').addEventListener('submit', event => {
    event.preventDefault();
    if (byId('scope-lane').value !== '') addLane(byId('scope-lane').value.trim());
    byId('scope-lane').value = '';
  });
  byId('zoom-in').addEventListener('click', () => zoom(0.5));
  byId('zoom-out').addEventListener('click', () => zoom(2));
  byId('zoom-all').addEventListener('click', () => { scope.from = scope.to = 0; paintLanes(); });
  byId('scope-csv').addEventListener('click', saveCsv);
  byId('lanes').addEventListener('keydown', onScopeKey);
  addEventListener('resize', paintLanes);
  const state = await ask('/api/scope');
  if (url.lanes.length === 0) url.lanes = state.paths;
  takeState(state);
  showLanes();
}
