// SPDX-License-Identifier: Apache-2.0
// The language server `rung lsp`, its item in the status bar, and the commands of its code lenses.
import * as vscode from 'vscode';
import {
  Executable,
  LanguageClient,
  LanguageClientOptions,
  Location,
  Position,
  RevealOutputChannelOn,
  State,
  StaticFeature,
} from 'vscode-languageclient/node';
import { commonArguments, program, run } from './rung';

// Commands that the server may name in code lenses, see docs/editor.md.
const kLensCommands = ['rung.debugTest', 'rung.runTest', 'rung.showReferences'];

const kXmlFiles = '**/*.{TcPOU,TcDUT,TcGVL,TcIO,TcTTO,TcTLEO,plcproj,xml,XML,cfc}';
const kSelector = [
  ...['iecst', 'nct', 'nct-messages', 'rung-cam', 'rung-project'].map(language => ({ scheme: 'file', language })),
  { scheme: 'file', language: 'xml', pattern: kXmlFiles },
];

// XML of programs; any other is none of the server's business.
const kProgramXml = /<TcPlcObject|plcopen\.org|TC65SC65BWG7TF10|<(?:pou|PyFile|CFile|BaseParams)\b|developer\/msbuild|<project\b/i;
const isForServer = (document: vscode.TextDocument) =>
  document.languageId !== 'xml' || !/\.xml$/i.test(document.fileName) || kProgramXml.test(document.getText().slice(0, 4000));

class LensCommands implements StaticFeature {
  fillClientCapabilities(capabilities: { experimental?: object }): void {
    capabilities.experimental = { ...capabilities.experimental, commands: { commands: kLensCommands } };
  }
  initialize(): void {}
  getState(): { kind: 'static' } {
    return { kind: 'static' };
  }
  clear(): void {}
}

export class Server implements vscode.Disposable {
  private client: LanguageClient | undefined;
  private readonly status = vscode.window.createStatusBarItem('rung.status', vscode.StatusBarAlignment.Left, 0);
  private readonly output = vscode.window.createOutputChannel('Rung', { log: true });
  private version = '';

  constructor() {
    this.status.name = 'Rung';
    this.status.command = 'rung.menu';
  }

  async start(): Promise<void> {
    this.show('$(sync~spin) Rung', 'The language server starts.');
    const version = await run(['version'], '/');
    if (version.code !== 0) return this.notFound(version.stderr);
    this.version = version.stdout.split('\n')[0] ?? '';
    const log = vscode.workspace.getConfiguration('rung').get<string>('server.log', '');
    const args = ['lsp', ...(log === '' ? [] : ['--log', log]), ...commonArguments()];
    const server: Executable = { command: program(), args };
    this.client = new LanguageClient('rung', 'Rung', server, this.options());
    this.client.registerFeature(new LensCommands());
    this.client.onDidChangeState(event => this.stateChanged(event.newState));
    try {
      await this.client.start();
    } catch (error) {
      this.show('$(error) Rung', `The language server does not start: ${String(error)}`, true);
    }
  }

  async restart(): Promise<void> {
    const client = this.client;
    this.client = undefined;
    await client?.dispose().catch(() => undefined);
    await this.start();
  }

  // A request of Rung's own; undefined: no server, or it does not know this one.
  async ask<Answer>(method: string, params: object, token?: vscode.CancellationToken): Promise<Answer | null | undefined> {
    if (this.client === undefined || this.client.state !== State.Running) return undefined;
    if (token === undefined) return this.client.sendRequest<Answer | null>(method, params);
    return this.client.sendRequest<Answer | null>(method, params, token);
  }

  showLog(): void {
    this.output.show(true);
  }

  // Locations arrive as the protocol has them.
  async showReferences(uri: string, position: Position, locations: Location[]): Promise<void> {
    const convert = this.client?.protocol2CodeConverter;
    if (convert === undefined) return;
    await vscode.commands.executeCommand(
      'editor.action.showReferences',
      convert.asUri(uri),
      convert.asPosition(position),
      locations.map(location => convert.asLocation(location)),
    );
  }

  dispose(): void {
    void this.client?.dispose().catch(() => undefined);
    this.status.dispose();
    this.output.dispose();
  }

  private options(): LanguageClientOptions {
    return {
      documentSelector: kSelector,
      outputChannel: this.output,
      revealOutputChannelOn: RevealOutputChannelOn.Never,
      middleware: {
        didOpen: (document, next) => (isForServer(document) ? next(document) : Promise.resolve()),
        didChange: (event, next) => (isForServer(event.document) ? next(event) : Promise.resolve()),
        didClose: (document, next) => (isForServer(document) ? next(document) : Promise.resolve()),
      },
    };
  }

  private stateChanged(state: State): void {
    if (state === State.Running) this.show('$(check) Rung', `${this.version}: the language server runs.`);
    if (state === State.Stopped && this.client !== undefined)
      this.show('$(warning) Rung', 'The language server does not run.', true);
  }

  private show(text: string, tooltip: string, isWarning = false): void {
    this.status.text = text;
    this.status.tooltip = tooltip;
    this.status.backgroundColor = isWarning ? new vscode.ThemeColor('statusBarItem.warningBackground') : undefined;
    this.status.show();
  }

  private notFound(why: string): void {
    this.show('$(error) Rung', `\`${program()}\` could not be started: ${why}`, true);
    this.output.error(`${program()} version: ${why}`);
    const change = 'Set the Path';
    void vscode.window
      .showErrorMessage(`Rung: \`${program()}\` could not be started. Install Rung, or set \`rung.path\`.`, change)
      .then(chosen => {
        if (chosen === change) void vscode.commands.executeCommand('workbench.action.openSettings', 'rung.path');
      });
  }
}
