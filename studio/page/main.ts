// Starts the page: connection, screen, open file.
import { effect } from "@preact/signals";
import { h, render } from "preact";
import { register } from "./screen/actions";
import { listen } from "./screen/commands";
import * as breakpoints from "./debug/breakpoints";
import * as run from "./debug/controls";
import { begin as beginCurves } from "./debug/curves";
import { begin as beginFollowing } from "./debug/following";
import { begin as beginGone } from "./debug/gone";
import { begin as beginRobot } from "./debug/robot";
import { begin as beginRuns, log } from "./debug/run";
import { begin as beginWhy } from "./debug/why";
import { ask } from "./screen/dialogs";
import * as documents from "./documents/documents";
import { begin as beginFolded } from "./drawing/folded";
import { begin as beginShown } from "./drawing/kept";
import { follow } from "./drawing/model";
import * as guide from "./plan/guide";
import { begin as beginJobs } from "./jobs/jobs";
import * as keep from "./documents/keep";
import * as layout from "./screen/layout";
import { connect } from "./server/lsp";
import { showFirst } from "./panes/files";
import { begin as beginForm } from "./panes/jobs";
import { follow as followRoom } from "./world/room";
import { begin as beginWorld } from "./world/surroundings";
import * as places from "./plan/places";
import * as problems from "./plan/problems";
import { resume } from "./jobs/results";
import { Screen } from "./screen/screen";
import { begin, hello } from "./server/session";
import { begin as beginUnsent } from "./documents/unsent";
import { words } from "./words";

const scheme = location.protocol === "https:" ? "wss" : "ws";
begin(`${scheme}://${location.host}/lsp`, documents.again, connect, sessionStorage);
documents.begin(ask);
problems.begin();
places.begin();
follow();
layout.begin(localStorage);
register();
run.commands();
breakpoints.begin(localStorage);
beginFolded(sessionStorage);
beginRuns();
beginRobot(window);
beginFollowing();
beginGone(sessionStorage);
beginForm(sessionStorage);
beginWorld();
followRoom();
beginWhy();
beginCurves();
beginJobs(resume);
guide.begin();
beginUnsent(localStorage);
listen(window);
render(h(Screen, {}), document.getElementById("page")!);
effect(() => {
  const file = documents.current.value && documents.nameOf(documents.current.value);
  document.title = words.title(log.value ? words.logShown(log.value.split("/").at(-1)!) : file);
});
const begun = hello.subscribe((said) => {
  if (!said) return;
  // After `subscribe` has returned its end function.
  queueMicrotask(() => {
    begun();
    void showFirst().then(() => {
      beginShown(sessionStorage);
      return keep.begin(sessionStorage);
    });
  });
});
