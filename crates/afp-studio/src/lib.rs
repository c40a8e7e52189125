//! The studio's server: the plans of a folder, edited and drawn in a browser.
//!
//! Texts and drawings use the Language Server Protocol over a socket, with an `afp-lsp` server for
//! each client. A *room* holds the shared state of the folder: open texts, the editing client and
//! unsaved changes. Only the room writes files. It writes atomically, and never over another
//! program's change.
//!
//! The server listens only on the local machine. Other users of the machine and any web page can
//! reach that, too. A browser therefore needs a one-time code, which on Linux works only for the
//! same user. `Host` and `Origin` of each request are checked before the response.

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
mod world;

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

/// Makes the file access of a client's language server.
pub type MakeHost = fn() -> Box<dyn Host>;

#[derive(Clone, Debug)]
pub struct Options {
    /// The folder whose files may be read and written.
    pub folder: PathBuf,
    /// The file that is shown first.
    pub open: Option<PathBuf>,
    /// The local port; 0 selects a free one.
    pub port: u16,
    /// Additional allowed origins, such as `http://localhost:8080` at the near end of a tunnel.
    pub origins: Vec<String>,
    /// The command-line program that runs jobs: this program.
    pub program: PathBuf,
    pub examples: Vec<Example>,
    /// The folder with the user's lock files, outside the served folder; [`own_folder`], or `None`
    /// without a home directory.
    pub own: Option<PathBuf>,
}

/// The user's folder for files without a project.
pub fn own_folder() -> Option<PathBuf> {
    let folder = |name: &str| env::var_os(name).map(PathBuf::from).filter(|it| it.is_absolute());
    let own = folder("XDG_CONFIG_HOME").or_else(|| folder("APPDATA"));
    let own = own.or_else(|| Some(folder("HOME")?.join(".config")));
    Some(own?.join("afp"))
}

/// A client that runs and debugs plans: it uses the Debug Adapter Protocol, a message at a time.
#[derive(Debug)]
pub struct Debugging {
    /// Its messages; disconnected when it leaves.
    pub said: std::sync::mpsc::Receiver<String>,
    /// Messages to it; the sender waits if the client reads slowly. Closed when it leaves, or reads
    /// nothing for a while.
    pub told: tokio::sync::mpsc::Sender<String>,
}

/// The server of a folder.
#[derive(Debug)]
pub enum Opened {
    /// This program.
    Here(Box<Studio>),
    /// Another program; a browser opens this one-time address within a minute.
    Elsewhere(String),
}

/// A server with an open port.
#[derive(Debug)]
pub struct Studio {
    listener: TcpListener,
    secret: Secret,
    room: Room,
    program: PathBuf,
}

impl Studio {
    /// Opens the port and reads the folder, unless it is already served.
    ///
    /// # Errors
    /// The port is in use, or the folder does not exist.
    pub fn open(options: &Options, host: MakeHost) -> io::Result<Opened> {
        let folder = Folder::new(&options.folder)?;
        let among = options.own.as_ref().map(|own| own.join("open"));
        // If locking is not possible, the changes of two studios are merged.
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

    /// The one-time address for a browser, valid for a minute.
    pub fn address(&self) -> String {
        self.secret.address()
    }

    /// The folder without links.
    pub fn folder(&self) -> PathBuf {
        self.room.folder().root().to_owned()
    }

    /// Whether the folder is trusted to run, now and later.
    pub fn trusted(&self) -> Trusted {
        self.room.trusted()
    }

    /// Serves until the program is asked to end, and then saves everything. Debugging clients go to
    /// `debuggers`.
    ///
    /// # Errors
    /// The socket fails.
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
