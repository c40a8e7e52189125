//! The readings of infrared sensor, colour sensor and camera.

use crate::{among, at, drive, the_box, wait};
use afp_carbot::devices::{Camera, ColorSensor, Glow, InfraredSensor, Invalid};
use afp_core::Duration;
use afp_sim::{Defect, Fault, Film, Simulation};

fn light(x: f64, y: f64, rest: &str) -> String {
    format!("[[infrared]]\nposition_m = [{x}, {y}]\n{rest}\n")
}

fn glow(sim: &mut Simulation) -> Option<Glow> {
    wait(sim, 100);
    sim.glow().value.expect("the sensor works")
}

/// The mean bearing in degrees, and the mean strength.
fn mean_glow(sim: &mut Simulation) -> (f64, f64) {
    let glows: Vec<Glow> = (0..200).filter_map(|_| glow(sim)).collect();
    assert_eq!(glows.len(), 200);
    let mean = |of: fn(&Glow) -> f64| glows.iter().map(of).sum::<f64>() / 200.0;
    (mean(|glow| glow.bearing.si().to_degrees()), mean(|glow| glow.strength))
}

#[test]
fn infrared_light_has_a_bearing_and_a_strength_that_falls_with_the_square_of_the_distance() {
    // The sensor sits 18 cm ahead of the turning centre.
    for (x, y, bearing, strength) in
        [(1.18, 0.0, 0.0, 1.0), (2.18, 0.0, 0.0, 0.25), (1.18, 1.0, 45.0, 0.5)]
    {
        let mut sim = among(&light(x, y, ""));
        let (seen, bright) = mean_glow(&mut sim);
        assert!((seen - bearing).abs() < 1.0, "{seen} for {bearing}");
        assert!((bright / strength - 1.0).abs() < 0.02, "{bright} for {strength}");
    }
}

#[test]
fn infrared_light_is_seen_within_60_degrees_and_not_through_high_obstacles() {
    let wall = the_box([1.0, 0.0], [0.1, 1.0], 1.0);
    let step = the_box([1.0, 0.0], [0.1, 1.0], 0.08);
    let cases = [
        (light(1.0, 1.2, ""), true),
        (light(0.5, 1.2, ""), false),
        (light(-1.0, 0.0, ""), false),
        (light(2.0, 0.0, "") + &wall, false),
        (light(2.0, 0.0, "height_m = 2.5") + &wall, true),
        (light(2.0, 0.0, "") + &step, true),
        (light(11.0, 0.0, ""), false),
        (light(11.0, 0.0, "strength = 9.0"), true),
    ];
    for (world, seen) in cases {
        assert_eq!(glow(&mut among(&world)).is_some(), seen, "{world}");
    }
    let two = light(1.5, 0.5, "") + &light(2.0, -0.5, "strength = 20.0");
    assert!(glow(&mut among(&two)).unwrap().bearing.si() < 0.0, "the brighter one counts");
}

#[test]
fn the_colour_sensor_sees_the_patch_under_the_robots_front() {
    let patch = "[floor]\ncolor = \"#ffffff\"\n[[patch]]\ncolor = \"#ff0000\"\n\
                 points_m = [[0.4, -0.5], [0.6, -0.5], [0.6, 0.5], [0.4, 0.5]]\n";
    let mut sim = among(patch);
    assert_eq!(sim.color().value, Err(Invalid::NotYet));
    let red = |sim: &Simulation| {
        let color = sim.color().value.expect("the sensor works");
        assert!(color.red > 0.95, "{color:?}");
        color.green < 0.05 && color.reflectance() < 0.3
    };
    let mut stretches = Vec::new();
    for _ in 0..40 {
        drive(&mut sim, 0.2, 0.0, 100);
        let front = sim.truth().pose().x + 0.15;
        if (front - 0.4).abs() > 0.02 && (front - 0.6).abs() > 0.02 {
            assert_eq!(red(&sim), (0.4..0.6).contains(&front), "{front}");
            stretches.push(red(&sim));
        }
    }
    assert!(stretches.contains(&true) && stretches.ends_with(&[false]));
}

/// A pixel's colour, without its grain.
fn close(a: [u8; 3], b: [u8; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 4)
}

const RED_BOX: &str = "[[box]]\npose_m_deg = [1.28, 0.0, 0.0]\nsize_m = [0.2, 0.4]\n\
                       height_m = 0.5\ncolor = \"#c00000\"\n";

