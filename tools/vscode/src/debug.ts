// SPDX-License-Identifier: Apache-2.0
// The debugger: starts `rung dap`, fills in what a configuration leaves out, and the requests of Rung's own. A program is
// the project of the active editor, a test is one of the Test Explorer. Values of the stopped frame end the lines.
import * as path from 'node:path';
import * as vscode from 'vscode';
import { chooseProject, findProjects, Project } from './projects';
import { commonArguments, program } from './rung';

const kType = 'rung';
const kSelector = ['iecst', 'nct', 'xml'].map(language => ({ scheme: 'file', language }));

// ---- configurations

function launchOf(project: Project): vscode.DebugConfiguration {
  return { type: kType, request: 'launch', name: `Debug ${project.name}`, program: project.folder };
}

const provider: vscode.DebugConfigurationProvider = {
  async provideDebugConfigurations() {
    return (await findProjects()).map(launchOf);
  },

  // F5 without a launch.json gives an empty configuration.
  async resolveDebugConfiguration(_folder, configuration) {
    if (configuration.type) return configuration;
    const project = await chooseProject();
    return project === undefined ? undefined : launchOf(project);
  },

  async resolveDebugConfigurationWithSubstitutedVariables(folder, configuration) {
    if (configuration.request === 'attach') {
      configuration.url ??= await askUrl();
      return configuration.url === undefined ? undefined : configuration;
    }
    const wanted: unknown = configuration.program;
    if (typeof wanted !== 'string' || wanted === '') {
      const project = await chooseProject();
      if (project === undefined) return undefined;
      configuration.program = project.folder;
    } else if (folder !== undefined) {
      configuration.program = path.resolve(folder.uri.fsPath, wanted);
    }
    configuration.args = [...commonArguments(), ...((configuration.args as string[] | undefined) ?? [])];
    return configuration;
  },
};

export function askUrl(): Thenable<string | undefined> {
  return vscode.window.showInputBox({
    prompt: 'The URL that the program printed at its start',
    placeHolder: 'http://127.0.0.1:8080/?token=…',
    ignoreFocusOut: true,
  });
}

const factory: vscode.DebugAdapterDescriptorFactory = {
  createDebugAdapterDescriptor(session) {
    const cwd = session.workspaceFolder?.uri.fsPath ?? path.dirname(String(session.configuration.program ?? '/'));
    return new vscode.DebugAdapterExecutable(program(), ['dap'], { cwd });
  },
};

// ---- commands

export async function debugProject(): Promise<void> {
  const project = await chooseProject();
  if (project === undefined) return;
  await vscode.workspace.saveAll(false);
  await vscode.debug.startDebugging(vscode.workspace.getWorkspaceFolder(vscode.Uri.file(project.folder)), launchOf(project));
}

// Runs one test to its end; what it returned, or undefined when the session ended before.
export async function debugTest(project: Project, name: string, testRun?: vscode.TestRun): Promise<number | undefined> {
  const configuration = { ...launchOf(project), name: `Debug ${name}`, test: name };
  let code: number | undefined;
  let session: vscode.DebugSession | undefined;
  const tracker = vscode.debug.registerDebugAdapterTrackerFactory(kType, {
    createDebugAdapterTracker(created) {
      if (created.configuration.test !== name) return undefined;
      session ??= created;
      return {
        onDidSendMessage(message: { type: string; event?: string; body?: { exitCode?: number; output?: string } }) {
          if (message.type !== 'event') return;
          if (message.event === 'exited') code = message.body?.exitCode;
          if (message.event === 'output') testRun?.appendOutput((message.body?.output ?? '').replace(/\r?\n/g, '\r\n'));
        },
      };
    },
  });
  try {
    const ended = new Promise<void>(resolve => {
      const listener = vscode.debug.onDidTerminateDebugSession(one => {
        if (one.id !== session?.id) return;
        listener.dispose();
        resolve();
      });
    });
    const folder = vscode.workspace.getWorkspaceFolder(vscode.Uri.file(project.folder));
    const options = testRun === undefined ? {} : { testRun };
    if (await vscode.debug.startDebugging(folder, configuration, options)) await ended;
    return code;
  } finally {
    tracker.dispose();
  }
}

