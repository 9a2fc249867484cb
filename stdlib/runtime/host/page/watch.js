// SPDX-License-Identifier: Apache-2.0
// Lists of watched variables, which the URL keeps, and the dialog in which any variable gets a new value: written once,
// or forced.
'use strict';

const watch = {
  rows: new Map(),  // by path: {row, value, release, text}, of those that have been in sight
  first: 0, end: 0, // the rows that are in the table
};
const kRowHeight = 36, kMargin = 4;  // pixels, as in style.css; rows above and below what is in sight
const currentList = () => url.lists[url.list];

// ---- the list

// Of a record or an array the elementary variables in it.
function leavesOf(path) {
  const symbol = symbolOf(path);
  if (!symbol || isLeaf(symbol)) return [symbol ? symbol.path : path];
  return (tree.children.get(symbol.path) || []).flatMap(child => leavesOf(child.path));
}

function watchPath(path) {
  const list = currentList();
  for (const leaf of leavesOf(path).slice(0, 1000)) if (!list.paths.includes(leaf)) list.paths.push(leaf);
  showWatched();
}

function unwatchPath(path) {
  const list = currentList();
  list.paths = list.paths.filter(other => other !== path);
  showWatched();
}

function watchedRow(path) {
  const symbol = symbolOf(path);
  const value = document.createTextNode('');
  const text = make('input', {'aria-label': 'New value of ' + path, autocomplete: 'off',
    keydown: event => { if (event.key === 'Enter') write(); }});
  const write = guarded(async () => { await assign('write', path, text.value); text.value = ''; });
  const force = guarded(() => assign('force', path, text.value === '' ? program.values.get(path) : text.value));
  const action = (label, act, kind) => make('button', {type: 'button', click: act, class: kind || '', 'data-act': label, 'aria-label': label + ' ' + path}, label);
  const can_write = !symbol || symbol.writable;
  const release = action('Unforce', guarded(() => unforce(path)));
  const row = make('tr', {'data-path': path},
    make('td', {class: 'path', title: path}, path),
    make('td', {class: 'quiet'}, symbol ? symbol.type : ''),
    make('td', {class: 'value'}, make('div', {class: 'cell'}, value)),
    make('td', {}, can_write ? text : ''),
    make('td', {class: 'actions'}, ...(can_write ? [action('Write', write), ' ', action('Force', force, 'force'), ' ', release, ' '] : []),
      action('Remove', () => unwatchPath(path))));
  return {row, value, release, text: null};
}

function showWatched() {
  const {paths} = currentList();
  watch.rows.clear();
  byId('lists').replaceChildren(...url.lists.map((list, i) => make('option', {value: i, selected: i === url.list}, list.name)));
  byId('remove-list').disabled = url.lists.length === 1;
  byId('watched-empty').hidden = paths.length > 0;
  byId('watched').hidden = paths.length === 0;
  watch.end = 0;
  showWindow();
  writeUrl();
  refreshStream();
}

// The rows in sight and some around them: a table of thousands costs a browser much with each new value.
function showWindow() {
  const content = byId('content'), rows = byId('watched').tBodies[0], {paths} = currentList();
  const hidden = content.getBoundingClientRect().top - rows.getBoundingClientRect().top;
  const first = Math.max(Math.floor(hidden / kRowHeight) - kMargin, 0);
  const end = Math.min(first + Math.ceil(content.clientHeight / kRowHeight) + 2 * kMargin, paths.length);
  if (watch.end !== 0 && first === watch.first && end === watch.end) return;
  Object.assign(watch, {first, end});
  const space = count => make('tr', {'aria-hidden': 'true', style: `height: ${count * kRowHeight}px`, hidden: count === 0});
  const focused = document.activeElement;
  rows.replaceChildren(space(first), ...paths.slice(first, end).map(path => rowOfWatched(path).row), space(paths.length - end));
  if (rows.contains(focused)) focused.focus({preventScroll: true});
  paintWindow();
  paintForced();
}

function rowOfWatched(path) {
  if (!watch.rows.has(path)) watch.rows.set(path, watchedRow(path));
  return watch.rows.get(path);
}

function paintWindow() {
  for (const path of currentList().paths.slice(watch.first, watch.end)) paintWatched(rowOfWatched(path), path);
}

function paintWatched(row, path) {
  const text = program.values.get(path);
  if (text === row.text) return;
  row.text = text;
  row.value.data = text === undefined ? '' : text === null ? 'null' : text;
}

