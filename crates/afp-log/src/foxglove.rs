//! Robots and worlds as Foxglove messages.

use afp_core::Instant;
use prost_types::Timestamp;

use crate::event::timestamp;
use crate::picture;
use crate::proto::foxglove::{
    Color, CompressedImage, FrameTransform, FrameTransforms, LaserScan, LinePrimitive, Log, Point3,
    Pose, PoseInFrame, Quaternion, SceneEntity, SceneUpdate, TriangleListPrimitive, Vector3,
    line_primitive, log,
};
use crate::robot::{Image, Level, Pose2, Ranging, Shape, Transform};

/// The number of rays in the cone of a ranging.
const RAYS: usize = 9;

pub(crate) fn transforms(at: Instant, transforms: &[Option<Transform>]) -> FrameTransforms {
    let one = |transform: &Transform| FrameTransform {
        timestamp: Some(timestamp(at)),
        parent_frame_id: transform.parent.to_owned(),
        child_frame_id: transform.child.to_owned(),
        translation: Some(place(transform.pose, transform.height)),
        rotation: Some(turned(transform.pose.heading)),
    };
    FrameTransforms { transforms: transforms.iter().flatten().map(one).collect() }
}

pub(crate) fn pose(at: Instant, frame: &str, at_pose: Pose2) -> PoseInFrame {
    PoseInFrame {
        timestamp: Some(timestamp(at)),
        frame_id: frame.to_owned(),
        pose: Some(Pose {
            position: Some(place(at_pose, 0.0)),
            orientation: Some(turned(at_pose.heading)),
        }),
    }
}

/// A range sensor's reading at this height, in metres. Without an echo the scan has no ranges:
/// infinity would read as free space.
pub(crate) fn ranging(ranging: &Ranging, height: f64) -> LaserScan {
    LaserScan {
        timestamp: Some(timestamp(ranging.time)),
        frame_id: ranging.frame.to_owned(),
        pose: Some(Pose {
            position: Some(place(ranging.pose, height)),
            orientation: Some(turned(ranging.pose.heading)),
        }),
        start_angle: -ranging.half_angle,
        end_angle: ranging.half_angle,
        ranges: ranging.range.map_or_else(Vec::new, |range| vec![range; RAYS]),
        intensities: Vec::new(),
    }
}

/// The picture as a PNG; empty if its size and its pixels do not agree.
pub(crate) fn image(image: &Image) -> CompressedImage {
    CompressedImage {
        timestamp: Some(timestamp(image.time)),
        frame_id: image.frame.to_owned(),
        data: picture::png(image).unwrap_or_default(),
        format: "png".to_owned(),
    }
}

pub(crate) fn text(at: Instant, level: Level, name: &str, message: &str) -> Log {
    let level = match level {
        Level::Info => log::Level::Info,
        Level::Warning => log::Level::Warning,
        Level::Error => log::Level::Error,
    };
    Log {
        timestamp: Some(timestamp(at)),
        level: level.into(),
        message: message.to_owned(),
        name: name.to_owned(),
        ..Log::default()
    }
}

pub(crate) fn scene(at: Instant, shapes: &[Shape]) -> SceneUpdate {
    SceneUpdate {
        deletions: Vec::new(),
        entities: shapes.iter().map(|shape| entity(timestamp(at), shape)).collect(),
    }
}

fn entity(at: Timestamp, shape: &Shape) -> SceneEntity {
    let [r, g, b, a] = shape.color;
    let rim = |z: f64| LinePrimitive {
        r#type: line_primitive::Type::LineLoop.into(),
        pose: None,
        thickness: 0.01,
        scale_invariant: false,
        points: shape.outline.iter().map(|&at| point(at, z)).collect(),
        color: Some(Color { r: r * 0.6, g: g * 0.6, b: b * 0.6, a: 1.0 }),
    };
    SceneEntity {
        timestamp: Some(at),
        frame_id: shape.frame.to_owned(),
        id: shape.id.clone(),
        lifetime: None,
        frame_locked: true,
        cubes: Vec::new(),
        lines: vec![rim(0.0), rim(shape.height)],
        triangles: vec![TriangleListPrimitive {
            pose: None,
            points: faces(shape),
            color: Some(Color { r, g, b, a }),
        }],
    }
}

/// The sides of a prism and, for a convex outline, the top.
fn faces(shape: &Shape) -> Vec<Point3> {
    let (outline, top) = (&shape.outline, shape.height);
    let mut points = Vec::new();
    let next = outline.iter().cycle().skip(1);
    for (&a, &b) in outline.iter().zip(next) {
        points.extend([point(a, 0.0), point(b, 0.0), point(b, top)]);
        points.extend([point(a, 0.0), point(b, top), point(a, top)]);
    }
    if let [first, rest @ ..] = outline.as_slice()
        && convex(outline)
    {
        for pair in rest.windows(2) {
            points.extend([*first, pair[0], pair[1]].map(|at| point(at, top)));
        }
    }
    points
}

fn convex(outline: &[[f64; 2]]) -> bool {
    let corner = |n: usize| outline[n % outline.len()];
    (0..outline.len()).all(|n| {
        let ([ax, ay], [bx, by], [cx, cy]) = (corner(n), corner(n + 1), corner(n + 2));
        (bx - ax) * (cy - by) - (by - ay) * (cx - bx) >= 0.0
    })
}

fn point([x, y]: [f64; 2], z: f64) -> Point3 {
    Point3 { x, y, z }
}

fn place(pose: Pose2, z: f64) -> Vector3 {
    Vector3 { x: pose.x, y: pose.y, z }
}

fn turned(heading: f64) -> Quaternion {
    let half = heading / 2.0;
    Quaternion { x: 0.0, y: 0.0, z: libm::sin(half), w: libm::cos(half) }
}
