//! Maps of `map_server` become worlds.

use afp_carbot::devices::{Navigator, Ultrasonic};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Instant};
use afp_session::Robot;
use afp_sim::{Pose, Simulation, World};

use crate::world::placed;

const YAML: &str = "image: room.pgm\nmode: trinary\nresolution: 0.1\norigin: [-1.0, -2.0, 0]\n\
                    negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// Four by five metres with walls one cell thick, and an unknown cell in a corner.
fn room() -> Vec<u8> {
    let mut picture = b"P5\n# made for a test\n40 50\n255\n".to_vec();
    for row in 0..50 {
        for column in 0..40 {
            let wall = row % 49 == 0 || column % 39 == 0;
            let unknown = (row, column) == (1, 1);
            picture.push(if wall {
                0
            } else if unknown {
                205
            } else {
                254
            });
        }
    }
    picture
}

#[test]
fn a_map_has_its_walls_at_their_places_and_the_robot_near_the_origin() {
    assert_eq!(World::map_picture(YAML).as_deref(), Ok("room.pgm"));
    let text = World::map_text("a \"room\"", YAML, &room()).unwrap();
    let world = World::parse(&text).unwrap();
    assert_eq!(world.name, "a \"room\"");
    assert_eq!(world.obstacles.len(), 4, "{text}");
    let corners = || world.obstacles.iter().flat_map(|obstacle| obstacle.outline.corners());
    let least = |i: usize| corners().map(|c| c[i]).fold(f64::INFINITY, f64::min);
    let most = |i: usize| corners().map(|c| c[i]).fold(f64::NEG_INFINITY, f64::max);
    for (is, expected) in [(least(0), -1.0), (most(0), 3.0), (least(1), -2.0), (most(1), 3.0)] {
        assert!((is - expected).abs() < 1e-9, "{is} for {expected}");
    }
    let Pose { x, y, heading } = world.start;
    assert!((x.abs() - 0.05).abs() < 1e-9 && (y.abs() - 0.05).abs() < 1e-9 && heading == 0.0);
    let mut sim = Simulation::new(&world, 1).unwrap();
    sim.advance_to(Instant::ZERO + Duration::from_secs(1));
    let distance = sim.echo().value.unwrap().distance.expect("the wall is in range").si();
    assert!((distance - (2.9 - x - 0.1)).abs() < 0.03, "{distance}");
}

#[test]
fn the_robot_starts_inside_of_the_walls() {
    // A closed room far from the origin; the floor around it is free and nearer to the origin.
    let mut picture = b"P5\n60 30\n255\n".to_vec();
    for row in 0..30 {
        for column in 0..60 {
            let room = (5..25).contains(&row) && (30..55).contains(&column);
            let inner = (6..24).contains(&row) && (31..54).contains(&column);
            picture.push(if room && !inner { 0 } else { 254 });
        }
    }
    let yaml = YAML.replace("[-1.0, -2.0, 0]", "[0.0, 0.0, 0]");
    let world = World::parse(&World::map_text("m", &yaml, &picture).unwrap()).unwrap();
    assert!((3.1..5.4).contains(&world.start.x), "{:?}", world.start);
    assert!((0.6..2.4).contains(&world.start.y), "{:?}", world.start);
}

#[test]
fn a_turned_map_is_turned_about_its_corner() {
    let yaml = YAML.replace("[-1.0, -2.0, 0]", "[0.0, 0.0, 1.5707963267948966]");
    let world = World::parse(&World::map_text("m", &yaml, &room()).unwrap()).unwrap();
    let corners = world.obstacles.iter().flat_map(|obstacle| obstacle.outline.corners());
    for [x, y] in corners {
        assert!((-5.001..=0.001).contains(&x) && (-0.001..=4.001).contains(&y), "{x} {y}");
    }
}

