// SVG fragments from the engine, which contain names and icons of toolboxes. They are parsed and
// accepted only if every element and attribute is on these lists. Nothing that runs, loads or links
// is on them.

const ELEMENTS = new Set(["g", "path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text", "tspan", "title", "use", "symbol"]);

const ATTRIBUTES = new Set([
  ..."id class d points x y x1 y1 x2 y2 cx cy r rx ry width height viewBox transform".split(" "),
  ..."fill stroke color opacity fill-opacity stroke-opacity fill-rule clip-rule".split(" "),
  ..."stroke-width stroke-dasharray stroke-dashoffset stroke-miterlimit stroke-linecap stroke-linejoin".split(" "),
  ..."font-size text-anchor data-item data-exit".split(" "),
]);

const SVG = "http://www.w3.org/2000/svg";
/** The ids of the drawing's own symbols begin so. */
const REFERENCE = "#afp-";

const loads = (value: string): boolean => value.toLowerCase().includes("url");

function allowed(element: Element): boolean {
  if (element.namespaceURI !== SVG || !ELEMENTS.has(element.localName)) return false;
  for (const { name, value } of element.attributes) {
    if (name === "xmlns" && value === SVG) continue;
    const known = name === "href" ? element.localName === "use" && value.startsWith(REFERENCE) : ATTRIBUTES.has(name);
    if (!known || loads(value)) return false;
  }
  return [...element.children].every(allowed);
}

const parsed = (svg: string): Element => new DOMParser().parseFromString(`<svg xmlns="${SVG}">${svg}</svg>`, "image/svg+xml").documentElement;

/** Imports the nodes of a parsed group; none if anything is not on the lists. */
const checked = (group: Element): SVGElement[] =>
  [...group.children].every(allowed) ? [...group.children].map((child) => document.importNode(child, true) as unknown as SVGElement) : [];

/** The nodes of a fragment; none if anything is not on the lists. */
export function nodes(svg: string): SVGElement[] {
  const root = parsed(svg);
  return root.localName === "svg" ? checked(root) : [];
}

/** Parses many fragments at once. */
export function all(fragments: readonly string[]): SVGElement[][] {
  const root = parsed(fragments.map((svg) => `<g>${svg}</g>`).join(""));
  // An unbalanced or unreadable fragment is found by parsing each one.
  const whole = root.localName === "svg" && root.children.length === fragments.length && [...root.children].every((group) => group.localName === "g" && group.attributes.length === 0);
  return whole ? [...root.children].map(checked) : fragments.map(nodes);
}

/**
 * An icon of a toolbox, a whole `svg` element; null if it is invalid or has anything that is not on
 * the lists.
 */
export function icon(svg: string): SVGSVGElement | null {
  const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
  if (root.localName !== "svg" || root.namespaceURI !== SVG) return null;
  const frame = new Set(["xmlns", "version", "role"]);
  const fine = [...root.attributes].every(({ name, value }) => frame.has(name) || (ATTRIBUTES.has(name) && !loads(value)));
  if (!fine || ![...root.children].every(allowed)) return null;
  const made = document.importNode(root, true) as unknown as SVGSVGElement;
  made.setAttribute("aria-hidden", "true");
  return made;
}

/** Creates an SVG element with attributes. */
export function svg<K extends keyof SVGElementTagNameMap>(name: K, attributes: Record<string, string | number> = {}): SVGElementTagNameMap[K] {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}
