// SPDX-License-Identifier: Apache-2.0
// Sessions with `rung dap` by the client that Microsoft tests adapters with (@vscode/debugadapter-testsupport from npm).
//   node testsupport.js FILE.st      in a folder with that package; the program of docs/debugging.md
// Prints a line for each session; exit code 1: one failed.
const assert = require("assert");
const fs = require("fs");
const path = require("path");
const { DebugClient } = require(require.resolve("@vscode/debugadapter-testsupport", { paths: [process.cwd()] }));

const program = path.resolve(process.argv[2]);
const text = fs.readFileSync(program, "utf8").split("\n");
const lineOf = (part) => text.findIndex((line) => line.includes(part)) + 1;
const launch = { program, cycles: 12 };

const sessions = {
  async "stops on entry and ends"(client) {
    await Promise.all([
      client.configurationSequence(),
      client.launch({ ...launch, cycles: 3, stopOnEntry: true }),
      client.assertStoppedLocation("entry", { line: lineOf("recipe := recipe + 1") }),
    ]);
    await Promise.all([client.continueRequest({ threadId: 1 }), client.waitForEvent("terminated")]);
  },
  async "hits a breakpoint, and a condition holds there"(client) {
    const line = lineOf("filled := filled");
    await Promise.all([
      client.waitForEvent("initialized").then(async () => {
        const breakpoints = [{ line, condition: "filled > 100" }];
        await client.setBreakpointsRequest({ source: { path: program }, breakpoints });
        await client.configurationDoneRequest();
      }),
      client.launch(launch),
      client.assertStoppedLocation("breakpoint", { line }),
    ]);
    const frames = (await client.stackTraceRequest({ threadId: 1 })).body.stackFrames;
    const value = await client.evaluateRequest({ expression: "filled", frameId: frames[0].id, context: "watch" });
    assert.ok(Number(value.body.result) > 100, value.body.result);
  },
  async "steps in, out, over and back"(client) {
    const line = lineOf("scale(raw");
    await client.hitBreakpoint(launch, { path: program, line });
    const steps = [
      ["stepInRequest", lineOf("percent := raw")],
      ["stepOutRequest", lineOf("filled := filled")],
      ["stepBackRequest", line],
      ["nextRequest", lineOf("filled := filled")],
    ];
    for (const [step, expected] of steps)
      await Promise.all([client[step]({ threadId: 1 }), client.assertStoppedLocation("step", { line: expected })]);
  },
  async "stops at a fault, with its variables"(client) {
    await Promise.all([
      client.waitForEvent("initialized").then(async () => {
        await client.setExceptionBreakpointsRequest({ filters: ["uncaught"] });
        await client.configurationDoneRequest();
      }),
      client.launch(launch),
      client.assertStoppedLocation("exception", { line: lineOf("percent := raw") }),
    ]);
    const frames = (await client.stackTraceRequest({ threadId: 1 })).body.stackFrames;
    assert.deepStrictEqual(frames.map((frame) => frame.name), ["Scale (Filler.scale)", "Filler"]);
    const scopes = (await client.scopesRequest({ frameId: frames[0].id })).body.scopes;
    const instance = scopes.find((scope) => scope.name === "Instance").variablesReference;
    const variables = (await client.variablesRequest({ variablesReference: instance })).body.variables;
    assert.strictEqual(variables.find((variable) => variable.name === "span").value, "0");
  },
  async "refuses what it does not know"(client) {
    await client.initializeRequest();
    await assert.rejects(client.send("nonsense", {}));
    await assert.rejects(client.launchRequest({ program: "/nowhere.st" }));
  },
};

async function main() {
  let failed = 0;
  for (const [name, session] of Object.entries(sessions)) {
    const client = new DebugClient("rung", "dap", "rung");
    client.defaultTimeout = 60000;
    try {
      await client.start();
      await session(client);
      console.log("ok", name);
    } catch (error) {
      failed++;
      console.log("FAILED", name, error.message);
    }
    await client.stop();
  }
  process.exit(failed ? 1 : 0);
}

main();
