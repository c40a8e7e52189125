// Whose turn it is: what was asked of the engine before a press must not open anything over what that press has opened.

let presses = 0;

/** Something was pressed on the drawing. */
export const pressed = (): void => void presses++;

/** Says later whether nothing has been pressed since. */
export function turn(): () => boolean {
  const mine = presses;
  return () => mine === presses;
}
