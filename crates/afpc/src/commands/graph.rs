//! `afpc graph`: the drawing of a plan.

use std::io::{ErrorKind, IsTerminal};
use std::path::{Path, PathBuf};

use afp_draw::layout_file::Layout;
use afp_draw::{Options, Scene, Usage};
use afp_dsl::files::read_text_file;
use afp_dsl::graph::Graph;
use afp_dsl::outline::{Outline, PlanId};
use afp_dsl::toolbox::Toolbox;
use afp_run::{EXIT_FAILED, EXIT_OK, PictureFormat, RunError, check_apart, say, write_whole};
use afp_syntax::source::Source;
use clap::{Args, ValueEnum};

use super::{name_of, print};
use crate::no_plan::NoPlan;
use crate::picture;
use crate::plan_file::{PlanArgument, PlanFile};
use crate::reader::Reader;

/// Arguments of `afpc graph`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,

    /// File for the drawing [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Format [default: from the file extension, or else svg]
    #[arg(long)]
    format: Option<Format>,

    /// Colours of an SVG or PNG [default: auto for SVG, light for PNG]
    #[arg(long)]
    theme: Option<Theme>,

    /// PNG pixels per SVG pixel, 0.1 to 10 [default: 2]
    #[arg(long, value_name = "FACTOR", value_parser = scale, allow_hyphen_values = true)]
    scale: Option<f32>,

    /// Leave out the bodies of sub-plans
    #[arg(long)]
    fold: bool,

    /// Draw only the flow of action, without entries and formulas
    #[arg(long)]
    no_data: bool,
}

/// The formats of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// The paper's notation, for browsers and papers
    Svg,
    /// The drawing as pixels, with bundled fonts
    Png,
    /// For GraphViz
    Dot,
    /// The checked graph, for programs
    Json,
    /// The flow of action as State Chart XML, sub-plans unfolded
    Scxml,
}

/// The colours of a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Theme {
    /// The colours of the reader's system
    Auto,
    /// Dark on light
    Light,
    /// Light on dark
    Dark,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc graph plans/wall_following.afp -o plan.svg
  afpc graph plans/wall_following.afp -o plan.png --theme dark --scale 3
  afpc graph plans/wall_following.afp -o flow.svg --no-data
  afpc graph plans/wall_following.afp --format json
  afpc graph plans/wall_following.afp --format scxml
  afpc graph plans/wall_following.afp --format dot | dot -Tpdf -o plan.pdf";

/// Draws a plan, even a plan with errors: the drawing marks them, and they are printed.
///
/// # Errors
/// The options do not fit the format, a file cannot be read or written, a plan with errors cannot
/// become a state chart.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let format = arguments.format()?;
    arguments.fit(format)?;
    let file = PlanFile::read(&arguments.plan.plan)?;
    let sources = file.compiled.plan_sources().map(|source| Path::new(&source.name));
    check_apart(arguments.output.as_deref(), sources)?;
    file.report(Reader::People)?;
    let code = if file.compiled.diags.has_errors() { EXIT_FAILED } else { EXIT_OK };
    if file.compiled.outline.main.is_none() {
        // There is nothing to draw, and an existing drawing is kept.
        return Err(NoPlan::Wrong);
    }
    let positions = positions(&file);
    let icons = |toolbox: &Toolbox, name: &str| file.own.icon(toolbox, name);
    let outline = &file.compiled.outline;
    let options = Options {
        icons: Some(&icons),
        positions: &positions,
        theme: arguments.theme(format),
        sub_plans: !arguments.fold,
        data: !arguments.no_data,
        ..Options::default()
    };
    let text = match format {
        Format::Png => return pixels(arguments, outline, &options).map(|_| code),
        Format::Svg => afp_draw::svg(outline, &options),
        Format::Json => afp_draw::json(outline, &options),
        Format::Dot => afp_draw::dot(outline, &options),
        Format::Scxml => {
            let graph = file.compiled.graph.as_ref().ok_or(NoPlan::Wrong)?;
            afp_draw::scxml(graph, Some(&file.compiled.sources), options.data)
        }
    };
    match &arguments.output {
        Some(path) => write(path, text.as_bytes())?,
        None => print(&text)?,
    };
    Ok(code)
}

/// Draws a plan with its usage, in the colours of the output format.
///
/// # Errors
/// The output file's extension is not that of a picture.
pub(super) fn with_usage(
    file: &PlanFile,
    graph: &Graph,
    usage: &Usage,
    path: &Path,
) -> Result<String, RunError> {
    let icons = |toolbox: &Toolbox, name: &str| file.own.icon(toolbox, name);
    let plans = (0..).map(PlanId).zip(&file.compiled.outline.plans);
    let mut own = plans.filter(|(_, plan)| plan.span.contains(graph.main().span));
    let options = Options {
        plan: own.next().map(|(id, _)| id),
        icons: Some(&icons),
        positions: &positions(file),
        theme: picture::theme(PictureFormat::of(path)?),
        usage: Some(usage),
        ..Options::default()
    };
    Ok(afp_draw::svg(&file.compiled.outline, &options))
}