#[test]
fn errors_in_a_map_are_reported() {
    let cases = [
        (YAML.replace("resolution: 0.1", "resolution: big"), "line 3, column 1: resolution: must"),
        (
            YAML.replace("[-1.0, -2.0, 0]", "[-1.0, -2.0]"),
            "line 4, column 1: origin: must be three",
        ),
        (format!("{YAML}unknown: wall\n"), "line 8, column 1: unknown: 'wall' is unknown"),
        (YAML.replace("trinary", "foo"), "line 2, column 1: mode: 'foo' is unknown"),
        (
            YAML.replace("trinary", "5"),
            "line 2, column 1: mode: must be 'trinary' or 'scale' or 'raw'",
        ),
        (YAML.replace("negate: 0", "negate: some"), "line 5, column 1: negate: must be 0 or 1"),
        (YAML.replace("[-1.0,", "[a, -1.0,"), "line 4, column 1: origin: must be three"),
        (YAML.replace("0.65", "1.5"), "occupied_thresh: is not within 0 and 1"),
        (YAML.replace("0.196", "0.7"), "free_thresh: is more than 'occupied_thresh'"),
        (YAML.replace("0.65", "1.0"), "no cell of the map is occupied"),
        (YAML.replace("image: room.pgm", "image: ''"), "line 1, column 1: image: must name a"),
        (
            YAML.replace("image: room.pgm", "images: a"),
            "image: must name a picture, and is missing",
        ),
        (YAML.replace("resolution: 0.1", "resolution: 0.01"), "no free place"),
        (YAML.replace("[-1.0", "[998"), "the map reaches farther than 1000 m"),
        ("a: [".to_owned(), "line 1, column "),
        ("image: room.pgm\nmode".to_owned(), "line 2, column 5"),
        (String::new(), "image"),
    ];
    for (yaml, expected) in cases {
        let message = placed(&yaml, &World::map_text("m", &yaml, &room()).unwrap_err());
        assert!(message.contains(expected), "{message}");
    }
    let message = World::map_text("m", YAML, b"GIF89a").unwrap_err().to_string();
    assert_eq!(message, "the map's picture is neither PGM nor PNG");
}

fn walls(settings: &str, greys: &[u8]) -> Vec<usize> {
    // The row of greys has free space for the robot around it, and a wall, because a map needs one.
    let mut rows = vec![[254; 40]; 40];
    rows[0] = [0; 40];
    rows[20][..greys.len()].copy_from_slice(greys);
    if settings.contains("raw") {
        rows = rows.iter().map(|row| row.map(|grey| if grey == 254 { 0 } else { grey })).collect();
        rows[0] = [100; 40];
    }
    let picture = [b"P5\n40 40\n255\n".as_slice(), rows.as_flattened()].concat();
    let yaml = format!("{}{settings}", YAML.replace("mode: trinary\n", ""));
    let world = World::parse(&World::map_text("m", &yaml, &picture).unwrap()).unwrap();
    // The middle of cell `i` of the row.
    let middle = |i: usize| [-0.95 + 0.1 * i as f64, -2.0 + 1.95];
    let holds = |i: &usize| {
        world.obstacles.iter().any(|wall| {
            let corners = wall.outline.corners();
            let [x, y] = middle(*i);
            let within = |k: usize, value: f64| {
                let all = || corners.iter().map(|corner| corner[k]);
                all().fold(f64::MAX, f64::min) < value && value < all().fold(f64::MIN, f64::max)
            };
            within(0, x) && within(1, y)
        })
    };
    (0..greys.len()).filter(holds).collect()
}

#[test]
fn the_mode_of_a_map_decides_on_walls_and_unknown_cells() {
    // Free, unknown, just below and just above the threshold of 0.65, black.
    let greys = [254, 205, 90, 88, 0];
    let cases: [(&str, &[u8], &[usize]); 7] = [
        ("", &greys, &[3, 4]),
        ("mode: trinary\n", &greys, &[3, 4]),
        ("mode: scale\n", &greys, &[3, 4]),
        ("unknown: free\n", &greys, &[3, 4]),
        ("unknown: walls\n", &greys, &[1, 2, 3, 4]),
        ("mode: raw\n", &[0, 20, 66, 100, 101, 255], &[2, 3]),
        ("mode: raw\nunknown: walls\n", &[0, 20, 66, 100, 101, 255], &[1, 2, 3, 4, 5]),
    ];
    for (settings, greys, expected) in cases {
        assert_eq!(walls(settings, greys), expected, "{settings:?}");
    }
}

