//! Sessions on robots that are there.

#[cfg(feature = "load")]
use afp::load::{Graph, LoadedPlan, Registry};
use afp_core::rt::{NamedPlan, Plan};

use crate::any::AnySession;
use crate::hardware::{Hardware, LastResort, Settings};
use crate::record::Kept;
#[cfg(feature = "load")]
use crate::robot::Robot;
use crate::robots::SessionError;
use crate::session::Session;
use crate::watch::Watch;

/// A plan on a robot that is there.
pub struct Opened {
    /// The session.
    pub session: Box<dyn AnySession>,
    /// What stops the robot where the session cannot.
    pub last_resort: Option<LastResort>,
    /// The watch of the session, for another thread.
    pub watch: Option<Watch>,
}

impl Opened {
    /// A plan on a robot that is opened now.
    ///
    /// # Errors
    /// The robot cannot be reached.
    pub fn new<P, H>(plan: P, settings: &Settings) -> Result<Self, SessionError>
    where
        P: NamedPlan + Plan<H> + 'static,
        H: Hardware,
        Session<P, H, Kept>: AnySession,
    {
        let robot = H::open(settings).map_err(|why| SessionError::Hardware(why.into()))?;
        let last_resort = robot.last_resort();
        let session = Session::on_hardware(plan, robot);
        let watch = session.watch();
        Ok(Opened { session: Box::new(session), last_resort, watch })
    }
}

/// A kind of robot that is there, on which plans can be loaded.
#[cfg(feature = "load")]
pub trait Opener: Sync {
    /// The main plan of a graph on the robot, which is opened now.
    ///
    /// # Errors
    /// A template that this program does not know or that the robot does not serve; a robot that cannot be reached.
    fn open(&self, plan: &Graph, settings: &Settings) -> Result<Opened, SessionError>;
}

#[cfg(feature = "load")]
struct Kind<H, F> {
    robot: std::marker::PhantomData<fn() -> H>,
    register: F,
}

/// A kind of robot that is there, with the devices of a simulated one and a function that registers the templates that
/// plans for it may use.
#[cfg(feature = "load")]
pub const fn hardware<R, H, F>(register: F) -> impl Opener
where
    R: crate::Simulated,
    H: Hardware + Robot<Devices = R::Devices>,
    F: Fn(&mut Registry<H>) + Sync,
{
    Kind::<H, F> { robot: std::marker::PhantomData, register }
}

#[cfg(feature = "load")]
impl<H: Hardware, F: Fn(&mut Registry<H>) + Sync> Opener for Kind<H, F> {
    fn open(&self, plan: &Graph, settings: &Settings) -> Result<Opened, SessionError> {
        let mut registry = Registry::new();
        (self.register)(&mut registry);
        // Before the robot is touched.
        let plan = LoadedPlan::new(plan, &registry).map_err(SessionError::Load)?;
        Opened::new::<_, H>(plan, settings)
    }
}
