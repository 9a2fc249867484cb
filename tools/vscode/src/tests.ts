// SPDX-License-Identifier: Apache-2.0
// The Test Explorer: what `rung test --list --format=json` prints for each project, and runs of it with and without
// coverage. A list is made when the extension starts, when a source is saved, and on request.
import * as fs from 'node:fs/promises';
import * as os from 'node:os';
import * as path from 'node:path';
import * as vscode from 'vscode';
import { debugTest } from './debug';
import { findProjects, Project } from './projects';
import { readFailures, readJunit, readLcov, TestResult } from './reports';
import { commonArguments, Outcome, run } from './rung';

// A row of `rung test --list --format=json`.
interface Listed {
  name: string;
  pou: string;
  file: string;
  line: number;
  column: number;
  skip?: string;
}

interface Leaf {
  project: Project;
  name: string;
}

const kSources = /\.(?:st|iecst|il|pou|decl|impl|exp|xml|cfc|nct|cam|TcPOU|TcDUT|TcGVL|plcproj|project)$/i;
const kDelay = 400; // ms after a save

class LineCoverage extends vscode.FileCoverage {
  constructor(uri: vscode.Uri, readonly lines: [number, number][]) {
    const covered = lines.filter(([, count]) => count > 0).length;
    super(uri, new vscode.TestCoverageCount(covered, lines.length));
  }
  details(): vscode.StatementCoverage[] {
    return this.lines.map(([line, count]) => new vscode.StatementCoverage(count, new vscode.Position(line - 1, 0)));
  }
}

export class Tests implements vscode.Disposable {
  private readonly controller = vscode.tests.createTestController('rung', 'Rung');
  private readonly leaves = new WeakMap<vscode.TestItem, Leaf>();
  private readonly disposables: vscode.Disposable[] = [this.controller];
  private timer: NodeJS.Timeout | undefined;

  constructor() {
    const { Run, Debug, Coverage } = vscode.TestRunProfileKind;
    this.controller.createRunProfile('Run', Run, (request, token) => this.runTests(request, token, false), true);
    this.controller.createRunProfile('Debug', Debug, (request, token) => this.debugTests(request, token), true);
    const coverage = this.controller.createRunProfile('Run with Coverage', Coverage, (request, token) =>
      this.runTests(request, token, true),
    );
    coverage.loadDetailedCoverage = async (_run, file) => (file instanceof LineCoverage ? file.details() : []);
    this.controller.refreshHandler = () => this.refresh();
    this.disposables.push(
      vscode.workspace.onDidSaveTextDocument(document => this.refreshSoon(document.fileName)),
      vscode.workspace.onDidChangeWorkspaceFolders(() => this.refreshSoon('.st')),
      vscode.workspace.onDidDeleteFiles(event => event.files.forEach(file => this.refreshSoon(file.fsPath))),
    );
  }

  dispose(): void {
    clearTimeout(this.timer);
    for (const one of this.disposables) one.dispose();
  }

  async refresh(): Promise<void> {
    const projects = await findProjects();
    const roots: vscode.TestItem[] = [];
    for (const project of projects) {
      const items = await this.itemsOf(project);
      if (items === undefined) {
        roots.push(...this.oldItemsOf(project)); // it cannot be read at the moment
      } else if (projects.length === 1) {
        roots.push(...items);
      } else if (items.length > 0) {
        const root = this.controller.createTestItem(project.folder, project.name, vscode.Uri.file(project.folder));
        root.children.replace(items);
        roots.push(root);
      }
    }
    this.controller.items.replace(roots);
  }

  // Runs one test, named as its POU: all its cases.
  async runNamed(uri: vscode.Uri, name: string): Promise<void> {
    const request = await this.requestOf(uri, name);
    if (request !== undefined) await this.runTests(request, new vscode.CancellationTokenSource().token, false);
  }

  async debugNamed(uri: vscode.Uri, name: string): Promise<void> {
    const request = await this.requestOf(uri, name);
    if (request !== undefined) await this.debugTests(request, new vscode.CancellationTokenSource().token);
  }

