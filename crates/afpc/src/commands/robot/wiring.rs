//! `afpc robot wiring`: the wires of the project's robot, as a table or as a drawing.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use afp_project::{ProjectFile, Wire, WireKind};
use afp_run::{RunError, write_whole};
use clap::Args;

use crate::commands::print;
use crate::no_plan::NoPlan;

#[derive(Args, Debug)]
pub struct Arguments {
    /// SVG file for a drawing [default: a table on standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Shows the wires of the robot of this folder's project.
///
/// # Errors
/// The project has no robot with a profile, or the file cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let (project, _) = afp_project::read(&ProjectFile::find(Path::new("."))?.text);
    let Some(robot) = project.profile() else {
        let help = "'afpc new mycar --profile carbot' creates such a project";
        return Err(RunError::usage("the project has no robot with a profile", help).into());
    };
    let wires = robot.wires();
    match &arguments.output {
        Some(path) => {
            write_whole("cannot write the drawing", path, svg(robot.name, &wires))?;
            Ok(afp_run::EXIT_OK)
        }
        None => print(&table(&wires)),
    }
}

/// The wires, one in a line.
fn table(wires: &[Wire]) -> String {
    let mut text = String::new();
    for Wire { board, pin, part, at, note, .. } in wires {
        let line = format!("{board:<18}  {pin:<18}  {part:<32}  {at:<14}  {note}");
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// The sizes of a drawing, in pixels.
const WIDTH: usize = 760;
const MARGIN: usize = 20;
const BOARD_END: usize = 240;
const PART_START: usize = 480;
const ROW: usize = 22;
const GAP: usize = 14;

/// Draws the wires of each board as rows, so that no two wires cross: the board on the left, its
/// parts on the right.
fn svg(name: &str, wires: &[Wire]) -> String {
    let mut drawing = Drawing { body: String::new(), y: MARGIN };
    wires.chunk_by(|one, next| one.board == next.board).for_each(|wires| drawing.board(wires));
    drawing.legend(wires);
    let Drawing { body, y: height } = drawing;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <title>Wiring of the profile {name}</title>\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" rx=\"6\" fill=\"#ffffff\"/>\n{body}</svg>\n"
    )
}

struct Drawing {
    body: String,
    y: usize,
}

impl Drawing {
    /// Draws a board with its parts.
    fn board(&mut self, wires: &[Wire]) {
        let top = self.y;
        let mut rows = String::new();
        let mut y = top;
        for part in wires.chunk_by(|one, next| one.part == next.part) {
            let height = ROW * (part.len() + 1);
            rows += &box_of(PART_START, y, WIDTH - MARGIN - PART_START, height, part[0].part);
            for wire in part {
                y += ROW;
                rows += &row(wire, y + ROW / 2);
            }
            y += ROW + GAP;
        }
        let height = y - GAP - top;
        self.body += &box_of(MARGIN, top, BOARD_END - MARGIN, height, wires[0].board);
        self.body += &rows;
        self.y = y + GAP;
    }

    /// Draws the meaning of the colours.
    fn legend(&mut self, wires: &[Wire]) {
        let kinds = [
            (WireKind::Supply, "supply"),
            (WireKind::Ground, "ground"),
            (WireKind::Command, "command"),
            (WireKind::Reading, "reading"),
            (WireKind::Motor, "motor current"),
        ];
        let used = kinds.iter().filter(|(kind, _)| wires.iter().any(|wire| wire.kind == *kind));
        let y = self.y;
        for (n, (kind, words)) in used.enumerate() {
            let x = MARGIN + n * 140;
            let colour = colour(*kind);
            self.body += &format!(
                "<path d=\"M{x} {y}h24\" stroke=\"{colour}\" stroke-width=\"3\"/>\
                 <text class=\"legend\" x=\"{}\" y=\"{}\">{words}</text>\n",
                x + 30,
                y + 4
            );
        }
        self.y += MARGIN;
    }
}

/// A board or part with its name.
fn box_of(x: usize, y: usize, width: usize, height: usize, name: &str) -> String {
    format!(
        "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"4\" fill=\"#f2f4f7\" \
         stroke=\"#5b6675\"/><text class=\"name\" x=\"{}\" y=\"{}\" font-weight=\"bold\">{name}</text>\n",
        x + 8,
        y + 16
    )
}

/// A wire with its two pins.
fn row(wire: &Wire, y: usize) -> String {
    let Wire { kind, pin, at, note, .. } = wire;
    let (colour, base) = (colour(*kind), y + 4);
    let mut text = format!(
        "<text class=\"pin\" x=\"{}\" y=\"{base}\" text-anchor=\"end\">{pin}</text>\
         <path d=\"M{BOARD_END} {y}H{PART_START}\" stroke=\"{colour}\" stroke-width=\"3\"/>\
         <circle cx=\"{BOARD_END}\" cy=\"{y}\" r=\"4\" fill=\"{colour}\"/>\
         <circle cx=\"{PART_START}\" cy=\"{y}\" r=\"4\" fill=\"{colour}\"/>\
         <text class=\"at\" x=\"{}\" y=\"{base}\">{at}</text>",
        BOARD_END - 10,
        PART_START + 10
    );
    if !note.is_empty() {
        let middle = (BOARD_END + PART_START) / 2;
        let width = note.len() * 8 + 6;
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "<rect x=\"{}\" y=\"{}\" width=\"{width}\" height=\"18\" fill=\"#ffffff\" stroke=\"{colour}\"/>\
             <text class=\"note\" x=\"{middle}\" y=\"{base}\" text-anchor=\"middle\">{note}</text>",
            middle - width / 2,
            y - 9
        );
    }
    text.push('\n');
    text
}

fn colour(kind: WireKind) -> &'static str {
    match kind {
        WireKind::Supply => "#c62828",
        WireKind::Ground => "#212121",
        WireKind::Command => "#1565c0",
        WireKind::Reading => "#2e7d32",
        WireKind::Motor => "#e07b00",
    }
}
