// SPDX-License-Identifier: Apache-2.0
// The extension: starts the language server and connects the commands of package.json to the parts that carry them out.
import * as vscode from 'vscode';
import { Location, Position } from 'vscode-languageclient/node';
import { askUrl, debugCommands, registerDebugger } from './debug';
import { Drawing } from './drawing';
import { LiveText } from './liveText';
import { Monitor } from './monitor';
import { chooseProject } from './projects';
import { Server } from './server';
import { projectTask, taskProvider } from './tasks';
import { Tests } from './tests';

function isTrusted(): boolean {
  if (vscode.workspace.isTrusted) return true;
  void vscode.window.showErrorMessage('Rung: programs run in trusted folders only.');
  return false;
}

async function runProject(): Promise<void> {
  const project = isTrusted() ? await chooseProject() : undefined;
  const task = project === undefined ? undefined : projectTask(project, 'run');
  if (task === undefined) return;
  await vscode.workspace.saveAll(false);
  await vscode.tasks.executeTask(task);
}

async function runMonitored(monitor: Monitor, drawing: Drawing): Promise<void> {
  const project = isTrusted() ? await chooseProject() : undefined;
  if (project === undefined) return;
  await vscode.workspace.saveAll(false);
  await drawing.showIfDrawn();
  await monitor.start(project);
}

async function connectMonitor(monitor: Monitor, drawing: Drawing): Promise<void> {
  const url = await askUrl();
  if (url === undefined) return;
  try {
    await monitor.connect(url.trim());
    await drawing.showIfDrawn();
  } catch (error) {
    void vscode.window.showErrorMessage(`Rung: no monitor answers there: ${String(error)}`);
  }
}

async function openMonitorPage(monitor: Monitor): Promise<void> {
  if (monitor.page !== undefined) await vscode.env.openExternal(vscode.Uri.parse(monitor.page));
}

async function choose(commands: [string, string][]): Promise<void> {
  const items = commands.map(([command, label]) => ({ label, command }));
  const chosen = await vscode.window.showQuickPick(items, { placeHolder: 'Rung' });
  if (chosen !== undefined) await vscode.commands.executeCommand(chosen.command);
}

function showMenu(): Promise<void> {
  return choose([
    ['rung.restartServer', '$(refresh) Restart the language server'],
    ['rung.showLog', '$(output) Show the log'],
    ['rung.showDiagram', '$(open-preview) Open the drawing'],
    ['rung.test', '$(beaker) Test the project'],
    ['rung.run', '$(play) Run the project'],
    ['rung.monitor', '$(pulse) Run the project and show it live'],
  ]);
}

function showMonitorMenu(monitor: Monitor): Promise<void> {
  return choose([
    ['rung.openMonitorPage', '$(globe) Open the monitor in a browser'],
    ['rung.showDiagram', '$(open-preview) Open the drawing'],
    monitor.isOwn ? ['rung.stopMonitor', '$(stop) End the program'] : ['rung.disconnectMonitor', '$(debug-disconnect) Disconnect'],
  ]);
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const server = new Server();
  const tests = new Tests();
  const monitor = new Monitor();
  const live = new LiveText(monitor);
  const drawing = new Drawing(vscode.Uri.joinPath(context.extensionUri, 'media'), server, monitor);
  const commands: Record<string, (...parameters: never[]) => unknown> = {
    'rung.run': runProject,
    'rung.test': () => tests.runAll(),
    'rung.runTest': (uri: string, name: string) => tests.runNamed(vscode.Uri.parse(uri), name),
    'rung.monitor': () => runMonitored(monitor, drawing),
    'rung.connectMonitor': () => connectMonitor(monitor, drawing),
    'rung.stopMonitor': () => monitor.stop(),
    'rung.disconnectMonitor': () => monitor.stop(),
    'rung.monitorMenu': () => showMonitorMenu(monitor),
    'rung.chooseInstance': (block: string) => live.chooseInstance(block),
    'rung.openMonitorPage': () => openMonitorPage(monitor),
    'rung.showDiagram': () => drawing.show(),
    'rung.showReferences': (uri: string, position: Position, locations: Location[]) =>
      server.showReferences(uri, position, locations),
    'rung.restartServer': () => server.restart(),
    'rung.showLog': () => server.showLog(),
    'rung.menu': showMenu,
    'rung.debugTest': (uri: string, name: string) => tests.debugNamed(vscode.Uri.parse(uri), name),
    ...debugCommands,
  };
  for (const [name, act] of Object.entries(commands))
    context.subscriptions.push(vscode.commands.registerCommand(name, act));
  context.subscriptions.push(
    server,
    tests,
    monitor,
    live,
    drawing,
    registerDebugger(),
    vscode.tasks.registerTaskProvider('rung', taskProvider),
    vscode.workspace.onDidChangeConfiguration(event => {
      const names = ['rung.path', 'rung.arguments', 'rung.server.log'];
      if (names.some(name => event.affectsConfiguration(name))) void server.restart().then(() => tests.refresh());
    }),
  );
  await server.start();
  await tests.refresh();
}

export function deactivate(): void {}
