// SPDX-License-Identifier: Apache-2.0
// Live values in the text: while a program is watched, each line of a body in ST or IL ends with the values of what it
// names, in the instance that is chosen by the lens above the body. Only what is visible is asked for.
import * as path from 'node:path';
import * as vscode from 'vscode';
import { Body, Line, Monitor, Values } from './monitor';
import { unescape } from './reports';

interface ShownBody {
  body: Body;
  first: number; // the line of its heading, from 0
  lines: Line[]; // with lines from 0, moved by edits
}

const kDelay = 60; // ms after the last move
const kMostShown = 40; // characters of a value
const kLanguages = /^(?:iecst|xml)$/;
const kSelector = ['iecst', 'xml'].map(language => ({ scheme: 'file', language }));
const kHidden = /(?:^|\.)__/; // what the compiler adds
const kNoBreak = '\u00a0';

export class LiveText implements vscode.Disposable, vscode.CodeLensProvider {
  private bodies: Body[] = [];
  private known = new Map<string, Promise<{ file: string; lines: Line[] } | undefined>>(); // by the name of the body
  private readonly documents = new Map<string, ShownBody[]>(); // by URI
  private values: Values = {};
  private timer: NodeJS.Timeout | undefined;
  private readonly lensesChanged = new vscode.EventEmitter<void>();
  readonly onDidChangeCodeLenses = this.lensesChanged.event;
  private readonly decoration = vscode.window.createTextEditorDecorationType({
    rangeBehavior: vscode.DecorationRangeBehavior.ClosedOpen,
    after: {
      margin: '0 0 0 2em',
      color: new vscode.ThemeColor('editor.inlineValuesForeground'),
      backgroundColor: new vscode.ThemeColor('editor.inlineValuesBackground'),
    },
  });
  private readonly painted = new WeakMap<vscode.TextEditor, string>();
  private readonly disposables: vscode.Disposable[] = [this.decoration];

  constructor(private readonly monitor: Monitor) {
    this.disposables.push(
      monitor.onDidChange(() => void this.programChanged()),
      monitor.onDidChoose(() => {
        this.lensesChanged.fire();
        void this.refresh();
      }),
      monitor.onValues(values => {
        Object.assign(this.values, values);
        this.paint();
      }),
      vscode.window.onDidChangeVisibleTextEditors(() => this.refreshSoon()),
      vscode.window.onDidChangeTextEditorVisibleRanges(() => this.refreshSoon()),
      vscode.workspace.onDidChangeTextDocument(event => this.edited(event)),
      vscode.workspace.onDidChangeConfiguration(event => {
        if (event.affectsConfiguration('rung.monitor.valuesInText')) void this.refresh();
      }),
      vscode.languages.registerCodeLensProvider(kSelector, this),
    );
  }

  dispose(): void {
    clearTimeout(this.timer);
    for (const one of this.disposables) one.dispose();
  }

  async provideCodeLenses(document: vscode.TextDocument): Promise<vscode.CodeLens[]> {
    if (!isWanted()) return [];
    return (await this.bodiesIn(document)).flatMap(({ body, first }) => {
      const instance = this.monitor.instanceOf(body);
      if (instance === undefined || body.name !== body.block || first >= document.lineCount) return [];
      const count = body.instances.length;
      const title = count === 1 ? `$(pulse) ${instance}` : `$(pulse) ${instance} (one of ${count})`;
      return [new vscode.CodeLens(document.lineAt(first).range, { title, command: 'rung.chooseInstance', arguments: [body.block] })];
    });
  }

  // Lets the user choose which instance of a block is shown.
  async chooseInstance(block: string): Promise<void> {
    const instances = this.bodies.find(body => body.block === block)?.instances ?? [];
    const chosen = await vscode.window.showQuickPick(instances, { placeHolder: `The instance of ${block} that is shown` });
    if (chosen !== undefined) this.monitor.choose(block, chosen);
  }

  // ---- what the program has

  private async programChanged(): Promise<void> {
    this.known.clear();
    this.documents.clear();
    this.values = {};
    this.bodies = this.monitor.isConnected ? await this.monitor.bodies().catch(() => []) : [];
    this.lensesChanged.fire();
    await this.refresh();
  }

  private linesOf(body: Body): Promise<{ file: string; lines: Line[] } | undefined> {
    const known = this.known.get(body.name) ?? this.monitor.lines(body.name).catch(() => undefined);
    this.known.set(body.name, known);
    return known;
  }

