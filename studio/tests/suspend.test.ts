// An element that is set aside: striped in the drawing, with the time since when.
import { inBrowser } from "./browser";

const PLAN = `use std

plan P {
    start work

    actor work: Wait(duration = 60 s) {
        supervise late: CheckTimeout(duration = 500 ms) { TimedOut -> suspend handle }
        Elapsed -> terminate
    }

    actor handle: Wait(duration = 3 s) { Elapsed -> return }
}
`;

inBrowser("a suspended element is striped and shows the time of its suspension until it continues", { "plan.afp": PLAN }, async ({ page }) => {
  await page.locator('.node [data-item="P.work"]').first().waitFor();
  await page.keyboard.press("F5");
  await page.locator('.node.active [data-item="P.handle"]').first().waitFor();
  await page.locator(".run-aside").waitFor({ state: "attached" });
  await page.locator("text.run-place-text.aside", { hasText: "⏸ since 0.5 s" }).waitFor();
  await page.getByLabel("Speed").selectOption("5");
  await page.locator('.node.active [data-item="P.work"]').first().waitFor();
  await page.waitForFunction(() => !document.querySelector(".run-aside"));
});
