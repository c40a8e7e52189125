//! From the first message to the start of a run, and its end.

use std::collections::BTreeMap;
use std::time::Duration as Wall;

use afp_core::trace::ComponentId;
use afp_core::{Duration, Instant};
use dapts::{StoppedEventReason as Reason, event};
use serde::Deserialize;
use serde_json::{Value, json};

use super::clients::Counting;
use super::mode::{By, Mode, Pace, STATES};
use super::stop::stopped_event;
use super::{Adapter, Answer, Guard, Refusal, Run, parse};
use crate::target::{Position, Target};

/// The arguments of `launch`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub struct Launch {
    /// The plan's file; append `:Plan` to select a plan other than the first.
    pub program: String,
    /// The log of a recorded run, to show instead of a new run.
    pub log: Option<String>,
    /// The world; the default is the plan's.
    pub world: Option<String>,
    /// The start of the robot, in metres and radians; the default is the world's.
    pub start: Option<[f64; 3]>,
    /// The seed of all noise; the default is 0.
    pub seed: Option<u64>,
    /// Values for `in` entries with units, `"30 cm"`.
    pub set: BTreeMap<String, String>,
    /// The time limit in seconds from the start; the default is none.
    pub until: Option<f64>,
    /// The speed as a multiple of real time; the default is unlimited.
    pub speed: Option<f64>,
    /// Whether the run stops before its first step.
    pub stop_on_entry: bool,
    /// Whether breakpoints are disabled.
    pub no_debug: bool,
    /// The second of the log at which a simulation continues, with the text of `program` or of the
    /// log.
    pub at: Option<f64>,
    /// The token of a guarded adapter.
    pub token: Option<String>,
    /// Whether the run has continued from a log.
    #[serde(skip)]
    pub is_fork: bool,
}

/// The arguments of `attach`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Attach {
    /// The token of a guarded adapter.
    token: Option<String>,
    /// `operator` takes over; by default the client only watches.
    role: Option<String>,
    /// Whether the client puts its role under a lease.
    lease: bool,
}

/// The exceptions that can stop a run.
const FILTERS: [(&str, &str, bool); 5] = [
    ("fault", "A component fails", true),
    ("deadlineMissed", "A deadline is missed", false),
    ("interruption", "An element is interrupted", false),
    ("livelock", "Edges are taken without time passing", false),
    ("collision", "The robot touches something, in the simulator", false),
];

/// The capabilities for a client: a recorded run cannot change, a robot that drives cannot go back,
/// and an observer cannot change a run.
pub(super) fn capabilities(steers: bool, of: Of) -> dapts::Capabilities {
    let changes = Some(steers && of != Of::Log);
    let turns_back = Some(steers && of != Of::Robot);
    dapts::Capabilities {
        supports_goto_targets_request: Some(steers && of == Of::Simulation),
        supports_restart_request: turns_back,
        supports_set_expression: changes,
        supports_set_variable: changes,
        supports_step_back: turns_back,
        ..dapts::Capabilities::default()
    }
}

/// The kind of a run, which decides what clients can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    Simulation,
    Log,
    /// A run whose time passes by itself.
    Robot,
}

impl Of {
    pub(super) fn target(target: &dyn Target) -> Of {
        match (target.is_recorded(), target.is_live()) {
            (true, _) => Of::Log,
            (false, true) => Of::Robot,
            (false, false) => Of::Simulation,
        }
    }
}

