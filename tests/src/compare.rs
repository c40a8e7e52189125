//! Shows the first difference of two traces.

/// Lines shown of each trace.
const SHOWN: usize = 12;

/// The first difference of two traces, `None` if they are equal.
pub fn part(left: &[String], right: &[String]) -> Option<String> {
    if left == right {
        return None;
    }
    let same = left.iter().zip(right).take_while(|(a, b)| a == b).count();
    let show = |lines: &[String]| {
        let rest = lines.get(same..).unwrap_or(&[]);
        rest.iter().take(SHOWN).map(|line| format!("  {line}\n")).collect::<String>()
    };
    Some(format!("after {same} equal lines\n{}instead of\n{}", show(right), show(left)))
}
