//! The page of every code: its first example breaks the rule, its second keeps it.

use crate::support;

use afp_dsl::diagnostics::Code;

/// The code blocks of a page.
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
    for code in Code::ALL {
        let page = code.explanation();
        let title = format!("# {}: {}\n", code.as_str(), code.title());
        assert!(page.starts_with(&title), "{} should begin with {title}", code.as_str());
        let examples = blocks(page);
        assert_eq!(examples.len(), 2, "{}", code.as_str());
        let wrong = support::compile(&examples[0], &toolboxes);
        assert!(
            wrong.diags.iter().any(|each| each.code == *code),
            "{} is not reported in its example:\n{}",
            code.as_str(),
            wrong.render(false)
        );
        let right = support::compile(&examples[1], &toolboxes);
        assert!(right.diags.is_empty(), "{}:\n{}", code.as_str(), right.render(false));
    }
}

#[test]
fn codes_are_found_by_name() {
    assert_eq!(Code::parse("E0203"), Some(Code::E0203));
    assert_eq!(Code::parse("e0203"), Some(Code::E0203));
    assert_eq!(Code::parse("E9999"), None);
}
