//! Who steers a run, where several watch it: one at a time; anybody may end it.
//!
//! A client may put its role under a lease: it is asked five times a second whether it is still there, and answers. A
//! connection may stay open long after the person behind it is cut off, a page may be hidden; answers tell.

use std::time::Duration as Wall;

use dapts::{BreakpointEventReason as Changed, StoppedEventReason as Reason, event};
use serde::Deserialize;
use serde_json::{Value, json};

use super::clients::Lease;
use super::launch::capabilities;
use super::{Adapter, Answer, ClientId, Refusal};

/// How often who steers is asked whether it is there.
const ASK: Wall = Wall::from_millis(200);
/// How long it may leave that open, of the time in which an answer is heard.
const SILENT: Wall = Wall::from_secs(3);
/// How long while the run makes a step of its.
const SILENT_IN_A_STEP: Wall = Wall::from_millis(500);
/// How often a lease is looked at: what passes beyond that between two calls, the adapter or whoever calls it was busy.
const LOOK: Wall = Wall::from_millis(100);

/// What changes a run, or lets time pass.
const STEERS: &[&str] = &[
    "afp/drop",
    "afp/fault",
    "afp/force",
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
    /// The role.
    take: Option<String>,
    /// Gives it away.
    release: bool,
    /// Whether it answers for it.
    lease: bool,
}

impl Adapter<'_> {
    /// Takes the role of who steers, or gives it away; who has which.
    pub(super) fn role(&mut self, wanted: Wanted, now: Wall) -> Answer<Value> {
        self.run()?;
        match wanted.take.as_deref() {
            Some("operator") => self.take_role(wanted.lease, now),
            Some(other) => {
                return Err(Refusal(format!("'{other}' is no role: there is 'operator'")));
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

    /// The client that asks steers from now on.
    pub(super) fn take_role(&mut self, lease: bool, now: Wall) {
        let (asker, before) = (self.asker, self.operator);
        self.operator = Some(asker);
        if let Some(client) = self.clients.get_mut(&asker) {
            client.lease = lease.then_some(Lease { asked: now, open: None });
        }
        if before != Some(asker) {
            before.into_iter().chain([asker]).for_each(|id| self.send_capabilities(id));
        }
    }

    /// Whether the client that asks may do what it asks for. A role that nobody has is taken by who uses it.
    pub(super) fn may(&mut self, command: &str, now: Wall) -> Answer<()> {
        if !STEERS.contains(&command) || self.run.is_none() {
            return Ok(());
        }
        match self.operator {
            Some(operator) if operator == self.asker => {}
            Some(operator) => {
                let name = self.name_of(operator);
                return Err(Refusal(format!(
                    "{name} steers this run: 'afp/role' with \"take\": \"operator\" takes over; anybody may end it with 'terminate'"
                )));
            }
            None => {
                self.take_role(false, now);
                self.send_roles();
            }
        }
        Ok(())
    }

    /// Tells a client what it can ask for in its role.
    fn send_capabilities(&mut self, id: ClientId) {
        let Some(run) = &self.run else { return };
        let capabilities = capabilities(self.operator == Some(id), run.target.is_recorded());
        self.event_to::<event::Capabilities>(id, &dapts::CapabilitiesEvent { capabilities });
    }

    /// Who has which role, as a client sees it.
    fn roles(&self, to: ClientId) -> Value {
        let attached = self.clients.iter().filter(|(_, client)| client.attached);
        let clients: Vec<_> =
            attached.map(|(id, it)| json!({"id": id.number(), "name": it.name})).collect();
        json!({"operator": self.operator.map(ClientId::number), "you": to.number(), "clients": clients})
    }

    /// Tells everybody who knows such events who has which role.
    pub(super) fn send_roles(&mut self) {
        let those = self.clients.iter().filter(|(_, client)| client.attached && client.ours);
        for to in those.map(|(id, _)| *id).collect::<Vec<_>>() {
            let roles = self.roles(to);
            self.send_event(to, "afp/role", roles);
        }
    }

    /// Nobody steers any more, since who did does so: what was held in place by who did is let go, and a step of its ends here.
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
        self.output("important", &format!("{why}: nobody steers this run\n"));
        match steps {
            true => self.stopped(Reason::Pause, &why, Vec::new()),
            // What is held stays so, what runs goes on.
            false => self.send_state(),
        }
        self.send_capabilities(lost);
        self.send_roles();
    }

    /// Takes a client's breakpoints away and tells the others.
    pub(super) fn forget_breakpoints(&mut self, owner: ClientId) {
        let gone = self.breakpoints.forget(owner);
        let Some(program) = self.run.as_ref().map(|run| run.target.program().clone()) else {
            return;
        };
        self.send_breakpoints(owner, Changed::Removed, &gone, &program);
    }

    /// A client says that it is there.
    pub(super) fn on_lease_answer(&mut self, from: ClientId) {
        let client = self.clients.get_mut(&from);
        if let Some(lease) = client.and_then(|client| client.lease.as_mut()) {
            lease.open = None;
        }
    }

    /// Lets time pass in which who steers could answer: no longer than between two looks, since what has been said meanwhile
    /// is heard after what takes long, whoever is slow.
    pub(super) fn listen_for_lease(&mut self, now: Wall) {
        let passed = now.saturating_sub(std::mem::replace(&mut self.called, now)).min(LOOK);
        let client = self.operator.and_then(|operator| self.clients.get_mut(&operator));
        let lease = client.and_then(|client| client.lease.as_mut());
        if let Some(open) = lease.and_then(|lease| lease.open.as_mut()) {
            *open += passed;
        }
    }

    /// Asks who steers whether it is there, and lets go of one that is not.
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

    /// When a lease has to be looked at again.
    pub(super) fn lease_due(&self) -> Option<Wall> {
        let client = self.clients.get(&self.operator?)?;
        client.lease.map(|_| LOOK)
    }
}
