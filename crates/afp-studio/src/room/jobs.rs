//! Command-line jobs for clients: run and generate scenarios, sweeps, builds, new projects.
//!
//! The room only determines programs and arguments; its owner runs them.

mod arguments;

use std::collections::BTreeMap;
use std::time::Duration;

use afp_lsp::Message;
use serde_json::{Value, json};

use super::{ClientId, Out, Room, notification};
use arguments::{arguments, file_of};

const MOST: usize = 4;
/// The most lines of a job sent and kept for its end.
const MOST_LINES: usize = 2_000;
/// The longest such line, in characters.
const MOST_LETTERS: usize = 2_000;
/// The time that a job waits for a lost page before it is ended.
const WAITS: Duration = Duration::from_secs(60);
/// The time for which lines are collected into a message.
const COLLECTED: Duration = Duration::from_millis(50);
/// The most results kept for the end of a job; each run needs some 600 bytes.
const MOST_RESULTS: usize = 20_000;
/// The most bytes of results, which are sent in one message.
const MOST_BYTES: usize = 32 << 20;
/// The most bytes of the summary, which is kept even if there is no room for more results.
const MOST_SUM: usize = 1 << 20;

pub(crate) type JobId = u32;

/// A request to run or end a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// Run the command line with these arguments, in the folder.
    Begin(JobId, Vec<String>),
    End(JobId),
}

#[derive(Debug, Default)]
pub(super) struct Job {
    client: ClientId,
    /// The original request.
    order: Value,
    /// The time since which the client is gone.
    alone: Option<Duration>,
    /// The final message, while the client is gone.
    done: Option<Message>,
    results: Vec<Value>,
    /// The total length of the results.
    bytes: usize,
    /// Whether some were dropped.
    is_cut: bool,
    said: Vec<String>,
    /// The number of lines sent to the client.
    told: usize,
}

#[derive(Debug, Default)]
pub(super) struct Jobs {
    running: BTreeMap<JobId, Job>,
    orders: Vec<Order>,
    made: JobId,
    /// The time of the last message with lines.
    told: Duration,
}

impl Room {
    /// Takes the pending orders.
    pub(crate) fn orders(&mut self) -> Vec<Order> {
        std::mem::take(&mut self.jobs.orders)
    }

    pub(super) fn begin_job(&mut self, client: ClientId, params: &Value) -> Result<Value, String> {
        let goes_on = |job: &&Job| job.done.is_none();
        if self.jobs.running.values().filter(goes_on).count() >= MOST {
            return Err(format!("{MOST} jobs are running: wait for one to end, or cancel it"));
        }
        let kind = params["kind"].as_str().unwrap_or_default();
        let arguments = arguments(self, kind, params)?;
        self.check_trust(kind, params)?;
        self.jobs.made += 1;
        let id = self.jobs.made;
        let order = params.clone();
        self.jobs.running.insert(id, Job { client, order, ..Job::default() });
        self.jobs.orders.push(Order::Begin(id, arguments));
        Ok(json!({ "id": id }))
    }

    /// Ends a job that is still running.
    pub(super) fn end_job(&mut self, params: &Value) -> Result<Value, String> {
        let id = params["id"].as_u64().and_then(|id| JobId::try_from(id).ok());
        let id = id.filter(|id| (1..=self.jobs.made).contains(id)).ok_or("there is no such job")?;
        let goes_on = self.jobs.running.contains_key(&id);
        self.jobs.orders.extend(goes_on.then_some(Order::End(id)));
        Ok(Value::Null)
    }

    /// Keeps the jobs of a lost client for a while.
    pub(super) fn leave_jobs(&mut self, client: ClientId, now: Duration) {
        let own = self.jobs.running.values_mut().filter(|job| job.client == client);
        own.for_each(|job| job.alone = Some(now));
    }

    /// Gives a client the jobs of its previous id, unless that is still connected.
    pub(super) fn take_jobs(&mut self, client: ClientId, before: ClientId) {
        let own = self.jobs.running.values_mut();
        let own = own.filter(|job| job.client == before && job.alone.is_some());
        own.for_each(|job| (job.client, job.alone) = (client, None));
    }

    /// The jobs of a client for its greeting, with the lines sent before.
    pub(super) fn jobs_of(&self, client: ClientId) -> Value {
        let own = self.jobs.running.iter().filter(|(_, job)| job.client == client);
        let listed = |(id, job): (&JobId, &Job)| {
            let said = job.said.get(..job.told).unwrap_or_default().join("\n");
            json!({ "id": id, "order": job.order, "said": said })
        };
        own.map(listed).collect()
    }

    /// Sends a reconnected client the jobs that ended in the meantime.
    pub(super) fn tell_done(&mut self, client: ClientId) -> Out {
        let mut out = Out::new();
        self.jobs.running.retain(|&id, job| {
            let done = job.done.take_if(|_| job.client == client);
            let is_told = done.is_some();
            if is_told {
                out.extend(job.tell(id));
            }
            out.extend(done.map(|done| (client, done)));
            !is_told
        });
        out
    }