#[test]
fn every_key_except_the_mode_is_required() {
    for line in YAML.lines().filter(|line| !line.starts_with("mode")) {
        let (key, _) = line.split_once(':').unwrap();
        let without = YAML.replace(&format!("{line}\n"), "");
        let message = placed(&without, &World::map_text("m", &without, &room()).unwrap_err());
        assert!(message.starts_with(&format!("line 1, column 1: {key}: must")), "{message}");
        assert!(message.contains(", and is missing"), "{message}");
    }
    // Words and quotes in the notation of other YAML readers.
    let words = YAML.replace("negate: 0", "negate: no").replace("0.65", "'0.65'");
    let words = words.replace("mode: trinary", "\"mode\" : Trinary");
    assert_eq!(World::map_text("m", &words, &room()), World::map_text("m", YAML, &room()));
}

#[test]
fn cells_of_a_png_may_have_an_opacity() {
    // Black walls around floor; a black transparent cell, and a dark opaque cell.
    let cells = room().split_off(room().len() - 40 * 50);
    let mut pixels: Vec<[u8; 2]> = cells.iter().map(|grey| [*grey, 255]).collect();
    (pixels[25 * 40 + 5], pixels[25 * 40 + 9]) = ([0, 0], [80, 255]);
    let mut picture = Vec::new();
    let mut encoder = png::Encoder::new(&mut picture, 40, 50);
    encoder.set_color(png::ColorType::GrayscaleAlpha);
    encoder.write_header().unwrap().write_image_data(pixels.as_flattened()).unwrap();
    for (mode, unknown, count) in [
        ("trinary", "free", 5),
        ("trinary", "walls", 6),
        ("scale", "free", 5),
        ("scale", "walls", 6),
    ] {
        let yaml = format!("{}unknown: {unknown}\n", YAML.replace("trinary", mode));
        let world = World::parse(&World::map_text("m", &yaml, &picture).unwrap()).unwrap();
        assert_eq!(world.obstacles.len(), count, "{mode} {unknown}");
    }
}

#[test]
fn the_time_of_leaving_the_map_is_recorded() {
    // A map with a wall on one side only.
    let open: Vec<u8> =
        room().iter().enumerate().map(|(i, grey)| if i > 500 { 254 } else { *grey }).collect();
    let world = World::parse(&World::map_text("m", YAML, &open).unwrap()).unwrap();
    assert_eq!(world.map, [[-1.0, -2.0], [3.0, -2.0], [3.0, 3.0], [-1.0, 3.0]]);
    assert!(
        !world.is_beyond([2.9, 2.9]) && world.is_beyond([3.1, 0.0]) && world.is_beyond([0.0, -2.1])
    );
    let mut sim = Simulation::new(&world, 1).unwrap();
    let mut figures = Vec::new();
    for tenth in 1..200 {
        let now = sim.now();
        sim.drive(Speed::from_si(0.25), AngularSpeed::from_si(0.0), now);
        sim.advance_to(Instant::ZERO + Duration::from_millis(100 * tenth));
        assert_eq!(
            sim.truth().left_map().is_some(),
            sim.truth().pose().x > 3.0 || !figures.is_empty()
        );
        figures = sim.figures();
        figures.retain(|figure| figure.name == "left_map");
    }
    assert_eq!(figures.len(), 1);
    assert!(figures[0].text.starts_with("at 1"), "{figures:?}");
    let error = afp_session::World::started_at(&world, Pose { x: 3.5, y: 0.0, heading: 0.0 });
    assert_eq!(error.unwrap_err().message, "the robot starts beyond the edge of the map");
}
