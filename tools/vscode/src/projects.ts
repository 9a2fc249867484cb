// SPDX-License-Identifier: Apache-2.0
// The projects below the opened folders, by the rule of docs/editor.md: a folder with a rung.project, one .plcproj, or
// beremiz.xml or plc.xml; an opened folder without any is a project with all its folders.
import * as path from 'node:path';
import * as vscode from 'vscode';

export interface Project {
  folder: string;
  name: string; // for people: its path below the opened folder
  inputs: string[]; // of a command that runs in the folder: none where a project file names the sources
}

const kProjectFiles = '**/{rung.project,*.plcproj,beremiz.xml,plc.xml}';
const kMost = 200;

export async function findProjects(): Promise<Project[]> {
  const projects: Project[] = [];
  for (const opened of vscode.workspace.workspaceFolders ?? []) {
    if (opened.uri.scheme !== 'file') continue;
    const files = await vscode.workspace.findFiles(
      new vscode.RelativePattern(opened, kProjectFiles),
      '**/{node_modules,build,.git}/**',
      kMost,
    );
    const folders = [...new Set(files.map(file => path.dirname(file.fsPath)))].sort();
    for (const folder of folders) {
      const below = path.relative(opened.uri.fsPath, folder);
      projects.push({ folder, name: below === '' ? opened.name : `${opened.name}/${below}`, inputs: [] });
    }
    if (folders.length === 0) projects.push({ folder: opened.uri.fsPath, name: opened.name, inputs: ['.'] });
  }
  return projects;
}

// The project of a file: the one whose folder is nearest above it.
export function projectOf(projects: Project[], file: string): Project | undefined {
  const holds = (project: Project) => file.startsWith(project.folder + path.sep);
  return projects.filter(holds).sort((a, b) => b.folder.length - a.folder.length)[0];
}

// The project of the active editor, or the only one, or the one that the user chooses.
export async function chooseProject(): Promise<Project | undefined> {
  const projects = await findProjects();
  const file = vscode.window.activeTextEditor?.document.uri;
  const around = file?.scheme === 'file' ? projectOf(projects, file.fsPath) : undefined;
  if (around !== undefined || projects.length <= 1) {
    if (around === undefined && projects.length === 0) void vscode.window.showErrorMessage('Rung: open a folder first.');
    return around ?? projects[0];
  }
  const items = projects.map(project => ({ label: project.name, description: project.folder, project }));
  return (await vscode.window.showQuickPick(items, { placeHolder: 'Which project?' }))?.project;
}
