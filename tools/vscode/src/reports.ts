// SPDX-License-Identifier: Apache-2.0
// What `rung test` writes for other tools: JUnit XML and LCOV. In: their text. Out: results by test, lines by file.
export interface TestResult {
  name: string;
  kind: 'passed' | 'failed' | 'errored' | 'skipped';
  milliseconds: number;
  text: string;
}

const kEntities: Record<string, string> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };
export const unescape = (text: string) => text.replace(/&(amp|lt|gt|quot|apos);/g, (_, name: string) => kEntities[name] ?? '');

function attribute(attributes: string, name: string): string {
  const found = new RegExp(`\\b${name}="([^"]*)"`).exec(attributes);
  return found === null ? '' : unescape(found[1]!);
}

export function readJunit(xml: string): TestResult[] {
  const results: TestResult[] = [];
  for (const [, attributes, content] of xml.matchAll(/<testcase\b([^>]*?)(?:\/>|>([\s\S]*?)<\/testcase>)/g)) {
    const outcome = /<(failure|error|skipped)\b([^>]*?)(?:\/>|>([\s\S]*?)<\/\1>)/.exec(content ?? '');
    const kinds = { failure: 'failed', error: 'errored', skipped: 'skipped' } as const;
    results.push({
      name: attribute(attributes!, 'name'),
      kind: outcome === null ? 'passed' : kinds[outcome[1] as keyof typeof kinds],
      milliseconds: Number(attribute(attributes!, 'time')) * 1000,
      text: outcome === null ? '' : unescape(outcome[3] ?? '') || attribute(outcome[2]!, 'message'),
    });
  }
  return results;
}

// Of each file the lines with code, from 1, and how often each ran.
export function readLcov(text: string): Map<string, [number, number][]> {
  const files = new Map<string, [number, number][]>();
  let lines: [number, number][] = [];
  for (const row of text.split('\n')) {
    if (row.startsWith('SF:')) files.set(row.slice(3).trim(), (lines = []));
    const counted = /^DA:(\d+),(\d+)/.exec(row);
    if (counted !== null) lines.push([Number(counted[1]), Number(counted[2])]);
  }
  return files;
}

export interface Failure {
  file: string;
  line: number; // from 1, as the column
  column: number;
  message: string;
  expected?: string;
  actual?: string;
}

// The headings of failed assertions and faults in the text of a test.
export function readFailures(text: string): Failure[] {
  const failures: Failure[] = [];
  for (const [, file, line, column, message] of text.matchAll(/^(.+?):(\d+):(?:(\d+):)? (.+)$/gm)) {
    const sides = /^assertion failed: expected (.+), got (.+?)(?: \(.*\))?$/.exec(message!);
    const failure: Failure = { file: file!, line: Number(line), column: Number(column ?? 1), message: message! };
    if (sides !== null && !/[<>=]/.test(sides[1]!)) [failure.expected, failure.actual] = [sides[1], sides[2]];
    failures.push(failure);
  }
  return failures;
}
