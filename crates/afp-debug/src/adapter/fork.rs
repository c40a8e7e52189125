//! Runs that continue another run: with a changed text, or a log in the simulator.

use std::time::Duration as Wall;

use serde::Deserialize;

use super::mode::{Mode, Pace};
use super::{Adapter, Answer, Fork, Launch};

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Wanted {
    /// The file with the plan of a log; by default the text in the log counts.
    program: String,
}

impl Adapter<'_> {
    /// Starts the run again with the current text, repeats its requests, and goes to the same
    /// instant. If the text has an equal meaning, the run is in the same state.
    ///
    /// A log continues in the simulator.
    pub(super) fn fork(&mut self, wanted: Wanted, now: Wall) -> Answer<()> {
        let run = self.run()?;
        if run.target.is_recorded() {
            return self.fork_log(wanted.program, now);
        }
        if run.launch.is_fork {
            return Err(
                "this run continues a log: open the log again to continue it with another text"
                    .into(),
            );
        }
        let (at, speed) = (run.target.now(), run.pace.factor);
        let (launch, traced) = (run.launch.clone(), run.traced.is_some());
        // The host makes the requests before the start again.
        let requests = run.target.requests().into_iter().skip(launch.set.len());
        let requests: Vec<_> = requests.take_while(|(asked, _)| *asked <= at).collect();
        let goes_on = !matches!(run.mode, Mode::Held | Mode::Over);
        self.begin(Launch { stop_on_entry: true, ..launch.clone() }, now)?;
        let run = self.run()?;
        (run.launch, run.traced) = (launch, traced.then(Vec::new));
        run.pace = Pace::new(speed, run.target.now(), now);
        for (asked, what) in requests {
            run.target.repeat(asked, &what)?;
        }
        let program = run.target.program().clone();
        run.has_begun = true;
        run.mode = Mode::Seek { to: at, goes_on };
        self.find_breakpoints(&program);
        Ok(())
    }

    /// Continues a log in the simulator, from its present moment.
    pub(super) fn fork_log(&mut self, program: String, now: Wall) -> Answer<()> {
        let run = self.run.as_ref().ok_or("nothing runs yet: send 'launch' first")?;
        let launch = Launch { program, ..run.launch.clone() };
        let (at, target) = (run.target.now(), &run.target);
        let (program, state, pose) = (target.program(), target.state(), target.pose());
        let fork = Fork { launch: &launch, at, program, state, pose };
        let (target, notes) = self.host.fork(&fork)?;
        let Launch { program, speed, .. } = launch;
        let launch = Launch { program, speed, is_fork: true, ..Launch::default() };
        self.begin_with(target, launch, now);
        let traced = self.clients.values().any(|client| client.attached && client.trace);
        let run = self.run()?;
        run.traced = traced.then(Vec::new);
        run.has_begun = true;
        run.mode = Mode::Seek { to: at, goes_on: false };
        let program = run.target.program().clone();
        self.find_breakpoints(&program);
        for id in self.attached().collect::<Vec<_>>() {
            self.send_capabilities(id);
        }
        for note in notes {
            self.output("console", &format!("{note}\n"));
        }
        Ok(())
    }
}
