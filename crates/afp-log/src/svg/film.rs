//! A film strip of the camera's pictures in a log, each with its time and the active actor.

mod still;

use std::fmt::Write;

use afp_core::Instant;
use afp_core::trace::{ComponentId, Names};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::canvas::escape;
use super::{NOBODY, PALETTE, follow, known_actors};
use crate::{LogData, LogNames};
use still::fewer_colors;

/// The maximum number of pictures; longer films are thinned out evenly.
const MOST: usize = 40;
const COLUMNS: usize = 5;
/// The width of a picture, in pixels; it keeps its aspect ratio. In a PNG with two pixels for each,
/// a camera pixel is 3 by 3.
const WIDTH: f64 = 240.0;
const HEIGHT: f64 = 180.0;
const CAPTION: f64 = 30.0;
const GAP: f64 = 10.0;
const MARGIN: f64 = 24.0;
const HEAD: f64 = 62.0;

const STYLE: &str = r#"<style>
text { font: 12.5px system-ui, "Helvetica Neue", Arial, sans-serif; fill: #2b2b2b }
.title { font-size: 17px; font-weight: 600 }
.quiet { fill: #77736b }
.time { font-weight: 600 }
</style>
"#;

struct Shot<'a> {
    at: Instant,
    png: &'a [u8],
    actor: Option<ComponentId>,
}

/// Draws the film strip of a logged run; `None` for a log without camera pictures.
pub fn draw_film(log: &LogData) -> Option<String> {
    if log.images.is_empty() {
        return None;
    }
    let names = &log.names;
    let (path, _) = follow(&log.events, &log.poses, names);
    let known = known_actors(&path, names);
    let actor_at = |at: Instant| {
        let behind = log.poses.partition_point(|(time, _)| *time <= at);
        path.get(behind.checked_sub(1)?)?.actor
    };
    let shots = thinned(&log.images);
    let rows = shots.len().div_ceil(COLUMNS);
    let columns = shots.len().min(COLUMNS);
    let width = 2.0 * MARGIN + columns as f64 * (WIDTH + GAP) - GAP;
    let height = HEAD + rows as f64 * (HEIGHT + CAPTION + GAP) + MARGIN - GAP;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\">\n{STYLE}\
         <rect width=\"100%\" height=\"100%\" fill=\"#f6f5f2\"/>\n"
    );
    head(&mut svg, log, shots.len());
    for (index, (at, png)) in shots.iter().enumerate() {
        let (column, row) = (index % COLUMNS, index / COLUMNS);
        let x = MARGIN + column as f64 * (WIDTH + GAP);
        let y = HEAD + row as f64 * (HEIGHT + CAPTION + GAP);
        let shot = Shot { at: *at, png, actor: actor_at(*at) };
        draw(&mut svg, &shot, names, &known, (x, y));
    }
    svg.push_str("</svg>\n");
    Some(svg)
}

/// At most `MOST` pictures, from the first to the last.
fn thinned(images: &[(Instant, Vec<u8>)]) -> Vec<&(Instant, Vec<u8>)> {
    match images.len() {
        count @ ..=MOST => images.iter().take(count).collect(),
        count => (0..MOST).filter_map(|n| images.get(n * (count - 1) / (MOST - 1))).collect(),
    }
}

fn head(svg: &mut String, log: &LogData, shown: usize) {
    let fact = |key: &str| escape(log.facts.get(key).map_or("", String::as_str));
    let count = match log.images.len() {
        all if all == shown => format!("{all} pictures"),
        all => format!("{shown} of {all} pictures"),
    };
    let _ = writeln!(
        svg,
        "<text class=\"title\" x=\"{MARGIN}\" y=\"30\">{}</text>\n\
         <text class=\"quiet\" x=\"{MARGIN}\" y=\"49\">{}, seed {}: {count} of the camera</text>",
        fact("plan"),
        fact("world"),
        fact("seed"),
    );
}

fn draw(
    svg: &mut String,
    shot: &Shot<'_>,
    names: &LogNames,
    known: &[ComponentId],
    (x, y): (f64, f64),
) {
    let index = shot.actor.and_then(|actor| known.iter().position(|each| *each == actor));
    let color = index.map_or(NOBODY, |index| PALETTE[index % PALETTE.len()]);
    let name = shot.actor.map_or("", |actor| names.component(actor).path);
    let (below, text) = (y + HEIGHT, y + HEIGHT + 20.0);
    let right = x + WIDTH;
    let secs = shot.at.as_secs_f64();
    // An invalid or oversized picture is left out.
    if let Some(fewer) = fewer_colors(shot.png) {
        let data = STANDARD.encode(fewer);
        let _ = writeln!(
            svg,
            "<image x=\"{x}\" y=\"{y}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" \
             image-rendering=\"optimizeSpeed\" href=\"data:image/png;base64,{data}\"/>"
        );
    }
    let _ = writeln!(
        svg,
        "<rect x=\"{x}\" y=\"{below}\" width=\"{WIDTH}\" height=\"4\" fill=\"{color}\"/>\n\
         <text class=\"time\" x=\"{x}\" y=\"{text}\">{secs:.1} s</text>\n\
         <text class=\"quiet\" x=\"{right}\" y=\"{text}\" text-anchor=\"end\">{}</text>",
        escape(name),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_film_keeps_its_ends() {
        let image = |n: u64| (Instant::from_nanos(n), Vec::new());
        let images: Vec<_> = (0..121).map(image).collect();
        let shown = thinned(&images);
        assert_eq!(shown.len(), MOST);
        assert_eq!((shown[0].0.as_nanos(), shown[MOST - 1].0.as_nanos()), (0, 120));
        assert_eq!(thinned(&images[..7]).len(), 7);
    }
}
