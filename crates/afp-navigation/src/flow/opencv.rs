use super::{BAD_PICTURES, DULL, LEVELS, OpticalFlow, Picture, RETURN, STEPS, WINDOW};
use afp_carbot::devices::{Grid, Shift};
use afp_core::{Fault, Reason};
use opencv::core::{Mat, MatTraitConst, Point2f, Size, TermCriteria, TermCriteria_Type, Vector};
use opencv::video::{OPTFLOW_USE_INITIAL_FLOW, calc_optical_flow_pyr_lk};

pub const OPENCV_FAILED: Fault =
    Fault::new(&Reason { code: "opencv-failed", text: "OpenCV refused to compute the flow" });

/// OpenCV's gradients are 32 times the slope, and it divides their squares by 2 to the 20.
const DULL_FOR_OPENCV: f64 = DULL as f64 / 1024.0;

/// OpenCV's `calcOpticalFlowPyrLK`, there and back, with the settings of
/// [`LucasKanade`](super::LucasKanade). It allocates, on the worker.
#[derive(Debug, Default)]
pub struct OpenCv {
    from: Vector<Point2f>,
    there: Tracked,
    back: Tracked,
}

#[derive(Debug, Default)]
struct Tracked {
    points: Vector<Point2f>,
    found: Vector<u8>,
    errors: Vector<f32>,
}

impl OpenCv {
    /// OpenCV creates its buffers itself.
    pub fn new() -> Self {
        Self::default()
    }

    fn track(&mut self, before: &Mat, after: &Mat) -> opencv::Result<()> {
        self.there.points = self.from.clone();
        self.there.track(before, after, &self.from)?;
        self.back.points = self.from.clone();
        self.back.track(after, before, &self.there.points)
    }

    fn shift(&self, n: usize) -> Option<Shift> {
        let found = self.there.found.get(n).ok()? & self.back.found.get(n).ok()? != 0;
        let [from, there, back] = [&self.from, &self.there.points, &self.back.points]
            .map(|points| points.get(n).unwrap_or_default());
        let missed = (back.x - from.x).powi(2) + (back.y - from.y).powi(2);
        (found && missed <= RETURN * RETURN)
            .then_some(Shift { right: there.x - from.x, down: there.y - from.y })
    }
}

impl Tracked {
    fn track(&mut self, before: &Mat, after: &Mat, from: &Vector<Point2f>) -> opencv::Result<()> {
        let kind = TermCriteria_Type::COUNT as i32 + TermCriteria_Type::EPS as i32;
        let enough = TermCriteria::new(kind, STEPS as i32, 0.01)?;
        calc_optical_flow_pyr_lk(
            before,
            after,
            from,
            &mut self.points,
            &mut self.found,
            &mut self.errors,
            Size::new(WINDOW as i32, WINDOW as i32),
            LEVELS as i32 - 1,
            enough,
            OPTFLOW_USE_INITIAL_FLOW,
            DULL_FOR_OPENCV,
        )
    }
}

impl OpticalFlow for OpenCv {
    fn flow(
        &mut self,
        before: &Picture,
        after: &Picture,
        grid: &Grid,
        shifts: &mut [Option<Shift>],
    ) -> Result<(), Fault> {
        let fits = (before.width(), before.height()) == (after.width(), after.height());
        if !fits || shifts.len() != grid.len() {
            return Err(BAD_PICTURES);
        }
        let [before, after] = [mat(before)?, mat(after)?];
        let point = |n| {
            let (x, y) = grid.pixel(n);
            Point2f::new(x as f32, y as f32)
        };
        self.from = (0..grid.len()).map(point).collect();
        self.track(&before, &after).map_err(|_| OPENCV_FAILED)?;
        for (n, shift) in shifts.iter_mut().enumerate() {
            *shift = self.shift(n);
        }
        Ok(())
    }
}

fn mat(picture: &Picture) -> Result<Mat, Fault> {
    let refused = |_| OPENCV_FAILED;
    let row = Mat::from_slice(picture.grey()).map_err(refused)?;
    row.reshape(1, picture.height() as i32).and_then(|mat| mat.try_clone()).map_err(refused)
}
