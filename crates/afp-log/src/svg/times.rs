//! Histograms of a real robot's control loop.

use std::fmt::Write;

use afp_core::Duration;
use afp_session::Histogram;

use super::canvas::escape;

const WIDTH: f64 = 960.0;
const HEAD: f64 = 72.0;
/// The height of a row, and of its highest bar.
const ROW: f64 = 44.0;
const BAR: f64 = 30.0;
/// The columns of names and numbers, and the margin on the right.
const NAMES: f64 = 24.0;
const PLOT: f64 = 330.0;
const MARGIN: f64 = 30.0;
/// The decades of the time axis, which begins at a microsecond.
const DECADES: f64 = 7.0;
const LABELS: [&str; 8] = ["1 us", "10 us", "100 us", "1 ms", "10 ms", "100 ms", "1 s", "10 s"];

const STYLE: &str = r##"<style>
text { font: 13px system-ui, "Helvetica Neue", Arial, sans-serif; fill: #2b2b2b }
.title { font-size: 17px; font-weight: 600 }
.quiet { font-size: 11.5px; fill: #77736b }
.grid { stroke: #e2dfd8 }
.bar { fill: #0072b2 }
.limit { stroke: #d55e00; stroke-width: 2 }
</style>
"##;

/// A histogram with its name.
#[derive(Clone, Debug)]
pub struct TimesRow<'a> {
    /// The name of the loop's or component's time.
    pub name: String,
    /// The durations.
    pub times: &'a Histogram,
    /// The declared budget or proved bound.
    pub limit: Option<Duration>,
}

/// Draws histograms below each other, with their limits. Both axes are logarithmic.
pub fn draw_times(title: &str, rows: &[TimesRow<'_>]) -> String {
    let bottom = HEAD + rows.len() as f64 * ROW;
    let height = bottom + 40.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\">\n{STYLE}\
         <rect width=\"100%\" height=\"100%\" fill=\"#f6f5f2\"/>\n\
         <text class=\"title\" x=\"{NAMES}\" y=\"30\">{}</text>\n\
         <text class=\"quiet\" x=\"{NAMES}\" y=\"50\">number, median, 99th percentile, worst; \
         the line is the declared budget or the proved bound</text>\n",
        escape(title),
    );
    for (decade, label) in LABELS.into_iter().enumerate() {
        let at = PLOT + (WIDTH - MARGIN - PLOT) * decade as f64 / DECADES;
        // Writing to a `String` cannot fail.
        let _ = writeln!(
            svg,
            "<line class=\"grid\" x1=\"{at:.1}\" y1=\"{HEAD}\" x2=\"{at:.1}\" y2=\"{bottom}\"/>\n\
             <text class=\"quiet\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
            bottom + 18.0
        );
    }
    for (index, row) in rows.iter().enumerate() {
        draw(&mut svg, row, HEAD + index as f64 * ROW);
    }
    svg.push_str("</svg>\n");
    svg
}

fn draw(svg: &mut String, row: &TimesRow<'_>, top: f64) {
    let TimesRow { name, times, limit } = row;
    let base = top + ROW - 8.0;
    let _ = writeln!(
        svg,
        "<text x=\"{NAMES}\" y=\"{:.1}\">{}</text>\n\
         <text class=\"quiet\" x=\"{NAMES}\" y=\"{:.1}\">{times}</text>",
        base - 16.0,
        escape(name),
        base,
    );
    let most = times.buckets().map(|(_, count)| count).max().unwrap_or(1);
    let size = |count: u64| libm::log10(1.0 + count as f64);
    for (end, count) in times.buckets() {
        let (right, height) = (place(end), BAR * size(count) / size(most));
        let left = (right - 10.0).max(place(Duration::from_nanos(end.as_nanos() / 9 * 8)));
        let _ = writeln!(
            svg,
            "<rect class=\"bar\" x=\"{left:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{height:.1}\"/>",
            base - height,
            (right - left).max(1.5),
        );
    }
    if let Some(limit) = limit {
        let at = place(*limit);
        let _ = writeln!(
            svg,
            "<line class=\"limit\" x1=\"{at:.1}\" y1=\"{:.1}\" x2=\"{at:.1}\" y2=\"{base:.1}\"/>",
            base - BAR - 3.0,
        );
    }
}

/// The place of a duration on the axis.
fn place(duration: Duration) -> f64 {
    let decades = libm::log10((duration.as_nanos() as f64 / 1e3).max(1.0)).min(DECADES);
    PLOT + (WIDTH - MARGIN - PLOT) * decades / DECADES
}
