//! The operator of a run with several clients: one at a time; each client can end the run.
//!
//! A client can put its role under a lease. The adapter then asks it five times a second, and the
//! client answers. A connection may stay open after its user is cut off, and a page may be hidden;
//! only answers prove presence.

use std::time::Duration as Wall;

use dapts::{BreakpointEventReason as Changed, StoppedEventReason as Reason, event};
use serde::Deserialize;
use serde_json::{Value, json};

use super::clients::Lease;
use super::launch::{Of, capabilities};
use super::{Adapter, Answer, ClientId, Refusal};

/// The interval of questions to the operator.
const ASK: Wall = Wall::from_millis(200);
/// The longest time without an answer, counting only time in which an answer could arrive.
const SILENT: Wall = Wall::from_secs(3);
/// The longest time without an answer during a step of the operator.
const SILENT_IN_A_STEP: Wall = Wall::from_millis(500);
/// The most time counted between two calls. Beyond it, the adapter or its owner was busy.
const LOOK: Wall = Wall::from_millis(100);

/// Commands that change a run or let time pass.
const STEERS: &[&str] = &[
    "afp/drop",
    "afp/fault",
    "afp/force",
    "afp/fork",
    "afp/move",
    "afp/press",
    "afp/release",
    "afp/seek",
    "afp/speed",
    "continue",
    "goto",
    "next",
    "pause",
    "restart",
    "reverseContinue",
    "setExpression",
    "setVariable",
    "stepBack",
    "stepIn",
    "stepOut",
];

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Wanted {
    take: Option<String>,
    release: bool,
    /// Whether to put the role under a lease.
    lease: bool,
}

impl Adapter<'_> {
    /// Takes or releases the operator's role, and returns all roles.
    pub(super) fn role(&mut self, wanted: Wanted, now: Wall) -> Answer<Value> {
        self.run()?;
        match wanted.take.as_deref() {
            Some("operator") => self.take_role(wanted.lease, now),
            Some(other) => {
                return Err(Refusal(format!("'{other}' is not a role: write 'operator'")));
            }
            None if wanted.release && self.operator == Some(self.asker) => {
                self.operator = None;
                self.send_capabilities(self.asker);
            }
            None => {}
        }
        self.send_roles();
        Ok(self.roles(self.asker))
    }

    /// Makes the asking client the operator.
    pub(super) fn take_role(&mut self, lease: bool, now: Wall) {
        let (asker, before) = (self.asker, self.operator);
        // The operator of a robot that drives must prove its presence.
        let lease = lease || self.run.as_ref().is_some_and(|run| run.target.is_live());
        self.operator = Some(asker);
        if let Some(client) = self.clients.get_mut(&asker) {
            client.lease = lease.then_some(Lease { asked: now, open: None });
        }
        if before != Some(asker) {
            before.into_iter().chain([asker]).for_each(|id| self.send_capabilities(id));
        }
    }

    /// Checks that the asking client may send a command. The first user of a free role takes it.
    pub(super) fn may(&mut self, command: &str, now: Wall) -> Answer<()> {
        if !STEERS.contains(&command) || self.run.is_none() {
            return Ok(());
        }
        match self.operator {
            Some(operator) if operator == self.asker => {}
            Some(operator) => {
                let name = self.name_of(operator);
                return Err(Refusal(format!(
                    "{name} operates this run: send 'afp/role' with \"take\": \"operator\" to take over, or 'terminate' to end it"
                )));
            }
            None => {
                self.take_role(false, now);
                self.send_roles();
            }
        }
        Ok(())
    }

    pub(super) fn send_capabilities(&mut self, id: ClientId) {
        let Some(run) = &self.run else { return };
        let capabilities = capabilities(self.operator == Some(id), Of::target(&*run.target));
        self.event_to::<event::Capabilities>(id, &dapts::CapabilitiesEvent { capabilities });
    }

    fn roles(&self, to: ClientId) -> Value {
        let attached = self.clients.iter().filter(|(_, client)| client.attached);
        let clients: Vec<_> =
            attached.map(|(id, it)| json!({"id": id.number(), "name": it.name})).collect();
        json!({"operator": self.operator.map(ClientId::number), "you": to.number(), "clients": clients})
    }

    /// Sends all roles to clients that know AFP's events.
    pub(super) fn send_roles(&mut self) {
        let those = self.clients.iter().filter(|(_, client)| client.attached && client.ours);
        for to in those.map(|(id, _)| *id).collect::<Vec<_>>() {
            let roles = self.roles(to);
            self.send_event(to, "afp/role", roles);
        }
    }

    /// Ends the operator's role: its forces are released, and its step ends here.
    pub(super) fn lose_operator(&mut self, why: &str) {
        let Some(lost) = self.operator.take() else { return };
        let why = format!("{} {why}", self.name_of(lost));
        if let Some(client) = self.clients.get_mut(&lost) {
            client.lease = None;
        }
        self.forget_breakpoints(lost);
        let Some(run) = &mut self.run else { return };
        run.forces.clear();
        let steps = run.mode.is_step();
        let live = run.target.is_live();
        self.output("important", &format!("{why}: this run has no operator\n"));
        match steps {
            true if live => self.hold_without_operator(),
            true => self.stopped(Reason::Pause, &why, Vec::new()),
            // A stopped run stays stopped, and a running one continues.
            false => self.send_state(),
        }
        self.send_capabilities(lost);
        self.send_roles();
    }

    /// Removes a client's breakpoints and informs the other clients.
    pub(super) fn forget_breakpoints(&mut self, owner: ClientId) {
        let gone = self.breakpoints.forget(owner);
        let Some(program) = self.run.as_ref().map(|run| run.target.program().clone()) else {
            return;
        };
        self.send_breakpoints(owner, Changed::Removed, &gone, &program);
    }

    pub(super) fn on_lease_answer(&mut self, from: ClientId) {
        let client = self.clients.get_mut(&from);
        if let Some(lease) = client.and_then(|client| client.lease.as_mut()) {
            lease.open = None;
        }
    }

    /// Adds time in which the operator could answer. It is limited to the interval between two
    /// checks, because a slow call delays answers that have already arrived.
    pub(super) fn listen_for_lease(&mut self, now: Wall) {
        let passed = now.saturating_sub(std::mem::replace(&mut self.called, now)).min(LOOK);
        let client = self.operator.and_then(|operator| self.clients.get_mut(&operator));
        let lease = client.and_then(|client| client.lease.as_mut());
        if let Some(open) = lease.and_then(|lease| lease.open.as_mut()) {
            *open += passed;
        }
    }

    /// Asks the operator for its lease answer, and ends the role after a long silence.
    pub(super) fn check_lease(&mut self, now: Wall) {
        let Some(operator) = self.operator else { return };
        let steps = self.run.as_ref().is_some_and(|run| run.mode.is_step());
        let client = self.clients.get_mut(&operator);
        let Some(lease) = client.and_then(|client| client.lease.as_mut()) else { return };
        let most = if steps { SILENT_IN_A_STEP } else { SILENT };
        if lease.open.is_some_and(|open| open > most) {
            return self.lose_operator("does not answer");
        }
        if now.saturating_sub(lease.asked) >= ASK {
            lease.asked = now;
            lease.open.get_or_insert_default();
            let question = json!({"type": "request", "command": "afp/lease"});
            self.out.push((operator, question));
        }
    }

    /// The time of the next check of a lease.
    pub(super) fn lease_due(&self) -> Option<Wall> {
        let client = self.clients.get(&self.operator?)?;
        client.lease.map(|_| LOOK)
    }
}
