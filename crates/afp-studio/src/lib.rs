//! The studio's server: the plans of one folder, edited and drawn in a browser.
//!
//! Everything about texts and drawings is said in the Language Server Protocol over a socket, to a server of
//! `afp-lsp` for each client; a *room* keeps what is the folder's: which texts are open, who changes them, what is
//! saved. The room alone writes files, whole or not at all, and never over what somebody else has written meanwhile.
//!
//! It listens on the machine itself alone. Other users of the machine reach that as well, and so does any web page:
//! what lets a browser in is a code that works once, on Linux for this program's user alone, and what it asks is looked
//! at (`Host`, `Origin`) before anything is answered.

mod access;
mod debugging;
mod event;
mod examples;
mod files;
mod jobs;
mod lock;
mod outbox;
mod page;
mod peer;
mod room;
mod server;
mod sockets;
mod trust;

use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::{env, io};

use afp_lsp::Host;

use access::Secret;
pub use examples::Example;
pub use files::Folder;
use lock::Lock;
pub use room::{ClientId, Room};
pub use trust::Trusted;

/// Where the language server of a client finds texts that nobody has open.
pub type MakeHost = fn() -> Box<dyn Host>;

/// What is served, and where.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder whose files may be read and written.
    pub folder: PathBuf,
    /// The file that is shown first.
    pub open: Option<PathBuf>,
    /// The port on the machine itself; 0 is a free one.
    pub port: u16,
    /// Addresses of pages beside our own that may talk with it, such as `http://localhost:8080` at the near end of
    /// a tunnel.
    pub origins: Vec<String>,
    /// The command line that does jobs: this program.
    pub program: PathBuf,
    /// Plans that people can begin with.
    pub examples: Vec<Example>,
    /// The folder of the user's own files, outside of what is served, which says who serves what; [`own_folder`],
    /// and nowhere where there is no home.
    pub own: Option<PathBuf>,
}

/// Where files of this user are kept that are of no project.
pub fn own_folder() -> Option<PathBuf> {
    let folder = |name: &str| env::var_os(name).map(PathBuf::from).filter(|it| it.is_absolute());
    let own = folder("XDG_CONFIG_HOME").or_else(|| folder("APPDATA"));
    let own = own.or_else(|| Some(folder("HOME")?.join(".config")));
    Some(own?.join("afp"))
}

/// A client that wants to run and debug plans: it speaks the Debug Adapter Protocol, a message at a time.
#[derive(Debug)]
pub struct Debugging {
    /// What it says; disconnected when it is gone.
    pub said: std::sync::mpsc::Receiver<String>,
    /// What it is told; whoever tells more than it reads waits. Closed when it is gone, or reads nothing for a while.
    pub told: tokio::sync::mpsc::Sender<String>,
}

/// Who serves a folder.
#[derive(Debug)]
pub enum Opened {
    /// This program does.
    Here(Box<Studio>),
    /// Another one does already: what a browser opens to be there, once, within a minute.
    Elsewhere(String),
}

/// A server that has its port.
#[derive(Debug)]
pub struct Studio {
    listener: TcpListener,
    secret: Secret,
    room: Room,
    program: PathBuf,
}

impl Studio {
    /// Takes the port and reads the folder, unless it is served already.
    ///
    /// # Errors
    /// The port is taken, there is no such folder.
    pub fn open(options: &Options, host: MakeHost) -> io::Result<Opened> {
        let folder = Folder::new(&options.folder)?;
        let among = options.own.as_ref().map(|own| own.join("open"));
        // Where nothing can be locked, what two of them write is merged.
        let lock = among.and_then(|among| Lock::take(folder.root(), &among).ok()).transpose();
        let lock = match lock {
            Ok(lock) => lock,
            Err(other) => {
                let file = options.open.as_ref().and_then(|file| file.to_str());
                return Ok(Opened::Elsewhere(other.address(file)?));
            }
        };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, options.port))?;
        let port = listener.local_addr()?.port();
        if let Some(lock) = &lock {
            lock.say(port)?;
        }
        let secret = Secret::new(port, options.origins.clone(), lock)?;
        let room = Room::new(folder, options.open.as_deref(), options.examples.clone(), host);
        let program = options.program.clone();
        Ok(Opened::Here(Box::new(Studio { listener, secret, room, program })))
    }

    /// What a browser opens: works once, for a minute.
    pub fn address(&self) -> String {
        self.secret.address()
    }

    /// The folder, without links.
    pub fn folder(&self) -> PathBuf {
        self.room.folder().root().to_owned()
    }

    /// Whether what lies in the folder may be run, now and later.
    pub fn trusted(&self) -> Trusted {
        self.room.trusted()
    }

    /// Serves until the program is asked to end; then everything is saved. Whoever wants to debug is handed over.
    ///
    /// # Errors
    /// The socket breaks.
    pub fn serve(self, debuggers: Sender<Debugging>) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        runtime.block_on(server::serve(
            self.listener,
            self.secret,
            (self.room, self.program),
            debuggers,
        ))
    }
}