  private async requestOf(uri: vscode.Uri, name: string): Promise<vscode.TestRunRequest | undefined> {
    await this.refresh();
    const found: vscode.TestItem[] = [];
    const file = uri.fsPath;
    this.forEachItem(this.controller.items, item => {
      const isIt = item.label === name || item.id.endsWith(`\n${name}`) || item.id.endsWith(`.${name}`);
      if (item.uri?.fsPath === file && isIt && item.parent !== undefined) found.push(item);
    });
    if (found.length > 0) return new vscode.TestRunRequest(found.slice(0, 1));
    void vscode.window.showWarningMessage(`Rung: no test \`${name}\` was found.`);
    return undefined;
  }

  async runAll(): Promise<void> {
    await this.refresh();
    await vscode.commands.executeCommand('workbench.view.testing.focus');
    await this.runTests(new vscode.TestRunRequest(), new vscode.CancellationTokenSource().token, false);
  }

  // ---- the tree: files, tests, cases

  private async itemsOf(project: Project): Promise<vscode.TestItem[] | undefined> {
    const args = ['test', ...commonArguments(), ...project.inputs, '--list', '--format=json'];
    const { stdout } = await run(args, project.folder);
    let listed: Listed[];
    try {
      listed = JSON.parse(stdout) as Listed[];
    } catch {
      return undefined;
    }
    const files = new Map<string, vscode.TestItem>();
    for (const test of listed) {
      const uri = vscode.Uri.file(path.resolve(project.folder, test.file));
      let file = files.get(test.file);
      if (file === undefined) {
        file = this.controller.createTestItem(`${project.folder}\n${test.file}`, test.file, uri);
        files.set(test.file, file);
      }
      this.addTest(project, file, uri, test);
    }
    return [...files.values()];
  }

  private addTest(project: Project, file: vscode.TestItem, uri: vscode.Uri, test: Listed): void {
    let parent = file;
    const pouId = `${file.id}\n${test.pou}`;
    if (test.name !== test.pou) {
      parent = file.children.get(pouId) ?? this.controller.createTestItem(pouId, test.pou, uri);
      file.children.add(parent);
    }
    const label = test.name.startsWith(`${test.pou}(`) ? test.name.slice(test.pou.length) : test.name;
    const item = this.controller.createTestItem(`${file.id}\n${test.name}`, label, uri);
    item.range = new vscode.Range(test.line - 1, test.column - 1, test.line - 1, test.column - 1);
    if (parent !== file) parent.range ??= item.range;
    if (test.skip !== undefined) item.description = `skipped: ${test.skip}`;
    this.leaves.set(item, { project, name: test.name });
    parent.children.add(item);
  }

  private oldItemsOf(project: Project): vscode.TestItem[] {
    const items: vscode.TestItem[] = [];
    this.controller.items.forEach(item => {
      if (item.id === project.folder || item.id.startsWith(`${project.folder}\n`)) items.push(item);
    });
    return items;
  }

  private forEachItem(items: vscode.TestItemCollection, visit: (item: vscode.TestItem) => void): void {
    items.forEach(item => {
      visit(item);
      this.forEachItem(item.children, visit);
    });
  }

