// Talks with the language server as WebAssembly: the conversations of its own tests, answer by answer.
// AFP_LANGUAGE_SERVER is the module, AFP_CASES their folder.
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const test = require('node:test');
const { WASI } = require('node:wasi');

const [program, cases] = [process.env.AFP_LANGUAGE_SERVER, process.env.AFP_CASES];
const compiled = WebAssembly.compile(fs.readFileSync(program));

/** What a case has: the files, what is said, and what is answered to all of it. */
function read(text) {
    const [files, said, wanted] = [{}, [], []];
    const lines = text.split('\n');
    for (let at = 0; at < lines.length; at += 1) {
        const line = lines[at];
        if (line.startsWith('file ')) {
            const end = lines.indexOf('end', at);
            files[line.slice(5)] = lines.slice(at + 1, end).map((each) => `${each}\n`).join('');
            at = end;
        } else if (line.startsWith('--> ')) {
            let whole = line.slice(4);
            while (lines[at + 1]?.startsWith('    ')) whole += lines[(at += 1)];
            said.push(whole);
        } else if (line.startsWith('<-- ')) {
            wanted.push(JSON.parse(line.slice(4)));
        }
    }
    return { files, said, wanted };
}

/** Messages as the protocol has them, requests numbered. */
function messages({ files, said }) {
    let asked = 0;
    return said.map((line) => {
        const [, what, name, rest] = /^(\S+) (\S+) ?(.*)$/.exec(line);
        if (what === 'open') {
            const textDocument = { uri: `file://${name}`, languageId: 'afp', version: 1, text: files[name] };
            return { jsonrpc: '2.0', method: 'textDocument/didOpen', params: { textDocument } };
        }
        const message = { jsonrpc: '2.0', method: name, params: JSON.parse((rest || 'null').replaceAll('@', 'file:///w/')) };
        return what === 'ask' ? { ...message, id: (asked += 1) } : message;
    });
}

/** A message as cases have it: addresses short, pictures left out. */
function shown(line) {
    const short = (key, value) => (typeof value === 'string' && (key === 'svg' || key === 'icon') ? '...' : value);
    return JSON.parse(line.replaceAll('file:///w/', '@'), short);
}

/** All that the server says. */
async function talk(input) {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'afp-lsp-'));
    const [from, to] = ['in', 'out'].map((name) => path.join(folder, name));
    fs.writeFileSync(from, input.map((each) => `${JSON.stringify(each)}\n`).join(''));
    const [stdin, stdout] = [fs.openSync(from, 'r'), fs.openSync(to, 'w')];
    try {
        const wasi = new WASI({ version: 'preview1', stdin, stdout, returnOnExit: true });
        const instance = await WebAssembly.instantiate(await compiled, wasi.getImportObject());
        assert.strictEqual(wasi.start(instance), 0);
        return fs.readFileSync(to, 'utf8');
    } finally {
        [stdin, stdout].forEach(fs.closeSync);
        fs.rmSync(folder, { recursive: true });
    }
}

const names = fs.readdirSync(cases).sort();
assert.ok(names.length >= 5, 'there are cases');
for (const name of names) {
    test(`${name} goes in WebAssembly as it does elsewhere`, async () => {
        const conversation = read(fs.readFileSync(path.join(cases, name), 'utf8'));
        const said = await talk([conversation.files, ...messages(conversation)]);
        const answers = said.split('\n').filter((line) => line !== '').map(shown);
        assert.deepStrictEqual(answers, conversation.wanted);
    });
}
