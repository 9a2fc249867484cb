// SPDX-License-Identifier: Apache-2.0
// Uses the extension in a real editor: code-server in headless Chromium, with a project of two files. Each step does what
// a user does, with keys, and looks at what the editor shows or at the files. Prints a line for each; the exit code is 1
// when one fails. Called by editor.sh.
//   node editor.mjs CODE-SERVER VSIX RUNG WORK-FOLDER [PICTURES]
import { chromium } from 'playwright-core';
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';

const [codeServer, vsix, rung, work, pictures] = process.argv.slice(2);
const kMs = Number(process.env.RUNG_EDITOR_MS ?? 60000); // for each thing that must appear
const kSources = new URL('project', import.meta.url).pathname;
const project = path.join(work, 'plant');
let page;
let failed = 0;

// ---- the editor

function freePort() {
  return new Promise(resolve => {
    const probe = net.createServer().listen(0, '127.0.0.1', () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });
}

async function startEditor() {
  fs.cpSync(kSources, project, { recursive: true });
  const settings = {
    'rung.path': rung,
    'workbench.startupEditor': 'none',
    'workbench.secondarySideBar.defaultVisibility': 'hidden',
    'workbench.colorTheme': process.env.RUNG_EDITOR_THEME ?? 'Default Light Modern',
    'editor.minimap.enabled': false,
    'editor.wordBasedSuggestions': 'off',
    'files.autoSave': 'off',
    'chat.disableAIFeatures': true,
  };
  for (const place of ['user/User', 'user/Machine']) {
    fs.mkdirSync(path.join(work, place), { recursive: true });
    fs.writeFileSync(path.join(work, place, 'settings.json'), JSON.stringify(settings));
  }
  const folders = ['--user-data-dir', `${work}/user`, '--extensions-dir', `${work}/extensions`, '--config', `${work}/config.yaml`];
  execFileSync(process.execPath, [codeServer, ...folders, '--install-extension', vsix], { stdio: 'pipe' });
  const port = await freePort();
  const options = ['--auth', 'none', '--bind-addr', `127.0.0.1:${port}`, '--disable-telemetry', '--disable-update-check', '--disable-workspace-trust'];
  const log = fs.openSync(path.join(work, 'server.log'), 'w');
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

async function command(title) {
  await page.keyboard.press('F1');
  await page.waitForSelector('.quick-input-widget:visible input', { timeout: kMs });
  await page.keyboard.type(title);
  const row = page.locator(`.quick-input-list .monaco-list-row[aria-label^="${title}"]`).first();
  await row.waitFor({ timeout: kMs });
  await row.click();
}

// A file that was made a moment ago is not in the list at once: the list is opened again.
async function open(file, line, column) {
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

async function goTo(line, column = 1) {
  await page.keyboard.press('Control+g');
  await page.waitForSelector('.quick-input-widget:visible input', { timeout: kMs });
  await page.keyboard.type(`${line}:${column}`);
  await page.locator('.quick-input-list .monaco-list-row', { hasText: `to go to line ${line} at column ${column}` }).first().waitFor({ timeout: kMs });
  await page.keyboard.press('Enter');
  await cursorAt(line, column);
}

const cursorAt = (line, column) =>
  page.locator('.statusbar-item', { hasText: `Ln ${line}, Col ${column}` }).first().waitFor({ timeout: kMs });

async function until(what, test, ms = kMs) {
  const end = Date.now() + ms;
  for (;;) {
    if (await test()) return;
    if (Date.now() > end) throw new Error(`not seen: ${what}`);
    await page.waitForTimeout(100);
  }
}

const onDisk = file => fs.readFileSync(path.join(project, file), 'utf8');
const errorCount = () => page.locator('.squiggly-error').count();

async function drawingFrame() {
  let found;
  await until('the drawing', async () => {
    for (const frame of page.frames())
      if ((await frame.locator('#drawing').count().catch(() => 0)) > 0) found = frame;
    return found !== undefined;
  });
  return found;
}

// What a function of the page sees in the picture, which has a document of its own.
const inDrawing = async (frame, read) => frame.locator('#drawing').evaluate(read).catch(() => undefined);

async function picture(name, clip) {
  if (pictures === undefined) return;
  fs.mkdirSync(pictures, { recursive: true });
  if (name !== 'error.png') await page.mouse.move(640, 785); // away from what shows a tooltip
  await page.waitForTimeout(500);
  await page.screenshot({ path: path.join(pictures, name), ...(clip === undefined ? {} : { clip }) });
}

async function step(name, act) {
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

// ---- what a user does

async function serverRuns() {
  await open('pump.st');
  await page.locator('.statusbar-item', { hasText: 'Rung' }).locator('.codicon-check').first().waitFor({ timeout: kMs });
}

async function errorAppears() {
  await open('pump.st', 17, 1);
  await page.keyboard.type('level := levle;\n');
  await until('an error underlined', async () => (await errorCount()) > 0);
  await goTo(17, 12);
  await page.keyboard.press('Control+k');
  await page.keyboard.press('Control+i');
  const message = page.locator('.monaco-hover', { hasText: '`levle` is not declared' }).first();
  await message.waitFor({ timeout: kMs });
  await picture('error.png', { x: 0, y: 0, width: 1280, height: 560 });
}

async function fixApplies() {
  await goTo(17, 12);
  await page.keyboard.press('Control+.');
  const fix = page.locator('.action-widget .monaco-list-row', { hasText: /level/ }).first();
  await fix.waitFor({ timeout: 10000 });
  await fix.click();
  await until('no error', async () => (await errorCount()) === 0);
  await page.keyboard.press('Control+s');
  await until('the fix on disk', () => onDisk('pump.st').includes('level := level;'));
}

async function errorGoes() {
  await page.keyboard.press('Escape');
  await goTo(17);
  await page.keyboard.press('Control+Shift+k');
  await until('no error', async () => (await errorCount()) === 0);
}

async function completes() {
  await open('pump.st', 16, 1);
  await page.keyboard.press('End');
  await page.keyboard.type('\npump.ru');
  await page.keyboard.press('Control+Space');
  await page.locator('.suggest-widget .monaco-list-row', { hasText: 'running' }).first().waitFor({ timeout: kMs });
  await page.keyboard.press('Enter');
  await until('the name in the text', async () => (await page.locator('.view-line', { hasText: /^pump\.running/ }).count()) > 0);
  await page.keyboard.press('Escape');
  await page.keyboard.press('Escape');
  await page.keyboard.press('Control+Shift+k');
  await until('no error', async () => (await errorCount()) === 0);
}

async function goesToDefinition() {
  await open('pump_test.st', 3, 13);
  await page.keyboard.press('F12');
  await page.locator('.tab.active', { hasText: 'pump.st' }).waitFor({ timeout: kMs });
  await cursorAt(2, 16);
}

async function renames() {
  await open('pump.st', 4, 3);
  await page.keyboard.press('F2');
  const box = page.locator('.rename-box input');
  await box.waitFor({ timeout: kMs });
  await box.fill('height');
  await box.press('Enter');
  await until('the new name', async () => (await page.locator('.view-lines').first().innerText()).includes('height'));
  await command('File: Save All');
  await until('it in both files', () => onDisk('pump.st').includes('pump(height := level)') && onDisk('pump_test.st').includes('pump(height := 2.0)'));
}

async function formats() {
  await open('pump.st', 9, 1);
  await page.keyboard.press('Control+End');
  await page.keyboard.type('\nPROGRAM ugly\nVAR a:INT;END_VAR\na:=a+1;\nEND_PROGRAM\n');
  await command('Format Document');
  await until('a formatted line on disk', async () => {
    await page.keyboard.press('Control+s');
    await page.waitForTimeout(300);
    return onDisk('pump.st').includes('a := a + 1;');
  });
}

async function outlines() {
  await command('Go to Symbol in Editor');
  await page.locator('.quick-input-list .monaco-list-row', { hasText: 'Pump' }).first().waitFor({ timeout: kMs });
  await page.keyboard.press('Escape');
}

async function runsTests() {
  await command('Rung: Test the Project');
  const row = text => page.locator('.test-explorer .monaco-list-row', { hasText: text }).first();
  await row('pump_test.st').waitFor({ timeout: kMs });
  await until('the results', async () => (await page.locator('.test-explorer .codicon-testing-failed-icon').count()) > 0);
  const expand = async (closed, child) => {
    if ((await row(child).count()) === 0) await row(closed).locator('.monaco-tl-twistie').click();
    await row(child).waitFor({ timeout: kMs });
  };
  await expand('pump_test.st', 'stops_at_the_limit');
  await expand('tenfold', 'raw := 2');
  const icon = async text => (await row(text).locator('.computed-state').getAttribute('class')) ?? '';
  await until('the test passed', async () => (await icon('stops_at_the_limit')).includes('testing-passed-icon'));
  await until('the case failed', async () => (await icon('raw := 2')).includes('testing-failed-icon'));
  await until('the other case passed', async () => (await icon('raw := 1')).includes('testing-passed-icon'));
}

async function showsFailure() {
  await open('pump_test.st', 15, 1);
  await page.getByText(/20.!=.21/).first().waitFor({ timeout: kMs });
  await picture('tests.png', { x: 0, y: 0, width: 1280, height: 460 });
}

async function runsLens() {
  await open('pump_test.st', 2, 1);
  const lens = page.locator('.codelens-decoration a', { hasText: 'run test' }).first();
  await lens.waitFor({ timeout: kMs });
  await lens.click();
  await until('a result', async () => (await page.locator('.test-explorer .codicon-testing-passed-icon').count()) > 0);
}

async function draws() {
  await open('motor_starter.st', 15, 1);
  await command('Rung: Open the Drawing');
  const frame = await drawingFrame();
  await until('a picture', async () => (await inDrawing(frame, main => main.shadowRoot?.querySelectorAll('[data-chosen]').length)) > 5);
  const marked = () => inDrawing(frame, main => main.shadowRoot.querySelector('rect.cursor')?.parentElement.dataset.chosen);
  const text = () => inDrawing(frame, main => main.shadowRoot.querySelector('rect.cursor')?.parentElement.textContent);
  await until('the contact at the cursor', async () => ((await text()) ?? '').includes('start_button'));
  const first = await marked();
  await goTo(17, 12);
  await until('the next contact', async () => ((await text()) ?? '').includes('stop_button'));
  await picture('drawing.png');
  return `${first}, then ${await marked()}`;
}

async function clickGoesToText() {
  const frame = await drawingFrame();
  await inDrawing(frame, main => [...main.shadowRoot.querySelectorAll('[data-chosen]')].find(one => one.textContent.includes('overload')).dispatchEvent(new MouseEvent('click', { bubbles: true })));
  await page.locator('.statusbar-item', { hasText: 'Ln 29' }).first().waitFor({ timeout: kMs });
}

async function redraws() {
  const frame = await drawingFrame();
  await goTo(15, 12);
  await page.keyboard.press('Control+Shift+ArrowRight');
  await page.keyboard.type('overload');
  await until('the other name', async () => ((await inDrawing(frame, main => main.shadowRoot.querySelector('rect.cursor')?.parentElement.textContent)) ?? '').includes('overload'));
  await page.keyboard.press('Control+z');
}

async function isLive() {
  await open('motor_starter.st', 15, 1);
  await command('Rung: Run the Project and Show It Live');
  const frame = await drawingFrame();
  await until('the picture live', async () => (await frame.locator('#state').textContent()) === '● live');
  await until('what conducts', async () => (await inDrawing(frame, main => main.shadowRoot.querySelectorAll('.on').length)) > 0);
  await until('what does not', async () => (await inDrawing(frame, main => main.shadowRoot.querySelectorAll('.off').length)) > 0);
  await page.keyboard.press('Control+j');
  await until('values of the whole picture', async () => (await page.locator('.terminal-wrapper').first().isHidden().catch(() => true)));
  await picture('live.png');
  await command('Rung: End the Running Program');
  await until('the end', async () => (await frame.locator('#head').isHidden()));
}

async function hasTasks() {
  await command('Tasks: Run Task');
  const entry = page.locator('.quick-input-list .monaco-list-row', { has: page.getByText('rung', { exact: true }) }).first();
  await entry.waitFor({ timeout: kMs });
  await entry.click();
  const check = page.locator('.quick-input-list .monaco-list-row', { hasText: 'rung: check' }).first();
  await check.waitFor({ timeout: kMs });
  await check.click();
  await page.locator('.terminal-wrapper').first().waitFor({ timeout: kMs });
  await page.keyboard.press('Control+j'); // the terminal takes half of the window
  await page.keyboard.press('Control+1');
}

// A project of its own, which the others do not see.
async function editsTwinCat() {
  fs.cpSync(new URL('twincat', import.meta.url).pathname, path.join(project, 'twincat'), { recursive: true });
  await open('Motor.TcPOU');
  await until('an error in the CDATA', async () => (await errorCount()) > 0);
  await page.locator('.view-line', { hasText: 'zero' }).first().waitFor({ timeout: kMs });
  const styleOf = text => page.locator('.view-line span span', { hasText: text }).first().getAttribute('class');
  await until('colours in the CDATA', async () => (await styleOf('END_VAR')) !== (await styleOf('count')));
  await picture('twincat.png');
}

const stop = await startEditor();
try {
  await step('the language server runs', serverRuns);
  if (failed > 0) throw new Error('the language server does not run');
  await step('an error appears', errorAppears);
  if (process.env.RUNG_FIXES !== 'no') await step('a fix applies', fixApplies);
  await step('an error goes', errorGoes);
  await step('completion', completes);
  await step('definition', goesToDefinition);
  await step('rename in two files', renames);
  await step('formatting', formats);
  await step('symbols', outlines);
  await step('the Test Explorer runs tests', runsTests);
  await step('a failure is shown at its line', showsFailure);
  await step('the lens runs a test', runsLens);
  await step('tasks', hasTasks);
  if (process.env.RUNG_DRAWINGS !== 'no') {
    await step('the drawing follows the cursor', draws);
    await step('a click goes to the text', clickGoesToText);
    await step('an edit redraws', redraws);
    await step('the drawing is live', isLive);
  }
  await step('a file of TwinCAT', editsTwinCat);
} finally {
  await stop();
}
process.exit(failed === 0 ? 0 : 1);
