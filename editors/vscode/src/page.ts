// The page of the drawing. It loads nothing from elsewhere and runs only our script: the drawing
// contains texts and icons of toolboxes, whose authors must not run code here.

export interface Sources {
  /** The address of the page's script, served by the editor. */
  script: string;
  /** The origin of the editor's files. */
  origin: string;
  /** The colours of the engine, for light and dark themes. */
  colours: { light: string; dark: string };
  nonce: string;
}

const LOOK = `
html, body { height: 100%; margin: 0; padding: 0; overflow: hidden; }
body { --paper: #ffffff; --mark: #0b57d0; --runs: #157f3c; --holds: #8a5a00; background: var(--paper); color: var(--vscode-editor-foreground, #1c2430); font: 13px/20px var(--vscode-font-family, system-ui, sans-serif); }
body.dark { color: var(--vscode-editor-foreground, #e6ebf2); --paper: #12161d; --mark: #8ab4f8; --runs: #4ade80; --holds: #f0c24b; }
#board { position: absolute; inset: 0; touch-action: none; outline: none; cursor: grab; }
#board.panning { cursor: grabbing; }
#board svg { width: 100%; height: 100%; display: block; user-select: none; -webkit-user-select: none; }
#board text { pointer-events: none; }
#bar { position: absolute; left: 8px; top: 8px; display: flex; gap: 4px; }
#bar select, #bar button { font: inherit; min-height: 26px; color: var(--vscode-dropdown-foreground, inherit); background: var(--vscode-dropdown-background, var(--paper)); border: 1px solid var(--vscode-widget-border, #7d8896); border-radius: 4px; }
#bar :focus-visible, #board:focus-visible { outline: 2px solid var(--mark); outline-offset: -2px; }
#why { position: absolute; inset: 40% 16px auto; text-align: center; }
#older { position: absolute; right: 8px; top: 8px; margin: 0; padding: 3px 8px; color: var(--holds); background: var(--paper); border: 1px solid currentColor; border-radius: 4px; }
#said { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
.ring { fill: none; stroke: var(--mark); stroke-width: 2; vector-effect: non-scaling-stroke; }
.runs { fill: none; stroke: var(--runs); stroke-width: 5; }
.runs.held { stroke: var(--holds); }
.rings { pointer-events: none; }
[hidden] { display: none !important; }
`;

export function page({ script, origin, colours, nonce }: Sources): string {
  const policy = `default-src 'none'; style-src 'nonce-${nonce}'; script-src 'nonce-${nonce}'; img-src ${origin} data:; base-uri 'none'; form-action 'none'`;
  // The first `</` would end a style sheet, even within its text.
  const sheet = (text: string): string => text.replaceAll("</", "<\\/");
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Drawing</title>
<style nonce="${nonce}">${LOOK}</style>
<style nonce="${nonce}" id="light">${sheet(colours.light)}</style>
<style nonce="${nonce}" id="dark">${sheet(colours.dark)}</style>
</head>
<body>
<div id="board" tabindex="0" role="application" aria-label="Drawing of the plan: arrows move it, plus and minus zoom, 0 fits it, N and P go through its elements, Enter shows one in the text"></div>
<div id="bar"><select id="plans" aria-label="Plan"></select><button id="fit" title="Fit (0)">Fit</button></div>
<p id="older" role="status" hidden>This run is of an older text.</p>
<div id="said" role="status" aria-live="polite"></div>
<p id="why" hidden></p>
<script nonce="${nonce}" src="${script}"></script>
</body>
</html>
`;
}
