// Builds the page (`dist/`) or, with `--tests`, its tests (`built/`); `--watch` rebuilds the page
// at each change.
import { cp, mkdir, readdir, rm } from "node:fs/promises";
import * as esbuild from "esbuild";

const given = new Set(process.argv.slice(2));
const shared = { bundle: true, format: "esm", target: "es2022", logLevel: "warning", jsx: "automatic", jsxImportSource: "preact" };

const copied = {
  name: "copied",
  setup(build) {
    build.onEnd(async () => {
      for (const name of ["index.html", "icon.svg"]) await cp(`page/${name}`, `dist/${name}`);
    });
  },
};

const page = {
  ...shared,
  entryPoints: ["page/main.ts", "page/app.css"],
  outdir: "dist",
  minify: !given.has("--watch"),
  sourcemap: given.has("--watch"),
  legalComments: "linked",
  plugins: [copied],
};

if (given.has("--tests")) {
  const names = (await readdir("tests")).filter((name) => name.endsWith(".test.ts"));
  await rm("built", { recursive: true, force: true });
  const entryPoints = names.map((name) => `tests/${name}`);
  await esbuild.build({ ...shared, entryPoints, outdir: "built", platform: "node", packages: "external", sourcemap: "inline" });
} else {
  await rm("dist", { recursive: true, force: true });
  await mkdir("dist", { recursive: true });
  if (given.has("--watch")) {
    const context = await esbuild.context({ ...page, logLevel: "info" });
    await context.watch();
  } else {
    await esbuild.build(page);
  }
}
