// SPDX-License-Identifier: Apache-2.0
// The state of the program and commands to it, what is forced, tasks, faults, messages, the memory of NCT; and the
// beginning of the page.
'use strict';

// ---- the head of the page

// Another version of the program: the page begins again, and the URL has what was chosen.
let version = '';
function followVersion(info) {
  const now = `${info.layout_hash} ${info.changes}`;
  if (version !== '' && version !== now) location.reload();
  version = now;
}

function paintInfo(info) {
  byId('name').textContent = info.name;
  byId('state').textContent = info.state;
  byId('state').dataset.state = info.state;
  byId('clock').textContent = `cycle ${info.cycle}, ${shortNumber(info.time_ms / 1000)} s, ${info.engine}`;
  byId('start').disabled = info.state !== 'stopped';
  byId('stop').disabled = info.state !== 'running';
  byId('cycle').disabled = info.state !== 'stopped';
  document.title = `${info.name}: ${info.state}`;
}

async function paintFault(info) {
  byId('fault').hidden = info.state !== 'faulted';
  if (info.state !== 'faulted') return;
  const faults = await ask('/api/faults');
  byId('fault-text').textContent = faults.length > 0 ? faults[faults.length - 1].text : 'the program is faulted';
}

// Several times a second; without an answer the page says so.
async function poll() {
  try {
    const info = await ask('/api/info');
    followVersion(info);
    paintInfo(info);
    await paintFault(info);
    await readForces();
    for (const view of views) if (view.onPoll && isShown(view)) await view.onPoll();
  } catch (error) {
    byId('state').textContent = 'no connection';
    byId('state').dataset.state = 'lost';
  }
}

async function pollAgain() {
  await poll();
  setTimeout(pollAgain, document.hidden ? 5000 : 500);
}

const command = text => guarded(async () => {
  const answer = await ask('/api/command', {command: text()});
  if (answer.warning) notify(answer.warning);
  await poll();
});

function showForced() {
  const forces = [...program.forces.values()];
  byId('forced').hidden = forces.length === 0;
  byId('forced-count').textContent = forces.length === 1 ? '1 value is forced' : `${forces.length} values are forced`;
  const text = forces.map(force => force.join('\n')).join('\n');
  if (byId('forced-list').dataset.shown === text) return;
  byId('forced-list').dataset.shown = text;
  byId('forced-list').replaceChildren(...forces.map(([path, value]) => make('li', {},
    make('button', {type: 'button', title: 'Unforce ' + path, 'aria-label': `Unforce ${path}, which is ${value}`, click: guarded(() => unforce(path))}, `${path} = ${value} ×`))));
}
views.push({onForces: showForced});

// ---- tasks, faults and messages

views.push({
  tab: 'tasks',
  onPoll: async () => {
    const rows = (await ask('/api/tasks')).map(task => make('tr', {class: task.stopped ? 'is-forced' : ''},
      ...[task.name, task.kind, task.priority, task.interval_us, task.activations, task.overruns, task.last_us, task.shortest_us,
        task.average_us, task.longest_us, `${task.earliest_us} to ${task.latest_us}`, task.late_us].map(value => make('td', {}, String(value)))));
    byId('task-table').tBodies[0].replaceChildren(...rows);
  },
});

const moment = entry => entry.time_ms === undefined ? '' : `${shortNumber(entry.time_ms / 1000)} s`;
function showEntries(id, entries, none) {
  const items = entries.slice(-200).reverse().map(entry => make('li', {'data-severity': entry.severity || 'error'},
    make('span', {class: 'quiet'}, moment(entry) + (entry.severity ? ' ' + entry.severity : '')), make('pre', {}, entry.text)));
  byId(id).replaceChildren(...(items.length > 0 ? items : [make('li', {class: 'quiet'}, none)]));
}
views.push({
  tab: 'log',
  onPoll: async () => {
    showEntries('faults', await ask('/api/faults'), 'The program has had no fault.');
    showEntries('messages', await ask('/api/messages'), 'The program has said nothing.');
  },
});

// ---- the memory of NCT: words of 32 bits

