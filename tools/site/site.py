#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders the documentation as HTML: site.py DIR. Called by site.sh.
docs/README.md is the first page, and its sections and their links are the navigation. A file outside of docs/ that a page
links to becomes a page below source/; tests, of which the statements of compliance name hundreds, share one for their
folder. The anchor of a heading is the one of code hosts, so that links work in both."""
import html
import json
import multiprocessing
import os
import re
import shutil
import sys
from pathlib import Path

from markdown_it import MarkdownIt

ROOT = Path(__file__).resolve().parents[2]
FIRST, ERRORS = 'docs/README.md', 'docs/errors'
NAMES = {'README.md': 'tour.html', 'CHANGELOG.md': 'changes.html', 'CONTRIBUTING.md': 'contributing.html'}
CODE = re.compile(r'[EWI]\d{4}')
CAPTIONS = {'broken': 'With the mistake', 'fixed': 'Corrected', 'output': 'Output'}

ST = re.compile(r"""(?P<c>\(\*.*?\*\)|//[^\n]*|/\*.*?\*/)|(?P<p>\{[^}]*\})|(?P<s>'(?:\$.|[^'$])*'|"(?:\$.|[^"$])*")|(?P<k>\b(?:
    (?:END_)?(?:PROGRAM|FUNCTION|FUNCTION_BLOCK|METHOD|PROPERTY|INTERFACE|CLASS|NAMESPACE|CONFIGURATION|RESOURCE|TYPE|STRUCT|
    UNION|VAR|IF|CASE|FOR|WHILE|REPEAT|STEP|INITIAL_STEP|TRANSITION|ACTION|NETWORK)|
    VAR_(?:INPUT|OUTPUT|IN_OUT|TEMP|GLOBAL|EXTERNAL|STAT|INST|ACCESS|CONFIG)|RETAIN|NON_RETAIN|PERSISTENT|CONSTANT|AT|OF|
    THEN|ELSE|ELSIF|DO|TO|BY|UNTIL|EXIT|CONTINUE|RETURN|JMP|EXTENDS|IMPLEMENTS|ABSTRACT|FINAL|OVERRIDE|PUBLIC|PRIVATE|
    PROTECTED|INTERNAL|THIS|SUPER|ARRAY|POINTER|REFERENCE|REF_TO|TASK|WITH|ON|USING|FROM|NOT|AND|OR|XOR|MOD|TRUE|FALSE|NULL|
    __(?:TRY|CATCH|FINALLY|ENDTRY|NEW|DELETE))\b)""", re.S | re.X | re.I)


def highlighted(text):
    """The HTML of a program in ST."""
    parts, end = [], 0
    for match in ST.finditer(text):
        word = f'<span class="{match.lastgroup}">{html.escape(match.group(), False)}</span>'
        parts += [html.escape(text[end:match.start()], False), word]
        end = match.end()
    return ''.join(parts) + html.escape(text[end:], False)


def is_test(path):
    """Whether it is a file that is shown on the page of its folder."""
    return path.startswith('tests/') and (ROOT / path).is_file()


def page_of(path):
    """The page or file of the site for a file or folder of the project."""
    if path in NAMES:
        return NAMES[path]
    inside, is_folder = path.startswith('docs/'), (ROOT / path).is_dir()
    if is_test(path):
        path = os.path.dirname(path)
    path = path[5:] if inside else 'source/' + path
    if is_folder:
        return path + '/index.html'
    if path.endswith('.svg'):
        return path
    if inside and path.endswith('.md'):
        return re.sub(r'(^|/)README\.md$', r'\1index.md', path)[:-3] + '.html'
    return path + '.html'


def relative(page, target):
    return os.path.relpath(target, os.path.dirname(page) or '.')


class Headings:
    """Gives each heading of a page its anchor."""

    def __init__(self):
        self.seen, self.all = {}, []  # all: (level, anchor, text)

    def add(self, level, text):
        slug = re.sub(r'[^\w\- ]', '', text.strip().lower()).replace(' ', '-')
        count = self.seen.get(slug, 0)
        self.seen[slug] = count + 1
        anchor = f'{slug}-{count}' if count else slug
        self.all.append((level, anchor, text))
        return anchor


def fence(self, tokens, index, options, env):
    words = tokens[index].info.split()
    language, kind = (words + ['', ''])[:2]
    caption = CAPTIONS.get(kind) or CAPTIONS.get(language) or (kind if re.fullmatch(r'[\w/-]*\.\w+', kind) else '')
    code = tokens[index].content
    code = highlighted(code) if language == 'st' else html.escape(code, False)
    code = f'<pre><code>{code}</code></pre>\n'
    if not caption:
        return code
    return f'<figure class="{html.escape(kind)}">\n<figcaption>{html.escape(caption)}</figcaption>\n{code}</figure>\n'


def code_inline(self, tokens, index, options, env):
    """A short one stays on its line: browsers break after the `--` of an option."""
    code = tokens[index].content
    short = ' class="short"' if len(code) <= 28 else ''
    return f'<code{short}>{html.escape(code, False)}</code>'


def markdown():
    md = MarkdownIt('commonmark', {'xhtmlOut': False}).enable('table')
    md.add_render_rule('fence', fence)
    md.add_render_rule('code_inline', code_inline)
    md.add_render_rule('table_open', lambda self, *_: '<div class="table">\n<table>\n')
    md.add_render_rule('table_close', lambda self, *_: '</table>\n</div>\n')
    return md


MD = markdown()


def plain(token):
    return ''.join(child.content for child in token.children or [] if child.type in ('text', 'code_inline'))


def rewritten(source, page, link, wanted):
    """A link of a file of the project as one of its page; adds the file that it needs to `wanted`."""
    path, hash_sign, anchor = link.partition('#')
    if not path or re.match(r'[a-z]+:', path):
        return link
    path = os.path.normpath(os.path.join(os.path.dirname(source), path))
    if not (ROOT / path).exists():
        sys.exit(f'{source}: dead link to {link}')
    wanted.add(path)
    if is_test(path):
        hash_sign, anchor = '#', os.path.basename(path)
    return relative(page, page_of(path)) + hash_sign + anchor


def body_of_markdown(source, page):
    """(title, HTML, headings, files that it needs) of a file in Markdown."""
    headings, wanted, title = Headings(), set(), ''
    tokens = MD.parse((ROOT / source).read_text())
    for index, token in enumerate(tokens):
        if token.type == 'heading_open':
            text = plain(tokens[index + 1])
            title = title or text
            token.attrSet('id', headings.add(int(token.tag[1]), text))
        children = token.children or []
        for child, inside in zip(children, children[1:] + children[-1:]):
            name = {'link_open': 'href', 'image': 'src'}.get(child.type)
            if name:
                child.attrSet(name, rewritten(source, page, child.attrGet(name), wanted))
            if name == 'href' and re.fullmatch(r'[\w/-]+(\.md|/)', inside.content):  # a page of the site, not a file
                target = os.path.normpath(os.path.join(os.path.dirname(page), child.attrGet('href').partition('#')[0]))
                inside.content = NAMED.get(target, inside.content)
    return title, MD.renderer.render(tokens, MD.options, {}), headings.all, wanted


def body_of_folder(source, page):
    """A list of the files in a folder, or of all diagnostics."""
    wanted, rows = set(), []
    if source == ERRORS:
        title, kinds = 'Diagnostics', {'E': 'Errors', 'W': 'Warnings', 'I': 'Notes'}
        headings = Headings()
        for letter, kind in kinds.items():
            rows.append(f'<h2 id="{headings.add(2, kind)}">{kind}</h2>\n<ul class="codes">')
            for file in sorted((ROOT / source).glob(letter + '*.md')):
                code, _, text = file.open().readline().lstrip('# ').strip().partition(': ')
                text = MD.renderInline(text)
                rows.append(f'<li><a href="{code}.html"><b>{code}</b> {text}</a></li>')
            rows.append('</ul>')
        return title, f'<h1>{title}</h1>\n<p>Each page has a program that causes the message, and the program corrected. ' \
            '<code>rung explain CODE</code> prints it.</p>\n' + '\n'.join(rows), headings.all, wanted
    for entry in sorted((ROOT / source).iterdir()):
        if entry.name.startswith('.'):
            continue
        path = f'{source}/{entry.name}'
        wanted.add(path)
        name = entry.name + ('/' if entry.is_dir() else '')
        rows.append(f'<li><a href="{html.escape(relative(page, page_of(path)))}">{html.escape(name)}</a></li>')
    return source, f'<h1>{html.escape(source)}</h1>\n<ul>\n' + '\n'.join(rows) + '\n</ul>', [], wanted


def code_of(source):
    """A file that is not Markdown, as it is."""
    text = (ROOT / source).read_text(errors='replace')
    code = highlighted(text) if source.endswith(('.st', '.iecst')) else html.escape(text, False)
    return f'<pre><code>{code}</code></pre>\n'


def body_of_tests(source, files):
    """Files of a folder one below the other, each with its name as anchor."""
    parts = [f'<h2 id="{html.escape(os.path.basename(file))}">{html.escape(os.path.basename(file))}</h2>\n{code_of(file)}'
             for file in files]
    return source, f'<h1>{html.escape(source)}</h1>\n' + ''.join(parts), [], set()


def navigation():
    """[(section, [(text, page or page#anchor)])] of the first page."""
    sections, tokens = [], MD.parse((ROOT / FIRST).read_text())
    for index, token in enumerate(tokens):
        if token.type == 'heading_open' and token.tag == 'h2':
            sections.append((plain(tokens[index + 1]), []))
        elif token.type == 'list_item_open':
            children = tokens[index + 2].children
            link = children[0].attrGet('href')
            path, hash_sign, anchor = link.partition('#')
            path = page_of(os.path.normpath('docs/' + path))
            sections[-1][1].append((children[1].content, path + hash_sign + anchor))
    return sections


NAVIGATION = navigation()
NAMED = {page_of(f'docs/{path.name}'): path.open().readline().lstrip('# ').strip() for path in (ROOT / 'docs').glob('*.md')}
NAMED |= {target: text for _, links in NAVIGATION for text, target in links}
LISTED = {target for _, links in NAVIGATION for _, target in links}
VERSION = re.search(r'project\(\w+\s+VERSION (\S+)', (ROOT / 'CMakeLists.txt').read_text()).group(1)


def contents(page, headings):
    """The navigation beside a page, with the sections of the page below its link."""
    current = page if page in LISTED else page.split('/')[0] + '/index.html'
    rows = []
    for section, links in NAVIGATION:
        rows.append(f'<h2>{html.escape(section)}</h2>\n<ul>')
        for text, target in links:
            here = ' aria-current="page"' if target == page else ' class="around"' if target == current else ''
            rows.append(f'<li><a href="{html.escape(relative(page, target))}"{here}>{html.escape(text)}</a>')
            inner = [h for h in headings if h[0] == 2] if target == current else []
            if len(inner) > 1:
                rows.append('<ul>')
                rows += [f'<li><a href="#{html.escape(anchor)}">{html.escape(name)}</a></li>' for _, anchor, name in inner]
                rows.append('</ul>')
            rows.append('</li>')
        rows.append('</ul>')
    return '<nav id="contents" aria-label="Contents">\n' + '\n'.join(rows) + '\n</nav>\n'


def trail(page):
    """The way to a page that the contents do not list, when it lies below one that they do."""
    if CODE.match(os.path.basename(page)):
        return f'<p class="trail"><a href="index.html">Diagnostics</a></p>\n'
    if page.startswith('library/') and page != 'library/index.html':
        return f'<p class="trail"><a href="index.html">Libraries</a></p>\n'
    folders = os.path.dirname(page[7:]).split('/') if page.startswith('source/') else []
    if folders and folders[0] == 'samples' and os.path.basename(page) != 'index.html':
        return f'<p class="trail"><a href="index.html">{html.escape("/".join(folders))}</a></p>\n'
    return ''


def render(job):
    """Writes the page of a file or folder, or of tests in it; (files that it needs, entries of the search index)."""
    source, tests, out = job
    page = page_of((tests or [source])[0])
    target = out / page
    target.parent.mkdir(parents=True, exist_ok=True)
    if tests:
        title, body, headings, wanted = body_of_tests(source, tests)
    elif page.endswith('.svg'):
        shutil.copyfile(ROOT / source, target)
        return set(), []
    elif (ROOT / source).is_dir():
        readme = f'{source}/README.md'
        if page_of(readme) == page and (ROOT / readme).exists():
            return {readme}, []
        title, body, headings, wanted = body_of_folder(source, page)
    elif source.endswith('.md'):
        title, body, headings, wanted = body_of_markdown(source, page)
    else:
        title, body, headings, wanted = source, f'<h1>{html.escape(source)}</h1>\n{code_of(source)}', [], set()
    is_leaf = page.startswith('source/') or CODE.match(os.path.basename(page))
    beside = '' if is_leaf else contents(page, headings)
    root = relative(page, '.')
    way = '#contents' if beside else f'{root}/index.html#contents'
    head = '' if page == 'index.html' else ' · Rung'
    target.write_text(f'''<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{html.escape(title)}{head}</title>
<link rel="stylesheet" href="{root}/style.css">
<script defer src="{root}/search.js" data-root="{root}"></script>
</head>
<body{' class="leaf"' if is_leaf else ''}>
<header>
<a class="name" href="{root}/index.html">Rung</a>
<a class="menu" href="{way}">Contents</a>
<form class="search" role="search" hidden>
<input type="search" name="q" placeholder="Search" title="Search titles, names and codes: /" aria-keyshortcuts="/"
 autocomplete="off" spellcheck="false">
<div class="found" hidden><p role="status"></p><ul></ul></div>
</form>
</header>
<main>
{trail(page)}{body}
</main>
{beside}<footer>Rung {VERSION}</footer>
</body>
</html>
''')
    if page.startswith('source/'):
        return wanted, []
    return wanted, [(page, '', title)] + [(page, anchor, text) for level, anchor, text in headings if level in (2, 3)]


def main():
    out = Path(sys.argv[1])
    out.mkdir(parents=True)
    wanted = {ERRORS} | {str(path.relative_to(ROOT)) for path in (ROOT / 'docs').rglob('*.md')}
    done, index = set(), []
    with multiprocessing.Pool() as pool:
        while wanted:
            jobs = [(source, None, out) for source in sorted(wanted) if not is_test(source)]
            done |= wanted
            wanted = set()
            for more, entries in pool.imap(render, jobs, chunksize=8):
                wanted |= more
                index += entries
            wanted -= done
        folders = {}
        for test in sorted(filter(is_test, done)):
            folders.setdefault(os.path.dirname(test), []).append(test)
        pool.map(render, [(folder, tests, out) for folder, tests in folders.items()])
    pages = sorted({page for page, _, _ in index})
    number = {page: at for at, page in enumerate(pages)}
    # Of equally good answers, a page that explains comes before one that lists.
    index.sort(key=lambda entry: (not entry[0].startswith(('cli/', 'errors/', 'library/')), entry))
    entries = [[number[page], anchor, text] for page, anchor, text in index]
    data = json.dumps([pages, entries], ensure_ascii=False, separators=(',', ':'))
    (out / 'search-index.js').write_text(f'rungIndex({data});\n')
    for file in ('style.css', 'search.js'):
        shutil.copyfile(ROOT / 'tools/site' / file, out / file)


if __name__ == '__main__':
    main()