function paintForced() {
  for (const [path, row] of watch.rows) {
    row.row.classList.toggle('is-forced', isForced(path));
    row.release.hidden = !isForced(path);
  }
}

views.push({
  tab: 'watch',
  paths: () => currentList().paths,
  onValues: paintWindow,
  onForces: paintForced,
  onShow: () => { watch.end = 0; showWindow(); },
});

function startWatch() {
  byId('content').addEventListener('scroll', showWindow, {passive: true});
  addEventListener('resize', showWindow);
  byId('lists').addEventListener('change', () => { url.list = Number(byId('lists').value); showWatched(); });
  byId('new-list').addEventListener('click', () => {
    url.lists.push({name: 'List ' + (url.lists.length + 1), paths: []});
    url.list = url.lists.length - 1;
    showWatched();
  });
  byId('rename-list').addEventListener('click', () => {
    const name = prompt('Name of the list', currentList().name);
    if (name) currentList().name = name.replaceAll(';', ',');
    showWatched();
  });
  byId('remove-list').addEventListener('click', () => {
    url.lists.splice(url.list, 1);
    url.list = 0;
    showWatched();
  });
  byId('add-form').addEventListener('submit', guarded(async event => {
    event.preventDefault();
    const path = byId('add-path').value.trim();
    if (path === '') return;
    if (!symbolOf(path)) await ask('/api/values?paths=' + encodeURIComponent(path));  // it may be an address
    watchPath(path);
    byId('add-path').value = '';
  }));
  offerPaths();
  showWatched();
}

// Paths that inputs suggest; of a large program the search of the tree is faster.
function offerPaths() {
  const paths = [...program.symbols.values()].filter(isLeaf).slice(0, 2000);
  byId('paths').replaceChildren(...paths.map(symbol => make('option', {value: symbol.path})));
}

// ---- the dialog

const dialog = {path: ''};

function openDialog(path) {
  const symbol = symbolOf(path);
  dialog.path = symbol ? symbol.path : path;
  const is_bool = symbol && symbol.type === 'BOOL';
  const can_write = !symbol || symbol.writable;
  byId('set-path').textContent = dialog.path;
  byId('set-type').textContent = symbol ? symbol.type : '';
  byId('set-error').textContent = can_write ? '' : 'This cannot be written.';
  byId('set-text').value = '';
  byId('set-bool').hidden = !is_bool;
  for (const id of ['set-new', 'set-write', 'set-force']) byId(id).hidden = !can_write;
  paintDialog();
  byId('set').showModal();
  byId(can_write ? 'set-text' : 'set-close').focus();
  refreshStream();
}

function paintDialog() {
  if (dialog.path === '') return;
  const text = program.values.get(dialog.path);
  byId('set-value').textContent = text === undefined || text === null ? '' : text;
  byId('set-value').classList.toggle('is-forced', isForced(dialog.path));
  byId('set-unforce').hidden = !isForced(dialog.path);
}

async function inDialog(act) {
  try {
    byId('set-error').textContent = '';
    await act();
    paintDialog();
  } catch (error) {
    byId('set-error').textContent = error.message;
  }
}

views.push({
  paths: () => dialog.path === '' ? [] : [dialog.path],
  onValues: paintDialog,
  onForces: paintDialog,
});

function startDialog() {
  const text = () => byId('set-text').value === '' ? byId('set-value').textContent : byId('set-text').value;
  const set = kind => inDialog(() => assign(kind, dialog.path, text()));
  const choose = value => { byId('set-text').value = value; byId('set-text').focus(); };
  byId('set-true').addEventListener('click', () => choose('TRUE'));
  byId('set-false').addEventListener('click', () => choose('FALSE'));
  byId('set-write').addEventListener('click', () => set('write'));
  byId('set-force').addEventListener('click', () => set('force'));
  byId('set-unforce').addEventListener('click', () => inDialog(() => unforce(dialog.path)));
  byId('set-watch').addEventListener('click', () => { watchPath(dialog.path); byId('set').close(); });
  byId('set-scope').addEventListener('click', () => { addLane(dialog.path); byId('set').close(); });
  byId('set-text').addEventListener('keydown', event => {
    if (event.key !== 'Enter') return;
    event.preventDefault();
    set('write');
  });
  byId('set').addEventListener('close', () => {
    if (byId('set').open) return;  // for another variable meanwhile
    dialog.path = '';
    refreshStream();
  });
}
