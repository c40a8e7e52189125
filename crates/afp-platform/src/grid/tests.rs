use super::{Contact, Grid};
use afp_session::Pose2;

const HALL: &str = "Hall\ncell 50 cm\n\n#####\n# * #\n#> o#\n#####\n";

#[test]
fn a_drawing_is_read_line_by_line() {
    let hall = Grid::read(HALL, "*o").unwrap();
    assert_eq!(hall.name, "Hall");
    assert_eq!(hall.start, Pose2 { x: 0.75, y: 0.75, heading: 0.0 });
    // The upper row has the greater y.
    for (x, y, letter) in [(1.25, 1.25, '*'), (1.75, 0.75, 'o'), (0.75, 0.75, ' '), (0.2, 0.2, '#')]
    {
        assert_eq!(hall.letter(x, y), letter, "({x}, {y})");
    }
    for (x, y) in
        [(-0.1, 1.0), (2.6, 1.0), (1.0, -0.1), (1.0, 2.1), (1e300, 1e300), (f64::NAN, 1.0)]
    {
        assert_eq!(hall.letter(x, y), '#', "({x}, {y})");
    }
    let drawing = hall.drawing(0.2, &[('*', [1, 2, 3])]);
    assert_eq!(drawing.patches[0].corners, [[1.0, 1.0], [1.5, 1.0], [1.5, 1.5], [1.0, 1.5]]);
    assert_eq!(drawing.things.len(), 6, "rows in one piece, two ends each of the others");
}

#[test]
fn an_error_is_shown_at_its_place() {
    for (text, at, why) in [
        ("Hall\ncell 3 m\n#>#", "cell 3 m", "'cell 25 cm'"),
        ("Hall\ncell 0 cm\n#>#", "cell 0 cm", "from 1 to 500"),
        ("Hall\ncell 25 cm\n#>?#", "?", "'?' is none of '#', ' ', '>^<v' and '*'"),
        ("Hall\ncell 25 cm\n#> \u{e9}", "\u{e9}", "is none of"),
    ] {
        let wrong = Grid::read(text, "*").unwrap_err();
        assert_eq!(&text[wrong.span.clone().unwrap()], at, "{wrong}");
        assert!(wrong.message.contains(why), "{wrong}");
    }
    let wide = "#".repeat(3 << 20);
    for rows in [format!(">\n{wide}\n#"), format!("{}>#{wide}", "#\n".repeat(1 << 20))] {
        let text = format!("Hall\ncell 25 cm\n{rows}");
        let wrong = Grid::read(&text, "").unwrap_err();
        assert!(text[wrong.span.clone().unwrap()].ends_with(&wide), "{wrong}");
        assert!(wrong.message.contains("at most 4194304 cells"), "{wrong}");
    }
    for text in ["Hall\ncell 25 cm\n###", "Hall\ncell 25 cm\n#>v#"] {
        assert!(Grid::read(text, "").unwrap_err().message.contains("one of '>^<v'"));
    }
    for text in ["", "\n", "x", "x\ncell 25 cm"] {
        assert!(Grid::read(text, "").is_err(), "{text:?}");
    }
}

#[test]
fn a_place_that_is_not_a_number_touches_nothing() {
    let hall = Grid::read(HALL, "*o").unwrap();
    for (x, y) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0)] {
        assert_eq!(hall.contacts(x, y, 0.25).count(), 0);
    }
}

#[test]
fn walls_push_a_disc_out() {
    let hall = Grid::read(HALL, "*o").unwrap();
    let mut pose = Pose2 { x: 0.65, y: 1.0, heading: 0.0 };
    let contacts: Vec<_> = hall.contacts(pose.x, pose.y, 0.25).collect();
    assert!(
        contacts
            .iter()
            .all(|Contact { towards, depth }| { towards[0] < 0.0 && (depth - 0.1).abs() < 1e-9 })
    );
    assert_eq!(contacts.len(), 2, "the cells of two rows");
    hall.push_out(&mut pose, 0.25);
    assert!((pose.x - 0.75).abs() < 1e-9, "{pose:?}");
    assert_eq!(hall.contacts(pose.x, pose.y, 0.249).count(), 0);
    assert!(hall.started_at(pose, 0.249).is_ok());
    assert!(hall.started_at(Pose2 { x: 0.6, ..pose }, 0.249).is_err());
}

#[test]
fn the_robot_can_start_on_random_floors() {
    for seed in 0..200 {
        let text = Grid::made_up(seed, 20, 12, &[('#', 8), ('*', 5)]);
        let floor = Grid::read(&text, "*").unwrap();
        assert!(floor.started_at(floor.start, 0.2).is_ok(), "{text}");
    }
    let of = |seed| Grid::made_up(seed, 20, 12, &[('#', 8)]);
    assert_ne!(
        of(1).lines().skip(1).collect::<String>(),
        of(2).lines().skip(1).collect::<String>()
    );
}