async function ask(request: string, parameters: object): Promise<void> {
  const session = vscode.debug.activeDebugSession;
  if (session?.type !== kType) return;
  try {
    await session.customRequest(request, parameters);
  } catch (error) {
    void vscode.window.showErrorMessage(`Rung: ${error instanceof Error ? error.message : String(error)}`);
  }
}

const activeThread = () => vscode.debug.activeStackItem?.threadId ?? 1;

async function goToCycle(): Promise<void> {
  const text = await vscode.window.showInputBox({
    prompt: 'The cycle, from 0, at whose end the program is shown',
    validateInput: typed => (/^\d+$/.test(typed) ? undefined : 'A number of a cycle'),
  });
  if (text !== undefined) await ask('rung/gotoCycle', { cycle: Number(text) });
}

// To where a variable of the view got its value.
async function goToLastWrite(chosen: { container?: { variablesReference?: number }; variable?: { name?: string } }): Promise<void> {
  const session = vscode.debug.activeDebugSession;
  if (session === undefined) return;
  const { variablesReference } = chosen.container ?? {};
  const info = (await session.customRequest('dataBreakpointInfo', { variablesReference, name: chosen.variable?.name })) as { dataId: string | null };
  if (info.dataId === null) return void vscode.window.showInformationMessage('Rung: nothing writes this.');
  await ask('rung/lastWrite', { dataId: info.dataId });
}

export const debugCommands: Record<string, (...parameters: never[]) => unknown> = {
  'rung.debug': debugProject,
  'rung.stepCycle': () => ask('rung/stepCycle', { threadId: activeThread() }),
  'rung.stepActivation': () => ask('rung/stepActivation', { threadId: activeThread() }),
  'rung.gotoCycle': goToCycle,
  'rung.lastWrite': goToLastWrite,
};

// ---- where the program is stopped

export interface Stop {
  uri: vscode.Uri;
  line: number;
  column: number;
}

interface StackFrame {
  id: number;
  line: number;
  column: number;
  source?: { path?: string };
}