    /// Ends the jobs of clients that did not return, and kills a job that does not end.
    pub(super) fn end_jobs_alone(&mut self, now: Duration) {
        let orders = &mut self.jobs.orders;
        self.jobs.running.retain(|&id, job| {
            if job.alone.is_none_or(|since| now < since + WAITS) {
                return true;
            }
            job.alone = Some(now);
            let goes_on = job.done.is_none();
            orders.extend(goes_on.then_some(Order::End(id)));
            goes_on
        });
    }

    /// Rejects requests that run code of the folder before it is trusted.
    fn check_trust(&self, kind: &str, params: &Value) -> Result<(), String> {
        if kind == "new" || self.trust.is_given() {
            return Ok(());
        }
        match kind == "build" || !self.code(params)?.is_empty() {
            true => Err("this would run code from the folder: trust the folder first".to_owned()),
            false => Ok(()),
        }
    }

    /// The code of the folder, or of a file's project, that a request would build and run.
    pub(super) fn code(&self, params: &Value) -> Result<Vec<String>, String> {
        Ok(self.trust.code(file_of(self, params).transpose()?.as_deref()))
    }

    /// Handles a line printed by a job.
    pub(crate) fn job_said(&mut self, id: JobId, line: &str) {
        self.jobs.running.get_mut(&id).into_iter().for_each(|job| job.say(line));
    }

    /// The time of the next message with lines.
    pub(super) fn jobs_due(&self) -> Option<Duration> {
        let waits = |job: &Job| job.alone.is_none() && job.told < job.said.len();
        self.jobs.running.values().any(waits).then_some(self.jobs.told + COLLECTED)
    }

    /// Sends the new lines of all jobs.
    pub(super) fn tell_jobs(&mut self, now: Duration) -> Out {
        self.jobs.told = now;
        self.jobs.running.iter_mut().filter_map(|(&id, job)| job.tell(id)).collect()
    }

    /// Handles the end of a job with its exit code, or `None` if it was killed.
    pub(crate) fn job_done(&mut self, id: JobId, code: Option<i32>) -> Out {
        let Some(mut job) = self.jobs.running.remove(&id) else { return Out::new() };
        let mut out = Out::from_iter(job.tell(id));
        let done = json!({
            "id": id, "ok": code == Some(0), "code": code, "results": std::mem::take(&mut job.results), "said": job.said.join("\n"),
        });
        let done = notification("afp/jobDone", done);
        match job.alone {
            None => out.push((job.client, done)),
            Some(_) => {
                job.done = Some(done);
                self.jobs.running.insert(id, job);
            }
        }
        out
    }
}

impl Job {
    /// Stores a line: a result, or text.
    fn say(&mut self, line: &str) {
        if let Ok(result @ Value::Object(_)) = serde_json::from_str(line) {
            let bytes = self.bytes + line.len();
            let is_room = self.results.len() < MOST_RESULTS && bytes <= MOST_BYTES;
            // The summary is the last result, and there is only one.
            let is_sum = result.get("summary").is_some() && line.len() <= MOST_SUM;
            if is_room || is_sum {
                self.bytes = bytes;
                self.results.push(result);
            } else if !std::mem::replace(&mut self.is_cut, true) {
                self.said.push("(more results were dropped)".to_owned());
            }
            return;
        }
        match self.said.len() {
            ..MOST_LINES => self.said.push(line.chars().take(MOST_LETTERS).collect()),
            MOST_LINES => self.said.push("(more output was dropped)".to_owned()),
            _ => {}
        }
    }

