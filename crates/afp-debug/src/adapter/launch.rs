//! From the first message to the start of a run, and its end.

use std::collections::BTreeMap;
use std::time::Duration as Wall;

use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant};
use dapts::event;
use serde::Deserialize;
use serde_json::{Value, json};

use super::steer::{Mode, Pace};
use super::{Adapter, Answer, Refusal, Run};
use crate::breakpoints::Filters;

/// What is to be run, and how.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Launch {
    /// The plan's file; `FILE:Plan` for another than its first.
    #[serde(default)]
    pub program: String,
    /// The log of a run that is over, to be looked at in place of a run.
    #[serde(default)]
    pub log: Option<String>,
    /// The world; without one that of the plan.
    #[serde(default)]
    pub world: Option<String>,
    /// Where the robot starts, metres and radians; without it where the world says.
    #[serde(default)]
    pub start: Option<[f64; 3]>,
    /// The seed of all noise.
    #[serde(default)]
    pub seed: u64,
    /// Values for `in` entries as people write them, `"30 cm"`.
    #[serde(default)]
    pub set: BTreeMap<String, String>,
    /// When the plan is stopped at the latest, seconds from the start; never without it.
    #[serde(default)]
    pub until: Option<f64>,
    /// How fast time passes, as a multiple of that on the wall; without it as fast as it can be computed.
    #[serde(default)]
    pub speed: Option<f64>,
    /// Whether the run stands still before its first step.
    #[serde(default)]
    pub stop_on_entry: bool,
    /// Whether breakpoints hold it.
    #[serde(default)]
    pub no_debug: bool,
    /// What a client has to know that was not started by the same person.
    #[serde(default)]
    pub token: Option<String>,
}

/// What can go wrong that a run may be held at.
const FILTERS: [(&str, &str, bool); 3] = [
    ("fault", "A component fails", true),
    ("deadlineMissed", "A deadline is missed", false),
    ("interruption", "An element is interrupted", false),
];

