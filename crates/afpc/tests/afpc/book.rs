//! The commands in the book print the output that the book shows, and the book has every option.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use afp_book::{Block, blocks, pages};
use tempfile::TempDir;

const AFPC: &str = env!("CARGO_BIN_EXE_afpc");

/// External commands that `sh` blocks may contain; the test does not run them.
const FOREIGN: &[&str] = &[
    "cargo",
    "git",
    "mdbook",
    "cd",
    "pip",
    "scp",
    "ssh",
    "sudo",
    "qemu-aarch64",
    "npm",
    "npx",
    "code",
    "cc",
    "install",
    "hx",
    "mkdir",
];

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

#[test]
fn commands_print_the_output_in_the_book() {
    let mut wrong = Vec::new();
    let mut page = Page::new("");
    for block in blocks(&docs()).unwrap() {
        if page.name != block.page {
            page = Page::new(&block.page);
        }
        if let Err(why) = page.take(&block) {
            wrong.push(format!("{}: {why}", block.place()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The options for runs of the book's plans.
const TRIAL: &str = "--until 15s --log none --svg none";

/// A folder with the files of a page so far.
struct Page {
    name: String,
    folder: TempDir,
    /// The current folder in it, which `cd` in a `console` block changes.
    here: PathBuf,
    /// The exit code of the last command.
    code: i32,
    /// Whether the page declares a toolbox: another test checks its Rust code.
    own_toolbox: bool,
}

impl Page {
    fn new(name: &str) -> Page {
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path().to_owned();
        Page { name: name.to_owned(), folder, here, code: 0, own_toolbox: false }
    }

    fn take(&mut self, block: &Block) -> Result<(), String> {
        if let Some(name) = block.value("file") {
            let path = self.here.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, &block.text).unwrap();
        }
        match block.kind.as_str() {
            "console" => self.console(&block.text),
            "afp" => self.plan(block),
            // These need a robot.
            "sh" if block.has("robot") => Ok(()),
            "sh" => block.text.lines().try_for_each(|line| self.shell(line)),
            _ => Ok(()),
        }
    }

    /// Runs a complete plan; a fault is an error unless the block expects it.
    fn plan(&mut self, block: &Block) -> Result<(), String> {
        self.own_toolbox |= block.text.lines().any(|line| line.starts_with("toolbox "));
        if self.own_toolbox || block.has("fragment") || block.value("error").is_some() {
            return Ok(());
        }
        let name = block.value("file").unwrap_or("block.afp");
        fs::write(self.here.join(name), &block.text).unwrap();
        let set = block.value("set").map(|set| format!("--set {set}")).unwrap_or_default();
        let tried = self.shell(&format!("afpc run {name} {TRIAL} {set}"));
        match block.value("ends") {
            Some(code) if code == self.code.to_string() => Ok(()),
            Some(code) => Err(format!("'{name}' ends with {}, not with {code}", self.code)),
            None => tried,
        }
    }

    /// Commands after `$ `, each with its expected output.
    fn console(&mut self, text: &str) -> Result<(), String> {
        let text = text.strip_prefix("$ ").ok_or("does not begin with '$ '")?;
        for part in text.split("\n$ ") {
            let (command, wanted) = part.split_once('\n').unwrap_or((part, ""));
            let printed = self.run(command)?;
            if !fits(&lines(wanted), &lines(&printed)) {
                return Err(format!("'{command}' prints\n{printed}"));
            }
        }
        Ok(())
    }

    /// A command that must succeed.
    fn shell(&mut self, line: &str) -> Result<(), String> {
        let command = line.split(" #").next().unwrap_or_default().trim();
        let mut words = command.split(' ').skip_while(|word| word.contains('='));
        let first = words.next().unwrap_or_default();
        if command.is_empty() || FOREIGN.contains(&first) {
            return Ok(());
        }
        let printed = self.run(command)?;
        match self.code {
            0 => Ok(()),
            code => Err(format!("'{command}' ends with {code}:\n{printed}")),
        }
    }

    /// The output of a command, both streams in the order of a terminal.
    fn run(&mut self, command: &str) -> Result<String, String> {
        if command == "echo $?" {
            return Ok(format!("{}\n", self.code));
        }
        if let Some(inner) = command.strip_prefix("cd ") {
            self.here = self.here.join(inner);
            self.code = 0;
            return Ok(String::new());
        }
        let arguments = command.strip_prefix("afpc ").ok_or(format!("'{command}' is not run"))?;
        let path = self.folder.path().join(".printed");
        let printed = File::create(&path).unwrap();
        let mut afpc = Command::new(AFPC);
        afpc.args(arguments.split_whitespace()).current_dir(&self.here);
        afpc.stdin(Stdio::null()).stderr(printed.try_clone().unwrap()).stdout(printed);
        self.code = afpc.status().unwrap().code().unwrap_or(-1);
        Ok(fs::read_to_string(path).unwrap())
    }
}

/// The lines of a text without trailing spaces and trailing empty lines.
fn lines(text: &str) -> Vec<&str> {
    text.trim_end().lines().map(str::trim_end).collect()
}

/// Whether lines match the expected lines; `...` matches any number of lines, or any text within a
/// line.
fn fits(wanted: &[&str], lines: &[&str]) -> bool {
    match wanted.split_first() {
        None => lines.is_empty(),
        Some((&"...", rest)) => (0..=lines.len()).any(|skipped| fits(rest, &lines[skipped..])),
        Some((line, rest)) => {
            lines.first().is_some_and(|first| line_fits(line, first)) && fits(rest, &lines[1..])
        }
    }
}

fn line_fits(wanted: &str, line: &str) -> bool {
    match wanted.split_once("...") {
        None => wanted == line,
        Some((before, after)) => {
            let long = line.len() >= before.len() + after.len();
            long && line.starts_with(before) && line.ends_with(after)
        }
    }
}

#[test]
fn every_command_and_option_is_on_the_page_of_the_command_line() {
    let pages = pages(&docs()).unwrap();
    let (_, page) = pages.iter().find(|(name, _)| name == "command-line").unwrap();
    let help = |command: &str| {
        let output = Command::new(AFPC).args([command, "--help"]).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let all = help("help");
    let commands = all.lines().skip_while(|line| *line != "Commands:").skip(1);
    for line in commands.take_while(|line| !line.is_empty()) {
        let command = line.split_whitespace().next().unwrap();
        let heading = format!("\n## afpc {command}\n");
        let Some((_, section)) = page.split_once(&heading) else {
            assert_eq!(command, "help", "no section of 'afpc {command}'");
            continue;
        };
        let section = section.split("\n## ").next().unwrap();
        for word in help(command).lines().filter_map(|line| line.split("--").nth(1)) {
            let option: String =
                word.chars().take_while(|c| c.is_ascii_lowercase() || *c == '-').collect();
            let there = option == "help" || section.contains(&format!("--{option}"));
            assert!(there, "'afpc {command} --{option}' is not in the book");
        }
    }
}
