// SPDX-License-Identifier: Apache-2.0
// The drawing beside the text: the body at the cursor as `rung/diagram` draws it, its element marked; a click on an
// element goes to its text. While a program is watched that has this body, its picture of it with live values.
import * as crypto from 'node:crypto';
import * as vscode from 'vscode';
import { currentStop, Stop } from './debug';
import { Body, Monitor } from './monitor';
import { Server } from './server';

interface Answer {
  title: string;
  svg: string;
  pou: string;
  elements: { id: string; range: { start: Place; end: Place } }[];
  cursor?: string;
}
interface Place {
  line: number;
  character: number;
}

// The element at the cursor, else the one that begins in its line.
function cursorOf(answer: Answer, position: Place): string {
  return answer.cursor ?? answer.elements.find(element => element.range.start.line === position.line)?.id ?? '';
}

const requestAt = (uri: vscode.Uri, position: Place) => ({ textDocument: { uri: uri.toString() }, position });

function requestOf({ document, selection }: vscode.TextEditor): { textDocument: { uri: string }; position: Place } {
  return requestAt(document.uri, { line: selection.active.line, character: selection.active.character });
}

const kCursorMs = 30; // after the last move
const kDrawn = /^(?:iecst|nct|xml)$/;

export class Drawing implements vscode.Disposable {
  private panel: vscode.WebviewPanel | undefined;
  private isReady = false;
  private shown: Answer | undefined;
  private cursor = ''; // the id of the element at the cursor
  private document: vscode.Uri | undefined;
  private request: vscode.CancellationTokenSource | undefined;
  private timer: NodeJS.Timeout | undefined;
  private live: Body | undefined; // the body whose values are shown
  private bodies: Body[] = []; // of the watched program
  private stop: Stop | undefined; // where the debugger is
  private readonly openedFor = new Set<string>(); // debug sessions
  private readonly disposables: vscode.Disposable[] = [];

  constructor(
    private readonly media: vscode.Uri,
    private readonly server: Server,
    private readonly monitor: Monitor,
  ) {
    this.disposables.push(
      vscode.window.onDidChangeTextEditorSelection(event => this.moved(event.textEditor)),
      vscode.window.onDidChangeActiveTextEditor(editor => editor !== undefined && this.moved(editor)),
      vscode.debug.onDidChangeActiveStackItem(() => void this.stopChanged()),
      vscode.debug.onDidTerminateDebugSession(session => this.openedFor.delete(session.id)),
      vscode.workspace.onDidChangeTextDocument(event => this.edited(event.document)),
      monitor.onDidChange(() => void this.readBodies()),
      monitor.onDidChoose(() => this.postInstance()),
      monitor.onValues(values => this.post({ type: 'values', values })),
    );
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.panel?.dispose();
    for (const one of this.disposables) one.dispose();
  }

  show(): void {
    const editor = vscode.window.activeTextEditor;
    if (this.panel === undefined) this.createPanel();
    else this.panel.reveal(undefined, true);
    if (editor !== undefined) void this.draw(editor);
  }

  // Shows it where the body at the cursor is drawn.
  async showIfDrawn(): Promise<void> {
    const editor = vscode.window.activeTextEditor;
    if (this.panel !== undefined || editor === undefined) return;
    const answer = await this.server.ask<Answer>('rung/diagram', requestOf(editor)).catch(() => null);
    if (answer) this.show();
  }

