// Turns: the answer to an older request must not open anything over a newer press.

let presses = 0;

/** Counts a press on the drawing. */
export const pressed = (): void => void presses++;

/** Returns a function that tells whether there was no press since. */
export function turn(): () => boolean {
  const mine = presses;
  return () => mine === presses;
}
