//! The supervisors of the toolbox, a file each.

mod blink;
mod check_battery;
mod check_color;
mod check_distance;
mod check_driving_lane;
mod check_infrared;
mod check_line;
mod check_motion;
mod check_progress;
#[cfg(test)]
mod facts;
mod measure_distance;
mod measure_light;
mod plan_path;
mod switches;

pub use blink::Blink;
pub use check_battery::CheckBattery;
pub use check_color::CheckColor;
pub use check_distance::CheckDistance;
pub use check_driving_lane::CheckDrivingLane;
pub use check_infrared::CheckInfrared;
pub use check_line::CheckLine;
pub use check_motion::CheckMotion;
pub use check_progress::CheckProgress;
pub use measure_distance::MeasureDistance;
pub use measure_light::MeasureLight;
pub use plan_path::PlanPath;
pub use switches::{
    CheckEscapeButton, CheckEscapeButtonClick, CheckTouchSensor, CheckTouchSensorClick,
};
