//! The grammar of the command line and the dispatch to the commands.

use std::ffi::OsString;
use std::process::ExitCode;

use afp_run::options::{for_devices, for_robot};
use afp_run::{EXIT_FAILED, EXIT_OK, RunError, say};
use afp_syntax::diagnostics::words::list;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

#[cfg(all(feature = "dap", unix))]
use crate::commands::attach;
#[cfg(all(unix, feature = "pi"))]
use crate::commands::calibrate;
#[cfg(feature = "dap")]
use crate::commands::dap;
#[cfg(all(feature = "pi", unix))]
use crate::commands::guard;
#[cfg(feature = "lsp")]
use crate::commands::lsp;
#[cfg(feature = "studio")]
use crate::commands::studio;
#[cfg(unix)]
use crate::commands::{agent, deploy, robot};
use crate::commands::{
    build, check, completions, explain, fmt, graph, later, log, new, print, run, sweep, templates,
    test,
};
use crate::no_plan::NoPlan;
use crate::{Linked, declared};

/// Compile, check, draw and run Action Flow Plans.
#[derive(Parser, Debug)]
#[command(name = "afpc", version, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// The commands.
#[derive(Subcommand, Debug)]
enum Command {
    /// Create a project: a plan, a toolbox or a robot
    #[command(after_help = new::EXAMPLES)]
    New(new::Arguments),
    /// List the templates of toolboxes
    #[command(after_help = templates::EXAMPLES)]
    Templates(templates::Arguments),
    /// Report all errors in plans and toolboxes
    #[command(after_help = check::EXAMPLES)]
    Check(check::Arguments),
    /// Explain an error code
    Explain(explain::Arguments),
    /// Format plans and toolboxes
    #[command(after_help = fmt::EXAMPLES)]
    Fmt(fmt::Arguments),
    /// Draw a plan
    #[command(after_help = graph::EXAMPLES)]
    Graph(graph::Arguments),
    /// Run a plan on the simulated robot
    #[command(after_help = afp_run::EXAMPLES)]
    Run(run::Arguments),
    /// Run scenarios on all cores
    #[command(after_help = test::EXAMPLES)]
    Test(test::Arguments),
    /// Run a plan with many seeds, worlds and values on all cores
    #[command(after_help = sweep::EXAMPLES)]
    Sweep(sweep::Arguments),
    /// Generate a readable Rust crate from a plan and build it
    #[command(after_help = build::EXAMPLES)]
    Build(build::Arguments),
    /// Measure the wheels and the range sensor of a real robot
    #[cfg(all(unix, feature = "pi"))]
    #[command(after_help = calibrate::EXAMPLES)]
    Calibrate(calibrate::Arguments),
    /// Put a plan on a robot over ssh
    #[cfg(unix)]
    #[command(after_help = deploy::EXAMPLES)]
    Deploy(deploy::Arguments),
    /// Show a robot's wires; show, arm, stop and roll back a robot; fetch its logs
    #[cfg(unix)]
    #[command(after_help = robot::EXAMPLES)]
    Robot(robot::Arguments),
    /// Serve 'afpc deploy' on a robot
    #[cfg(unix)]
    #[command(after_help = agent::EXAMPLES)]
    Agent(agent::Arguments),
    /// Switch a robot's motors off when its run ends or hangs
    #[cfg(all(feature = "pi", unix))]
    #[command(after_help = guard::EXAMPLES)]
    Guard(guard::Arguments),
    /// Show, check and repair the log of a run
    #[command(after_help = log::EXAMPLES)]
    Log(log::Arguments),
    /// Start the language server on standard input and output
    #[cfg(feature = "lsp")]
    #[command(after_help = lsp::EXAMPLES)]
    Lsp,
    /// Start the debug adapter for simulated runs
    #[cfg(feature = "dap")]
    #[command(after_help = dap::EXAMPLES)]
    Dap(dap::Arguments),
    /// Attach a debugger to a robot that drives
    #[cfg(all(feature = "dap", unix))]
    #[command(after_help = attach::EXAMPLES)]
    Attach(attach::Arguments),
    /// Draw and edit plans in the browser
    #[cfg(feature = "studio")]
    #[command(after_help = studio::EXAMPLES)]
    Studio(studio::Arguments),
    /// Print completions for a shell
    #[command(after_help = completions::EXAMPLES)]
    Completions(completions::Arguments),
}