/// The positions from the plans' side files, by file.
fn positions(file: &PlanFile) -> Vec<Layout> {
    let outline = &file.compiled.outline;
    let holds_plans =
        |file: usize| outline.plans.iter().any(|plan| usize::from(plan.file()) == file);
    let read = |(file, source): (usize, &Source)| match holds_plans(file) {
        true => layout(&format!("{}.layout", source.name), outline, file),
        false => Layout::default(),
    };
    file.compiled.sources.iter().enumerate().map(read).collect()
}

/// The positions of a side file; empty without a file. Invalid lines are reported on standard error
/// and do not stop the drawing.
fn layout(path: &str, outline: &Outline, file: usize) -> Layout {
    let (text, why) = match read_text_file(path.as_ref()) {
        Ok(text) => (text, None),
        Err(error) if error.kind() == ErrorKind::NotFound => (String::new(), None),
        Err(error) => (String::new(), Some(error.to_string())),
    };
    let file = u16::try_from(file).unwrap_or(u16::MAX);
    let (layout, errors) = Layout::read_for(&text, outline, file);
    let wrong = errors.iter().map(|error| format!("{path}:{error}"));
    let unread = why.iter().map(|why| format!("cannot read '{path}': {why}"));
    for warning in unread.chain(wrong) {
        say(format_args!("warning: {warning}"));
    }
    layout
}

fn write(path: &Path, drawing: &[u8]) -> Result<u8, NoPlan> {
    write_whole("cannot write the drawing", path, drawing)?;
    Ok(EXIT_OK)
}

fn pixels(arguments: &Arguments, outline: &Outline, options: &Options) -> Result<u8, NoPlan> {
    if arguments.output.is_none() && std::io::stdout().is_terminal() {
        let error = "a terminal cannot show a picture";
        return Err(RunError::usage(error, "name a file: -o plan.png").into());
    }
    let scale = arguments.scale.unwrap_or(picture::DEFAULT_SCALE);
    picture::check_area(Scene::least_area(outline, options), scale)?;
    let picture = picture::pixels(&afp_draw::svg(outline, options), scale)?;
    match &arguments.output {
        Some(path) => write(path, &picture),
        None => super::print_bytes(&picture),
    }
}

fn scale(text: &str) -> Result<f32, String> {
    let scale = text.parse::<f32>().ok().filter(|scale| (0.1..=10.0).contains(scale));
    scale.ok_or_else(|| "expected a number from 0.1 to 10".to_owned())
}

impl Arguments {
    /// # Errors
    /// The file extension does not name a format.
    fn format(&self) -> Result<Format, RunError> {
        let Some(path) = self.output.as_deref().filter(|_| self.format.is_none()) else {
            return Ok(self.format.unwrap_or(Format::Svg));
        };
        let Some(ending) = path.extension() else { return Ok(Format::Svg) };
        let format = ending.to_str().and_then(|ending| Format::from_str(ending, true).ok());
        format.ok_or_else(|| {
            let help = "use '.svg', '.png', '.dot', '.json' or '.scxml', or add '--format'";
            RunError::usage(format!("unsupported format '.{}'", ending.display()), help)
        })
    }

    fn theme(&self, format: Format) -> afp_draw::Theme {
        match (self.theme, format) {
            (Some(Theme::Dark), _) => afp_draw::Theme::Dark,
            // A PNG cannot adapt to the reader's system.
            (Some(Theme::Light), _) | (_, Format::Png) => afp_draw::Theme::Light,
            (Some(Theme::Auto) | None, _) => afp_draw::Theme::Auto,
        }
    }

    /// Rejects options that would have no effect.
    fn fit(&self, format: Format) -> Result<(), RunError> {
        use Format::{Dot, Png, Scxml, Svg};

        let given: [(bool, &str, &[Format]); 4] = [
            (self.theme.is_some(), "--theme", &[Svg, Png]),
            (self.scale.is_some(), "--scale", &[Png]),
            (self.fold, "--fold", &[Svg, Png, Dot]),
            (self.no_data, "--no-data", &[Svg, Png, Dot, Scxml]),
        ];
        let wrong = given.iter().find(|(given, _, formats)| *given && !formats.contains(&format));
        let Some((_, option, formats)) = wrong else { return Ok(()) };
        let formats: Vec<_> = formats.iter().map(name_of).collect();
        Err(RunError::usage(
            format!("'{option}' has no effect on '--format {}'", name_of(&format)),
            format!("use it with {}", formats.join(", ")),
        ))
    }
}
