// Icons of buttons: lines of one width in a square of 16.

const PATHS = {
  menu: "M2.5 4h11M2.5 8h11M2.5 12h11",
  undo: "M6.5 3 3 6.5 6.5 10M3 6.5h6.2a3.8 3.8 0 0 1 0 7.6H7",
  redo: "M9.5 3 13 6.5 9.5 10M13 6.5H6.8a3.8 3.8 0 0 0 0 7.6H9",
  close: "M4 4l8 8M12 4l-8 8",
  search: "M7 2.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9zM10.3 10.3l3.4 3.4",
  down: "M4 6.2 8 10.2 12 6.2",
  up: "M4 9.8 8 5.8 12 9.8",
  check: "M3 8.5l3.2 3.2L13 4.8",
  file: "M4 1.8h5L12.5 5v9.2H4zM9 1.8V5h3.5",
  plus: "M8 3v10M3 8h10",
  palette: "M2.5 2.5h4.5V7H2.5zM9 2.5h4.5V7H9zM2.5 9h4.5v4.5H2.5zM9 9h4.5v4.5H9z",
  world: "M2 2.5h12v11H2zM4.8 8.5a2 2 0 1 0 4 0 2 2 0 0 0-4 0M8.8 8.5h2.4",
  drawing: "M2 2.5h6v4H2zM8 9.5h6v4H8zM5 6.5v5h3",
  inspector: "M2.5 4.5h6M11.5 4.5h2M2.5 11.5h2M7.5 11.5h6M8.5 2.5v4M4.5 9.5v4",
  text: "M2.5 3.5h7M2.5 6.5h11M2.5 9.5h9M2.5 12.5h5",
  run: "M4.5 2.8v10.4L13 8z",
  pause: "M5.5 3v10M10.5 3v10",
  stop: "M4 4h8v8H4z",
  next: "M2.5 8h7M6.6 4.8 9.8 8l-3.2 3.2M13 3v10",
  into: "M8 2v7M4.8 6.2 8 9.4l3.2-3.2M8 13v.1",
  out: "M8 9.5v-7M4.8 5.6 8 2.4l3.2 3.2M8 13v.1",
  back: "M13.5 8h-7M9.4 4.8 6.2 8l3.2 3.2M3 3v10",
  again: "M12.8 8a4.8 4.8 0 1 1-1.6-3.6M11.5 1.8v3H8.5",
  timeline: "M2 3v10.5h12M4.5 5h5M6.5 8h6M4.5 11h3",
  before: "M10 3.5 5.5 8 10 12.5M4 3.5v9",
  after: "M6 3.5 10.5 8 6 12.5M12 3.5v9",
  minus: "M3 8h10",
  fit: "M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3",
  lock: "M3.5 7.5h9v6h-9zM5.5 7.5V5a2.5 2.5 0 0 1 5 0v2.5",
  why: "M5.5 5.8a2.5 2.5 0 1 1 3.6 2.3c-.8.4-1.1.9-1.1 1.8M8 12.6v.1",
  scenarios: "M2.5 4.5l1.5 1.5 2.5-3M2.5 11l1.5 1.5 2.5-3M9 4.5h5M9 11h5",
  jobs: "M8 5.2a2.8 2.8 0 1 0 0 5.6 2.8 2.8 0 0 0 0-5.6M8 1.8v2M8 12.2v2M1.8 8h2M12.2 8h2",
  outline: "M2.5 3.5h6M5 8h6M5 12.5h8M2.5 6v6.5",
  problems: "M8 2 14.5 13.5h-13zM8 6.5v3.2M8 11.6v.1",
};

export type Icon = keyof typeof PATHS;

export const Sign = ({ name }: { name: Icon }) => (
  <svg class="sign" viewBox="0 0 16 16" width="16" height="16" aria-hidden="true">
    <path d={PATHS[name]} />
  </svg>
);

/** The icon of a severity: octagon, triangle, circle; colour is not enough. */
export const Severity = ({ of }: { of: "error" | "warning" | "note" }) => (
  <svg class={`severity ${of}`} viewBox="0 0 16 16" width="14" height="14" aria-hidden="true">
    <path d={of === "error" ? "M5.2 1h5.6L15 5.2v5.6L10.8 15H5.2L1 10.8V5.2z" : of === "warning" ? "M8 1.2 15.4 14.4H.6z" : "M8 1a7 7 0 1 0 0 14A7 7 0 0 0 8 1z"} />
    <path class="mark" d={of === "warning" ? "M8 5.8v4.2M8 12v.1" : "M8 4.4v4.4M8 11.2v.1"} />
  </svg>
);
