//! `afpc robot setup`: a computer with its own users, programs and state, which is a namespace of
//! this machine. Nothing outside it changes. It needs root.

use std::path::Path;
use std::process::Command;

use super::ssh::{SSHD, Server};
use crate::common::{Place, WALL_FOLLOWING};

/// Gives a new mount namespace the folders of the computer, and starts its server of ssh.
const START: &str = r#"set -e
cp -a /etc/. "$1/etc"
mkdir -p "$1/run/sshd" "$1/run/systemd/system" "$1/state" "$1/home" \
    "$1/etc/systemd/system"
sed -i 's#^root:\(.*\):/root:#root:\1:/home/root:#' "$1/etc/passwd"
echo 'pi ALL=(ALL) NOPASSWD: ALL' >"$1/etc/sudoers.d/pi"
for of in etc:/etc run:/run state:/var/lib home:/home local:/usr/local; do
    mount --bind "$1/${of%%:*}" "${of#*:}"
done
for user in pi guest; do
    useradd --create-home --password '*' --shell /bin/sh $user
    install -d -o $user "/home/$user/.ssh"
    install -o $user "$1/user.pub" "/home/$user/.ssh/authorized_keys"
done
shift
exec "$@"
"#;

/// The only service of the computer is started without systemd.
const SYSTEMCTL: &str = r#"#!/bin/sh
echo "$*" >>/run/systemctl
case "$1" in
stop | restart) if [ -e /run/afp.pid ]; then kill "$(cat /run/afp.pid)"; fi ;;
esac
case "$1" in
restart)
    cd /
    setpriv --reuid=afp --regid=afp --init-groups /usr/local/bin/afpc agent --serve \
        </dev/null >/dev/null 2>&1 &
    echo $! >/run/afp.pid
    ;;
esac
"#;

const NMCLI: &str = "#!/bin/sh\nfor word; do echo \"$word\"; done >>/run/nmcli\n";

/// A program for the processor of a Raspberry Pi, which the computer emulates: its namespace runs such
/// programs in QEMU.
pub const EMULATED: &str = "AFP_ROBOTS_AFPC";

/// The rest of [`START`] for such a computer.
const EMULATE: &str = r#"
mount -t binfmt_misc none /proc/sys/fs/binfmt_misc
mask='\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff'
magic='\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00'
echo ":aarch64:M::$magic:$mask:/usr/local/bin/emulator:" >/proc/sys/fs/binfmt_misc/register
"#;
/// Runs a command in another user namespace with the same users, which has its own list of emulators.
const ENTER: &str = r#"
unshare --user sleep 10 &
holder=$!
while [ "$(readlink /proc/$holder/ns/user)" = "$(readlink /proc/self/ns/user)" ]; do
    sleep 0.01
done
echo 0 0 65536 >/proc/$holder/uid_map
echo 0 0 65536 >/proc/$holder/gid_map
exec nsenter --user --target $holder "$@"
"#;
const EMULATOR: &str = "#!/bin/sh\nexec qemu-aarch64 -L /usr/aarch64-linux-gnu \"$@\"\n";
const UNAME: &str =
    "#!/bin/sh\ncase \"$1\" in -m) echo aarch64 ;; *) exec /usr/bin/uname \"$@\" ;; esac\n";

/// The computer; `None` if this test cannot make one.
pub fn computer() -> Option<Server> {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|it| it.stdout == b"0\n");
    let missing = ["/usr/sbin/sshd", "/usr/bin/sudo", "/usr/bin/unshare", "/usr/bin/sftp"];
    let missing = missing.into_iter().find(|program| !Path::new(program).exists());
    if !is_root || missing.is_some() {
        println!("left out: it needs root, sshd, sftp, sudo and unshare");
        return None;
    }
    Some(Server::started(|place| {
        place.write("etc/.keep", "");
        let emulated = std::env::var_os(EMULATED).is_some();
        let emulate = if emulated { EMULATE } else { "" };
        place.write("start", &START.replace("shift\n", &format!("{emulate}shift\n")));
        place.program("local/bin/systemctl", SYSTEMCTL);
        place.program("local/bin/nmcli", NMCLI);
        let mut unshare = Command::new("unshare");
        if emulated {
            place.program("local/bin/emulator", EMULATOR);
            place.program("local/bin/uname", UNAME);
            place.write("enter", ENTER);
            unshare = Command::new("sh");
            unshare.args(["enter", "unshare"]);
        }
        let namespaces = ["--mount", "--pid", "--fork", "--mount-proc", "--kill-child"];
        unshare.args(namespaces).args(["sh", "start"]).current_dir(place.path(""));
        unshare.arg(place.path("")).arg(SSHD);
        (unshare, "Subsystem sftp internal-sftp\n".to_owned())
    }))
}

