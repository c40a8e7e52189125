//! The page of every code: its first example breaks only that rule, its second breaks none.

use crate::support;

use afp_syntax::diagnostics::Code;

/// Codes that occur only beside others: polling too often for the tick also needs too much of the
/// processor.
const BESIDE_OTHERS: &[Code] = &[Code::E0403, Code::E0404];

fn blocks(page: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    for rest in page.split("```afp\n").skip(1) {
        blocks.extend(rest.split("```").next().map(str::to_owned));
    }
    blocks
}

#[test]
fn examples_break_and_keep_the_rule() {
    let toolboxes = support::toolboxes();
    let mut wrong = Vec::new();
    for code in Code::ALL {
        let page = code.explanation();
        let name = code.as_str();
        let title = format!("# {name}: {}\n", code.title());
        assert!(page.starts_with(&title), "{name} should begin with {title}");
        let examples = blocks(page);
        assert_eq!(examples.len(), 2, "{name}");
        let broken = support::compile(&examples[0], &toolboxes);
        let others = broken.diags.iter().any(|each| each.code != *code);
        if !broken.diags.iter().any(|each| each.code == *code) {
            wrong.push(format!("{name} is missing in its example:\n{}", broken.render(false)));
        } else if others && !BESIDE_OTHERS.contains(code) {
            wrong.push(format!("{name} has others beside it:\n{}", broken.render(false)));
        }
        let mended = support::compile(&examples[1], &toolboxes);
        if !mended.diags.is_empty() {
            wrong.push(format!("{name} mended:\n{}", mended.render(false)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn codes_are_found_by_name() {
    assert_eq!(Code::parse("E0203"), Some(Code::E0203));
    assert_eq!(Code::parse("e0203"), Some(Code::E0203));
    assert_eq!(Code::parse("E9999"), None);
}
