//! Deploys over a real `sshd` on loopback, and the unit of the service.

use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use super::Robot;
use crate::common::{Place, Said, said};

const SSHD: &str = "/usr/sbin/sshd";

fn succeeds(command: &mut Command) -> String {
    let said = said(command.output().unwrap());
    said.succeeds();
    said.out.trim().to_owned()
}

/// A server whose only key runs the agent of a robot.
struct Server {
    place: Place,
    process: Child,
    port: u16,
}

impl Server {
    fn new(robot: &Robot) -> Server {
        let place = Place::new();
        for key in ["host", "user", "other"] {
            let mut keygen = Command::new("ssh-keygen");
            keygen.args(["-q", "-t", "ed25519", "-N", "", "-f"]).arg(place.path(key));
            succeeds(&mut keygen);
        }
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let file = |name: &str| place.path(name).display().to_string();
        let agent = robot.host().replace("exec:", "exec ");
        let asked = r#"test \"$SSH_ORIGINAL_COMMAND\" = 'afpc agent' && "#;
        place.write("keys", &format!("command=\"{asked}{agent}\" {}", place.read("user.pub")));
        place.write(
            "sshd",
            &format!(
                "Port {port}\nListenAddress 127.0.0.1\nHostKey {}\nAuthorizedKeysFile {}\nPidFile none\n\
                 StrictModes no\nUsePAM no\nPasswordAuthentication no\nPermitRootLogin yes\n",
                file("host"),
                file("keys")
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
        // The client of the path is the system's with another configuration.
        place
            .write("bin/ssh", &format!("#!/bin/sh\nexec /usr/bin/ssh -F {} \"$@\"\n", file("ssh")));
        let executable = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(place.path("bin/ssh"), executable).unwrap();
        // The folder that the server needs if root starts it.
        std::fs::create_dir_all("/run/sshd").ok();
        let mut server = Command::new(SSHD);
        server.args(["-D", "-f"]).arg(place.path("sshd")).stdin(Stdio::null());
        let process = server.stderr(Stdio::null()).spawn().unwrap();
        let server = Server { place, process, port };
        server.knows("host");
        server
    }

    /// Makes the client expect this key of the host.
    fn knows(&self, key: &str) {
        let public = self.place.read(&format!("{key}.pub"));
        self.place.write("known", &format!("[127.0.0.1]:{} {public}", self.port));
    }

    fn afpc(&self, robot: &Robot, arguments: &str) -> Said {
        let path = std::env::var("PATH").unwrap();
        let bin = self.place.path("bin").display().to_string();
        let mut command = robot.place.command();
        command.args(arguments.split(' ')).env("PATH", format!("{bin}:{path}"));
        said(command.output().unwrap())
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
    let mut first = server.afpc(&robot, deploy);
    for _ in 0..100 {
        if first.code == 0 {
            break;
        }
        // The server may not listen yet.
        std::thread::sleep(Duration::from_millis(100));
        first = server.afpc(&robot, deploy);
    }
    assert!(first.succeeds().out.starts_with("ready: WallFollowing "), "{first:?}");
    let status = server.afpc(&robot, "robot status robot.test");
    assert!(status.succeeds().out.starts_with("disarmed: WallFollowing "), "{status:?}");
    server.knows("other");
    let refused = server.afpc(&robot, deploy);
    refused.fails(1, &["Host key verification failed", "'robot.test' could not be reached"]);
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
