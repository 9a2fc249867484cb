// SPDX-License-Identifier: Apache-2.0
// Bodies of the program while it runs: pictures, see picture.js, and text with the values of each line beside it. A
// picture has its own document (a shadow root), since its style sheet is for itself.
'use strict';

const body = {
  root: null,     // the shadow root of the picture
  picture: null,  // the LivePicture in it
  chips: [],      // of text: {chip, path, name}
};

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
  body.picture = null;
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
  body.picture = new LivePicture(body.root.firstChild, {
    valueOf,
    isForced: path => isForced(fullPath(path)),
    open: path => openDialog(fullPath(path)),
  });
}

const valueOf = path => program.values.get(fullPath(path));

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
  if (body.picture) body.picture.paint();
  body.chips.forEach(paintChip);
}

views.push({
  tab: 'program',
  paths: () => [...(body.picture ? body.picture.paths() : []), ...body.chips.map(entry => entry.path)].map(fullPath),
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
