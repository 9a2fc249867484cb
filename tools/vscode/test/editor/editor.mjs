// SPDX-License-Identifier: Apache-2.0
// Uses the extension in a real editor, with a project of three files: each step does what a user does, and looks at what
// the editor shows or at the files. Prints a line for each; the exit code is 1 when one fails. Called by editor.sh.
//   node editor.mjs CODE-SERVER VSIX RUNG WORK-FOLDER [PICTURES]
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import * as debug from './debug.mjs';
import { answer, command, cursorAt, drawingFrame, errorCount, failed, goTo, inDrawing, kMs, onDisk, open, page, picture, project, rung, startEditor, step, until, valuesAfter } from './driver.mjs';


async function serverRuns() {
  await open('pump.st');
  await page.locator('.statusbar-item', { hasText: 'Rung' }).locator('.codicon-check').first().waitFor({ timeout: kMs });
}

async function errorAppears(pictureName) {
  await open('pump.st', 17, 1);
  await page.keyboard.type('level := levle;\n');
  await until('an error underlined', async () => (await errorCount()) > 0);
  await goTo(17, 12);
  await page.keyboard.press('Control+k');
  await page.keyboard.press('Control+i');
  const message = page.locator('.monaco-hover', { hasText: '`levle` is not declared' }).first();
  await message.waitFor({ timeout: kMs });
  await picture(pictureName, { x: 0, y: 0, width: 1280, height: 560 });
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
  await command('View: Close Editors in Other Groups');
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

// ---- a program that runs

const levelOf = async line => Number(/\blevel = ([\d.]+)/.exec(await valuesAfter(line))?.[1] ?? NaN);

async function valuesInText() {
  await command('View: Close All Editors');
  await open('pump.st', 17, 1);
  await command('Rung: Run the Project and Show It Live');
  await until('a value after a line', async () => (await levelOf('level := level + 0.1;')) >= 0.1);
  const first = await levelOf('level := level + 0.1;');
  await until('the value grows', async () => (await levelOf('level := level + 0.1;')) > first);
  await until('a member', async () => /^pump\.running = (TRUE|FALSE)$/.test(await valuesAfter('IF pump.running THEN')));
  await page.keyboard.press('Control+j');
  await command('View: Show Explorer');
  await picture('values.png', { x: 0, y: 0, width: 1280, height: 560 });
  return await valuesAfter('level := level + 0.1;');
}

// The other tank is ten times slower.
async function choosesInstance() {
  const slow = page.locator('.codelens-decoration a', { hasText: 'Tank1 (one of 2)' }).first();
  await slow.waitFor({ timeout: kMs });
  const other = page.locator('.quick-input-list .monaco-list-row', { hasText: 'Tank2' }).first();
  await until('the instances', async () => {  // a lens that is drawn again in this moment takes no click
    await slow.click();
    return other.waitFor({ timeout: kMs / 10 }).then(() => true, () => false);
  });
  await other.click();
  await page.locator('.codelens-decoration a', { hasText: 'Tank2 (one of 2)' }).first().waitFor({ timeout: kMs });
  await until('the value of the slow one', async () => (await levelOf('level := level + 0.1;')) <= 0.2);
}

async function valuesMoveWithText() {
  await goTo(1, 1);
  await page.keyboard.type('// a line more\n');
  await page.locator('.view-line', { hasText: 'a line more' }).first().waitFor({ timeout: kMs });
  await page.waitForTimeout(500);
  if (!((await levelOf('level := level + 0.1;')) >= 0.1)) throw new Error('no value after an edit above');
  await goTo(20, 1);
  await page.keyboard.type('level := level + 0.0;\n');
  await page.keyboard.press('Control+s');
  await until('the value in a new line of the version that took over', async () => (await levelOf('level := level + 0.0;')) >= 0.1);
}

async function endsProgram() {
  await command('Rung: End the Running Program');
  await until('no value', async () => (await valuesAfter('level := level + 0.1;')) === '');
}

const kPrompt = 'The URL that the program printed at its start';

// A program that somebody else started.
async function connectsByUrl() {
  await open('pump.st', 17, 1);
  await command('Rung: Connect to the Monitor of a Running Program');
  await answer(kPrompt, 'http://127.0.0.1:1/?token=no');
  await page.locator('.notification-list-item', { hasText: 'no monitor answers there' }).first().waitFor({ timeout: kMs });
  await command('Notifications: Clear All Notifications');
  const program = spawn(rung, ['run', project, '--monitor', '0'], { stdio: ['ignore', 'ignore', 'pipe'] });
  try {
    const url = await new Promise(resolve => {
      let said = '';
      program.stderr.on('data', data => {
        said += data;
        const found = /^monitor: (\S+)/m.exec(said);
        if (found !== null) resolve(found[1]);
      });
    });
    await command('Rung: Connect to the Monitor of a Running Program');
    await answer(kPrompt, url);
    await until('a value', async () => (await levelOf('level := level + 0.1;')) >= 0.1);
    await page.locator('.statusbar-item', { hasText: /running, cycle \d+/ }).first().waitFor({ timeout: kMs });
    await command('Rung: Disconnect from the Running Program');
    await until('no value', async () => (await valuesAfter('level := level + 0.1;')) === '');
    if (program.exitCode !== null) throw new Error('the program has ended');
    await command('Rung: Connect to the Monitor of a Running Program');
    await answer(kPrompt, url);
    await until('a value again', async () => (await levelOf('level := level + 0.1;')) >= 0.1);
  } finally {
    program.kill('SIGINT');
  }
  await until('that it has ended is seen', async () => (await valuesAfter('level := level + 0.1;')) === '');
}

// ---- coverage, walkthrough, trust

async function showsCoverage() {
  await open('pump.st', 8, 1);
  await command('Test: Run All Tests with Coverage');
  const row = page.locator('.test-coverage-tree .monaco-list-row, .monaco-list-row', { hasText: /pump\.st.*\d+(\.\d+)?%/ }).first();
  await row.waitFor({ timeout: kMs });
  await open('pump.st', 8, 1);
  const count = kind => page.locator(`.coverage-deco-gutter.coverage-deco-${kind}`).count();
  await until('a line that ran', async () => (await count('hit')) > 0);
  await until('a line that did not run', async () => (await count('miss')) > 0);
  const text = `${await count('hit')} lines ran, ${await count('miss')} did not`;
  await picture('coverage.png');
  await page.getByText('Close Test Coverage').first().click();
  await until('the end of it', async () => (await count('hit')) === 0);
  await page.keyboard.press('Control+j');
  return text;
}

async function walksThrough() {
  await command('View: Close All Editors');
  await page.keyboard.press('Control+b'); // a narrow page has no pictures
  await command('Welcome: Open Walkthrough...');
  await page.locator('.quick-input-list .monaco-list-row', { hasText: 'PLC programs with Rung' }).first().click();
  const steps = page.locator('.getting-started-step');
  await until('the steps', async () => (await steps.count()) === 5);
  const kPictures = { 'Open a project': 'error', 'See the drawing': 'drawing', 'Run the tests': 'tests', 'Watch it run': 'live' };
  for (const [title, name] of Object.entries(kPictures)) {
    await page.locator('.getting-started-step', { hasText: title }).first().click();
    await until(`the picture of ${title}`, () =>
      page.evaluate(file => [...document.querySelectorAll('.getting-started-media img')].some(one => one.currentSrc.includes(file) && one.naturalWidth > 0), `${name}.png`),
    );
  }
  await picture('walkthrough.png');
  await page.getByRole('button', { name: 'Run and show it live' }).first().waitFor({ timeout: kMs });
  await page.keyboard.press('Control+b');
  await command('View: Close All Editors');
}

// The folder brings a program of its own as `rung.path`; it must not run before the folder is trusted.
const kOwn = {
  '.vscode/settings.json': JSON.stringify({ 'rung.path': './own-rung' }),
  'own-rung': `#!/bin/sh\necho "$@" >>"$(dirname "$0")/ran"\nexec '${rung}' "$@"\n`,
};
const hasRun = () => fs.existsSync(path.join(project, 'ran'));

async function isRestricted() {
  await page.locator('.statusbar-item', { hasText: 'Restricted Mode' }).first().waitFor({ timeout: kMs });
  await serverRuns();
  await errorAppears('restricted_error.png');
  await errorGoes();
  await command('Rung: Run the Project');
  await page.locator('.notification-list-item', { hasText: 'programs run in trusted folders only' }).first().waitFor({ timeout: kMs });
  await command('Notifications: Clear All Notifications');
  await command('Rung: Test the Project');
  await page.locator('.notification-list-item', { hasText: 'tests run in trusted folders only' }).first().waitFor({ timeout: kMs });
  await picture('restricted.png');
  if (hasRun()) throw new Error('the program of the folder ran');
}

async function isTrustedLater() {
  await command('Notifications: Clear All Notifications');
  await command('Workspaces: Manage Workspace Trust');
  await page.locator('.workspace-trust-editor .monaco-button', { hasText: /^Trust$/ }).first().click();
  await until('the program of the folder runs', hasRun);
  await page.keyboard.press('Escape');
  await open('pump.st');
  await page.locator('.statusbar-item', { hasText: 'Rung' }).locator('.codicon-check').first().waitFor({ timeout: kMs });
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
  const text = onDisk('twincat/Motor.TcPOU');
  const line = text.split('\n').findIndex(one => one.includes('zero')) + 1;
  await goTo(line, text.split('\n')[line - 1].indexOf('zero') + 1);
  await page.keyboard.press('Control+Shift+ArrowRight');
  await page.keyboard.type('1');
  await until('no error', async () => (await errorCount()) === 0);
  await command('Rung: Run the Project and Show It Live');
  await until('a value in the CDATA', async () => /^count = [1-9]/.test(await valuesAfter('count := count + 1;')));
  await until('a value beside a tag', async () => /^start = TRUE$/.test(await valuesAfter('<ST><![CDATA[IF start THEN')));
  await command('Rung: End the Running Program');
}

async function inTrustedFolder() {
  const stop = await startEditor('plant');
  try {
    await step('the language server runs', serverRuns);
    if (failed > 0) throw new Error('the language server does not run');
    await step('an error appears', () => errorAppears('error.png'));
    await step('a fix applies', fixApplies);
    await step('an error goes', errorGoes);
    await step('completion', completes);
    await step('definition', goesToDefinition);
    await step('rename in two files', renames);
    await step('formatting', formats);
    await step('symbols', outlines);
    await step('the Test Explorer runs tests', runsTests);
    await step('a failure is shown at its line', showsFailure);
    await step('the lens runs a test', runsLens);
    await step('coverage', showsCoverage);
    await step('tasks', hasTasks);
    await step('the drawing follows the cursor', draws);
    await step('a click goes to the text', clickGoesToText);
    await step('an edit redraws', redraws);
    await step('the drawing is live', isLive);
    await step('values in the text are live', valuesInText);
    await step('values of another instance', choosesInstance);
    await step('values move with their text', valuesMoveWithText);
    await step('values end with the program', endsProgram);
    await step('a program that runs elsewhere', connectsByUrl);
    await step('the debugger stops in ST', debug.stopsInText);
    await step('the debugger shows values in the text', debug.showsInlineValues);
    await step('the debugger steps forward and back', debug.stepsBothWays);
    await step('the debugger evaluates', debug.evaluates);
    await step('the debugger stops on a change', debug.breaksOnChange);
    await step('the debugger stops in a network', debug.stopsInNetwork);
    await step('the debugger runs a test', debug.debugsTest);
    await step('a file of TwinCAT', editsTwinCat);
    await step('the walkthrough', walksThrough);
  } finally {
    await stop();
  }
}

async function inUntrustedFolder() {
  const stop = await startEditor('foreign', { isTrusted: false, files: kOwn });
  try {
    await step('a folder that is not trusted', isRestricted);
    await step('a folder that is trusted later', isTrustedLater);
  } finally {
    await stop();
  }
}

await inTrustedFolder();
await inUntrustedFolder();
process.exit(failed === 0 ? 0 : 1);
