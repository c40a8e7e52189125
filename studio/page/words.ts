// All words that the page shows. What the engine says (messages, help, labels of edits) comes from it.

const count = (number: number, one: string, many: string): string => `${number} ${number === 1 ? one : many}`;

export const words = {
  title: (name: string) => (name ? `${name} · AFP Studio` : "AFP Studio"),
  connecting: "Connecting …",
  connectionLost: "The connection to the server was lost.",
  offline: "The connection to the server is lost. What you change is kept on this page and sent as soon as it is back.",
  watching: "Somebody else changes this folder. You watch.",
  takePen: "Change it myself",

  saved: "saved",
  saving: "saving …",
  notSaved: "not saved",
  notSavedBecause: (why: string) => `not saved: ${why}`,

  undo: (label: string | null) => (label ? `Undo: ${label}` : "Nothing to undo"),
  redo: (label: string | null) => (label ? `Redo: ${label}` : "Nothing to redo"),
  typing: "typing",
  deleting: "deleting",
  changedOutside: (name: string) => `change of ${name} by another program`,
  undoForeign: "Undo a change that is not yours?",
  undoForeignBody: (label: string) => `The last thing that happened is a ${label}. You did not make it on this page.`,
  undoIt: "Undo it",
  cancel: "Cancel",
  ok: "OK",

  conflict: (name: string) => `${name} was changed here and by another program, in the same lines. Nothing of it is written until you choose.`,
  keep: { mine: "Keep mine", theirs: "Take theirs", both: "Keep both, marked" },

  panes: "panes",
  palette: "Palette",
  drawing: "Drawing",
  inspector: "Inspector",
  text: "Text",
  problems: "Problems",
  close: (name: string) => `Close ${name}`,
  open: (name: string) => `Open ${name}`,
  resize: (name: string) => `Width of ${name}`,

  menu: "Files",
  files: "Plans in this folder",
  newPlan: "New plan …",
  examples: "Examples",
  newPlanName: "Name of the new plan",
  newPlanHint: "A file of this name is made in the folder.",
  create: "Create",
  nameTaken: (name: string) => `${name} is there already: choose another name`,
  nameWrong: "Use letters, digits and _; begin with a letter",
  plans: "Plans of this file",
  out: (plan: string) => `Out of this plan, to ${plan}`,

  ready: "ready",
  errors: (number: number) => count(number, "error", "errors"),
  warnings: (number: number) => count(number, "warning", "warnings"),
  showProblems: (said: string) => `Problems: ${said}`,
  noProblems: "No problems. The plan is ready to run.",
  severity: { error: "error", warning: "warning", note: "note" },
  fix: (title: string) => `Fix: ${title}`,
  noFix: "There is no fix that can be made at once here",
  fixes: "Fixes",

  commands: "Commands",
  findCommand: "Type the name of a command",
  noCommand: "No command has this name",
  keys: "Keys",
  keysHint: "Letters act in the drawing alone.",
  nextPane: "Next pane",
  lastPane: "Pane before",

  renameTo: (name: string) => `New name of '${name}'`,
  rename: "Rename",
  renameInText: "Rename what the cursor is at",
  renamed: (before: string, after: string) => `rename '${before}' to '${after}'`,
  noRename: "There is nothing to rename here",
  definition: "To the definition",
  noDefinition: "No definition was found",
  definitionElsewhere: "It is defined in a toolbox outside of this folder",
  format: "Format the text",

  welcome: (folder: string) => `${folder} has no plan yet`,
  welcomeBody: "Nothing is written before you choose.",
  firstPlan: "Your first plan",
  firstPlanBody: "A robot that drives until it bumps, built step by step.",
  emptyPlan: "Empty plan",
  emptyPlanBody: "A blank drawing.",
  examplesBody: "A finished plan to look at, run and change. It is copied into the folder.",

  comingDrawing: "The drawing of the plan",
  comingPalette: "What a plan can be made of",
  comingInspector: "Nothing is selected",
};

/** The text of a new plan; it is a file, not a message. */
export const planText = (name: string): string => `use carbot\n\nplan ${name} {\n}\n`;
