//! Messages do not influence results: with codes instead of texts the results are equal.

use afp_dsl::Compiled;
use afp_syntax::diagnostics::show_only_codes;

use crate::errors::stripped;
use crate::support;

/// Everything that tools use: all except the texts.
fn found(compiled: &Compiled) -> Vec<String> {
    let one = |each: &afp_syntax::diagnostics::Diagnostic| {
        let notes: Vec<_> = each.note_texts().map(|(span, _)| span).collect();
        format!("{:?} {:?} {:?} {:?}", (each.code, each.severity), each.span, each.fix, notes)
    };
    compiled.diags.iter().map(one).collect()
}

#[test]
fn checks_do_not_depend_on_the_wording() {
    let toolboxes = support::toolboxes();
    for path in support::files("tests/errors") {
        let text = stripped(&support::read(&path));
        let wanted = found(&support::compile(&text, &toolboxes));
        show_only_codes(true);
        let compiled = support::compile(&text, &toolboxes);
        let (found, first) = (found(&compiled), compiled.diags.get(0).map(|it| it.message_text()));
        show_only_codes(false);
        assert_eq!(found, wanted, "{}", path.display());
        assert_eq!(first.as_deref(), compiled.diags.get(0).map(|it| it.code.as_str()));
    }
}
