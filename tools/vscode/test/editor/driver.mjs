// SPDX-License-Identifier: Apache-2.0
// The editor of the tests: code-server in headless Chromium, what a user does in it with keys, and what is seen. A step
// prints a line, and leaves a picture in the work folder when it fails.
import { chromium } from 'playwright-core';
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';

export const [codeServer, vsix, rung, work, pictures] = process.argv.slice(2);
export const kMs = Number(process.env.RUNG_EDITOR_MS ?? 60000); // for each thing that must appear
const kSources = new URL('project', import.meta.url).pathname;
export let project; // the folder that is open
export let page;
export let failed = 0;

// ---- the editor

function freePort() {
  return new Promise(resolve => {
    const probe = net.createServer().listen(0, '127.0.0.1', () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });
}

// With the project in a folder of this name; `files` are written beside it. Answers what ends the editor.
export async function startEditor(name, { isTrusted = true, files = {} } = {}) {
  project = path.join(work, name);
  fs.cpSync(kSources, project, { recursive: true });
  for (const [file, text] of Object.entries(files)) {
    fs.mkdirSync(path.dirname(path.join(project, file)), { recursive: true });
    fs.writeFileSync(path.join(project, file), text, { mode: 0o755 });
  }
  const settings = {
    'rung.path': rung,
    'workbench.startupEditor': 'none',
    'workbench.secondarySideBar.defaultVisibility': 'hidden',
    'workbench.colorTheme': process.env.RUNG_EDITOR_THEME ?? 'Default Light Modern',
    'editor.minimap.enabled': false,
    'editor.wordBasedSuggestions': 'off',
    'files.autoSave': 'off',
    'chat.disableAIFeatures': true,
    'git.enabled': false,
    'security.workspace.trust.startupPrompt': 'never',
  };
  const user = path.join(work, `user-of-${name}`);
  for (const place of ['User', 'Machine']) {
    fs.mkdirSync(path.join(user, place), { recursive: true });
    fs.writeFileSync(path.join(user, place, 'settings.json'), JSON.stringify(settings));
  }
  const folders = ['--user-data-dir', user, '--extensions-dir', `${work}/extensions`, '--config', `${work}/config.yaml`];
  execFileSync(process.execPath, [codeServer, ...folders, '--install-extension', vsix], { stdio: 'pipe' });
  const port = await freePort();
  const options = ['--auth', 'none', '--bind-addr', `127.0.0.1:${port}`, '--disable-telemetry', '--disable-update-check', ...(isTrusted ? ['--disable-workspace-trust'] : [])];
  const log = fs.openSync(path.join(work, `server-of-${name}.log`), 'w');
  const server = spawn(process.execPath, [codeServer, ...folders, ...options, project], { stdio: ['ignore', log, log] });
  const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu'] });
  page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const until = Date.now() + kMs;
  for (;;) {
    try {
      await page.goto(`http://127.0.0.1:${port}/?folder=${encodeURIComponent(project)}`);
      break;
    } catch (error) {
      if (Date.now() > until) throw error;
      await page.waitForTimeout(200);
    }
  }
  await page.waitForSelector('.monaco-workbench', { timeout: kMs });
  await page.locator('.explorer-folders-view .monaco-list-row', { hasText: 'pump.st' }).waitFor({ timeout: kMs });
  return async () => {
    await browser.close();
    server.kill();
  };
}

// The list closes when something else takes the focus in this moment: it is opened again.
export async function command(title) {
  const row = page.locator(`.quick-input-list .monaco-list-row[aria-label^="${title}"]`).first();
  await until(`${title} in the list of commands`, async () => {
    await page.keyboard.press('F1');
    await page.waitForSelector('.quick-input-widget:visible input', { timeout: kMs });
    await page.keyboard.type(title);
    if (await row.click({ timeout: kMs / 10 }).then(() => true, () => false)) return true;
    await page.keyboard.press('Escape');
    return false;
  });
}

// Types into the box with this prompt.
export async function answer(prompt, text) {
  await page.locator('.quick-input-widget:visible', { hasText: prompt }).first().waitFor({ timeout: kMs });
  await page.keyboard.type(text);
  await page.keyboard.press('Enter');
}

// A file that was made a moment ago is not in the list at once: the list is opened again.
export async function open(file, line, column) {
  const row = page.locator('.quick-input-list .monaco-list-row.focused', { hasText: file }).first();
  await until(`${file} in the list of files`, async () => {
    await page.keyboard.press('Control+p');
    await page.waitForSelector('.quick-input-widget:visible input', { timeout: kMs });
    await page.keyboard.type(file);
    if (await row.waitFor({ timeout: kMs / 10 }).then(() => true, () => false)) return true;
    await page.keyboard.press('Escape');
    return false;
  });
  await page.keyboard.press('Enter');
  await page.locator('.tab.active', { hasText: file }).waitFor({ timeout: kMs });
  if (line !== undefined) await goTo(line, column);
}

export async function goTo(line, column = 1) {
  await page.keyboard.press('Control+g');
  await page.waitForSelector('.quick-input-widget:visible input', { timeout: kMs });
  await page.keyboard.type(`${line}:${column}`);
  await page.locator('.quick-input-list .monaco-list-row', { hasText: `to go to line ${line} at column ${column}` }).first().waitFor({ timeout: kMs });
  await page.keyboard.press('Enter');
  await cursorAt(line, column);
}

export const cursorAt = (line, column) =>
  page.locator('.statusbar-item', { hasText: `Ln ${line}, Col ${column}` }).first().waitFor({ timeout: kMs });

export async function until(what, test, ms = kMs) {
  const end = Date.now() + ms;
  for (;;) {
    if (await test()) return;
    if (Date.now() > end) throw new Error(`not seen: ${what}`);
    await page.waitForTimeout(100);
  }
}

export const onDisk = file => fs.readFileSync(path.join(project, file), 'utf8');
// The number of the first line of a file with this text.
export const lineOf = (file, text) => onDisk(file).split('\n').findIndex(line => line.includes(text)) + 1;

export const errorCount = () => page.locator('.squiggly-error').count();

// What is shown after the text of each line, by the text of the line.
export const afterLines = () =>
  page.evaluate(() => {
    const content = span => getComputedStyle(span, '::after').content.replace(/^(?:none|normal)$/, '');
    const blank = text => text.replace(/\u00a0/g, ' ').replace(/^"|"$/g, '').trim();
    return [...document.querySelectorAll('.view-lines .view-line')].map(line => [
      blank(line.textContent),
      blank([...line.querySelectorAll('span span')].map(content).join('')),
    ]);
  });

export const valuesAfter = async text => (await afterLines()).find(([line]) => line === text)?.[1] ?? '';

export async function drawingFrame() {
  let found;
  await until('the drawing', async () => {
    for (const frame of page.frames())
      if ((await frame.locator('#drawing').count().catch(() => 0)) > 0) found = frame;
    return found !== undefined;
  });
  return found;
}

// What a function of the page sees in the picture, which has a document of its own.
export const inDrawing = async (frame, read) => frame.locator('#drawing').evaluate(read).catch(() => undefined);

// Those of the README in the folder that was given, all others in the work folder.
const kOfReadme = ['drawing.png', 'error.png', 'live.png', 'tests.png', 'values.png'];

export async function picture(name, clip) {
  if (pictures === undefined) return;
  const folder = kOfReadme.includes(name) ? pictures : work;
  fs.mkdirSync(folder, { recursive: true });
  if (!name.endsWith('error.png')) await page.mouse.move(640, 785); // away from what shows a tooltip
  await page.waitForTimeout(500);
  await page.screenshot({ path: path.join(folder, name), ...(clip === undefined ? {} : { clip }) });
}

// RUNG_EDITOR_STEPS: a pattern of the steps that are taken.
const kSteps = new RegExp(process.env.RUNG_EDITOR_STEPS ?? '');

export async function step(name, act) {
  if (!kSteps.test(name)) return;
  const begin = Date.now();
  try {
    const text = await act();
    console.log(`ok    ${name}${text === undefined ? '' : `: ${text}`}`);
  } catch (error) {
    failed += 1;
    console.log(`FAIL  ${name}: ${error.message} (${Date.now() - begin} ms)`);
    await page.screenshot({ path: path.join(work, `failed-${failed}.png`) });
    await page.keyboard.press('Escape');
  }
}
