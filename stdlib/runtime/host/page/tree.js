// SPDX-License-Identifier: Apache-2.0
// The tree of variables, with search: arrow keys move and open, Enter asks for a new value, `w` watches, `s` adds a lane
// to the scope. Children are made when their parent is opened; values are live where they are seen.
'use strict';

const tree = {
  children: new Map(),  // by path: symbols below it, '' for the roots
  shown: new Map(),     // by path: the elements of rows that are shown
  open: new Set(),
  filter: '',
};
const kMostRows = 500;

// The path of the record or array that has this variable, or ''.
function parentOf(path) {
  const cut = path.endsWith(']') ? path.lastIndexOf('[') : path.lastIndexOf('.');
  const parent = cut > 0 ? path.slice(0, cut) : '';
  return program.symbols.has(parent) ? parent : '';
}

function growTree() {
  tree.children.clear();
  for (const symbol of program.symbols.values()) {
    const parent = parentOf(symbol.path);
    if (!tree.children.has(parent)) tree.children.set(parent, []);
    tree.children.get(parent).push(symbol);
  }
}

function rowOf(symbol, name) {
  const has_children = tree.children.has(symbol.path);
  const is_open = tree.open.has(symbol.path);
  const value = make('span', {class: 'value'});
  const item = make('li', {role: 'treeitem', tabindex: -1, 'data-path': symbol.path, title: symbol.path + ' : ' + symbol.type});
  if (has_children) item.setAttribute('aria-expanded', is_open);
  item.append(make('div', {class: 'node', click: () => chooseRow(item)},
    make('span', {class: 'twist'}, has_children ? (is_open ? '▾' : '▸') : ''),
    make('span', {class: 'label'}, name), value));
  if (isLeaf(symbol)) tree.shown.set(symbol.path, {item, value, text: null});
  if (has_children && is_open) item.append(branchOf(symbol.path));
  return item;
}

function branchOf(parent) {
  const group = make('ul', {role: 'group'});
  const symbols = tree.children.get(parent) || [];
  for (const symbol of symbols.slice(0, kMostRows))
    group.append(rowOf(symbol, parent === '' ? symbol.path : symbol.path.slice(parent.length).replace(/^\./, '')));
  if (symbols.length > kMostRows)
    group.append(make('li', {class: 'quiet'}, `and ${symbols.length - kMostRows} more; search for them`));
  return group;
}

function showTree() {
  tree.shown.clear();
  const root = byId('tree');
  const focused = document.activeElement && document.activeElement.dataset.path;
  if (tree.filter === '') {
    root.replaceChildren(...branchOf('').childNodes);
  } else {
    const matches = [...program.symbols.values()].filter(symbol => isLeaf(symbol) && symbol.path.toLowerCase().includes(tree.filter));
    matches.sort((a, b) => a.path.length - b.path.length);
    const found = matches.slice(0, kMostRows).map(symbol => rowOf(symbol, symbol.path));
    root.replaceChildren(...(found.length > 0 ? found : [make('li', {class: 'quiet'}, 'no variable has this in its path')]));
  }
  const items = [...root.querySelectorAll('[role=treeitem]')];
  const again = items.find(item => item.dataset.path === focused);
  if (items.length > 0) (again || items[0]).tabIndex = 0;
  if (again) again.focus();
  paintTree(true);
  refreshStream();
}

function toggleRow(item, open) {
  const path = item.dataset.path;
  if (!tree.children.has(path) || tree.filter !== '' || open === tree.open.has(path)) return;
  tree.open.has(path) ? tree.open.delete(path) : tree.open.add(path);
  focusRow(item);
  showTree();
}

function chooseRow(item) {
  focusRow(item);
  if (tree.children.has(item.dataset.path) && tree.filter === '') toggleRow(item);
  else openDialog(item.dataset.path);
}

function focusRow(item) {
  for (const other of byId('tree').querySelectorAll('[tabindex="0"]')) other.tabIndex = -1;
  item.tabIndex = 0;
  item.focus();
}

function onTreeKey(event) {
  const item = event.target.closest('[role=treeitem]');
  if (!item || event.ctrlKey || event.metaKey || event.altKey) return;
  const items = [...byId('tree').querySelectorAll('[role=treeitem]')];
  const at = items.indexOf(item);
  const path = item.dataset.path;
  const keys = {
    ArrowDown: () => at + 1 < items.length && focusRow(items[at + 1]),
    ArrowUp: () => at > 0 && focusRow(items[at - 1]),
    Home: () => focusRow(items[0]),
    End: () => focusRow(items[items.length - 1]),
    ArrowRight: () => toggleRow(item, true),
    ArrowLeft: () => {
      const parent = item.parentElement.closest('[role=treeitem]');
      if (tree.open.has(path) && tree.filter === '') toggleRow(item, false);
      else if (parent) focusRow(parent);
    },
    Enter: () => chooseRow(item),
    w: () => watchPath(path),
    s: () => addLane(path),
  };
  if (!keys[event.key]) return;
  event.preventDefault();
  event.stopPropagation();
  keys[event.key]();
}

function paintTree(all) {
  for (const [path, row] of tree.shown) {
    const text = program.values.get(path);
    if (text === row.text && !all) continue;
    row.text = text;
    row.value.textContent = text === undefined || text === null ? '' : text;
    row.item.classList.toggle('is-forced', isForced(path));
  }
}

views.push({
  paths: () => [...tree.shown.keys()],
  onValues: () => paintTree(false),
  onForces: () => paintTree(true),
});

function startTree() {
  growTree();
  const roots = (tree.children.get('') || []).filter(symbol => tree.children.has(symbol.path));
  if (roots.length === 1) tree.open.add(roots[0].path);
  byId('tree').addEventListener('keydown', onTreeKey);
  byId('search').addEventListener('input', () => {
    tree.filter = byId('search').value.trim().toLowerCase();
    showTree();
  });
  byId('search').addEventListener('keydown', event => {
    const first = byId('tree').querySelector('[role=treeitem]');
    if (event.key === 'ArrowDown' && first) event.preventDefault(), focusRow(first);
  });
  showTree();
}
