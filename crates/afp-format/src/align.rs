//! From lines to text: columns of neighbouring lines get the same width.
//!
//! A run of entries shares the width of its keywords, also across comments; names are only padded
//! among directly adjacent lines. The same applies to the names of edges, the times of scenarios,
//! the values of tables, and trailing comments.

/// One line of the result.
#[derive(Debug, Default)]
pub(super) struct Line {
    /// The level of indentation.
    pub indent: usize,
    /// Whether a blank line comes before it.
    pub blank: bool,
    /// The kind of its columns.
    pub columns: Columns,
    /// Its code, cut at the starts of columns.
    pub cells: Vec<String>,
    /// The trailing comment.
    pub comment: Option<String>,
}

/// The kind of a line's columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Columns {
    #[default]
    None,
    /// A separate comment line.
    Comment,
    /// Keyword, name and type of an entry or port.
    Entry,
    /// Name and target of an edge.
    Edge,
    /// Time and action of a scenario's line.
    Stimulus,
    /// The values of a table's row.
    Row,
}

/// The text of all lines, each with a final line break.
pub(super) fn text(mut lines: Vec<Line>) -> String {
    let keyword_follows =
        |line: &Line| matches!(line.columns, Columns::Entry | Columns::Comment) && !line.blank;
    for_runs(&mut lines, keyword_follows, |run| pad(run, 0, &[Columns::Entry], 1));
    for columns in [Columns::Entry, Columns::Edge, Columns::Stimulus] {
        let (cell, least) = if columns == Columns::Entry { (1, 2) } else { (0, 1) };
        let follows = |line: &Line| line.columns == columns && !line.blank;
        for_runs(&mut lines, follows, |run| pad(run, cell, &[columns], least));
    }
    let follows = |line: &Line| line.columns == Columns::Row && !line.blank;
    for_runs(&mut lines, follows, pad_rows);
    let code_of = |line: &Line| {
        let blanks = if line.cells.is_empty() { 0 } else { 4 * line.indent };
        format!("{}{}", " ".repeat(blanks), line.cells.join(" "))
    };
    let mut code: Vec<String> = lines.iter().map(code_of).collect();
    pad_comments(&lines, &mut code);
    let mut text = String::new();
    for (line, code) in lines.iter().zip(code) {
        let blank = if line.blank { "\n" } else { "" };
        let comment = line.comment.as_deref().map(|comment| format!(" {comment}"));
        text += &format!("{blank}{code}{}\n", comment.unwrap_or_default());
    }
    text
}

/// Splits the lines before each line that does not continue the previous one, and visits the
/// pieces.
fn for_runs(
    lines: &mut [Line],
    follows: impl Fn(&Line) -> bool,
    mut visit: impl FnMut(&mut [Line]),
) {
    let mut rest = lines;
    while !rest.is_empty() {
        let indent = rest[0].indent;
        let end = rest[1..].iter().position(|line| !follows(line) || line.indent != indent);
        let (run, others) = rest.split_at_mut(end.map_or(rest.len(), |end| end + 1));
        visit(run);
        rest = others;
    }
}

/// Pads a cell in all lines of these columns with more than `least` cells.
fn pad(run: &mut [Line], cell: usize, columns: &[Columns], least: usize) {
    let takes_part =
        |line: &Line| columns.contains(&line.columns) && line.cells.len() > least.max(cell);
    let widths = run.iter().filter(|line| takes_part(line)).map(|line| width(&line.cells[cell]));
    let widest = widths.max().unwrap_or(0);
    for line in run.iter_mut().filter(|line| takes_part(line)) {
        let missing = widest - width(&line.cells[cell]);
        line.cells[cell] += &" ".repeat(missing);
    }
}

/// Pads the values of each column except the last.
fn pad_rows(run: &mut [Line]) {
    let most = run.iter().map(|line| line.cells.len()).max().unwrap_or(0);
    for cell in 0..most.saturating_sub(1) {
        pad(run, cell, &[Columns::Row], cell + 1);
    }
}

fn pad_comments(lines: &[Line], code: &mut [String]) {
    let mut start = 0;
    while start < lines.len() {
        let mut end = start + 1;
        let commented = |at: usize| lines[at].comment.is_some();
        let together = |at: usize| !lines[at].blank && lines[at].indent == lines[start].indent;
        while end < lines.len() && commented(start) && commented(end) && together(end) {
            end += 1;
        }
        let widest = code[start..end].iter().map(|code| width(code)).max().unwrap_or(0);
        for code in code[start..end].iter_mut().filter(|_| commented(start)) {
            let missing = widest - width(code);
            code.push_str(&" ".repeat(missing));
        }
        start = end;
    }
}

fn width(text: &str) -> usize {
    text.chars().count()
}
