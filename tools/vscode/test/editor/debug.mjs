// SPDX-License-Identifier: Apache-2.0
// The debugger in a real editor: breakpoints in ST and in a network, steps forward and back, variables, values in the
// text, a data breakpoint, a test. Called by editor.mjs after the other steps.
import { command, drawingFrame, goTo, inDrawing, kMs, lineOf, open, page, picture, until } from './driver.mjs';

// The line where the program is, by the arrow in the margin.
const stoppedLine = () =>
  page.evaluate(() => {
    const arrow = document.querySelector('.glyph-margin-widgets .codicon-debug-stackframe, .glyph-margin-widgets .codicon-debug-stackframe-dot, .codicon-debug-stackframe');
    if (arrow === null) return 0;
    const top = Math.round(arrow.getBoundingClientRect().top);
    const numbers = [...document.querySelectorAll('.margin-view-overlays .line-numbers')];
    return Number(numbers.find(one => Math.abs(Math.round(one.getBoundingClientRect().top) - top) < 4)?.textContent ?? 0);
  });

async function stopsAt(line) {
  await until(`the program at line ${line}`, async () => (await stoppedLine()) === line).catch(async error => {
    throw new Error(`${error.message}, but at ${await stoppedLine()}`);
  });
}

const inStack = text => page.locator('.debug-call-stack .monaco-list-row', { hasText: text }).first();
const variable = text => page.locator('.debug-variables .monaco-list-row', { hasText: text }).first();

async function expand(row, child) {
  await row.waitFor({ timeout: kMs });
  await until('what is in it', async () => {
    if (await child.isVisible()) return true;
    await row.locator('.monaco-tl-twistie').click();
    return child.waitFor({ timeout: kMs / 10 }).then(() => true, () => false);
  });
}

// A menu that has just opened takes no click.
async function choose(row, title) {
  await row.click({ button: 'right' });
  const item = page.locator('.monaco-menu .action-item', { hasText: title }).first();
  await item.hover({ timeout: kMs });
  await page.waitForTimeout(300);
  await page.keyboard.press('Enter');
  await until('the menu closes', async () => (await item.count()) === 0);
}

async function removeBreakpoints() {
  const one = page.locator('.debug-breakpoints .monaco-list-row', { hasText: /\.st|level/ }).first();
  await choose(one, 'Remove All Breakpoints');
  await until('no breakpoint', async () => (await one.count()) === 0);
}

const hasEnded = async () => (await page.locator('.debug-toolbar:visible').count()) === 0;

async function ends() {
  await page.keyboard.press('Shift+F5');
  await until('the end of the session', hasEnded);
}

export async function stopsInText() {
  await command('View: Close All Editors');
  await open('pump.st');
  const line = lineOf('pump.st', 'pump(');
  await goTo(line, 1);
  await page.keyboard.press('F9');
  await page.locator('.codicon-debug-breakpoint').first().waitFor({ timeout: kMs });
  await command('Rung: Debug the Project');
  await stopsAt(line);
  await expand(inStack('Fast'), inStack('Tank (Tank1)'));
  await expand(variable('Instance'), variable(/^level/));
  return `line ${line}`;
}

const lines = () => page.evaluate(() => [...document.querySelectorAll('.view-line')].map(one => one.textContent.replace(/\u00a0/g, ' ')));

export async function showsInlineValues() {
  await until('the value of a variable in the text', async () => (await lines()).some(one => /^pump\(.*level = 0\.0/.test(one)));
}

export async function stepsBothWays() {
  await removeBreakpoints(); // the other tank would stop there too
  const first = await stoppedLine();
  await page.keyboard.press('F10');
  await stopsAt(first + 1);
  await until('the value of a member in the text', async () => (await lines()).some(one => /IF pump\.running THEN.*pump\.running = TRUE/.test(one)));
  await picture('debug.png');
  await page.locator('.debug-toolbar .codicon-debug-step-back').first().click();
  await stopsAt(first);
  return `${first}, ${first + 1}, ${first}`;
}

export async function evaluates() {
  await page.locator('.repl-input-wrapper .monaco-editor').first().click();
  await page.keyboard.type('level + 2.0');
  await page.keyboard.press('Enter');
  await page.locator('.repl-tree .monaco-list-row', { hasText: /^2\.\d+$/ }).first().waitFor({ timeout: kMs });
}

export async function breaksOnChange() {
  await choose(variable(/^level/), 'Break on Value Change');
  await page.locator('.debug-breakpoints .monaco-list-row', { hasText: 'level' }).first().waitFor({ timeout: kMs });
  await page.keyboard.press('F5');
  await page.locator('.debug-call-stack', { hasText: /Tank1.level: 0.0 -> 0.1/i }).first().waitFor({ timeout: kMs });
  const line = await stoppedLine();
  await picture('debug_data.png');
  await removeBreakpoints();
  await ends();
  return `line ${line}`;
}

export async function stopsInNetwork() {
  await open('motor_starter.st', 19, 1);
  await page.keyboard.press('F9');
  await command('Rung: Debug the Project');
  await stopsAt(19);
  const frame = await drawingFrame();
  const marked = () => inDrawing(frame, main => main.shadowRoot.querySelector('rect.stop')?.parentElement.id);
  await until('the coil in the drawing', async () => (await marked()) === 'e6');
  await removeBreakpoints();
  await picture('debug_network.png');
  await page.keyboard.press('F10');
  await until('the next element', async () => !['e6', undefined].includes(await marked()));
  const next = await marked();
  await command('Rung: To the End of the Cycle');
  await until('another place', async () => (await marked()) !== next);
  await ends();
  return `e6, then ${next}`;
}

export async function debugsTest() {
  await command('View: Close All Editors');
  await open('pump_test.st', 5, 1);
  await page.keyboard.press('F9');
  const lens = page.locator('.codelens-decoration a', { hasText: /^debug$/ }).first();
  await lens.waitFor({ timeout: kMs });
  await until('a session', async () => {
    await lens.click();
    return page.locator('.debug-toolbar:visible').waitFor({ timeout: kMs / 5 }).then(() => true, () => false);
  });
  await stopsAt(5);
  await removeBreakpoints();
  await page.keyboard.press('F5');
  await until('the end of the session', hasEnded);
  await page.locator('.testing-run-glyph.codicon-testing-passed-icon, .codicon-testing-passed-icon').first().waitFor({ timeout: kMs });
}