impl Adapter<'_> {
    pub(super) fn initialize(
        &mut self,
        client: dapts::InitializeRequestArguments,
    ) -> Answer<dapts::Capabilities> {
        let first = |from_one: Option<bool>| u32::from(from_one.unwrap_or(true));
        self.client.first_line = first(client.lines_start_at1);
        self.client.first_column = first(client.columns_start_at1);
        let filter =
            |(filter, label, default): (&str, &str, bool)| dapts::ExceptionBreakpointsFilter {
                filter: filter.to_owned(),
                label: label.to_owned(),
                default: Some(default),
                condition_description: None,
                description: None,
                supports_condition: None,
            };
        let yes = Some(true);
        Ok(dapts::Capabilities {
            exception_breakpoint_filters: Some(FILTERS.map(filter).to_vec()),
            supports_conditional_breakpoints: yes,
            supports_configuration_done_request: yes,
            supports_breakpoint_locations_request: yes,
            supports_data_breakpoints: yes,
            supports_evaluate_for_hovers: yes,
            supports_exception_info_request: yes,
            supports_function_breakpoints: yes,
            supports_hit_conditional_breakpoints: yes,
            supports_log_points: yes,
            supports_restart_request: yes,
            supports_set_variable: yes,
            supports_step_back: yes,
            supports_stepping_granularity: yes,
            supports_terminate_request: yes,
            ..dapts::Capabilities::default()
        })
    }

    pub(super) fn launch(&mut self, launch: Launch, now: Wall) -> Answer<Value> {
        if self.run.is_some() {
            return Err("a plan runs already: 'restart' begins it again".into());
        }
        let told = launch.token.as_deref().unwrap_or_default();
        if self.token.as_ref().is_some_and(|token| !token.is(told)) {
            return Err("'token' is the one that 'afpc dap' printed".into());
        }
        if launch.speed.is_some_and(|speed| !(speed > 0.0 && speed.is_finite())) {
            return Err("'speed' is a number above 0; leave it out for as fast as can be".into());
        }
        if launch.until.is_some_and(|until| !(until > 0.0 && until < 1e9)) {
            return Err("'until' is a number of seconds above 0; leave it out for no end".into());
        }
        let fresh = launch.world.is_some()
            || launch.start.is_some()
            || !launch.set.is_empty()
            || launch.until.is_some();
        match &launch.log {
            None if launch.program.is_empty() => {
                return Err(
                    "'program' is the file of the plan; 'log' is that of a run that is over".into(),
                );
            }
            Some(_) if fresh => {
                return Err(
                    "a log is run again as it was: leave 'world', 'start', 'set' and 'until' out"
                        .into(),
                );
            }
            _ => {}
        }
        self.begin(launch, now)?;
        if self.run()?.target.is_recorded() {
            let capabilities =
                dapts::Capabilities { supports_set_variable: Some(false), ..Default::default() };
            self.event::<event::Capabilities>(&dapts::CapabilitiesEvent { capabilities });
        }
        self.event::<event::Initialized>(&None);
        let program = self.run()?.target.program();
        let plan = program.units.first();
        let file = plan.and_then(|plan| program.files.get(plan.at.file));
        Ok(json!({"plan": plan.map(|plan| &plan.name), "file": file}))
    }

    fn begin(&mut self, launch: Launch, now: Wall) -> Answer<()> {
        let target = self.host.launch(&launch)?;
        let pace = Pace::new(launch.speed, target.now(), now);
        let nanos = launch.until.map(|until| Duration::from_nanos((until * 1e9) as u64));
        let end = nanos.map_or(Instant::MAX, |until| target.now() + until);
        self.run = Some(Run {
            target,
            launch,
            mode: Mode::Held,
            pace,
            transitions: Vec::new(),
            exception: None,
            told: false,
            traced: None,
            told_at: now,
            end,
            forces: Vec::new(),
        });
        Ok(())
    }

    pub(super) fn configured(&mut self, now: Wall) -> Answer<Value> {
        let run = self.run()?;
        match run.launch.stop_on_entry {
            true => {
                self.stopped(dapts::StoppedEventReason::Entry, "before the first step", Vec::new())
            }
            false => self.go(Mode::On, now)?,
        }
        Ok(Value::Null)
    }

    pub(super) fn restart(&mut self, now: Wall) -> Answer<Value> {
        let launch = self.run()?.launch.clone();
        let (told, traced) = (self.run()?.told, self.run()?.traced.is_some());
        self.begin(launch, now)?;
        let run = self.run()?;
        (run.told, run.traced) = (told, traced.then(Vec::new));
        self.configured(now)
    }

    /// Stops the robot; a client that only wants the plan to end is told how it ended.
    pub(super) fn stop(&mut self, command: &str) -> Answer<Value> {
        if let Some(mut run) = self.run.take() {
            let mut said = Vec::new();
            run.target.stop(&mut |happened, _| said.push(happened.clone()));
            if command == "terminate" && run.mode != Mode::Over {
                said.iter().for_each(|happened| self.say(&run, happened));
                run.keep_trace(&said);
                self.tell_trace(&mut run);
                self.ended(&run);
            }
        }
        self.over = command == "disconnect";
        Ok(Value::Null)
    }

    pub(super) fn set_filters(
        &mut self,
        asked: &dapts::SetExceptionBreakpointsArguments,
    ) -> Answer<Value> {
        let mut filters = Filters::default();
        for name in &asked.filters {
            match &**name {
                "fault" => filters.fault = true,
                "deadlineMissed" => filters.deadline_missed = true,
                "interruption" => filters.interruption = true,
                other => {
                    let known = FILTERS.map(|(name, ..)| name).join(", ");
                    return Err(Refusal(format!("nothing is called '{other}'; there are {known}")));
                }
            }
        }
        self.breakpoints.filters = filters;
        Ok(Value::Null)
    }
}

/// The number of the thread that is the flow of action.
pub(super) const FLOW: ComponentId = ComponentId(0);
