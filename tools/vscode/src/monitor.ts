// SPDX-License-Identifier: Apache-2.0
// The monitor of a running program over HTTP (docs/monitor.md): the run that this extension starts, or the one whose
// URL the user gives. Out: bodies as pictures or lines, and values as they arrive.
import * as child_process from 'node:child_process';
import * as vscode from 'vscode';
import { Project } from './projects';
import { commonArguments, program } from './rung';

export interface Body {
  name: string;
  block: string;
  language: string;
  instances: string[];
}

// A line of a body in text, and what it names; a path that begins with a point is below the instance.
export interface Line {
  line: number;
  text: string;
  paths: string[];
}

export type Values = Record<string, string | null>;

interface Info {
  state: string;
  cycle: number;
  changes: number;
  rolled_back: boolean;
}

const kFirstSeconds = 30; // until the program has said where its monitor is
const kGraceMs = 2000; // after `quit`
const kInfoMs = 500; // between two questions whether it runs and which version

// A terminal that shows a process; Ctrl-C ends it.
class RunTerminal implements vscode.Pseudoterminal {
  private readonly write = new vscode.EventEmitter<string>();
  private readonly closed = new vscode.EventEmitter<number>();
  readonly onDidWrite = this.write.event;
  readonly onDidClose = this.closed.event;
  private waiting: string | undefined = ''; // what is written before it is open would be lost
  constructor(private readonly onEnd: () => void) {}
  open(): void {
    const text = this.waiting ?? '';
    this.waiting = undefined;
    this.write.fire(text);
  }
  close(): void {
    this.onEnd();
  }
  handleInput(keys: string): void {
    if (keys.includes('\x03')) this.onEnd();
  }
  show(text: string): void {
    const shown = text.replace(/\r?\n/g, '\r\n');
    if (this.waiting === undefined) this.write.fire(shown);
    else this.waiting += shown;
  }
}

export class Monitor implements vscode.Disposable {
  private url: URL | undefined;
  private child: child_process.ChildProcess | undefined;
  private stream: AbortController | undefined;
  private timer: NodeJS.Timeout | undefined;
  private info: Info | undefined;
  private readonly wanted = new Map<object, string[]>(); // paths, by who wants them
  private readonly chosen = new Map<string, string>(); // the instance of a block that is shown
  private readonly status = vscode.window.createStatusBarItem('rung.monitor', vscode.StatusBarAlignment.Left, 0);
  private readonly changed = new vscode.EventEmitter<void>();
  private readonly valuesArrived = new vscode.EventEmitter<Values>();
  private readonly instanceChosen = new vscode.EventEmitter<void>();
  // A program, or another version of it, begins or ends to be watched.
  readonly onDidChange = this.changed.event;
  readonly onValues = this.valuesArrived.event;
  readonly onDidChoose = this.instanceChosen.event;
  // Where the files are that the program names; undefined: on another machine perhaps.
  folder: string | undefined;

  constructor() {
    this.status.name = 'Rung: running program';
    this.status.command = 'rung.monitorMenu';
  }

  get isConnected(): boolean {
    return this.url !== undefined;
  }
  get isOwn(): boolean {
    return this.child !== undefined;
  }
  get page(): string | undefined {
    return this.url?.href;
  }

  // Starts `rung run --monitor 0` in a terminal; it takes over what is saved.
  async start(project: Project): Promise<void> {
    await this.stop();
    const args = ['run', ...commonArguments(), ...project.inputs, '--monitor', '0', '--watch-files', '--color=always'];
    const child = child_process.spawn(program(), args, { cwd: project.folder, stdio: ['ignore', 'pipe', 'pipe'] });
    this.child = child;
    const pty = new RunTerminal(() => child.kill('SIGINT'));
    vscode.window.createTerminal({ name: `rung run ${project.name}`, pty }).show(true);
    pty.show(`$ ${program()} ${args.join(' ')}\n`);
    const url = await new Promise<string | undefined>(resolve => {
      const timer = setTimeout(() => resolve(undefined), kFirstSeconds * 1000);
      let said = '';
      const read = (text: string) => {
        pty.show(text);
        said = (said + text).slice(-4000);
        const found = /^monitor: (http:\S+)/m.exec(said);
        if (found !== null) resolve(found[1]);
      };
      child.stdout!.setEncoding('utf8').on('data', (text: string) => pty.show(text));
      child.stderr!.setEncoding('utf8').on('data', read);
      child.on('error', error => pty.show(error.message));
      child.on('close', code => {
        clearTimeout(timer);
        pty.show(`\nended with exit code ${code ?? 'none'}\n`);
        resolve(undefined);
        if (this.child === child) this.end();
      });
    });
    if (url === undefined) {
      if (this.child === child) await this.stop();
      void vscode.window.showErrorMessage('Rung: the program did not start; its terminal says why.');
      return;
    }
    await this.connect(url, project.folder);
  }

  // Throws where there is no monitor. What was watched before is left.
  async connect(text: string, folder?: string): Promise<void> {
    const url = new URL(text);
    if (folder === undefined) await this.stop();
    this.url = url;
    this.folder = folder;
    try {
      this.info = await this.readInfo();
    } catch (error) {
      this.url = undefined;
      throw error;
    }
    this.showStatus();
    this.timer = setInterval(() => void this.poll(url), kInfoMs);
    await vscode.commands.executeCommand('setContext', 'rung.monitored', this.isOwn ? 'own' : 'other');
    this.changed.fire();
  }