// The editor makes a URI of a path that the adapter names, one of its own where it runs elsewhere.
const uriOf = (name: string) => vscode.Uri.file(/^[a-z][\w+.-]+:\/\//i.test(name) ? vscode.Uri.parse(name).path : name);

// The place of the frame that the user looks at; undefined: no program is stopped.
export async function currentStop(): Promise<Stop | undefined> {
  const item = vscode.debug.activeStackItem;
  if (item === undefined || item.session.type !== kType) return undefined;
  try {
    const { stackFrames } = (await item.session.customRequest('stackTrace', { threadId: item.threadId })) as { stackFrames: StackFrame[] };
    const frame = item instanceof vscode.DebugStackFrame ? stackFrames.find(one => one.id === item.frameId) : stackFrames[0];
    if (frame?.source?.path === undefined) return undefined;
    return { uri: uriOf(frame.source.path), line: frame.line - 1, column: Math.max(frame.column - 1, 0) };
  } catch {
    return undefined; // it runs
  }
}

// ---- values in the text

const kName = '[\\p{L}_][\\p{L}\\p{N}_]*';
const kPath = new RegExp(`${kName}(?:\\^|\\[[^\\]\\n;]*\\]|\\.${kName})*`, 'gu');
const kVariables = new Set(['variable', 'parameter', 'property']);

interface Token {
  line: number;
  start: number;
  end: number;
}

// What the language server calls a variable.
async function variablesIn(document: vscode.TextDocument): Promise<Token[]> {
  const legend = await vscode.commands.executeCommand<vscode.SemanticTokensLegend>('vscode.provideDocumentSemanticTokensLegend', document.uri);
  const tokens = await vscode.commands.executeCommand<vscode.SemanticTokens>('vscode.provideDocumentSemanticTokens', document.uri);
  const found: Token[] = [];
  let line = 0;
  let start = 0;
  for (let i = 0; i + 4 < (tokens?.data.length ?? 0); i += 5) {
    const [lines, columns, length, type] = [...tokens.data.slice(i, i + 4)] as [number, number, number, number];
    line += lines;
    start = lines === 0 ? start + columns : columns;
    if (kVariables.has(legend.tokenTypes[type]!)) found.push({ line, start, end: start + length });
  }
  return found;
}

// The lines of the innermost declaration around a line.
async function declarationAround(document: vscode.TextDocument, line: number): Promise<vscode.Range | undefined> {
  let symbols = await vscode.commands.executeCommand<vscode.DocumentSymbol[]>('vscode.executeDocumentSymbolProvider', document.uri);
  let found: vscode.Range | undefined;
  const kinds = new Set([vscode.SymbolKind.Module, vscode.SymbolKind.Namespace, vscode.SymbolKind.Class, vscode.SymbolKind.Function, vscode.SymbolKind.Method, vscode.SymbolKind.Property]);
  for (;;) {
    const around = symbols?.find(one => kinds.has(one.kind) && one.range.start.line <= line && one.range.end.line >= line);
    if (around === undefined) return found;
    found = around.range;
    symbols = around.children;
  }
}

class InlineValues implements vscode.InlineValuesProvider {
  async provideInlineValues(document: vscode.TextDocument, viewPort: vscode.Range, context: vscode.InlineValueContext): Promise<vscode.InlineValue[]> {
    const stopped = context.stoppedLocation.start.line;
    const around = await declarationAround(document, stopped);
    const first = Math.max(viewPort.start.line, around?.start.line ?? stopped);
    const last = Math.min(viewPort.end.line, stopped);
    const values: vscode.InlineValue[] = [];
    const seen = new Set<string>();
    for (const token of await variablesIn(document)) {
      if (token.line < first || token.line > last) continue;
      const text = document.lineAt(token.line).text;
      for (const one of text.slice(token.start).matchAll(kPath)) {
        const isHead = one.index === 0 && text[token.start - 1] !== '.';
        const key = `${token.line}:${one[0].toLowerCase()}`;
        if (isHead && !/^\s*\(/.test(text.slice(token.start + one[0].length)) && !seen.has(key)) {
          const range = new vscode.Range(token.line, token.start, token.line, token.start + one[0].length);
          values.push(new vscode.InlineValueEvaluatableExpression(range, one[0]));
          seen.add(key);
        }
        break;
      }
    }
    return values;
  }
}

// A hover evaluates the path up to the name under the mouse.
const evaluatable: vscode.EvaluatableExpressionProvider = {
  provideEvaluatableExpression(document, position) {
    for (const one of document.lineAt(position.line).text.matchAll(kPath)) {
      const end = one.index + one[0].length;
      if (position.character < one.index || position.character >= end) continue;
      const rest = one[0].slice(position.character - one.index);
      const upTo = position.character + (/^[\p{L}\p{N}_]*/u.exec(rest)?.[0].length ?? 0);
      const range = new vscode.Range(position.line, one.index, position.line, upTo);
      return new vscode.EvaluatableExpression(range, document.getText(range));
    }
    return undefined;
  },
};

export function registerDebugger(): vscode.Disposable {
  return vscode.Disposable.from(
    vscode.debug.registerDebugConfigurationProvider(kType, provider),
    vscode.debug.registerDebugConfigurationProvider(kType, { provideDebugConfigurations: provider.provideDebugConfigurations! }, vscode.DebugConfigurationProviderTriggerKind.Dynamic),
    vscode.debug.registerDebugAdapterDescriptorFactory(kType, factory),
    vscode.languages.registerInlineValuesProvider(kSelector, new InlineValues()),
    vscode.languages.registerEvaluatableExpressionProvider(kSelector, evaluatable),
  );
}
