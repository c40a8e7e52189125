// Watches the shipped plan of wall following with Foxglove's own client while it runs: its channels, its entries as
// parameters, its buttons as services.
'use strict';

const assert = require('node:assert');
const { spawn } = require('node:child_process');
const path = require('node:path');
const test = require('node:test');
const { FoxgloveClient } = require('@foxglove/ws-protocol');
const WebSocket = require('ws');

const AFPC = process.env.AFPC;
const PLAN = path.resolve(process.env.AFP_PLANS, 'wall_following.afp');

/** Fails when something does not come in time. */
function within(seconds, what, promise) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`no ${what} within ${seconds} s`)), seconds * 1000);
    timer.unref();
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

/** The next event of a client that fits. */
function next(client, name, fits = () => true) {
  const found = new Promise((resolve) => {
    const hear = (event) => {
      if (!fits(event)) return;
      client.off(name, hear);
      resolve(event);
    };
    client.on(name, hear);
  });
  return within(20, name, found);
}

/** A client of an address, with what the server says of itself. */
async function connect(address) {
  const ws = new WebSocket(address, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
  const client = new FoxgloveClient({ ws });
  client.on('error', (why) => console.error(why));
  const [info, channels, services] =
    await Promise.all(['serverInfo', 'advertise', 'advertiseServices'].map((name) => next(client, name)));
  return { client, info, channels, services };
}

/** What a service answers. */
async function call(client, services, name, said) {
  const serviceId = services.find((service) => service.name === name).id;
  const callId = Math.floor(Math.random() * 1e6);
  const mine = (event) => event.callId === callId;
  const done = Promise.race([
    next(client, 'serviceCallResponse', mine).then(() => 'done'),
    next(client, 'serviceCallFailure', mine).then((failure) => failure.message),
  ]);
  const data = new TextEncoder().encode(JSON.stringify(said));
  client.sendServiceCallRequest({ serviceId, callId, encoding: 'json', data });
  return done;
}

test('the plan is watched, written to, pressed and stopped while it runs', async () => {
  const run = spawn(AFPC, ['run', PLAN, '--live=0', '--until', '60s', '--log', 'none', '--svg', 'none', '--json'], {
    stdio: ['ignore', 'pipe', 'pipe'],
  });
  try {
    let out = '';
    run.stdout.on('data', (data) => (out += data));
    const ended = new Promise((resolve) => run.once('exit', resolve));
    const addresses = new Promise((resolve) => {
      let said = '';
      run.stderr.on('data', (data) => {
        said += data;
        const found = said.match(/ws:\S+/g);
        if (found && found.length === 2 && said.endsWith('\n')) resolve(found);
      });
    });
    const [operator, watcher] = await within(60, 'address', addresses);

    const stranger = new WebSocket(operator.replace(/token=\w+/, 'token=0'), [FoxgloveClient.SUPPORTED_SUBPROTOCOL]);
    const sentAway = new Promise((resolve) => stranger.once('error', resolve));
    assert.match(String(await within(20, 'refusal', sentAway)), /401/);
    const { client, info, channels, services } = await connect(operator);
    assert.strictEqual(info.name, 'WallFollowing');
    for (const topic of ['/plan/events', '/plan/configuration', '/tf', '/robot/pose', '/scene', '/log']) {
      const channel = channels.find((each) => each.topic === topic);
      assert.ok(channel, topic);
      assert.strictEqual(channel.encoding, 'protobuf');
      assert.ok(Buffer.from(channel.schema, 'base64').includes(channel.schemaName.split('.').pop()), topic);
    }

    const poses = client.subscribe(channels.find((each) => each.topic === '/robot/pose').id);
    const ofPoses = (message) => message.subscriptionId === poses;
    const first = await next(client, 'message', ofPoses);
    const second = await next(client, 'message', (message) => ofPoses(message) && message.timestamp > first.timestamp);
    assert.ok(second.data.byteLength > 10);

    const answer = next(client, 'parameterValues', (event) => event.id === 'all');
    client.getParameters([], 'all');
    const values = Object.fromEntries((await answer).parameters.map((each) => [each.name, each.value]));
    assert.strictEqual(values.walldist, '30 cm');
    client.subscribeParameterUpdates(['walldist']);
    const changed = next(client, 'parameterValues', (event) => event.parameters.some((each) => each.value === '42 cm'));
    client.setParameters([{ name: 'walldist', value: '42 cm' }]);
    await changed;
    const refused = next(client, 'status', (event) => event.level === 2);
    client.setParameters([{ name: 'walldist', value: '42 s' }]);
    assert.match((await refused).message, /'walldist=42 s': not a length \(help: a number and a unit: m, cm, /);

    const other = await connect(watcher);
    const held = { held: true };
    assert.match(await call(other.client, other.services, 'press/touch.touch', held), /for watching/);
    assert.strictEqual(await call(client, services, 'press/touch.touch', {}), 'done');
    assert.strictEqual(await call(client, services, 'fail/ultrasonic.lost', { seconds: 0.2 }), 'done');
    assert.match(await call(client, services, 'fail/ultrasonic.lost', { seconds: -1 }), /above 0/);
    const closed = next(other.client, 'close');
    assert.strictEqual(await call(other.client, other.services, 'stop', {}), 'done');
    await closed;
    assert.strictEqual(await within(20, 'end of the run', ended), 0);
    assert.match(out, /"press touch.touch"|touch\.touch/);
    client.close();
  } finally {
    run.kill('SIGKILL');
  }
});
