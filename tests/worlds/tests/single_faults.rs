//! Every single fault in every shipped plan: the robot stops for the right reason, or reaches its
//! goal, and does not push for long. By default it runs in a few rooms. `AFP_ROOMS` sets their
//! number, and `AFP_BLESS=1` then writes the book's page. `AFP_PLAN` selects one plan, `AFP_FAULT`
//! selects cases by endings of their names, as in `touch.frozen,slip`, and `AFP_SINGLE` shows one
//! case.

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{env, fs};

use afp_core::Duration;
use afp_worlds::{Account, Single, run};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// The default number of rooms.
const ROOMS: u64 = 1;
/// Runs with a longer push are printed.
const TOLD: Duration = Duration::from_millis(900);
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/single-faults.md");
/// One run of this number may push for more than a second, apart from plans that feel their way.
const LONG_OF: usize = 500;
/// The beginning of the page's tables.
const TABLES: &str = "<!-- tables: made by a test -->\n";

/// The name of a case, for [`shown`].
fn name(single: &Single) -> String {
    let (device, kind) = single.fault;
    format!("{} {} {device}.{kind}", single.case.plan.name, single.case.seed)
}

/// Drives the case with a name and prints the details.
fn shown(name_of: &str, all: &[Single]) {
    let single = all.iter().find(|single| name(single) == name_of);
    let single = single.unwrap_or_else(|| panic!("no case '{name_of}'"));
    let outcome = run(&single.case);
    println!("{}{}{:?}", single.case, outcome.timeline, outcome.ending);
    println!("{} contacts, pushing for {}", outcome.contacts.len(), outcome.seen.pushing);
    print!("{}", outcome.seen.pushes);
    assert_eq!(single.objections(&outcome), [""; 0]);
}

#[test]
fn any_single_fault_ends_well() {
    let rooms = env::var("AFP_ROOMS").map_or(ROOMS, |text| text.parse().expect("a number"));
    let only = env::var("AFP_PLAN").ok();
    let mut all = Single::all(rooms);
    all.retain(|single| only.as_ref().is_none_or(|only| *only == single.case.plan.name));
    assert!(!all.is_empty(), "no plan '{}'", only.unwrap_or_default());
    if let Ok(faults) = env::var("AFP_FAULT") {
        all.retain(|single| faults.split(',').any(|fault| name(single).ends_with(fault)));
    }
    if let Ok(name) = env::var("AFP_SINGLE") {
        return shown(&name, &all);
    }
    let findings = Mutex::new(Vec::new());
    let (account, long) = (Mutex::new(Account::default()), AtomicUsize::new(0));
    all.par_iter().for_each(|single| {
        let outcome = run(&single.case);
        account.lock().expect("nobody panics here").add(single, &outcome);
        long.fetch_add(usize::from(single.pushes_long(&outcome)), Ordering::Relaxed);
        if outcome.seen.pushing > TOLD {
            let (name, seen) = (name(single), &outcome.seen);
            print!("{name} pushes for {}\n{}", seen.pushing, seen.pushes);
        }
        let wrong = single.objections(&outcome);
        if let Some(first) = wrong.first() {
            let finding = format!("AFP_SINGLE='{}': {first}", name(single));
            findings.lock().expect("nobody panics here").push(finding);
        }
    });
    let tables = account.into_inner().expect("nobody panics here").markdown();
    println!("{tables}");
    if env::var_os("AFP_BLESS").is_some() && rooms > ROOMS && only.is_none() {
        bless(&tables);
    }
    let mut findings = findings.into_inner().expect("nobody panics here");
    findings.sort();
    assert!(findings.is_empty(), "{} of {}:\n{}", findings.len(), all.len(), findings.join("\n"));
    let long = long.into_inner();
    println!("{long} of {} runs pushed for too long", all.len());
    assert!(long * LONG_OF <= all.len(), "{long} of {} runs pushed for too long", all.len());
}

/// Writes the tables into the page.
fn bless(tables: &str) {
    let page = fs::read_to_string(Path::new(PAGE)).expect("the page is there");
    let (head, _) = page.split_once(TABLES).expect("the page says where tables begin");
    fs::write(PAGE, format!("{head}{TABLES}{tables}")).expect("the page can be written");
}
