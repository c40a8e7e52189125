// Turns: the answer to an older request must not open anything over a newer press.

let presses = 0;

/** Something was pressed on the drawing. */
export const pressed = (): void => void presses++;

/** Says later whether nothing has been pressed since. */
export function turn(): () => boolean {
  const mine = presses;
  return () => mine === presses;
}
