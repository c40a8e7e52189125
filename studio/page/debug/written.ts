// Waits until files are written, since a run reads the disk.
import { saved } from "../documents/documents";

/** Waits a limited time until the server has written everything. */
export function isWritten(): Promise<boolean> {
  return new Promise((done) => {
    let end = (): void => {};
    const timer = setTimeout(() => {
      end();
      done(false);
    }, 3000);
    end = saved.subscribe((now) => {
      if (now !== "saved") return;
      clearTimeout(timer);
      queueMicrotask(() => end());
      done(true);
    });
  });
}
