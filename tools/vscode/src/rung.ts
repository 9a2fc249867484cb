// SPDX-License-Identifier: Apache-2.0
// The program `rung` as the settings name it, and its runs. Used by all that starts it.
import * as child_process from 'node:child_process';
import * as path from 'node:path';
import * as vscode from 'vscode';

export interface Outcome {
  code: number | null; // null: could not be started, or was ended
  stdout: string;
  stderr: string;
}

const settings = () => vscode.workspace.getConfiguration('rung');

// The program; a path that begins with a dot is below the first folder.
export function program(): string {
  const configured = settings().get<string>('path', 'rung') || 'rung';
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  return configured.startsWith('.') && folder !== undefined ? path.join(folder, configured) : configured;
}

// The options that hold for every command.
export const commonArguments = (): string[] => settings().get<string[]>('arguments', []);

// Runs a command in a folder to its end, or until it is cancelled.
export function run(args: string[], cwd: string, token?: vscode.CancellationToken): Promise<Outcome> {
  return new Promise(resolve => {
    const child = child_process.spawn(program(), args, { cwd, stdio: ['ignore', 'pipe', 'pipe'] });
    let stdout = '';
    let stderr = '';
    child.stdout.setEncoding('utf8').on('data', (text: string) => (stdout += text));
    child.stderr.setEncoding('utf8').on('data', (text: string) => (stderr += text));
    const cancelled = token?.onCancellationRequested(() => child.kill());
    const end = (code: number | null) => {
      cancelled?.dispose();
      resolve({ code, stdout, stderr });
    };
    child.on('error', error => {
      stderr += error.message;
      end(null);
    });
    child.on('close', end);
  });
}