  private refreshSoon(file: string): void {
    if (!kSources.test(file)) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.refresh(), kDelay);
  }

  // ---- runs

  private async runTests(request: vscode.TestRunRequest, token: vscode.CancellationToken, counts: boolean): Promise<void> {
    if (!vscode.workspace.isTrusted) return void vscode.window.showErrorMessage('Rung: tests run in trusted folders only.');
    await vscode.workspace.saveAll(false);
    const all = this.chosenLeaves(undefined);
    const chosen = this.chosenLeaves(request);
    const testRun = this.controller.createTestRun(request);
    for (const items of byProject(chosen, this.leaves).values()) {
      const project = this.leaves.get(items[0]!)!.project;
      const isWhole = items.length === (byProject(all, this.leaves).get(project.folder)?.length ?? 0);
      for (const item of items) testRun.started(item);
      if (!token.isCancellationRequested) await this.runProject(project, items, isWhole, counts, testRun, token);
    }
    testRun.end();
  }

  // One after the other, each in a session of its own.
  private async debugTests(request: vscode.TestRunRequest, token: vscode.CancellationToken): Promise<void> {
    await vscode.workspace.saveAll(false);
    const testRun = this.controller.createTestRun(request);
    for (const item of this.chosenLeaves(request)) {
      if (token.isCancellationRequested) break;
      const { project, name } = this.leaves.get(item)!;
      testRun.started(item);
      const begin = Date.now();
      const code = await debugTest(project, name, testRun);
      if (code === 0) testRun.passed(item, Date.now() - begin);
      else if (code === undefined) testRun.skipped(item);
      else testRun.failed(item, new vscode.TestMessage('The test failed; the output has the reason.'), Date.now() - begin);
    }
    testRun.end();
  }

  // The tests of a request, without those that it excludes; of none: all.
  private chosenLeaves(request: vscode.TestRunRequest | undefined): vscode.TestItem[] {
    const leaves = new Set<vscode.TestItem>();
    const excluded = new Set(request?.exclude);
    const add = (item: vscode.TestItem) => {
      if (excluded.has(item)) return;
      if (this.leaves.has(item)) leaves.add(item);
      item.children.forEach(add);
    };
    if (request?.include === undefined) this.controller.items.forEach(add);
    else request.include.forEach(add);
    return [...leaves];
  }

  private async runProject(
    project: Project,
    items: vscode.TestItem[],
    isWhole: boolean,
    counts: boolean,
    testRun: vscode.TestRun,
    token: vscode.CancellationToken,
  ): Promise<void> {
    const folder = await fs.mkdtemp(path.join(os.tmpdir(), 'rung-'));
    const junit = path.join(folder, 'tests.xml');
    const lcov = path.join(folder, 'coverage.info');
    const filters = isWhole ? [] : items.flatMap(item => ['--filter', this.leaves.get(item)!.name]);
    const args = ['test', ...commonArguments(), ...project.inputs, ...filters, '--junit', junit, '--color=never'];
    if (counts) args.push('--lcov', lcov);
    try {
      const outcome = await run(args, project.folder, token);
      const text = outcome.stdout + outcome.stderr;
      testRun.appendOutput(text.replace(/\r?\n/g, '\r\n'));
      if (token.isCancellationRequested) return items.forEach(item => testRun.skipped(item));
      this.report(project, items, readJunit(await fs.readFile(junit, 'utf8').catch(() => '')), outcome, testRun);
      if (counts) this.addCoverage(project, await fs.readFile(lcov, 'utf8').catch(() => ''), testRun);
    } finally {
      await fs.rm(folder, { recursive: true, force: true });
    }
  }

  private report(project: Project, items: vscode.TestItem[], results: TestResult[], outcome: Outcome, testRun: vscode.TestRun): void {
    const byName = new Map(results.map(result => [result.name, result]));
    for (const item of items) {
      const result = byName.get(this.leaves.get(item)!.name);
      if (result === undefined) {
        testRun.errored(item, new vscode.TestMessage(outcome.stderr || outcome.stdout || 'The test did not run.'));
      } else if (result.kind === 'passed') {
        testRun.passed(item, result.milliseconds);
      } else if (result.kind === 'skipped') {
        testRun.skipped(item);
      } else if (result.kind === 'failed') {
        testRun.failed(item, messagesOf(project, result), result.milliseconds);
      } else {
        testRun.errored(item, messagesOf(project, result), result.milliseconds);
      }
    }
  }

  private addCoverage(project: Project, lcov: string, testRun: vscode.TestRun): void {
    for (const [file, lines] of readLcov(lcov))
      testRun.addCoverage(new LineCoverage(vscode.Uri.file(path.resolve(project.folder, file)), lines));
  }
}

function messagesOf(project: Project, result: TestResult): vscode.TestMessage[] {
  const failures = readFailures(result.text);
  if (failures.length === 0) return [new vscode.TestMessage(result.text)];
  return failures.map(failure => {
    const { expected, actual } = failure;
    const message =
      expected === undefined || actual === undefined
        ? new vscode.TestMessage(failure.message)
        : vscode.TestMessage.diff(failure.message, expected, actual);
    const uri = vscode.Uri.file(path.resolve(project.folder, failure.file));
    message.location = new vscode.Location(uri, new vscode.Position(failure.line - 1, Math.max(failure.column - 1, 0)));
    return message;
  });
}

function byProject(items: vscode.TestItem[], leaves: WeakMap<vscode.TestItem, Leaf>): Map<string, vscode.TestItem[]> {
  const groups = new Map<string, vscode.TestItem[]>();
  for (const item of items) {
    const { folder } = leaves.get(item)!.project;
    groups.set(folder, [...(groups.get(folder) ?? []), item]);
  }
  return groups;
}
