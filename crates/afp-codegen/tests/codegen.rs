//! Golden Rust: each `codegen/*.afp` generates the `.rs` with its name. `AFP_BLESS=1` rewrites.
//!
//! A case is about one construct. A first line `// shows: Actors, Rules` limits its golden text to
//! these sections. The macros' tests check that all of it compiles (`afp-macros`,
//! `tests/everything.rs`).

use std::path::{Path, PathBuf};
use std::{env, fs};

use afp_codegen::{
    CrateFile, CrateOptions, Dependency, Features, Module, Options, Origin, RUST_MADE_BY,
};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_dsl::toolbox::Toolbox;
use afp_syntax::source::Source;
use similar::TextDiff;

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/codegen");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut cases: Vec<_> =
        files.filter(|path| path.extension().is_some_and(|e| e == "afp")).collect();
    cases.sort();
    cases
}

fn toolboxes() -> Toolboxes {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/codegen/toolbox.afp");
    toolboxes.add(Source::new("toolbox.afp", fs::read_to_string(folder).unwrap()), "crate::kit");
    toolboxes
}

/// The Rust text of a file: its toolbox, or the shown parts of its plans' modules.
fn generate(path: &Path) -> String {
    let name = path.file_name().unwrap().to_string_lossy().into_owned();
    let source = Source::new(name, fs::read_to_string(path).unwrap());
    let options = Options::default();
    if source.text.contains("\ntoolbox ") {
        let (toolbox, diags) = Toolbox::parse(&source, 0, "crate::kit");
        assert!(!diags.has_errors());
        return afp_codegen::file(afp_codegen::toolbox(&toolbox.unwrap(), &options));
    }
    let compiled = afp_dsl::compile(&source, &toolboxes(), &Texts::default());
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    let generated = afp_codegen::plan(&compiled.graph.unwrap(), &options);
    let shown = source.text.lines().next().and_then(|line| line.strip_prefix("// shows: "));
    let texts = generated.modules.iter().filter_map(|module| {
        let text = show(module, shown)?;
        Some(format!("// {}.rs\n\n{text}", module.name))
    });
    texts.collect::<Vec<_>>().join("\n")
}

fn show(module: &Module, sections: Option<&str>) -> Option<String> {
    let Some(sections) = sections else { return Some(afp_codegen::file(module.tokens())) };
    let named = |title: &str| sections.split(", ").any(|section| section == title);
    let tokens = module.sections.iter().filter(|(title, _)| named(title));
    let text = afp_codegen::file(tokens.map(|(_, tokens)| tokens.clone()).collect());
    Some(text).filter(|text| !text.is_empty())
}

#[test]
fn plans_and_toolboxes_generate_their_golden_rust() {
    let mut wrong = Vec::new();
    for case in cases() {
        let golden = case.with_extension("rs");
        let text = generate(&case);
        assert!(!text.is_empty(), "{} shows nothing", case.display());
        if env::var_os("AFP_BLESS").is_some() {
            fs::write(&golden, &text).unwrap();
            continue;
        }
        let expected = fs::read_to_string(&golden).unwrap_or_default();
        if expected != text {
            let diff = TextDiff::from_lines(&expected, &text);
            let name = golden.file_name().unwrap().to_string_lossy();
            wrong.push(diff.unified_diff().header(&name, "generated").to_string());
        }
    }
    assert!(
        wrong.is_empty(),
        "other Rust than expected (AFP_BLESS=1 rewrites):\n{}",
        wrong.join("\n")
    );
}

/// The plan of the paper: its text, its graph, and the options of its crate.
fn wall_following() -> (String, Graph, CrateOptions) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/codegen/wall_following.afp");
    let text = fs::read_to_string(path).unwrap();
    let compiled = afp_dsl::compile(
        &Source::new("wall_following.afp", text.clone()),
        &toolboxes(),
        &Texts::default(),
    );
    let options = CrateOptions {
        file: "plans/wall_following.afp".to_owned(),
        texts: vec![("wall_following.afp".to_owned(), text.clone())],
        toolboxes: Vec::new(),
        project: String::new(),
        origin: Origin::Path("/home/a \"b\"".to_owned()),
        robot: None,
        hardware: None,
        dependencies: Vec::new(),
        features: Vec::new(),
        lib: false,
    };
    (text, compiled.graph.unwrap(), options)
}

