// Makes the extension (`dist/`) or, with `--tests`, also its tests (`built/`).
import { readdir, readFile, rm, writeFile } from "node:fs/promises";
import * as esbuild from "esbuild";

const shared = { bundle: true, target: "es2022", logLevel: "warning", legalComments: "linked" };

await rm("dist", { recursive: true, force: true });
const made = await esbuild.build({ ...shared, entryPoints: ["src/extension.ts"], outfile: "dist/extension.js", platform: "node", format: "cjs", external: ["vscode"], minify: true, metafile: true });
await writeFile("dist/LICENSES.txt", await licences(Object.keys(made.metafile.inputs)));
await esbuild.build({ ...shared, entryPoints: ["webview/main.ts"], outfile: "dist/drawing.js", format: "iife", minify: true });

if (process.argv.includes("--tests")) {
  const names = (await readdir("test")).filter((name) => name.endsWith(".test.ts"));
  await rm("built", { recursive: true, force: true });
  const entryPoints = names.map((name) => `test/${name}`);
  // The tests use a stub of the editor, and a client that talks with the real language server.
  const alias = { vscode: "./test/vscode.ts", "vscode-languageclient/node": "./test/client.ts" };
  const external = ["vscode-languageserver-protocol", "vscode-jsonrpc", "playwright-core", "@vscode/debugadapter-testsupport"];
  await esbuild.build({ ...shared, entryPoints, outdir: "built", platform: "node", format: "cjs", alias, external, sourcemap: "inline" });
}

/** Collects the licences of the packages that are part of a bundle. */
async function licences(files) {
  const folders = new Set(files.flatMap((file) => file.match(/^(?:.*\/)?node_modules\/(?:@[^/]+\/)?[^/]+/) ?? []));
  const texts = [...folders].sort().map(async (folder) => {
    const [{ name, version, license }, all] = [JSON.parse(await readFile(`${folder}/package.json`, "utf8")), await readdir(folder)];
    const file = all.find((each) => /^licen[cs]e/i.test(each));
    return `${name} ${version} (${license})\n\n${file ? await readFile(`${folder}/${file}`, "utf8") : ""}`;
  });
  return (await Promise.all(texts)).join("\n\n----\n\n");
}