    /// Sends the unsent lines to the client, if it is connected.
    fn tell(&mut self, id: JobId) -> Option<(ClientId, Message)> {
        if self.alone.is_some() {
            return None;
        }
        let lines = self.said.get(self.told..).filter(|lines| !lines.is_empty())?;
        let said = json!({ "id": id, "text": lines.join("\n") });
        self.told = self.said.len();
        Some((self.client, notification("afp/jobSaid", said)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A room with a client that has started a job.
    fn begun(folder: &tempfile::TempDir) -> Room {
        let folder = crate::Folder::new(folder.path()).unwrap();
        let mut room = Room::new(folder, None, Vec::new(), || Box::new(afp_lsp::NoFiles));
        room.join(1);
        room.begin_job(1, &json!({ "kind": "test" })).unwrap();
        assert_eq!(room.orders().len(), 1);
        room
    }

    /// The greeting of a reconnected client, and the messages after it.
    fn greeted(room: &mut Room, client: ClientId, before: ClientId) -> (Value, Vec<Value>) {
        room.join(client);
        let params = json!({ "client": before });
        let hello = lsp_server::Request::new(1.into(), "afp/hello".to_owned(), params);
        let out = room.handle(client, hello.into(), Duration::ZERO);
        let said = out.into_iter().filter(|(id, _)| *id == client);
        let mut said = said.map(|(_, message)| serde_json::to_value(message).unwrap());
        (said.next().unwrap()["result"]["jobs"].clone(), said.collect())
    }

    #[test]
    fn a_job_survives_a_reload_of_the_page() {
        let folder = tempfile::tempdir().unwrap();
        let mut room = begun(&folder);
        room.job_said(1, "one");
        room.tick(COLLECTED);
        room.job_said(1, "two");
        room.leave(1, Duration::ZERO);
        // Lines for a lost client are not due, or the room would wake up all the time.
        assert_eq!((room.jobs_due(), room.tick(COLLECTED * 9).len()), (None, 0));
        let listed = json!([{ "id": 1, "order": { "kind": "test" }, "said": "one" }]);
        assert_eq!(greeted(&mut room, 2, 1), (listed.clone(), vec![]));
        let told = room.tell_jobs(Duration::ZERO);
        assert_eq!(told[0].0, 2);
        // If the previous client is still connected, it keeps the job.
        assert_eq!(greeted(&mut room, 3, 2).0, json!([]));
        // The job ends during the absence.
        room.leave(2, Duration::ZERO);
        room.job_said(1, "three");
        assert!(room.job_done(1, Some(0)).is_empty());
        let (jobs, told) = greeted(&mut room, 4, 2);
        assert_eq!(jobs[0]["id"], 1);
        let methods: Vec<_> = told.iter().map(|message| message["method"].clone()).collect();
        assert_eq!(methods, ["afp/jobSaid", "afp/jobDone"]);
        assert_eq!(told[1]["params"]["said"], "one\ntwo\nthree");
        assert_eq!(greeted(&mut room, 5, 4).0, json!([]));
    }

    #[test]
    fn jobs_of_a_lost_page_are_ended() {
        let folder = tempfile::tempdir().unwrap();
        let mut room = begun(&folder);
        room.join(2);
        let order = json!({ "kind": "test" });
        for _ in 1..MOST {
            room.begin_job(1, &order).unwrap();
        }
        assert!(room.begin_job(2, &order).is_err());
        room.orders();
        room.leave(1, Duration::ZERO);
        // This job ended by itself.
        room.job_done(1, Some(0));
        assert!(room.begin_job(2, &order).is_ok());
        room.orders();
        room.tick(WAITS / 2);
        assert_eq!(room.orders(), []);
        let ended: Vec<_> = (2..).take(MOST - 1).map(Order::End).collect();
        room.tick(WAITS);
        assert_eq!(room.orders(), ended);
        // A job that does not end when asked is killed the second time.
        room.job_done(2, None);
        room.tick(WAITS * 2);
        assert_eq!(room.orders(), ended[1..]);
        (3..).take(MOST - 2).for_each(|id| _ = room.job_done(id, None));
        room.tick(WAITS * 3);
        assert_eq!(room.jobs.running.keys().collect::<Vec<_>>(), [&5]);
    }

    #[test]
    fn ending_a_finished_job_is_not_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let mut room = begun(&folder);
        room.job_done(1, Some(0));
        assert_eq!(room.end_job(&json!({ "id": 1 })), Ok(Value::Null));
        assert_eq!(room.orders(), []);
        assert!(room.end_job(&json!({ "id": 2 })).is_err());
    }

    #[test]
    fn the_summary_of_many_results_is_kept() {
        let mut job = Job::default();
        (0..MOST_RESULTS + 5).for_each(|_| job.say("{}"));
        job.say(r#"{"summary": {}}"#);
        assert_eq!(job.results.len(), MOST_RESULTS + 1);
        assert_eq!(job.results[MOST_RESULTS], json!({ "summary": {} }));
    }

    #[test]
    fn lines_of_a_job_are_sent_in_one_message_up_to_a_limit() {
        let mut job = Job::default();
        let mut text = |lines: usize| {
            (0..lines).for_each(|_| job.say(&"x".repeat(MOST_LETTERS + 1)));
            job.say(r#"{"name": "a result"}"#);
            let (_, message) = job.tell(7)?;
            let Message::Notification(told) = message else { return None };
            Some(told.params["text"].as_str()?.lines().map(str::to_owned).collect::<Vec<_>>())
        };
        assert_eq!(text(0), None);
        assert_eq!(text(600).unwrap(), vec!["x".repeat(MOST_LETTERS); 600]);
        let rest = text(5_000).unwrap();
        assert_eq!(rest.len(), MOST_LINES - 600 + 1);
        assert_eq!(rest.last().unwrap(), "(more output was dropped)");
        assert_eq!(text(10), None);
        assert_eq!(job.results.len(), 4);
    }
}
