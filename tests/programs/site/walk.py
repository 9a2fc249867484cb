#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Walks a site: walk.py DIR [NAME ...]. Prints what is wrong with its pages: elements that are not closed in order, an id given
twice, a page without a title or with several main headings, a picture without a text, and links to pages, pictures or
anchors that do not exist. Prints the pages that no link reaches, and where the search index leads for each NAME."""
import json
import os
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

EMPTY = {'meta', 'link', 'img', 'br', 'hr', 'input'}


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.open, self.ids, self.links, self.wrong, self.counts = [], set(), [], [], {}
        self.feed(path.read_text())
        self.close()
        self.wrong += [f'<{tag}> is not closed' for tag in self.open]
        self.wrong += [f'{self.counts.get(tag, 0)} <{tag}>' for tag in ('title', 'h1', 'main') if self.counts.get(tag) != 1]

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.counts[tag] = self.counts.get(tag, 0) + 1
        if tag not in EMPTY:
            self.open.append(tag)
        if 'id' in attrs:
            if attrs['id'] in self.ids or not attrs['id']:
                self.wrong.append(f'id {attrs["id"]} twice')
            self.ids.add(attrs['id'])
        if tag == 'img' and not attrs.get('alt'):
            self.wrong.append(f'{attrs.get("src")} has no text')
        self.links += [attrs[name] for name in ('href', 'src') if name in attrs]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(f'</{tag}> closes another element at line {self.getpos()[0]}')


def main():
    root = Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in sorted(root.rglob('*.html'))}
    reached = {root / 'index.html'}
    for path, page in pages.items():
        for link in page.links:
            if link.startswith(('https://', 'http://', 'mailto:')):
                continue
            file, _, anchor = unquote(link).partition('#')
            target = Path(os.path.normpath(path.parent / file)) if file else path
            if root not in target.parents or not target.is_file():
                page.wrong.append(f'dead link to {link}')
            elif anchor and anchor not in pages[target].ids:
                page.wrong.append(f'dead anchor {link}')
            elif target != path:
                reached.add(target)
        for what in page.wrong:
            print(f'{path.relative_to(root)}: {what}')
    for path in pages:
        if path not in reached:
            print(f'{path.relative_to(root)}: no link leads here')
    index = (root / 'search-index.js').read_text()
    files, entries = json.loads(index[index.index('(') + 1:index.rindex(')')])
    for number, anchor, text in entries:
        page = pages.get(root / files[number])
        if page is None or anchor and anchor not in page.ids:
            print(f'search-index.js: `{text}` leads nowhere')
        if text in sys.argv[2:]:
            print(f'{text}: {files[number]}{"#" if anchor else ""}{anchor}')
    print('walked more than 1000 pages' if len(pages) > 1000 else f'walked {len(pages)} pages')


main()