const memory = {from: 9056, count: 32, cells: new Map()};

function showMemory() {
  memory.cells.clear();
  const rows = [];
  for (let word = memory.from; word < memory.from + memory.count; ++word) {
    const value = make('td', {class: 'value'}), bits = make('td', {});
    memory.cells.set(String(word), {value, bits, text: null});
    rows.push(make('tr', {}, make('td', {}, make('button', {type: 'button', class: 'chip', click: () => openDialog(String(word))}, String(word))), value, bits));
  }
  byId('words').tHead.replaceChildren(make('tr', {}, ...['Word', 'Value', 'Bits 31 to 0'].map(name => make('th', {}, name))));
  byId('words').tBodies[0].replaceChildren(...rows);
  refreshStream();
}

function paintMemory() {
  for (const [path, cell] of memory.cells) {
    const text = program.values.get(path);
    if (text === cell.text || text === undefined) continue;
    cell.text = text;
    cell.value.textContent = text;
    cell.bits.textContent = Number(text).toString(2).padStart(32, '0').replace(/(.{8})(?=.)/g, '$1 ');
  }
}
views.push({tab: 'memory', paths: () => [...memory.cells.keys()], onValues: paintMemory});

function startMemory() {
  const has_ladder = program.pous.some(pou => pou.language === 'NCT');
  byId('tab-memory').hidden = !has_ladder;
  byId('memory-form').addEventListener('submit', event => {
    event.preventDefault();
    memory.from = Number(byId('memory-from').value);
    showMemory();
  });
  if (has_ladder) showMemory();
}

// ---- tabs

function showTab(name) {
  const tabs = [...document.querySelectorAll('[role=tab]')].filter(tab => !tab.hidden);
  const chosen = tabs.find(tab => tab.id === 'tab-' + name) || tabs[0];
  for (const tab of tabs) {
    tab.setAttribute('aria-selected', tab === chosen);
    tab.tabIndex = tab === chosen ? 0 : -1;
    byId(tab.getAttribute('aria-controls')).hidden = tab !== chosen;
  }
  url.tab = chosen.getAttribute('aria-controls');
  writeUrl();
  refreshStream();
  for (const view of views) if (view.onShow && isShown(view)) view.onShow();
  poll();
}

function onTabKey(event) {
  const tabs = [...document.querySelectorAll('[role=tab]')].filter(tab => !tab.hidden);
  const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
  const at = tabs.indexOf(event.target);
  if (!step || at < 0) return;
  const next = tabs[(at + step + tabs.length) % tabs.length];
  next.focus();
  showTab(next.getAttribute('aria-controls'));
}

function onKey(event) {
  const is_typing = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) || byId('set').open;
  if (is_typing || event.ctrlKey || event.metaKey || event.altKey) return;
  const tabs = [...document.querySelectorAll('[role=tab]')].filter(tab => !tab.hidden);
  if (event.key === '/') event.preventDefault(), byId('search').focus();
  else if (tabs[Number(event.key) - 1]) showTab(tabs[Number(event.key) - 1].getAttribute('aria-controls'));
}

const startPage = guarded(async () => {
  readUrl();
  byId('start').addEventListener('click', command(() => 'start'));
  byId('stop').addEventListener('click', command(() => 'stop'));
  byId('cycle').addEventListener('click', command(() => 'cycle'));
  byId('reset').addEventListener('click', command(() => 'reset ' + byId('reset-kind').value));
  byId('unforce-all').addEventListener('click', guarded(() => unforce()));
  byId('tabs').addEventListener('click', event => { if (event.target.role === 'tab') showTab(event.target.getAttribute('aria-controls')); });
  byId('tabs').addEventListener('keydown', onTabKey);
  addEventListener('keydown', onKey);
  addEventListener('hashchange', () => location.reload());
  await readSymbols();
  program.tasks = await ask('/api/tasks');
  startTree();
  startDialog();
  startWatch();
  await startProgram();
  startMemory();
  await startScope();
  await startMotion();
  showTab(url.tab);
  await pollAgain();
});
startPage();