  // The bodies of a document: of those whose POU it names, the ones that say that they are in this file.
  private async bodiesIn(document: vscode.TextDocument): Promise<ShownBody[]> {
    const key = document.uri.toString();
    const found = this.documents.get(key);
    if (found !== undefined) return found;
    if (this.bodies.length === 0 || document.uri.scheme !== 'file' || !kLanguages.test(document.languageId)) return [];
    const words = new Set(document.getText().toLowerCase().match(/[\p{L}_][\p{L}\p{N}_]*/gu));
    const shown: ShownBody[] = [];
    for (const body of this.bodies) {
      if (!words.has(body.name.split('.')[0]!.toLowerCase())) continue;
      const text = await this.linesOf(body);
      if (text === undefined || text.lines.length === 0 || !this.isFile(document.uri.fsPath, text.file)) continue;
      const lines = text.lines.map(line => ({ ...line, line: line.line - 1, paths: line.paths.filter(one => !kHidden.test(one)) }));
      shown.push({ body, first: lines[0]!.line, lines });
    }
    this.documents.set(key, shown);
    this.lensesChanged.fire(); // the editor may have given up before the lines were there
    return shown;
  }

  // A program that runs elsewhere names files as it was given them.
  private isFile(file: string, named: string): boolean {
    if (this.monitor.folder !== undefined) return path.resolve(this.monitor.folder, named) === file;
    return file === named || file.endsWith(path.sep + path.normalize(named).replace(/^(?:\.\.?[\\/])+/, ''));
  }

  // Lines after an edit move with their text.
  private edited(event: vscode.TextDocumentChangeEvent): void {
    for (const shown of this.documents.get(event.document.uri.toString()) ?? []) {
      for (const { range, text } of event.contentChanges) {
        const moved = text.split('\n').length - 1 - (range.end.line - range.start.line);
        const at = (line: number) => (line > range.end.line || (line === range.end.line && range.end.character === 0) ? line + moved : line);
        shown.first = at(shown.first);
        for (const line of shown.lines) line.line = at(line.line);
      }
    }
    this.refreshSoon();
  }

  // ---- what is shown

  private refreshSoon(): void {
    clearTimeout(this.timer);
    if (this.monitor.isConnected) this.timer = setTimeout(() => void this.refresh(), kDelay);
  }

  private async refresh(): Promise<void> {
    const paths = new Set<string>();
    for (const editor of vscode.window.visibleTextEditors) {
      if (isWanted()) await this.bodiesIn(editor.document);
      for (const { path: one } of this.visible(editor)) paths.add(one);
    }
    await this.monitor.watch(this, [...paths]);
    this.paint();
  }

  // What the visible lines name, where the text is still that of the program.
  private visible(editor: vscode.TextEditor): { line: number; name: string; path: string }[] {
    const { document, visibleRanges } = editor;
    const isVisible = (line: number) => visibleRanges.some(range => line >= range.start.line && line <= range.end.line);
    const found: { line: number; name: string; path: string }[] = [];
    if (!isWanted()) return found;
    for (const { body, lines } of this.documents.get(document.uri.toString()) ?? []) {
      const instance = this.monitor.instanceOf(body);
      for (const { line, text, paths } of lines) {
        if (!isVisible(line) || line >= document.lineCount || !isText(document, line, text)) continue;
        for (const one of paths) {
          const isInside = one.startsWith('.');
          if (!isInside || instance !== undefined) found.push({ line, name: isInside ? one.slice(1) : one, path: isInside ? instance + one : one });
        }
      }
    }
    return found;
  }

  private paint(): void {
    for (const editor of vscode.window.visibleTextEditors) this.paintIn(editor);
  }

  private paintIn(editor: vscode.TextEditor): void {
    const byLine = new Map<number, Set<string>>(); // a method is a body of its own, in that of its block
    for (const { line, name, path: one } of this.visible(editor)) {
      const value = this.values[one];
      if (value === undefined) continue;
      byLine.set(line, (byLine.get(line) ?? new Set()).add(`${name} = ${shortened(value ?? 'null')}`));
    }
    const texts = [...byLine].map(([line, parts]) => [line, [...parts].join(', ').replace(/ /g, kNoBreak)] as const);
    const key = JSON.stringify(texts);
    if ((this.painted.get(editor) ?? '[]') === key) return;
    this.painted.set(editor, key);
    editor.setDecorations(
      this.decoration,
      texts.map(([line, text]) => ({
        range: editor.document.lineAt(line).range,
        renderOptions: { after: { contentText: `${kNoBreak}${text}${kNoBreak}` } },
      })),
    );
  }
}

// In XML there may be tags around the text.
function isText(document: vscode.TextDocument, line: number, text: string): boolean {
  const written = document.lineAt(line).text;
  return document.languageId === 'xml' ? unescape(written).includes(text.trim()) : written.trim() === text.trim();
}

const isWanted = () => vscode.workspace.getConfiguration('rung').get<boolean>('monitor.valuesInText', true);

const shortened = (text: string) => (text.length > kMostShown ? `${text.slice(0, kMostShown)}…` : text);
