//! A picture of a path over the world.

use afp_sim::World;
use std::fmt::Write;

pub fn draw(world: &World, path: &[(f64, f64)]) -> String {
    let mut svg = String::from(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-0.2 -5.2 6.4 5.4' width='1280' height='1080'><rect x='-1' y='-6' width='9' height='8' fill='white'/>\n",
    );
    for obstacle in &world.obstacles {
        let corners = obstacle.outline.corners();
        let points: Vec<String> =
            corners.iter().map(|c| format!("{:.3},{:.3}", c[0], -c[1])).collect();
        let fill = if obstacle.height < 0.15 { "#c96" } else { "#999" };
        let _ = writeln!(svg, "<polygon points='{}' fill='{fill}'/>", points.join(" "));
    }
    let points: Vec<String> = path.iter().map(|p| format!("{:.3},{:.3}", p.0, -p.1)).collect();
    let _ = writeln!(
        svg,
        "<polyline points='{}' fill='none' stroke='#06c' stroke-width='0.02'/>",
        points.join(" ")
    );
    svg + "</svg>\n"
}
