//! The legend of colours in a drawing by use.

use super::metrics::width;
use super::sketch::{Anchor, Label, Rect, Shape, Sketch};
use super::usage::{Class, Use};

/// Font size in pixels.
const SIZE: f64 = 12.0;
/// A sample box.
const SAMPLE: (f64, f64) = (44.0, 20.0);
/// Distance between a sample and its text, and between two samples.
const GAP: (f64, f64) = (8.0, 28.0);

const LINES: [(Use, &str, &str); 3] = [
    (Use::Whole, "×3", "used, with all of its exits"),
    (Use::Partly, "×3", "used, but not all of its exits"),
    (Use::Never, "never", "never used"),
];

/// The legend at the origin, with its size.
pub(super) fn legend<'a>() -> (Sketch<'a>, f64, f64) {
    let mut sketch = Sketch::default();
    let mut x = 0.0;
    for (usage, sample, text) in LINES {
        let class = Class { name: "sample", usage: Some(usage) };
        let rect = Rect { x, y: 0.0, width: SAMPLE.0, height: SAMPLE.1 };
        sketch.frame(rect, Shape::Round(5.0), class);
        let label = |x, text| Label::new((x, SAMPLE.1 / 2.0 + 0.36 * SIZE), text, SIZE, "name");
        let sample = label(x + SAMPLE.0 / 2.0, sample);
        sketch.labels.push(Label { anchor: Anchor::Middle, ..sample });
        x += SAMPLE.0 + GAP.0;
        sketch.labels.push(label(x, text));
        x += width(text, SIZE, false) + GAP.1;
    }
    (sketch, x - GAP.1, SAMPLE.1)
}
