use std::sync::Arc;

use super::{Code, Diagnostic, Diagnostics, Severity};
use crate::source::{Source, Sources, Span};

fn span(start: u32, end: u32) -> Span {
    Span { file: 0, start, end }
}

#[test]
fn errors_are_identified_by_their_surroundings() {
    let mut all = Diagnostics::default();
    let places = [(Code::E0102, span(4, 9)), (Code::E0201, span(2, 3)), (Code::E0103, span(9, 9))];
    for (code, place) in places {
        all.push(Diagnostic::new(code, place, "it is wrong"));
    }
    assert_eq!(all.syntax_errors_within(span(0, 20)).collect::<Vec<_>>(), [span(4, 9), span(9, 9)]);
    assert_eq!(all.syntax_errors_within(span(5, 9)).collect::<Vec<_>>(), [span(9, 9)]);
    assert!(all.error_within(span(2, 3)) && !all.error_within(span(4, 8)));
    assert!(!all.error_within(Span { file: 1, ..span(0, 20) }));
    all.retain(|each| each.code != Code::E0201);
    assert!(!all.error_within(span(2, 3)) && all.has_errors());
    all.change(|each| each.severity = Severity::Warning);
    assert!(!all.error_within(span(0, 20)) && !all.has_errors());
}

#[test]
fn errors_of_a_long_text_are_shown_each_at_its_own_line() {
    let text = "ä # x\n".repeat(3000);
    let mut sources = Sources::default();
    sources.add(Arc::new(Source::new("long.afp", text)));
    let mut all = Diagnostics::default();
    for line in 0..3000 {
        let place = span(7 * line + 3, 7 * line + 4);
        all.push(Diagnostic::new(Code::E0101, place, "it is wrong").help("remove it"));
    }
    let shown = all.render(&sources, false);
    let json = all.json_lines(&sources);
    assert!(shown.ends_with("\n\nand 2,980 more errors"));
    for (line, (text, object)) in (1..=20).zip(shown.split("\n\n").zip(json.lines())) {
        assert!(text.contains(&format!("--> long.afp:{line}:3\n")), "{line}: {text}");
        assert!(object.contains(&format!("\"column\":3,\"end\":{}", 7 * line - 3)), "{object}");
        assert!(object.contains(&format!("\"line\":{line},")), "{object}");
        let alone = all.get(line - 1).unwrap();
        assert_eq!(
            (alone.render(&sources, false), alone.json(&sources)),
            (text.into(), object.into())
        );
    }
}
