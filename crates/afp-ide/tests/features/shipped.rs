//! Actions keep the shipped plans in canonical form.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Disk;
use afp_ide::edit::apply;
use afp_ide::{View, actions};
use afp_syntax::source::{Source, Span};

fn plans(folder: &Path, to: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.extension() {
            _ if path.is_dir() => plans(&path, to),
            Some(ending) if ending == "afp" => to.push(path),
            _ => {}
        }
    }
}

#[test]
fn actions_leave_canonical_plans_canonical() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../plans");
    let mut paths = Vec::new();
    plans(&folder, &mut paths);
    paths.sort();
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let (mut wrong, mut titles) = (Vec::new(), BTreeSet::new());
    for path in paths {
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(afp_format::format(&text).ok().as_ref(), Some(&text), "{}", path.display());
        let source = Source::new(path.display().to_string(), &*text);
        let compiled = compile(&source, &toolboxes, &Disk::default());
        let file = compiled.plan_files.start as u16;
        let view = View::new(&compiled, &toolboxes, file);
        let mut begin = 0;
        for line in text.split_inclusive('\n') {
            let (start, end) =
                (begin + line.len() - line.trim_start().len(), begin + line.trim_end().len());
            begin += line.len();
            let paragraph = text[start..].find("\n\n").map_or(end, |length| start + length);
            for end in [start, end.max(start), paragraph] {
                let place = Span { file, start: start as u32, end: end as u32 };
                for action in actions::actions(&view, place) {
                    let own = action.edits.iter().filter(|edit| edit.span.file == file);
                    let after = apply(&text, &own.cloned().collect::<Vec<_>>());
                    titles.insert(format!("{:?}", action.kind));
                    if afp_format::format(&after).ok().as_ref() != Some(&after) {
                        wrong.push(format!("{}: {}", path.display(), action.title));
                    }
                }
            }
        }
    }
    assert!(titles.contains("Inline") && titles.contains("Extract"), "{titles:?}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