  async stop(): Promise<void> {
    const child = this.child;
    if (child !== undefined && this.url !== undefined) {
      await this.ask('/api/command', { command: 'quit' }).catch(() => undefined);
      setTimeout(() => child.exitCode === null && child.kill('SIGKILL'), kGraceMs).unref();
    } else {
      child?.kill('SIGINT');
    }
    this.end();
  }

  bodies(): Promise<Body[]> {
    return this.ask('/api/pous').then(answer => JSON.parse(answer) as Body[]);
  }

  picture(body: string): Promise<string> {
    return this.ask(`/api/diagram?pou=${encodeURIComponent(body)}`);
  }

  // The lines of a body in text; of one that is drawn none.
  async lines(body: string): Promise<{ file: string; lines: Line[] } | undefined> {
    const answer = await this.picture(body);
    return answer.startsWith('{') ? (JSON.parse(answer) as { file: string; lines: Line[] }) : undefined;
  }

  // The instance of a body's block that is shown.
  instanceOf(body: Body): string | undefined {
    const chosen = this.chosen.get(body.block);
    return chosen !== undefined && body.instances.includes(chosen) ? chosen : body.instances[0];
  }

  choose(block: string, instance: string): void {
    if (this.chosen.get(block) === instance) return;
    this.chosen.set(block, instance);
    this.instanceChosen.fire();
  }

  // Values of these variables from now on, until its owner wants others.
  async watch(owner: object, paths: string[]): Promise<void> {
    const before = this.allWanted();
    if (paths.length === 0) this.wanted.delete(owner);
    else this.wanted.set(owner, paths);
    const all = this.allWanted();
    if (this.stream !== undefined && all.length === before.length && all.every((path, i) => path === before[i])) return;
    await this.follow(all);
  }

  private allWanted(): string[] {
    return [...new Set([...this.wanted.values()].flat())].sort();
  }

  private async follow(paths: string[]): Promise<void> {
    this.stream?.abort();
    this.stream = undefined;
    if (paths.length === 0 || this.url === undefined) return;
    const stream = new AbortController();
    this.stream = stream;
    const { id } = JSON.parse(await this.ask('/api/watch', { paths, skip_unknown: true })) as { id: number };
    const rate = vscode.workspace.getConfiguration('rung').get<number>('monitor.rate', 10);
    void this.read(`/api/stream?watch=${id}&rate=${rate}`, stream);
  }

  dispose(): void {
    this.child?.kill('SIGINT');
    this.end();
    this.status.dispose();
  }

  private readInfo(): Promise<Info> {
    return this.ask('/api/info').then(answer => JSON.parse(answer) as Info);
  }

  // The program may have ended, or another version have taken over.
  private async poll(url: URL): Promise<void> {
    const before = this.info;
    const info = await this.readInfo().catch(() => undefined);
    if (this.url !== url) return;
    if (info === undefined) return this.end();
    this.info = info;
    this.showStatus();
    if (before?.changes === info.changes && before.rolled_back === info.rolled_back) return;
    await this.follow(this.allWanted());
    this.changed.fire();
  }

  private showStatus(): void {
    if (this.info === undefined) return this.status.hide();
    const { state, cycle } = this.info;
    this.status.text = `$(pulse) ${state}, cycle ${cycle}`;
    this.status.tooltip = `Rung: the program at ${this.url?.origin ?? ''}`;
    this.status.backgroundColor = state === 'faulted' ? new vscode.ThemeColor('statusBarItem.errorBackground') : undefined;
    this.status.show();
  }

  // Reads Server-Sent Events; the program has ended when they do.
  private async read(path: string, stream: AbortController): Promise<void> {
    try {
      const answer = await this.request(path, undefined, stream.signal);
      const decoder = new TextDecoder();
      let text = '';
      for await (const chunk of answer.body! as unknown as AsyncIterable<Uint8Array>) {
        text += decoder.decode(chunk, { stream: true });
        const events = text.split('\n\n');
        text = events.pop() ?? '';
        for (const event of events)
          if (event.startsWith('data: '))
            this.valuesArrived.fire((JSON.parse(event.slice(6)) as { values: Values }).values);
      }
    } catch {
      // aborted, or the connection is gone
    }
    if (this.stream === stream && !stream.signal.aborted) this.end();
  }

  private async request(path: string, body?: object, signal?: AbortSignal): Promise<Response> {
    if (this.url === undefined) throw new Error('no program is watched');
    const token = this.url.searchParams.get('token') ?? '';
    const answer = await fetch(new URL(path, this.url), {
      method: body === undefined ? 'GET' : 'POST',
      headers: { Authorization: `Bearer ${token}`, 'Content-Type': 'application/json' },
      ...(body === undefined ? {} : { body: JSON.stringify(body) }),
      ...(signal === undefined ? {} : { signal }),
    });
    if (!answer.ok) throw new Error(await answer.text());
    return answer;
  }

  private ask(path: string, body?: object): Promise<string> {
    return this.request(path, body).then(answer => answer.text());
  }

  private end(): void {
    clearInterval(this.timer);
    this.stream?.abort();
    this.stream = undefined;
    this.child = undefined;
    this.info = undefined;
    this.showStatus();
    if (this.url === undefined) return;
    this.url = undefined;
    void vscode.commands.executeCommand('setContext', 'rung.monitored', false);
    this.changed.fire();
  }
}