impl<'h> Adapter<'h> {
    pub(super) fn initialize(
        &mut self,
        client: dapts::InitializeRequestArguments,
    ) -> Answer<dapts::Capabilities> {
        let first = |from_one: Option<bool>| u32::from(from_one.unwrap_or(true));
        let counting = Counting {
            first_line: first(client.lines_start_at1),
            first_column: first(client.columns_start_at1),
        };
        let name = client.client_name.or(client.client_id);
        if let Some(known) = self.clients.get_mut(&self.asker) {
            known.counting = counting;
            known.names_uris =
                client.path_format == Some(dapts::InitializeRequestArgumentsPathFormat::Uri);
            known.name = name.filter(|name| !name.is_empty()).unwrap_or(known.name.clone());
        }
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
            supports_stepping_granularity: yes,
            support_terminate_debuggee: yes,
            supports_terminate_request: yes,
            ..capabilities(true, Of::Simulation)
        })
    }

    pub(super) fn launch(&mut self, launch: Launch, now: Wall) -> Answer<Value> {
        self.admit(launch.token.as_deref())?;
        if self.run.is_some() {
            return Err(
                "a plan already runs: 'restart' starts it again, 'attach' joins its run".into()
            );
        }
        check(&launch)?;
        let (at, program) = (launch.at, launch.program.clone());
        self.begin(launch, now)?;
        self.take_part();
        self.operator = Some(self.asker);
        if let Some(at) = at {
            self.run()?.target.seek(Position::At(Instant::ZERO + Duration::from_secs_f64(at)))?;
            if let Err(why) = self.fork_log(program, now) {
                // There is no run.
                (self.run, self.operator) = (None, None);
                return Err(why);
            }
        }
        if self.run()?.target.is_recorded() {
            let capabilities = capabilities(true, Of::Log);
            self.event::<event::Capabilities>(&dapts::CapabilitiesEvent { capabilities });
        }
        self.event_to::<event::Initialized>(self.asker, &None);
        // Some breakpoints may come from an earlier run of a different program.
        let program = self.run()?.target.program().clone();
        self.find_breakpoints(&program);
        self.send_roles();
        self.begun()
    }

    /// Joins a run.
    pub(super) fn attach(&mut self, attach: Attach, now: Wall) -> Answer<Value> {
        self.admit(attach.token.as_deref())?;
        match attach.role.as_deref() {
            None | Some("observer" | "operator") => {}
            Some(other) => {
                return Err(Refusal(format!(
                    "'{other}' is not a role: write 'observer' or 'operator'"
                )));
            }
        }
        let of = Of::target(&*self.run()?.target);
        self.take_part();
        match attach.role.as_deref() {
            Some("operator") => self.take_role(attach.lease, now),
            _ => {
                let capabilities = capabilities(false, of);
                let body = dapts::CapabilitiesEvent { capabilities };
                self.event_to::<event::Capabilities>(self.asker, &body);
            }
        }
        self.event_to::<event::Initialized>(self.asker, &None);
        let program = self.run()?.target.program().clone();
        let others = self.breakpoints.of_others(self.asker);
        let others: Vec<_> = others.map(|(owner, each)| (owner, each.clone())).collect();
        for (owner, each) in others {
            self.send_breakpoint(
                self.asker,
                owner,
                dapts::BreakpointEventReason::New,
                &each,
                &program,
            );
        }
        self.send_roles();
        self.begun()
    }

    /// Admits the asking client.
    ///
    /// # Errors
    /// The token is wrong, or the number of clients is at its limit.
    fn admit(&mut self, told: Option<&str>) -> Answer<()> {
        if let Some(Guard { token, most }) = &self.guard {
            if !token.is(told.unwrap_or_default()) {
                return Err("'token' must be the token that 'afpc dap' printed".into());
            }
            if !self.is_admitted(self.asker) && self.admitted().count() >= *most {
                return Err(Refusal(format!(
                    "{most} clients are already connected: end one first"
                )));
            }
        }
        if let Some(client) = self.clients.get_mut(&self.asker) {
            client.admitted = true;
        }
        Ok(())
    }

    /// Attaches the asking client to the run's events.
    fn take_part(&mut self) {
        if let Some(client) = self.clients.get_mut(&self.asker) {
            client.attached = true;
        }
    }

    fn begun(&mut self) -> Answer<Value> {
        let program = self.run()?.target.program();
        let plan = program.units.first();
        let file = plan.and_then(|plan| program.files.get(plan.at.file));
        Ok(json!({"plan": plan.map(|plan| &plan.name), "file": file, "files": program.files}))
    }

    pub(super) fn begin(&mut self, launch: Launch, now: Wall) -> Answer<()> {
        let target = self.host.launch(&launch)?;
        self.begin_with(target, launch, now);
        Ok(())
    }

    /// Begins a run.
    pub(super) fn begin_with(&mut self, target: Box<dyn Target + 'h>, launch: Launch, now: Wall) {
        let pace = Pace::new(launch.speed, target.now(), now);
        let nanos = launch.until.map(Duration::from_secs_f64);
        let end = nanos.map_or(Instant::MAX, |until| target.now() + until);
        self.run = Some(Run {
            target,
            launch,
            mode: Mode::Held,
            pace,
            transitions: Vec::new(),
            exception: None,
            traced: None,
            touched: None,
            has_begun: false,
            end,
            forces: Vec::new(),
            ended_by: None,
            hit: None,
            next_state: now + STATES,
        });
    }

    /// Starts the run after a client's configuration; a client that joined receives the stopped
    /// state instead.
    pub(super) fn configured(&mut self, now: Wall) -> Answer<()> {
        let (asker, is_operator) = (self.asker, self.operator == Some(self.asker));
        let run = self.run()?;
        if run.has_begun {
            if run.mode == Mode::Held {
                let at = run.target.now();
                let body = stopped_event(Reason::Pause, "held", at, Vec::new());
                self.event_to::<event::Stopped>(asker, &body);
            }
            return Ok(());
        }
        if is_operator { self.start(now) } else { Ok(()) }
    }

    fn start(&mut self, now: Wall) -> Answer<()> {
        let run = self.run()?;
        run.has_begun = true;
        let (held, kept) = (run.launch.stop_on_entry, run.target.is_kept());
        for warning in run.target.warnings().to_vec() {
            self.output("console", &format!("warning: {warning}\n"));
        }
        if !kept {
            self.output("console", "the robot or a component cannot be copied: going back repeats the run from the start\n");
        }
        match held {
            true => self.stopped(Reason::Entry, "before the first step", Vec::new()),
            false => self.go(Mode::On, now)?,
        }
        Ok(())
    }

    /// Starts the run again with the current text, and with new arguments if the client gives some.
    pub(super) fn restart(&mut self, arguments: &Value, now: Wall) -> Answer<()> {
        let run = self.run()?;
        let traced = run.traced.is_some();
        let launch = again(arguments)?.unwrap_or_else(|| run.launch.clone());
        let launch = Launch { is_fork: false, ..launch };
        check(&launch)?;
        self.begin(launch, now)?;
        let run = self.run()?;
        run.traced = traced.then(Vec::new);
        let program = run.target.program().clone();
        self.find_breakpoints(&program);
        self.start(now)
    }

    /// Ends the plan, stops the robot and sends the result to all clients.
    pub(super) fn terminate(&mut self) -> Answer<()> {
        if self.run.as_ref().is_some_and(|run| run.target.is_live()) {
            return self.stop_live();
        }
        let Some(mut run) = self.run.take() else { return Ok(()) };
        let mut said = Vec::new();
        run.target.stop(&mut |happened, _| said.push(happened.clone()));
        if run.mode != Mode::Over {
            said.iter().for_each(|happened| self.say(&run, happened));
            run.keep_trace(&said);
            self.send_trace(&mut run);
            let by = By::Client(self.name_of(self.asker).to_owned());
            self.ended(&run, &by);
        }
        self.operator = None;
        self.clients.values_mut().for_each(|client| client.attached = false);
        Ok(())
    }

    /// Disconnects a client. The run continues for the others, unless a client in the run asks to
    /// end it.
    pub(super) fn disconnect(&mut self, asked: dapts::DisconnectArguments) -> Answer<()> {
        let asker = self.asker;
        // Every client at the port can disconnect; ending the run needs the token.
        let may_end = self.guard.is_none() || self.takes_part();
        if let Some(client) = self.clients.get_mut(&asker) {
            client.over = true;
        }
        self.detach(asker);
        if asked.terminate_debuggee == Some(true) && may_end {
            self.terminate()?;
        }
        Ok(())
    }

    pub(super) fn set_filters(
        &mut self,
        asked: dapts::SetExceptionBreakpointsArguments,
    ) -> Answer<()> {
        let names = FILTERS.map(|(name, ..)| name);
        let known = |asked: &String| {
            let unknown = || format!("unknown name '{asked}'; known names: {}", names.join(", "));
            names.into_iter().find(|name| *name == asked).ok_or_else(unknown)
        };
        let filters = asked.filters.iter().map(known).collect::<Result<_, _>>()?;
        self.breakpoints.set_filters(self.asker, filters);
        Ok(())
    }
}

