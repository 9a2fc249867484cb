// SPDX-License-Identifier: Apache-2.0
// Search over the titles of pages, headings, codes and names. The index is a script, which pages opened from disk can load
// too; it is loaded at the first use. `/` goes to the field, the arrows through the results; `?q=TON` in the address
// searches at once.
'use strict';
(() => {
  const root = document.currentScript.dataset.root;
  const form = document.querySelector('form.search');
  const input = form.querySelector('input');
  const found = form.querySelector('.found');
  const status = found.querySelector('p');
  const list = found.querySelector('ul');
  const shown = 40;
  let entries = null;  // of each: page, anchor, text, title of the page; folded, around, spaced: what rank() compares

  window.rungIndex = ([pages, rows]) => {
    const titles = {};
    for (const [page, anchor, text] of rows) if (!anchor) titles[page] = text;
    entries = rows.map(([page, anchor, text]) => {
      const folded = fold(text);
      return {page: pages[page], anchor, text, title: titles[page], folded, around: `${folded} ${fold(titles[page])}`,
        spaced: ' ' + folded.replace(/[^\p{L}\p{N}]+/gu, ' ')};
    });
    search();
  };

  // `unused-variable` and `unused variable` are one question.
  const fold = text => text.toLowerCase().replace(/([a-z])-(?=[a-z])/g, '$1 ').trim();

  // How well an entry answers, smaller is better; null: not at all. Words may also be in the title of the page.
  function rank(entry, query, words) {
    const {folded, around} = entry;
    if (!words.every(word => around.includes(word)) || !words.some(word => folded.includes(word))) return null;
    const beginWords = words.every(word => entry.spaced.includes(' ' + word));
    const place = folded === query ? 0 : folded.startsWith(query) ? 2 : beginWords ? 4 : 6;
    return place + (entry.anchor ? 1 : 0);
  }

  function search() {
    const query = fold(input.value);
    found.hidden = !query;
    if (!query) return;
    if (!entries) {
      if (!document.getElementById('index')) {
        const script = document.createElement('script');
        script.id = 'index';
        script.src = root + '/search-index.js';
        document.head.append(script);
      }
      return;
    }
    const words = query.split(/\s+/);
    const hits = [];
    for (const entry of entries) {
      const place = rank(entry, query, words);
      if (place !== null) hits.push([place, entry]);
    }
    hits.sort(([a, x], [b, y]) => a - b || x.text.length - y.text.length);
    status.textContent = hits.length > shown ? `${shown} of ${hits.length} results`
      : hits.length === 1 ? '1 result' : `${hits.length || 'no'} results`;
    list.replaceChildren(...hits.slice(0, shown).map(([, entry]) => {
      const link = document.createElement('a');
      link.href = `${root}/${entry.page}` + (entry.anchor ? '#' + entry.anchor : '');
      link.textContent = entry.text;
      if (entry.anchor) {
        const where = document.createElement('small');
        where.textContent = entry.title;
        link.append(' ', where);
      }
      const item = document.createElement('li');
      item.append(link);
      return item;
    }));
  }

  function close() {
    found.hidden = true;
  }

  input.addEventListener('input', search);
  input.addEventListener('focus', search);
  form.addEventListener('focusout', event => {
    if (event.relatedTarget && !form.contains(event.relatedTarget)) close();
  });
  document.addEventListener('pointerdown', event => {
    if (!form.contains(event.target)) close();
  });
  form.addEventListener('submit', event => {
    event.preventDefault();
    const first = list.querySelector('a');
    if (first) { close(); location.href = first.href; }
  });
  list.addEventListener('click', close);
  form.addEventListener('keydown', event => {
    const links = [...list.querySelectorAll('a')];
    const at = links.indexOf(document.activeElement);
    if (event.key === 'ArrowDown' && at + 1 < links.length) links[at + 1].focus();
    else if (event.key === 'ArrowUp' && at >= 0) (links[at - 1] || input).focus();
    else if (event.key === 'Escape') { input.focus(); close(); }
    else return;
    event.preventDefault();
  });
  document.addEventListener('keydown', event => {
    if (event.key !== '/' || event.ctrlKey || event.metaKey || event.altKey || event.target === input) return;
    event.preventDefault();
    input.focus();
    input.select();
  });

  // Where the contents scroll by themselves, they begin at the page that is shown.
  const contents = document.getElementById('contents');
  const current = contents && contents.querySelector('[aria-current], .around');
  if (current) contents.scrollTop = current.offsetTop - contents.clientHeight / 3;

  form.hidden = false;
  const asked = new URLSearchParams(location.search).get('q');
  if (asked) {
    input.value = asked;
    input.focus();
    search();
  }
})();