  private createPanel(): void {
    const panel = vscode.window.createWebviewPanel(
      'rung.drawing',
      'Drawing',
      { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
      { enableScripts: true, localResourceRoots: [this.media], retainContextWhenHidden: true },
    );
    this.panel = panel;
    this.isReady = false;
    panel.webview.html = this.html(panel.webview);
    panel.webview.onDidReceiveMessage(message => void this.receive(message));
    panel.onDidDispose(() => {
      this.panel = undefined;
      this.shown = undefined;
      void this.monitor.watch(this, []);
    });
  }

  // Nothing is loaded but the two scripts and the style of the extension.
  private html(webview: vscode.Webview): string {
    const nonce = crypto.randomBytes(16).toString('hex');
    const file = (name: string) => webview.asWebviewUri(vscode.Uri.joinPath(this.media, name)).toString();
    return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src ${webview.cspSource}; script-src 'nonce-${nonce}'">
<link rel="stylesheet" href="${file('drawing.css')}">
<title>Drawing</title>
</head>
<body>
<header id="head" hidden><span id="state"></span><label id="instances" hidden>Instance <select id="instance"></select></label></header>
<main id="drawing" tabindex="0" aria-label="Drawing"></main>
<p id="notice">Place the cursor in a body that is drawn: LD, FBD, CFC, SFC or the ladder of NCT.</p>
<script nonce="${nonce}" src="${file('picture.js')}"></script>
<script nonce="${nonce}" src="${file('drawing.js')}"></script>
</body>
</html>`;
  }

  // ---- from the editor

  private moved(editor: vscode.TextEditor): void {
    const follows = vscode.workspace.getConfiguration('rung').get<boolean>('drawing.followCursor', true);
    if (this.panel !== undefined && follows) this.drawSoon(editor);
  }

  private edited(document: vscode.TextDocument): void {
    const editor = vscode.window.activeTextEditor;
    if (this.panel !== undefined && editor?.document === document) this.drawSoon(editor);
  }

  private drawSoon(editor: vscode.TextEditor): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.draw(editor), kCursorMs);
  }

  private draw(editor: vscode.TextEditor): Promise<void> {
    const { line, character } = editor.selection.active;
    return this.drawAt(editor.document, { line, character });
  }

  private async drawAt(document: vscode.TextDocument, position: Place): Promise<void> {
    if (document.uri.scheme !== 'file' || !kDrawn.test(document.languageId)) return;
    this.request?.cancel();
    const request = new vscode.CancellationTokenSource();
    this.request = request;
    const params = requestAt(document.uri, position);
    let answer: Answer | null | undefined;
    try {
      answer = await this.server.ask<Answer>('rung/diagram', params, request.token);
    } catch (error) {
      if (!request.token.isCancellationRequested) this.post({ type: 'notice', text: `No drawing: ${String(error)}` });
      return;
    }
    if (request.token.isCancellationRequested || this.panel === undefined) return;
    if (answer === undefined) return this.post({ type: 'notice', text: 'The language server does not run.' });
    if (answer === null) return; // the last drawing stays
    this.document = document.uri;
    const isSame = this.shown?.svg === answer.svg;
    const isOther = this.shown?.pou !== answer.pou;
    this.shown = answer;
    this.panel.title = answer.title;
    if (!isSame) this.postDrawing();
    this.cursor = cursorOf(answer, params.position);
    this.post({ type: 'cursor', id: this.cursor });
    await this.postStop();
    if (isOther) await this.showLive();
  }

  private postDrawing(): void {
    if (this.shown === undefined || this.live !== undefined) return;
    this.post({ type: 'drawing', svg: this.shown.svg, elements: this.shown.elements.map(element => element.id) });
  }

  // ---- from the debugger

  // Opened once in a session, at the first stop in a body that is drawn.
  private async stopChanged(): Promise<void> {
    const session = vscode.debug.activeDebugSession?.id ?? '';
    this.stop = await currentStop();
    const stop = this.stop;
    if (stop === undefined) return this.postStop();
    const document = await vscode.workspace.openTextDocument(stop.uri); // the server answers for documents that are open
    const position = { line: stop.line, character: stop.column };
    const answer = await this.server.ask<Answer>('rung/diagram', requestAt(stop.uri, position)).catch(() => null);
    if (!answer || this.stop !== stop) return this.postStop();
    if (this.panel === undefined && !this.openedFor.has(session)) {
      this.openedFor.add(session);
      this.createPanel();
    }
    if (this.panel !== undefined) await this.drawAt(document, position);
  }

  // The element where the program is stopped, in the drawing that is shown.
  private async postStop(): Promise<void> {
    const stop = this.stop;
    let id = '';
    if (stop !== undefined && this.document?.toString() === stop.uri.toString() && this.shown !== undefined) {
      const position = { line: stop.line, character: stop.column };
      const answer = await this.server.ask<Answer>('rung/diagram', requestAt(stop.uri, position)).catch(() => null);
      if (answer && answer.pou === this.shown.pou) id = cursorOf(answer, position);
    }
    if (this.stop === stop) this.post({ type: 'stop', id });
  }

  // ---- from the watched program

  private async readBodies(): Promise<void> {
    this.bodies = this.monitor.isConnected ? await this.monitor.bodies().catch(() => []) : [];
    await this.showLive();
  }

  // The body of the drawing, if the watched program has it.
  private async showLive(): Promise<void> {
    const pou = this.shown?.pou;
    const body = this.panel === undefined ? undefined : this.bodies.find(one => one.name.toLowerCase() === pou?.toLowerCase());
    const picture = body === undefined ? '' : await this.monitor.picture(body.name).catch(() => '');
    const wasLive = this.live !== undefined;
    this.live = picture.startsWith('<') ? body : undefined;
    if (this.live !== undefined) {
      const elements = this.shown?.elements.map(element => element.id) ?? [];
      this.post({ type: 'live', svg: picture, elements, instances: this.live.instances, instance: this.monitor.instanceOf(this.live) });
      this.post({ type: 'cursor', id: this.cursor });
      await this.postStop();
    } else if (wasLive) {
      await this.monitor.watch(this, []);
      this.postDrawing();
    }
  }

  private postInstance(): void {
    if (this.live !== undefined) this.post({ type: 'instance', instance: this.monitor.instanceOf(this.live) });
  }

  // ---- to and from the page of the panel

  private post(message: object): void {
    if (this.isReady) void this.panel?.webview.postMessage(message);
  }

  private async receive(message: { type: string; id?: string; paths?: string[]; instance?: string }): Promise<void> {
    if (message.type === 'ready') {
      this.isReady = true;
      this.postDrawing();
      this.post({ type: 'cursor', id: this.cursor });
      await this.postStop();
      await this.readBodies();
    }
    if (message.type === 'watch') await this.monitor.watch(this, message.paths ?? []);
    if (message.type === 'choose' && this.live !== undefined) this.monitor.choose(this.live.block, message.instance ?? '');
    if (message.type === 'reveal') await this.reveal(message.id ?? '');
  }

  private async reveal(id: string): Promise<void> {
    const element = this.shown?.elements.find(one => one.id === id);
    if (element === undefined || this.document === undefined) return;
    const { start, end } = element.range;
    const range = new vscode.Range(start.line, start.character, end.line, end.character);
    const column = vscode.window.visibleTextEditors.find(one => one.document.uri.toString() === this.document?.toString())?.viewColumn;
    const editor = await vscode.window.showTextDocument(this.document, { selection: new vscode.Range(range.start, range.start), ...(column === undefined ? {} : { viewColumn: column }) });
    editor.revealRange(range, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
  }
}
