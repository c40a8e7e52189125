//! `afpc graph`: plans with errors, icons of a project.

use crate::common::Place;

#[test]
fn a_plan_with_errors_is_drawn_and_its_errors_are_printed() {
    let place = Place::new();
    place.write("p.afp", "use carbot\nplan P {\n    start go\n    actor go: Forwrd {\n    }\n}\n");
    let said = place.afpc("graph p.afp -o p.svg");
    assert_eq!(said.code, 1, "{said:?}");
    assert!(said.err.contains("E0201"), "{said:?}");
    let picture = place.read("p.svg");
    assert!(picture.contains(">Forwrd</text>") && picture.contains("icon wrong"), "{picture}");
    let said = place.afpc("graph p.afp --format scxml");
    assert!(said.code == 1 && said.out.is_empty(), "{said:?}");
}

#[test]
fn a_file_without_a_plan_is_not_drawn() {
    let place = Place::with_plan();
    place.write("tools.afp", "toolbox tools\n");
    for ending in [
        "svg",
        "json",
        "dot",
        "scxml",
        #[cfg(feature = "png")]
        "png",
    ] {
        let graph = |plan: &str| place.afpc(&format!("graph {plan} -o g.{ending}"));
        graph("wall_following.afp").succeeds();
        let good = place.bytes(&format!("g.{ending}"));
        graph("wall_following.afp:Wal").fails(1, &["E0504"]);
        graph("tools.afp").fails(1, &["E0503"]);
        assert_eq!(place.bytes(&format!("g.{ending}")), good);
        let said = place.afpc(&format!("graph tools.afp --format {ending}"));
        assert_eq!((said.code, said.out.as_str()), (1, ""), "{said:?}");
    }
}

#[test]
fn icons_are_next_to_the_toolbox_of_a_project() {
    let place = Place::new();
    place.write("afp.toml", "[toolboxes]\nmine = { path = \"tools/mine.afp\" }\n");
    let toolbox = "toolbox mine\n\nactor Dance {\n    icon \"dance\"\n    state Danced\n}\n";
    place.write("tools/mine.afp", toolbox);
    let plan = "use mine\nplan P { start go actor go: Dance { Danced -> terminate } }\n";
    place.write("p.afp", plan);
    let icon = |content: &str| format!("<svg viewBox=\"0 0 8 8\">{content}</svg>");
    place.write("tools/icons/dance.svg", &icon("<path d=\"M1 2h3\"/>"));
    let drawn = || place.afpc("graph p.afp").out;
    assert!(drawn().contains("M1 2h3"), "{}", drawn());
    place.write("tools/icons/dance.svg", &icon("<animate/onbegin=alert(1)><path d=\"M1 2h3\"/>"));
    assert!(!drawn().contains("animate") && !drawn().contains("M1 2h3"), "{}", drawn());
}

#[test]
#[cfg(feature = "png")]
fn a_picture_of_too_many_pixels_is_refused_before_it_is_laid_out() {
    let place = Place::new();
    // The number of boxes is enough for the error. After the layout, it names width and height.
    let actor = |nth: usize| format!("    actor a{nth}: Wait {{ Elapsed -> a{} }}\n", nth + 1);
    let actors: String = (0..4000).map(actor).collect();
    let last = "    actor a4000: Wait { Elapsed -> terminate }\n";
    place.write("p.afp", &format!("use std\nplan P {{\n    start a0\n{actors}{last}}}\n"));
    let said = place.afpc("graph p.afp -o p.png --scale 4");
    said.fails(2, &["million pixels large, at most 250 million", "choose a smaller '--scale'"]);
}