#[test]
fn a_computer_is_set_up_deployed_to_and_upgraded() {
    let Some(server) = computer() else { return };
    let project = Place::new();
    project.write("afp.toml", "[run]\n");
    project.write("wall_following.afp", WALL_FOLLOWING);
    let unconfirmed = server.afpc(&project, "robot setup pi@robot.test");
    unconfirmed.fails(2, &["there is no terminal to agree to this script", "add '--yes'"]);
    assert!(unconfirmed.out.contains("useradd --create-home"), "the script is shown");
    assert!(!server.place.exists("local/bin/afpc"));
    let early = "deploy wall_following.afp --robot sim --to pi@robot.test";
    server.afpc(&project, early).fails(1, &["'pi@robot.test' has no afpc", "afpc robot setup"]);

    let first = server.afpc(&project, "robot setup pi@robot.test --yes");
    assert!(first.succeeds().out.contains("ready: afp@robot.test has afpc "), "{first:?}");
    for file in [
        "local/bin/afpc",
        "state/afp/afp.toml",
        "etc/systemd/system/afp.service",
        "etc/udev/rules.d/99-afp.rules",
    ] {
        assert!(server.place.exists(file), "{file}");
    }
    assert!(!server.place.exists("home/pi/afp-setup"), "the copies are removed");
    let groups = server.place.read("etc/group");
    let dialout = groups.lines().find(|line| line.starts_with("dialout:"));
    assert!(dialout.is_none_or(|line| line.contains("afp")), "{dialout:?}");

    let other = server.afpc(&project, early);
    other.fails(2, &["this user may not use the service: log in as 'afp'"]);
    let deploy = "deploy wall_following.afp --robot sim --to afp@robot.test";
    let deployed = server.afpc(&project, deploy);
    assert!(deployed.succeeds().out.starts_with("ready: WallFollowing "), "{deployed:?}");
    server.afpc(&project, "robot arm afp@robot.test").succeeds();
    let moving = server.afpc(&project, "robot setup pi@robot.test --yes");
    moving.fails(2, &["the robot is armed and may be moving", "'afpc robot stop afp@robot.test'"]);
    server.afpc(&project, "robot stop afp@robot.test").succeeds();
    server.afpc(&project, "robot setup pi@robot.test --yes").succeeds();
    let asked = server.place.read("run/systemctl");
    let asked: Vec<_> = asked.lines().collect();
    let once = ["daemon-reload", "enable afp", "restart afp"];
    assert_eq!(asked, [&once[..], &["stop afp"], &once].concat());
    assert!(!server.place.exists("run/nmcli"), "no access point was asked for");
}

#[test]
fn an_access_point_is_created_for_the_next_boot() {
    let Some(server) = computer() else { return };
    let project = Place::new();
    let with = |input: &str| {
        let path = std::env::var("PATH").unwrap();
        let path = format!("{}:{path}", server.place.path("bin").display());
        project.write("input", input);
        let mut command = project.command();
        command.args(["robot", "setup", "pi@robot.test", "--yes", "--access-point", "my \"car\""]);
        command.stdin(std::fs::File::open(project.path("input")).unwrap());
        crate::common::said(command.env("PATH", path).output().unwrap())
    };
    with("short\n").fails(2, &["this cannot be the password of an access point", "8 to 63"]);
    with("a $(reboot) \"b\n").succeeds();
    let asked = server.place.read("run/nmcli");
    for words in ["ssid\nmy \"car\"\n", "wifi-sec.psk\na $(reboot) \"b\n", "ipv4.method\nshared\n"]
    {
        assert!(asked.contains(words), "{words:?} in {asked}");
    }
    assert!(!asked.contains("\nup\n"), "the connection of the setup stays");
}

#[test]
fn a_computer_that_cannot_run_plans_is_refused_with_the_next_step() {
    let Some(server) = computer() else { return };
    let project = Place::new();
    let setup = |more: &str| server.afpc(&project, &format!("robot setup {more}"));
    let mut other = std::fs::read(env!("CARGO_BIN_EXE_afpc")).unwrap();
    other.truncate(1 << 20);
    other[18..20].copy_from_slice(&[0x28, 0]);
    std::fs::write(project.path("other"), &other).unwrap();
    let wrong = setup("pi@robot.test --yes --afpc other");
    wrong.fails(2, &["and this afpc is for arm", "help: name one with '--afpc PROGRAM'"]);
    server.place.program(
        "local/bin/getconf",
        "#!/bin/sh\ncase $1 in LONG_BIT) echo 64 ;; *) echo glibc 2.17 ;; esac\n",
    );
    setup("pi@robot.test --yes").fails(2, &["this afpc needs glibc 2.", "the robot has 2.17"]);
    server.place.program("local/bin/getconf", "#!/bin/sh\nexit 1\n");
    setup("pi@robot.test --yes").fails(2, &["the robot has another C library"]);
    std::fs::remove_file(server.place.path("local/bin/getconf")).unwrap();

    let guest = setup("guest@robot.test --yes");
    guest.fails(2, &["'sudo' on 'guest@robot.test' asks for a password", "in a terminal"]);
    std::fs::remove_dir(server.place.path("run/systemd/system")).unwrap();
    setup("pi@robot.test --yes").fails(2, &["'pi@robot.test' does not run systemd"]);
    server.knows("other");
    setup("pi@robot.test --yes").fails(1, &["the key of 'pi@robot.test' has changed"]);
    setup("exec:sh --yes").fails(2, &["'exec:sh' is not a host"]);
    assert!(!server.place.exists("local/bin/afpc"));
}
