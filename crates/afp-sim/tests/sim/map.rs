//! Maps of `map_server` become worlds.

use afp_carbot::devices::Ultrasonic;
use afp_core::{Duration, Instant};
use afp_sim::{Pose, Simulation, World};

use crate::world::placed;

const YAML: &str = "image: room.pgm\nmode: trinary\nresolution: 0.1\norigin: [-1.0, -2.0, 0]\n\
                    negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// Four by five metres with walls one cell thick, and a cell of unknown in a corner.
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
fn a_map_has_its_walls_where_they_are_and_the_robot_near_the_origin() {
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
    // A closed room far from the origin; around it is free floor, nearer to the origin.
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
fn what_is_wrong_with_a_map_is_said() {
    let cases = [
        (YAML.replace("resolution: 0.1", "resolution: big"), "line 3, column 1: resolution: is"),
        (
            YAML.replace("[-1.0, -2.0, 0]", "[-1.0, -2.0]"),
            "line 4, column 1: origin: is to be three",
        ),
        (YAML.replace("trinary", "raw"), "line 2, column 1: mode: 'raw'"),
        (YAML.replace("trinary", "foo"), "line 2, column 1: mode: 'foo' is not known"),
        (YAML.replace("0.65", "1.5"), "occupied_thresh: is not within 0 and 1"),
        (YAML.replace("0.196", "0.7"), "free_thresh: is more than 'occupied_thresh'"),
        (YAML.replace("0.65", "1.0"), "no cell of the map is occupied"),
        (YAML.replace("image: room.pgm\n", ""), "image: is to name a picture"),
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