/// Returns the arguments of a restart, if given. A client that joined sends its `attach` arguments.
///
/// # Errors
/// The arguments are invalid.
fn again(arguments: &Value) -> Answer<Option<Launch>> {
    let said = &arguments["arguments"];
    let names = |key: &str| !matches!(&said[key], Value::Null) && said[key] != "";
    (names("program") || names("log")).then(|| parse(said.clone())).transpose()
}

/// # Errors
/// The reason if the arguments of `launch` contradict each other.
fn check(launch: &Launch) -> Answer<()> {
    if launch.speed.is_some_and(|speed| !(speed > 0.0 && speed.is_finite())) {
        return Err("'speed' is a number above 0; leave it out for full speed".into());
    }
    if launch.until.is_some_and(|until| !(until > 0.0 && until < 1e9)) {
        return Err("'until' is a number of seconds above 0; leave it out for no end".into());
    }
    if launch.at.is_some_and(|at| launch.log.is_none() || !(0.0..1e9).contains(&at)) {
        return Err("'at' is a second of a 'log'".into());
    }
    let fresh = launch.world.is_some()
        || launch.start.is_some()
        || launch.seed.is_some()
        || !launch.set.is_empty()
        || launch.until.is_some();
    match &launch.log {
        None if launch.program.is_empty() => {
            return Err(
                "'program' must be the file of a plan, or 'log' the log of a finished run".into()
            );
        }
        Some(_) if fresh => {
            return Err(
                "a log cannot be changed: leave out 'world', 'start', 'seed', 'set' and 'until'"
                    .into(),
            );
        }
        _ => {}
    }
    Ok(())
}

/// The thread number of the flow of action.
pub(super) const FLOW: ComponentId = ComponentId(0);