#[test]
fn the_camera_shows_a_box_at_its_place() {
    let mut sim = among(RED_BOX);
    assert_eq!(sim.frame().value.map(|frame| frame.number), Err(Invalid::NotYet));
    wait(&mut sim, 50);
    let lens = sim.lens();
    let frame = sim.frame().value.expect("the camera works");
    assert_eq!((frame.width, frame.height, frame.number), (lens.columns, lens.rows, 1));
    // The face is one metre ahead of the lens, 20 cm to either side, up to 30 cm above the lens.
    let focus = 80.0 / (lens.opening.si() / 2.0).tan();
    let red = |x: usize, y: usize| {
        let [red, green, blue] = frame.pixel(x, y).unwrap();
        red > 120 && green < 10 && blue < 10
    };
    let columns: Vec<usize> = (0..160).filter(|x| red(*x, 60)).collect();
    let half = 0.2 * focus;
    assert!((columns.len() as f64 - 2.0 * half).abs() <= 1.0, "{columns:?}");
    assert_eq!(columns[0] + columns[columns.len() - 1], 159, "in the middle");
    let rows: Vec<usize> = (0..120).filter(|y| red(80, *y)).collect();
    assert!((60.0 - rows[0] as f64 - 0.3 * focus).abs() <= 1.0, "{rows:?}");
    assert!((rows[rows.len() - 1] as f64 - 59.0 - 0.2 * focus).abs() <= 1.0, "{rows:?}");
    assert!(close(frame.pixel(80, 0).unwrap(), [205, 216, 228]), "sky above");
    assert!(close(frame.pixel(5, 119).unwrap(), [200, 194, 184]), "floor below");
}

#[test]
fn near_objects_hide_far_ones_and_the_top_of_a_low_object_is_visible() {
    let low = "[[box]]\npose_m_deg = [0.78, 0.0, 0.0]\nsize_m = [0.2, 0.2]\nheight_m = 0.1\n\
               color = \"#0000c0\"\n";
    let mut sim = among(&format!("{RED_BOX}{low}"));
    wait(&mut sim, 50);
    let frame = sim.frame().value.unwrap();
    let focus = 80.0 / (sim.lens().opening.si() / 2.0).tan();
    let blue = |y: usize| frame.pixel(80, y).is_some_and(|[r, _, b]| r < 10 && b > 100);
    // Its top is 10 cm below the lens from 0.5 to 0.7 m, its foot 20 cm below at 0.5 m.
    let rows: Vec<usize> = (0..120).filter(|y| blue(*y)).collect();
    let (first, last) = (60.0 + focus * 0.1 / 0.7, (60.0 + focus * 0.2 / 0.5).min(119.0));
    assert!((rows[0] as f64 - first).abs() <= 1.0, "{rows:?} {first}");
    assert!((rows[rows.len() - 1] as f64 - last).abs() <= 1.0, "{rows:?} {last}");
}

#[test]
fn pictures_come_20_times_a_second_and_do_not_depend_on_their_readers() {
    let run = |every: u64| {
        let mut sim = among(RED_BOX);
        let mut film = Film::default();
        for millis in 1..=10 {
            drive(&mut sim, 0.2, 0.2, 100);
            if millis % every == 0 {
                let frame = sim.frame();
                assert!(sim.now().since(frame.time) < Duration::from_millis(50));
                film.add(&frame.value.unwrap());
            }
        }
        let frame = sim.frame().value.unwrap();
        (frame.number, frame.rgb.to_vec(), film)
    };
    let (number, often, film) = run(1);
    assert_eq!(number, 20);
    assert_eq!(often, run(10).1);
    assert_eq!(film.frames(), 10);
    let png = film.png(5).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    assert!(Film::default().png(5).is_err());
}

#[test]
fn a_frozen_delayed_or_lost_camera_shows_the_past_or_nothing() {
    let mut sim = among(RED_BOX);
    sim.advance_to(at(500));
    let number = |sim: &Simulation| sim.frame().value.map(|frame| frame.number);
    let camera = |defect| Fault::Camera(defect);
    sim.inject(camera(Defect::Frozen), at(500), Duration::from_millis(500));
    sim.inject(camera(Defect::Lost), at(1000), Duration::from_millis(500));
    let delay = Defect::Delayed(Duration::from_millis(200));
    sim.inject(camera(delay), at(1500), Duration::from_millis(1000));
    let mut seen = Vec::new();
    for millis in [900, 1400, 2000, 2600] {
        sim.advance_to(at(millis));
        seen.push(number(&sim));
    }
    assert_eq!(seen, [Ok(10), Err(Invalid::NoAnswer), Ok(36), Ok(52)]);
}