#[test]
fn a_crate_names_its_dependencies_and_contains_its_text() {
    let (text, graph, mut options) = wall_following();
    let files = afp_codegen::crate_files(&graph, &options);
    let get = |path: &str| files.iter().find(|file| file.path == path).map(|file| &file.text);
    let names: Vec<_> = files.iter().map(|file| file.path.as_str()).collect();
    assert_eq!(
        names,
        [
            "Cargo.toml",
            "wall_following.afp",
            "src/lib.rs",
            "src/main.rs",
            "src/units.rs",
            "src/wall_following.rs"
        ]
    );
    let manifest = get("Cargo.toml").unwrap();
    assert!(
        manifest.contains(r#"afp-carbot = { path = "/home/a \"b\"/crates/afp-carbot" }"#),
        "{manifest}"
    );
    assert!(!manifest.contains("afp-dsl"));
    assert_eq!(get("wall_following.afp"), Some(&text));
    assert!(
        get("src/main.rs").unwrap().contains(
            "afp_run::main::<Simulation, _>(program, wall_following::WallFollowing::new)"
        )
    );
    options.texts.push(("lib/avoid.afp".to_owned(), "plan Avoid {}".to_owned()));
    let files = afp_codegen::crate_files(&graph, &options);
    let get = |path: &str| files.iter().find(|file| file.path == path).map(|file| &*file.text);
    assert_eq!(get("lib/avoid.afp"), Some("plan Avoid {}"));
    let library = get("src/lib.rs").unwrap();
    assert!(library.contains("include_str!(\"../lib/avoid.afp\")"), "{library:?}");
}

#[test]
fn a_program_contains_the_project_and_its_toolboxes_for_its_logs() {
    let (_, graph, mut options) = wall_following();
    options.toolboxes = vec![("arm".to_owned(), "toolbox arm\n".to_owned())];
    options.project = "[robot]\n".to_owned();
    options.texts.push(("attached/arm.afp".to_owned(), "plan Arm {}".to_owned()));
    let files = afp_codegen::crate_files(&graph, &options);
    let get = |path: &str| files.iter().find(|file| file.path == path).map(|file| &*file.text);
    assert_eq!(get("attached/arm.afp"), Some("plan Arm {}"), "a file of the plan keeps its place");
    assert_eq!(get("attached_/arm.afp"), Some("toolbox arm\n"));
    assert_eq!(get("attached_/project.toml"), Some("[robot]\n"));
    let main = get("src/main.rs").unwrap();
    for path in ["attached_/arm.afp", "attached_/project.toml"] {
        assert!(main.contains(&format!("include_str!(\"../{path}\")")), "{main}");
    }
    options.lib = true;
    let files = afp_codegen::crate_files(&graph, &options);
    assert!(!files.iter().any(|file| file.path.starts_with("attached_")));
}

/// The files of a crate of a plan and its sub-plans, each used by the file of the next one.
fn crate_of(plans: &[&str], options: &CrateOptions) -> Vec<CrateFile> {
    let texts = plans.iter().enumerate().map(|(i, name)| match plans.get(i + 1) {
        Some(next) => {
            format!("plan {name} {{ start go subplan go: {next}() {{ OK -> terminate }} }}\n")
        }
        None => format!(
            "plan {name} {{ start go computation go: Log(value = 1) {{ Done -> terminate }} }}\n"
        ),
    });
    let source = Source::new("x.afp", format!("use std\n{}", texts.collect::<String>()));
    let compiled = afp_dsl::compile(&source, &toolboxes(), &Texts::default());
    let errors = compiled.render(false);
    afp_codegen::crate_files(&compiled.graph.unwrap_or_else(|| panic!("{errors}")), options)
}

#[test]
fn no_name_of_a_plan_collides_with_a_file_or_crate() {
    let (_, _, mut options) = wall_following();
    options.robot = Some("robot_arm::Arm".to_owned());
    options.dependencies = vec![Dependency {
        key: "robot-arm".to_owned(),
        package: "arm".to_owned(),
        origin: Origin::Path("../arm".to_owned()),
        features: Features::Default,
    }];
    for (plans, package, modules) in [
        (&["Main"][..], "main", &["main_plan"][..]),
        (&["Lib", "Main", "Str"], "lib", &["str_plan", "main_plan", "lib_plan"]),
        (&["Enums", "EnumsPlan"], "enums", &["enums_plan", "enums_plan_plan"]),
        (&["Std"], "std-plan", &["std_plan"]),
        (&["Afp"], "afp-plan", &["afp"]),
        (&["AfpRun"], "afp-run-plan", &["afp_run"]),
        (&["AfpCore"], "afp-core-plan", &["afp_core"]),
        (&["Arm"], "arm-plan", &["arm"]),
        (&["RobotArm"], "robot-arm-plan", &["robot_arm"]),
        (&["Build"], "build-plan", &["build"]),
        (&["Program"], "program", &["program"]),
    ] {
        let files = crate_of(plans, &options);
        let get = |path: &str| &files.iter().find(|file| file.path == path).unwrap().text;
        let manifest = get("Cargo.toml");
        assert!(manifest.contains(&format!("name = \"{package}\"")), "{manifest}");
        let mut wanted: Vec<_> = ["main", "lib"].iter().chain(modules).collect();
        let of = |file: &CrateFile| {
            Some(file.path.strip_prefix("src/")?.strip_suffix(".rs")?.to_owned())
        };
        let mut paths: Vec<_> = files.iter().filter_map(of).collect();
        wanted.sort();
        paths.sort();
        assert!(paths.iter().eq(wanted), "{plans:?}: {paths:?}");
        assert!(get("src/main.rs").contains("fn main()"));
        let main = format!("{}::{}::new", package.replace('-', "_"), plans[0]);
        assert!(get("src/main.rs").contains(&main), "{}", get("src/main.rs"));
    }
}

#[test]
fn every_rust_file_names_its_generator_and_has_places() {
    let (_, graph, options) = wall_following();
    let files = afp_codegen::crate_files(&graph, &options);
    let rust = files.iter().filter(|file| file.path.ends_with(".rs"));
    for file in rust {
        let head = format!("{RUST_MADE_BY} from wall_following.afp.\n\n//! ");
        assert!(file.text.starts_with(&head), "{}", file.text);
    }
    let plan = files.iter().find(|file| file.path == "src/wall_following.rs").unwrap();
    let line = plan.text.lines().position(|line| line.contains("SearchFirstWall(")).unwrap();
    let (span, exact) = plan.place(line + 1);
    let text = &options.texts[0].1[span.start as usize..span.end as usize];
    assert_eq!((text, exact), ("searchFirstWall", true));
}

#[test]
fn a_library_takes_its_dependencies_from_the_given_place() {
    let (_, graph, mut options) = wall_following();
    options.lib = true;
    options.origin = Origin::Version("0.1.0".to_owned());
    options.dependencies = vec![Dependency {
        key: "afp-carbot".to_owned(),
        package: "mine".to_owned(),
        origin: Origin::Path("../mine".to_owned()),
        features: Features::Default,
    }];
    let files = afp_codegen::crate_files(&graph, &options);
    assert!(files.iter().all(|file| file.path != "src/main.rs"));
    assert!(
        files[0].text.contains("afp-carbot = { path = \"../mine\", package = \"mine\" }"),
        "{}",
        files[0].text
    );
    assert!(!files[0].text.contains("afp-run"));
}

#[test]
fn a_crate_named_like_its_toolbox_keeps_its_name() {
    let text =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/codegen/toolbox.afp"))
            .unwrap();
    let mut toolboxes = Toolboxes::default();
    toolboxes.add(Source::new("toolbox.afp", text), "kit");
    let plan = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/codegen/objects.afp");
    let source = Source::new("objects.afp", fs::read_to_string(plan).unwrap());
    let compiled = afp_dsl::compile(&source, &toolboxes, &Texts::default());
    let generated = afp_codegen::plan(&compiled.graph.unwrap(), &Options::default());
    let code = afp_codegen::file(generated.tokens());
    assert!(code.contains("use kit::templates as kit_templates;"), "{code}");
    assert!(code.contains("Seek(kit::Seek)") && code.contains("kit_templates::seek::"), "{code}");
    assert!(!code.contains("kit::seek::"), "{code}");
}

#[test]
fn only_plans_that_can_be_suspended_or_held_have_code_for_it() {
    const DRIVE: &str = "use std
plan P {
    start go
    actor go: Wait(duration = 1 s) {
        supervise late: CheckTimeout(duration = 2 s) { TimedOut -> EDGE }
        Elapsed -> terminate
    }
    HANDLER
}";
    let code = |edge: &str, handler: &str, hold: bool| {
        let text = DRIVE.replace("EDGE", edge).replace("HANDLER", handler);
        let compiled =
            afp_dsl::compile(&Source::new("x.afp", text), &toolboxes(), &Texts::default());
        let errors = compiled.render(false);
        let graph = compiled.graph.unwrap_or_else(|| panic!("{errors}"));
        let options = Options { hold, ..Options::default() };
        afp_codegen::file(afp_codegen::plan(&graph, &options).tokens())
    };
    let rest = "actor rest: Wait(duration = 1 s) { Elapsed -> return }";
    // The started handler has its own place; the supervisors share theirs.
    let parts =
        ["handler: Handler,", "fn suspend_element", "fn resume_element", "HOLDS", "[Slot; 1]"];
    let found = |code: &str| parts.map(|part| code.contains(part));
    assert_eq!(found(&code("terminate", "", false)), [false, false, false, false, true]);
    assert_eq!(found(&code("suspend rest", rest, false)), [true, true, true, false, true]);
    assert_eq!(found(&code("terminate", "", true)), [false, true, true, true, true]);
}
