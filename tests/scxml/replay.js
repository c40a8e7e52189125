// Feeds runs of the interpreter to a state chart engine and compares where control is.
//
// node replay.js CASES: one JSON object a line, as tests/src/state_chart.rs describes them. Ends
// with exit code 1 when a chart does not read or control is elsewhere in it.
'use strict';

const fs = require('fs');
const readline = require('readline');
const scxml = require('@scion-scxml/scxml');

/** Failures that are shown in full. */
const SHOWN = 5;

/** The engine's form of a chart. */
function compiled(name, chart) {
  return new Promise((resolve, reject) => {
    scxml.documentStringToModel(`${name}.scxml`, chart, (error, model) => {
      if (error) return reject(error);
      model.prepare((error, prepared) => (error ? reject(error) : resolve(prepared)), { console });
    }, {});
  });
}

/** What is wrong with the active states after a step; null when nothing is. */
function wrong(chart, step, before) {
  const atoms = chart.getConfiguration().slice().sort().join(' ');
  if (step.same && atoms !== before) return `'${atoms}' is active, '${before}' was`;
  if (step.only !== null && atoms !== step.only) return `'${atoms}' is active, not '${step.only}'`;
  const all = chart.getFullConfiguration();
  const missing = step.active.find((state) => !all.includes(state));
  return missing === undefined ? null : `'${missing}' is not active, but '${atoms}' is`;
}

/** Feeds a run; returns the events that led to the first difference, or null. */
function replay(model, steps, counts) {
  const chart = new scxml.core.Statechart(model);
  chart.start();
  const fed = [];
  let before = '';
  for (const step of steps) {
    if (step.event !== null) {
      chart.gen({ name: step.event });
      fed.push(step.event);
      counts.events += 1;
    }
    counts.places += step.active.length + (step.only === null ? 0 : 1) + (step.same ? 1 : 0);
    const difference = wrong(chart, step, before);
    if (difference !== null) return `${fed.join('\n  ')}\n  ${difference}`;
    before = chart.getConfiguration().slice().sort().join(' ');
  }
  return null;
}

async function main(file) {
  const counts = { runs: 0, cut: 0, events: 0, places: 0, passed: 0, failed: 0 };
  const lines = readline.createInterface({ input: fs.createReadStream(file) });
  for await (const line of lines) {
    const { name, chart, runs, cut } = JSON.parse(line);
    const failures = [];
    try {
      const model = await compiled(name, chart);
      for (const steps of runs) failures.push(replay(model, steps, counts));
    } catch (error) {
      failures.push(String(error && error.stack ? error.stack : error));
    }
    counts.runs += runs.length;
    counts.cut += cut;
    const first = failures.find((failure) => failure !== null);
    if (first === undefined) {
      counts.passed += 1;
    } else {
      counts.failed += 1;
      if (counts.failed <= SHOWN) console.error(`${name}:\n  ${first}\n`);
    }
  }
  console.log(`${counts.runs} runs, ${counts.events} events, ${counts.places} places compared`);
  console.log(`${counts.cut} runs compared up to a value that charts cannot see`);
  console.log(`${counts.passed} passed, ${counts.failed} failed`);
  // A comparison that compares next to nothing is none.
  const enough = counts.places >= counts.runs && counts.cut * 5 <= counts.runs;
  process.exitCode = counts.failed === 0 && counts.passed > 0 && enough ? 0 : 1;
}

main(process.argv[2]);
