// SPDX-License-Identifier: Apache-2.0
// The commands of Rung as tasks, for each project, with the matchers that find their messages.
import * as path from 'node:path';
import * as vscode from 'vscode';
import { findProjects, Project } from './projects';
import { commonArguments, program } from './rung';

const kCommands = ['check', 'test', 'run', 'build'];

function taskOf(definition: vscode.TaskDefinition, scope: vscode.WorkspaceFolder, folder: string, name: string, inputs: string[]): vscode.Task {
  const command = String(definition.command);
  const given = (definition.args as string[] | undefined) ?? [];
  const args = [command, ...commonArguments(), ...inputs, ...given];
  if (command === 'build' && !given.includes('-o')) args.push('-o', path.basename(folder));
  const execution = new vscode.ProcessExecution(program(), args, { cwd: folder });
  const task = new vscode.Task(definition, scope, name, 'rung', execution, ['$rung', '$rung-test']);
  task.presentationOptions = { clear: true };
  if (command === 'check' || command === 'build') task.group = vscode.TaskGroup.Build;
  if (command === 'test') task.group = vscode.TaskGroup.Test;
  return task;
}

const scopeOf = (project: Project) => vscode.workspace.getWorkspaceFolder(vscode.Uri.file(project.folder));

export function projectTask(project: Project, command: string): vscode.Task | undefined {
  const scope = scopeOf(project);
  if (scope === undefined) return undefined;
  const below = path.relative(scope.uri.fsPath, project.folder);
  const definition = { type: 'rung', command, ...(below === '' ? {} : { folder: below }) };
  return taskOf(definition, scope, project.folder, below === '' ? command : `${command} ${below}`, project.inputs);
}

export const taskProvider: vscode.TaskProvider = {
  async provideTasks() {
    const tasks = (await findProjects()).flatMap(project => kCommands.map(command => projectTask(project, command)));
    return tasks.filter(task => task !== undefined);
  },
  async resolveTask(task) {
    const { definition, scope } = task;
    if (typeof scope !== 'object' || !kCommands.includes(String(definition.command))) return undefined;
    const folder = path.join(scope.uri.fsPath, String(definition.folder ?? '.'));
    const project = (await findProjects()).find(one => path.relative(one.folder, folder) === '');
    return taskOf(definition, scope, folder, task.name, project?.inputs ?? ['.']);
  },
};