const EXAMPLES: &str = "\
Examples:
  afpc new patrol
  afpc run plans/wall_following.afp
  afpc check plans/*.afp
  afpc graph plans/wall_following.afp -o plan.svg
  afpc build plans/wall_following.afp

Exit codes: 0 done, 1 a plan is invalid or a file cannot be read or written, 2 wrong usage, 3 the plan ended in Error";

/// Runs the selected command.
pub fn run(linked: &Linked<'_>) -> ExitCode {
    let result = match &parse(linked) {
        Command::Check(arguments) => check::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Fmt(arguments) => fmt::run(arguments),
        Command::Graph(arguments) => graph::run(arguments),
        Command::Run(arguments) => run::run(arguments, linked),
        Command::Test(arguments) => test::run(arguments, linked),
        Command::Sweep(arguments) => sweep::run(arguments, linked),
        Command::Build(arguments) => build::run(arguments),
        #[cfg(all(unix, feature = "pi"))]
        Command::Calibrate(arguments) => calibrate::run(arguments),
        #[cfg(unix)]
        Command::Deploy(arguments) => deploy::run(arguments),
        #[cfg(unix)]
        Command::Robot(arguments) => robot::run(arguments),
        #[cfg(unix)]
        Command::Agent(arguments) => agent::run(arguments),
        #[cfg(all(feature = "pi", unix))]
        Command::Guard(arguments) => guard::run(arguments),
        Command::Log(arguments) => log::run(arguments, linked),
        #[cfg(feature = "lsp")]
        Command::Lsp => lsp::run(),
        #[cfg(feature = "studio")]
        Command::Studio(arguments) => studio::run(arguments, linked),
        Command::New(arguments) => new::run(arguments),
        Command::Templates(arguments) => templates::run(arguments),
        #[cfg(feature = "dap")]
        Command::Dap(arguments) => dap::run(arguments, linked),
        #[cfg(all(feature = "dap", unix))]
        Command::Attach(arguments) => attach::run(arguments),
        Command::Completions(arguments) => completions::run(arguments, &Cli::command()),
    };
    match result {
        Ok(code) => ExitCode::from(code),
        Err(NoPlan::File(error)) => error.report(),
        Err(NoPlan::Wrong | NoPlan::NotBuilt(_)) => ExitCode::from(EXIT_FAILED),
    }
}

/// Parses the command line; exits after `--help` or an invalid command line.
///
/// The help of `run` lists the words of the project's robot. The robot's program is not built for
/// this.
fn parse(linked: &Linked<'_>) -> Command {
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    let asks = |word: &str| arguments.iter().any(|argument| argument == word);
    let helps = ["--help", "-h", "help"].into_iter().any(asks) && asks("run");
    let declared = if helps && !linked.is_runner() { declared::devices(&arguments) } else { None };
    let command = command().long_version(&*version(linked).leak());
    let command = command.mut_subcommand("run", |run| match declared {
        Some(devices) => for_devices(run, devices),
        None => for_robot(run, linked.robot.kind()),
    });
    let command = match helps.then(|| declared::inputs(&arguments)).flatten() {
        Some(inputs) => command.mut_subcommand("run", |run| taking(run, &inputs)),
        None => command,
    };
    let matches = match command.try_get_matches() {
        Ok(matches) => matches,
        Err(error) => match better(&error, &arguments) {
            Some(refusal) => refuse(&refusal),
            None if !error.use_stderr() => tell(&error),
            None => {
                if asks("--json") {
                    println!("{}", wrong_option(&error));
                }
                error.exit()
            }
        },
    };
    if let Some((name, _)) = matches.subcommand()
        && let Some(error) = later::refusal(name)
    {
        refuse(&error);
    }
    match Cli::from_arg_matches(&matches) {
        Ok(cli) => cli.command,
        Err(error) => error.exit(),
    }
}

/// A wrong option as an object, for programs: option, value and message.
fn wrong_option(error: &clap::Error) -> serde_json::Value {
    let context = |kind| error.get(kind).map(ToString::to_string);
    let option = context(ContextKind::InvalidArg);
    let name = option.as_deref().and_then(|it| it.split(' ').next()).map(|it| it.trim_matches('-'));
    let text = error.to_string();
    let why = std::error::Error::source(error).map(ToString::to_string);
    let message = why.as_deref().or(text.lines().next()).unwrap_or_default();
    serde_json::json!({
        "severity": "error", "option": name, "value": context(ContextKind::InvalidValue),
        "message": message.trim_start_matches("error: "),
    })
}

/// The answer to `--version`: the build, and the robot and toolboxes that are linked in.
fn version(linked: &Linked<'_>) -> String {
    let robot = linked.own_robot.unwrap_or("Carbot");
    let hardware = linked.hardware.map_or(String::new(), |(name, _)| format!(", hardware {name}"));
    let mut text = format!("{}\nrobot    {robot}{hardware}", afp_run::build_line());
    for toolbox in linked.toolboxes {
        text.push_str(&format!("\ntoolbox  {toolbox}"));
    }
    text
}

/// The command with the plan's inputs in the help of `--set`.
fn taking(run: clap::Command, inputs: &str) -> clap::Command {
    run.mut_arg("set", |argument| {
        let known = argument.get_long_help().or(argument.get_help());
        let known = known.map(ToString::to_string).unwrap_or_default();
        argument.long_help(format!("{known}\n\n{inputs}"))
    })
}

/// Prints a help text to standard output and exits.
fn tell(help: &clap::Error) -> ! {
    match print(&help.render().ansi().to_string()) {
        Err(NoPlan::File(error)) => refuse(&error),
        _ => std::process::exit(EXIT_OK.into()),
    }
}

/// Prints an error and exits with the exit code for wrong usage.
fn refuse(error: &RunError) -> ! {
    say(error.styled());
    std::process::exit(error.code().into());
}

/// A better message for an error of clap, if there is one.
fn better(error: &clap::Error, arguments: &[OsString]) -> Option<RunError> {
    let words: Vec<_> = arguments.iter().filter_map(|argument| argument.to_str()).collect();
    without_command(error).or_else(|| swapped(error, &words)).or_else(|| no_utf8(error, arguments))
}

/// The message for a file name that is not UTF-8.
fn no_utf8(error: &clap::Error, arguments: &[OsString]) -> Option<RunError> {
    if error.kind() != ErrorKind::InvalidUtf8 {
        return None;
    }
    let wrong = arguments.iter().filter(|argument| argument.to_str().is_none());
    let wrong: Vec<_> = wrong.map(|argument| argument.to_string_lossy()).collect();
    let names = list(wrong.iter().map(|name| &**name), "and");
    let verb = if wrong.len() == 1 { "is" } else { "are" };
    let help = "rename the file in UTF-8, or create a link with a UTF-8 name: 'ln -s OLD NEW'";
    Some(RunError::usage(format!("{names} {verb} not in UTF-8"), help))
}

/// The message for a plan without a command.
fn without_command(error: &clap::Error) -> Option<RunError> {
    if error.kind() != ErrorKind::InvalidSubcommand {
        return None;
    }
    let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand) else {
        return None;
    };
    let path = name.split_once(".afp:").map_or(&**name, |(path, _)| path);
    (path != name || name.ends_with(".afp")).then(|| {
        RunError::usage(
            format!("'{name}' is a plan, not a command"),
            format!("'afpc run {name}' runs it; 'afpc --help' lists the other commands"),
        )
    })
}

/// The message for the arguments of `afpc log` in the wrong order.
fn swapped(error: &clap::Error, words: &[&str]) -> Option<RunError> {
    match words {
        ["log", first, second, ..] if error.kind() == ErrorKind::InvalidValue => {
            log::swapped(first, second)
        }
        _ => None,
    }
}

/// The grammar, with hidden commands of later releases and other builds. They get their own error
/// messages.
fn command() -> clap::Command {
    let later = later::names().map(|name| {
        let rest = clap::Arg::new("rest").num_args(0..).allow_hyphen_values(true);
        clap::Command::new(name).hide(true).disable_help_flag(true).arg(rest)
    });
    Cli::command().subcommands(later)
}
