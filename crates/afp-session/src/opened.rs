//! Sessions on real robots.

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

/// A plan on a real robot.
pub struct Opened {
    /// The session.
    pub session: Box<dyn AnySession>,
    /// Stops the robot if the session cannot.
    pub last_resort: Option<LastResort>,
    /// Watches the session from another thread.
    pub watch: Option<Watch>,
}

impl Opened {
    /// Opens a robot and puts a plan on it.
    ///
    /// # Errors
    /// The robot cannot be reached.
    pub fn new<P, H>(plan: P, settings: &Settings) -> Result<Self, SessionError>
    where
        P: NamedPlan + Plan<H> + 'static,
        H: Hardware,
        Session<P, H, Kept>: AnySession,
    {
        Opened::with(settings, |robot: H| Session::on_hardware(plan, robot))
    }

    fn with<P, H>(
        settings: &Settings,
        session: impl FnOnce(H) -> Session<P, H, Kept>,
    ) -> Result<Self, SessionError>
    where
        P: NamedPlan + Plan<H> + 'static,
        H: Hardware,
        Session<P, H, Kept>: AnySession,
    {
        let robot = H::open(settings).map_err(|why| SessionError::Hardware(why.into()))?;
        let last_resort = robot.last_resort();
        let session = session(robot);
        let watch = session.watch();
        Ok(Opened { session: Box::new(session), last_resort, watch })
    }
}

/// A kind of real robot on which plans can be loaded.
#[cfg(feature = "load")]
pub trait Opener: Sync {
    /// Opens the robot and puts the main plan of a graph on it.
    ///
    /// # Errors
    /// A template is unknown to this program or does not work on the robot; the robot cannot be
    /// reached.
    fn open(&self, plan: &Graph, settings: &Settings) -> Result<Opened, SessionError>;
}

#[cfg(feature = "load")]
struct Kind<H, F> {
    robot: std::marker::PhantomData<fn() -> H>,
    register: F,
}

/// A kind of real robot with the devices of a simulated one. `register` registers the templates for
/// its plans.
#[cfg(feature = "load")]
pub const fn hardware<R, H, F>(register: F) -> impl Opener
where
    R: crate::Simulated,
    H: Hardware + Robot<Devices = R::Devices>,
    F: Fn(&mut Registry<H>) + Sync,
{
    Kind::<H, F> { robot: std::marker::PhantomData, register }
}

/// Like [`hardware`], without a simulated robot.
#[cfg(feature = "load")]
pub const fn only_hardware<H, F>(register: F) -> impl Opener
where
    H: Hardware,
    F: Fn(&mut Registry<H>) + Sync,
{
    Kind::<H, F> { robot: std::marker::PhantomData, register }
}

#[cfg(feature = "load")]
impl<H: Hardware, F: Fn(&mut Registry<H>) + Sync> Opener for Kind<H, F> {
    fn open(&self, plan: &Graph, settings: &Settings) -> Result<Opened, SessionError> {
        let mut registry = Registry::new();
        (self.register)(&mut registry);
        // First, so that an error leaves the robot untouched.
        let plan = LoadedPlan::new(plan, &registry).map_err(SessionError::Load)?;
        Opened::with(settings, |robot: H| Session::on_hardware(plan, robot).testable())
    }
}
