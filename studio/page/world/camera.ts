// The robot's camera picture, requested after the last one has arrived, so that no pictures queue
// up.
import { signal } from "@preact/signals";
import { active, ask } from "../debug/run";

export interface Picture {
  at: number;
  width: number;
  height: number;
  /** A byte each for red, green and blue. */
  rgb: string;
}

/** Whether the picture is shown. */
export const watched = signal(false);
/** Milliseconds between requests. */
const PERIOD = 150;

export function pixels({ width, height, rgb }: Picture): ImageData {
  const bytes = Uint8Array.from(atob(rgb), (letter) => letter.charCodeAt(0));
  const image = new ImageData(width, height);
  for (let at = 0; at < width * height; at++) image.data.set([bytes[3 * at]!, bytes[3 * at + 1]!, bytes[3 * at + 2]!, 255], 4 * at);
  return image;
}

/** Shows pictures on a canvas until the returned function is called. */
export function show(canvas: HTMLCanvasElement): () => void {
  let over = false;
  const look = async (): Promise<void> => {
    const picture = active.peek() ? await ask<Picture>("afp/picture") : null;
    if (over) return;
    if (picture) {
      [canvas.width, canvas.height] = [picture.width, picture.height];
      canvas.getContext("2d")!.putImageData(pixels(picture), 0, 0);
    }
    setTimeout(() => void look(), PERIOD);
  };
  void look();
  return () => {
    over = true;
  };
}
