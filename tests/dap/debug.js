// Debugs the shipped plan of wall following with the client that VS Code's adapters are tested with, over standard
// input and output and over a socket: the same requests, the same places.
'use strict';

const assert = require('node:assert');
const { spawn } = require('node:child_process');
const path = require('node:path');
const test = require('node:test');
const { DebugClient } = require('@vscode/debugadapter-testsupport');

const AFPC = process.env.AFPC;
const PLAN = path.resolve(process.env.AFP_PLANS, 'wall_following.afp');

/** The line, from 1, at which a text of the plan begins. */
function lineOf(text) {
    const lines = require('node:fs').readFileSync(PLAN, 'utf8').split('\n');
    const line = lines.findIndex((each) => each.includes(text));
    assert.notStrictEqual(line, -1, `no line with '${text}'`);
    return line + 1;
}

/** A whole session: to a breakpoint, a look around, a step, back, on to the end; what was seen. */
async function debug(client, more) {
    const seen = [];
    client.on('output', (event) => seen.push(event.body.output));
    await client.initializeRequest();
    const ready = client.waitForEvent('initialized');
    await client.launch({ program: PLAN, until: 8, ...more });
    await ready;

    const line = lineOf('actor backupCollision');
    const set = await client.setBreakpointsRequest({ source: { path: PLAN }, breakpoints: [{ line }] });
    assert.deepStrictEqual(set.body.breakpoints.map((each) => [each.verified, each.line]), [[true, line]]);
    let stopped = client.waitForEvent('stopped');
    await client.configurationDoneRequest();
    assert.strictEqual((await stopped).body.reason, 'breakpoint');

    const stack = await client.stackTraceRequest({ threadId: 1 });
    const [frame] = stack.body.stackFrames;
    assert.deepStrictEqual([frame.name, frame.line], ['backupCollision: Forward', line]);
    const scopes = await client.scopesRequest({ frameId: frame.id });
    const values = {};
    for (const scope of scopes.body.scopes) {
        const all = await client.variablesRequest({ variablesReference: scope.variablesReference });
        values[scope.name] = Object.fromEntries(all.body.variables.map((each) => [each.name, each.value]));
    }
    assert.strictEqual(values.Entries.walldist, '30 cm');
    assert.strictEqual(values.Inputs.distance, '-30 cm');
    assert.strictEqual(values.Supervisors.escape, 'clear');
    const threads = await client.threadsRequest();
    assert.deepStrictEqual(threads.body.threads.map((each) => each.name), ['WallFollowing', 'escape']);

    stopped = client.waitForEvent('stopped');
    await client.nextRequest({ threadId: 1 });
    assert.strictEqual((await stopped).body.reason, 'step');
    const next = await client.stackTraceRequest({ threadId: 1 });
    stopped = client.waitForEvent('stopped');
    await client.stepBackRequest({ threadId: 1 });
    await stopped;
    const back = await client.stackTraceRequest({ threadId: 1 });
    assert.strictEqual(back.body.stackFrames[0].line, line);
    assert.notStrictEqual(next.body.stackFrames[0].line, line);

    await client.setBreakpointsRequest({ source: { path: PLAN }, breakpoints: [] });
    const ended = client.waitForEvent('terminated');
    await client.continueRequest({ threadId: 1 });
    await ended;
    await client.disconnectRequest();
    return seen.join('');
}

test('the same over standard input and output and over a socket', async () => {
    const piped = new DebugClient(AFPC, 'dap', 'afp');
    await piped.start();
    const one = await debug(piped, {});
    assert.match(one, /WallFollowing was interrupted after 8\.0 s/);

    const server = spawn(AFPC, ['dap', '--port', '0'], { stdio: ['ignore', 'ignore', 'pipe'] });
    try {
        const said = await new Promise((resolve) => server.stderr.once('data', (data) => resolve(String(data))));
        const [, port, token] = /listening on 127\.0\.0\.1:(\d+), token (\w+)/.exec(said);
        const stranger = new DebugClient(AFPC, 'dap', 'afp');
        await stranger.start(Number(port));
        await stranger.initializeRequest();
        await assert.rejects(stranger.launchRequest({ program: PLAN, token: 'x' }), /'token' must be the token/);
        await stranger.disconnectRequest();

        const socket = new DebugClient(AFPC, 'dap', 'afp');
        await socket.start(Number(port));
        assert.strictEqual(await debug(socket, { token }), one);
    } finally {
        server.kill();
    }
});
