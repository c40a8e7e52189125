// Converts protocol snippets (`$1`, `${1:text}`, `\}`) to CodeMirror's (`${1}`, `${1:text}`, `\{`,
// `\}`).

const PIECE = /\\([\\$}])|\$\{(\d+)(?::([^}]*))?\}|\$(\d+)|[{}]/g;

export function fromProtocol(source: string): string {
  return source.replace(PIECE, (whole, plain?: string, hole?: string, inside?: string, bare?: string) => {
    if (plain !== undefined) return plain === "}" ? "\\}" : plain;
    if (hole !== undefined) return inside ? `\${${hole}:${inside}}` : `\${${hole}}`;
    return bare !== undefined ? `\${${bare}}` : `\\${whole}`;
  });
}
