//! Deploys over a real `sshd` on loopback, and the unit of the service.

use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use super::Robot;
use crate::common::{Place, Said, said};

pub const SSHD: &str = "/usr/sbin/sshd";

fn succeeds(command: &mut Command) -> String {
    let said = said(command.output().unwrap());
    said.succeeds();
    said.out.trim().to_owned()
}

/// A server of ssh, and a client that knows it as 'robot.test'.
pub struct Server {
    pub place: Place,
    process: Child,
    port: u16,
}

impl Server {
    /// A server whose only key runs the agent of a robot.
    fn new(robot: &Robot) -> Server {
        Server::only("afpc agent", &robot.host().replace("exec:", "exec "))
    }

    /// A server whose only key runs a command if the client asks for `asked`.
    pub fn only(asked: &str, command: &str) -> Server {
        let asked = format!(r#"test \"$SSH_ORIGINAL_COMMAND\" = '{asked}' && "#);
        // The folder that the server needs if root starts it.
        std::fs::create_dir_all("/run/sshd").ok();
        Server::started(|place| {
            let keys = format!("command=\"{asked}{command}\" {}", place.read("user.pub"));
            place.write("keys", &keys);
            let more = format!(
                "AuthorizedKeysFile {}\nPermitRootLogin yes\n",
                place.path("keys").display()
            );
            (Command::new(SSHD), more)
        })
    }

    /// A server that a command starts, with more settings.
    pub fn started(make: impl FnOnce(&Place) -> (Command, String)) -> Server {
        let place = Place::new();
        for key in ["host", "user", "other"] {
            let mut keygen = Command::new("ssh-keygen");
            keygen.args(["-q", "-t", "ed25519", "-N", "", "-f"]).arg(place.path(key));
            succeeds(&mut keygen);
        }
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let file = |name: &str| place.path(name).display().to_string();
        let (mut command, more) = make(&place);
        place.write(
            "sshd",
            &format!(
                "Port {port}\nListenAddress 127.0.0.1\nHostKey {}\nPidFile none\nStrictModes no\n\
                 UsePAM no\nPasswordAuthentication no\n{more}",
                file("host")
            ),
        );
        let user = succeeds(Command::new("id").arg("-un"));
        place.write(
            "ssh",
            &format!(
                "Host robot.test\nHostName 127.0.0.1\nPort {port}\nUser {user}\nIdentityFile {}\n\
                 IdentitiesOnly yes\nUserKnownHostsFile {}\nBatchMode yes\nStrictHostKeyChecking yes\n",
                file("user"),
                file("known")
            ),
        );
        // The clients of the path are the system's with another configuration.
        for client in ["ssh", "sftp"] {
            let text = format!("#!/bin/sh\nexec /usr/bin/{client} -F {} \"$@\"\n", file("ssh"));
            place.program(&format!("bin/{client}"), &text);
        }
        command.args(["-D", "-f"]).arg(place.path("sshd")).stdin(Stdio::null());
        let process = command.stderr(Stdio::null()).spawn().unwrap();
        let server = Server { place, process, port };
        server.knows("host");
        server.listens();
        server
    }

    /// Waits until the server answers.
    fn listens(&self) {
        for _ in 0..600 {
            if TcpStream::connect(("127.0.0.1", self.port)).is_ok() {
                return;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("sshd does not listen");
    }

    /// Makes the client expect this key of the host.
    pub fn knows(&self, key: &str) {
        let public = self.place.read(&format!("{key}.pub"));
        self.place.write("known", &format!("[127.0.0.1]:{} {public}", self.port));
    }

    /// The search path with the clients of this server.
    pub fn path(&self) -> String {
        let path = std::env::var("PATH").unwrap();
        format!("{}:{path}", self.place.path("bin").display())
    }

    /// Runs `afpc` in a folder, with the clients of this server.
    pub fn afpc(&self, folder: &Place, arguments: &str) -> Said {
        let mut command = folder.command();
        command.args(arguments.split_whitespace()).env("PATH", self.path());
        said(command.stdin(Stdio::null()).output().unwrap())
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.process.kill().ok();
        self.process.wait().ok();
    }
}

#[test]
fn a_deploy_over_ssh_works_and_a_changed_host_key_is_refused() {
    if !Path::new(SSHD).exists() {
        println!("left out: there is no {SSHD}");
        return;
    }
    let robot = Robot::new();
    let server = Server::new(&robot);
    let deploy = "deploy wall_following.afp --robot sim --to robot.test";
    let first = server.afpc(&robot.place, deploy);
    assert!(first.succeeds().out.starts_with("ready: WallFollowing "), "{first:?}");
    let status = server.afpc(&robot.place, "robot status robot.test");
    assert!(status.succeeds().out.starts_with("disarmed: WallFollowing "), "{status:?}");
    server.knows("other");
    let refused = server.afpc(&robot.place, deploy);
    let texts =
        ["the key of 'robot.test' has changed", "help: if you have installed the robot again"];
    refused.fails(1, &texts);
    server.place.write("known", "");
    server.afpc(&robot.place, deploy).fails(1, &["the key of 'robot.test' is unknown"]);
    server.knows("host");
    std::fs::copy(server.place.path("other"), server.place.path("user")).unwrap();
    std::fs::remove_file(server.place.path("user.pub")).unwrap();
    let stranger = server.afpc(&robot.place, deploy);
    stranger.fails(1, &["'robot.test' accepts neither your key", "'ssh-copy-id robot.test'"]);
}

#[test]
fn systemd_accepts_the_unit_and_it_is_hardened() {
    let place = Place::new();
    let unit = place.afpc("agent --unit");
    unit.succeeds();
    // The program need not be installed where the test runs.
    place.write("afp.service", &unit.out.replace("/usr/local/bin/afpc", "/bin/true"));
    let path = place.path("afp.service");
    let analyze = |verb: &[&str]| Command::new("systemd-analyze").args(verb).arg(&path).output();
    let Ok(verified) = analyze(&["verify"]) else {
        println!("left out: there is no systemd-analyze");
        return;
    };
    let verified = said(verified);
    assert_eq!((verified.code, &*verified.err), (0, ""));
    let threshold = ["security", "--offline=true", "--threshold=35"];
    said(analyze(&threshold).unwrap()).succeeds();
}
