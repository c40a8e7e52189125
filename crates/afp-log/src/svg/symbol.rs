/// The symbol of a kind, around a point in pixels; `size` is 1 by default.
pub(super) fn symbol(kind: usize, x: f64, y: f64, size: f64) -> String {
    // After six kinds the shapes repeat, filled.
    let fill = if kind / 6 % 2 == 1 { " fill=\"#2b2b2b\"" } else { "" };
    let polygon = |corners: &[(f64, f64)]| {
        let points =
            corners.iter().map(|(dx, dy)| format!("{:.1},{:.1}", x + size * dx, y + size * dy));
        format!("<polygon{fill} points=\"{}\"/>", points.collect::<Vec<_>>().join(" "))
    };
    match kind % 6 {
        0 => polygon(&[(0.0, -7.0), (7.0, 6.0), (-7.0, 6.0)]),
        1 => format!("<circle{fill} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\"/>", 5.6 * size),
        2 => polygon(&[(-5.2, -5.2), (5.2, -5.2), (5.2, 5.2), (-5.2, 5.2)]),
        3 => polygon(&[(0.0, -7.5), (7.5, 0.0), (0.0, 7.5), (-7.5, 0.0)]),
        4 => polygon(&[(0.0, 7.0), (7.0, -6.0), (-7.0, -6.0)]),
        _ => {
            polygon(&[(-3.0, -6.5), (3.0, -6.5), (6.5, 0.0), (3.0, 6.5), (-3.0, 6.5), (-6.5, 0.0)])
        }
    }
}
