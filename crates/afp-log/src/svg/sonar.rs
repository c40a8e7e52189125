//! The range sensor's echoes over the true walls: a map from a log.
//!
//! Each echo is drawn twice. At the robot's true pose, it shows the sensor's own errors. At the
//! odometry's estimate, it shows a map as the robot itself would make it.

use afp_core::Instant;
use afp_session::{AnyWorld, Pose2};

use super::canvas::View;
use super::legend::Legend;
use super::{bounds, follow, marks, room, subtitle};
use crate::{Heard, LogData};

/// An echo in the world: its apparent place, and the ends of the arc of possible places.
struct Echo {
    at: [f64; 2],
    arc: [[f64; 2]; 2],
    range: f64,
}

/// Draws the echoes of a logged run over the walls of its world; `None` for a log without echoes.
pub fn draw_sonar(log: &LogData, world: &dyn AnyWorld) -> Option<String> {
    let drawing = world.drawing().ended(&log.things);
    let heard = log.rangings.iter().filter(|heard| heard.range.is_some()).count();
    if heard == 0 || log.poses.is_empty() {
        return None;
    }
    let names = &log.names;
    let (path, marks) = follow(&log.events, &log.poses, names);
    let view = View::around(bounds(&drawing, &path));
    let mut canvas = room(&drawing, view);
    canvas.robot(&drawing.body, drawing.start, false);
    canvas.clipped(|canvas| {
        canvas.line("believed", &places(&log.believed));
        canvas.line("true", &places(&log.poses));
        for echo in echoes(&log.rangings, &log.believed) {
            canvas.echo("believed", echo.at);
        }
        for echo in echoes(&log.rangings, &log.poses) {
            canvas.arc(echo.arc, echo.range);
            canvas.echo("true", echo.at);
        }
    });
    if let Some(last) = path.last() {
        canvas.robot(&drawing.body, last.pose, true);
    }
    let kinds = marks::kinds(&marks, names);
    marks::draw(&mut canvas, &marks, &kinds);
    canvas.scale_bar();
    let mut legend = Legend::new(view);
    let fact = |key: &str| log.facts.get(key).map_or("", String::as_str);
    legend.head(fact("plan"), &subtitle(world, fact("seed")));
    legend.sonar();
    legend.events(marks::counted(&marks, &kinds, names));
    legend.figures(&figures(log, heard));
    Some(canvas.finish(legend.finish()))
}

fn figures(log: &LogData, heard: usize) -> Vec<(String, String)> {
    let time = log.span.map_or(0.0, |(_, last)| last.as_secs_f64());
    let mut figures = vec![
        ("time".to_owned(), format!("{time:.1} s")),
        ("echoes".to_owned(), format!("{heard}")),
        ("silent".to_owned(), format!("{}", log.rangings.len() - heard)),
    ];
    if let (Some((_, pose)), Some((_, believed))) = (log.poses.last(), log.believed.last()) {
        let drift = libm::hypot(pose.x - believed.x, pose.y - believed.y);
        figures.push(("drift".to_owned(), format!("{:.0} cm", drift * 100.0)));
    }
    figures
}

fn places(poses: &[(Instant, Pose2)]) -> Vec<[f64; 2]> {
    poses.iter().map(|(_, pose)| [pose.x, pose.y]).collect()
}

/// The echoes, seen from some poses of the robot.
fn echoes<'a>(
    rangings: &'a [Heard],
    poses: &'a [(Instant, Pose2)],
) -> impl Iterator<Item = Echo> + 'a {
    rangings.iter().filter_map(|heard| {
        let (range, robot) = (heard.range?, pose_at(poses, heard.at)?);
        let sensor = robot.beyond(heard.pose);
        let at = |turn: f64| {
            let (sin, cos) = libm::sincos(sensor.heading + turn);
            [sensor.x + range * cos, sensor.y + range * sin]
        };
        Some(Echo { at: at(0.0), arc: [at(heard.half_angle), at(-heard.half_angle)], range })
    })
}

/// The pose at an instant, interpolated between the logged poses.
fn pose_at(poses: &[(Instant, Pose2)], at: Instant) -> Option<Pose2> {
    let behind = poses.partition_point(|(time, _)| *time < at);
    let after = *poses.get(behind).or(poses.last())?;
    let before = *poses.get(behind.saturating_sub(1))?;
    Some(Pose2::between(before, after, at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(x: f64, heading: f64) -> Pose2 {
        Pose2 { x, y: 0.0, heading }
    }

    #[test]
    fn poses_between_logged_poses_are_interpolated() {
        let at = Instant::from_nanos;
        let poses = [(at(0), pose(0.0, 3.0)), (at(100), pose(1.0, -3.0))];
        let middle = pose_at(&poses, at(50)).unwrap();
        assert!((middle.x - 0.5).abs() < 1e-12);
        // The shorter way around.
        assert!((middle.heading - std::f64::consts::PI).abs() < 1e-9, "{middle:?}");
        assert_eq!(pose_at(&poses, at(500)).unwrap().x, 1.0);
        assert!(pose_at(&[], at(5)).is_none());
    }

    #[test]
    fn an_echo_is_ahead_of_the_sensor() {
        let heard = Heard {
            device: "sonar".into(),
            at: Instant::ZERO,
            pose: Pose2 { x: 0.2, y: 0.0, heading: std::f64::consts::FRAC_PI_2 },
            half_angle: 0.1,
            range: Some(1.0),
        };
        let poses = [(Instant::ZERO, pose(1.0, 0.0))];
        let echo = echoes(&[heard], &poses).next().unwrap();
        assert!((echo.at[0] - 1.2).abs() < 1e-12 && (echo.at[1] - 1.0).abs() < 1e-12);
    }
}
