//! The user at the other end of a connection. The code of an address appears in the browser's
//! command line, which every user of the machine can read.

use std::net::SocketAddr;

/// Whether a peer is this program's user, the administrator, or unknown to the system.
pub(crate) fn is_own(peer: SocketAddr, port: u16) -> bool {
    user_of(peer, port).is_none_or(|user| user == 0 || Some(user) == own())
}

/// The user at the other end of a connection to a local port.
#[cfg(target_os = "linux")]
fn user_of(peer: SocketAddr, port: u16) -> Option<u32> {
    let tables = ["/proc/net/tcp", "/proc/net/tcp6"].into_iter();
    tables
        .filter_map(|table| std::fs::read_to_string(table).ok())
        .find_map(|table| find(&table, peer, port))
}

#[cfg(not(target_os = "linux"))]
fn user_of(_: SocketAddr, _: u16) -> Option<u32> {
    None
}

/// This program's user.
#[cfg(target_os = "linux")]
fn own() -> Option<u32> {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata("/proc/self").ok().map(|about| about.uid())
}

#[cfg(not(target_os = "linux"))]
fn own() -> Option<u32> {
    None
}

/// A user id for connections that the client has closed.
#[cfg(target_os = "linux")]
const NOBODY: u32 = u32::MAX;

/// The user of a connection in a Linux table, whose addresses are numbers in memory order.
#[cfg(target_os = "linux")]
fn find(table: &str, peer: SocketAddr, port: u16) -> Option<u32> {
    let SocketAddr::V4(peer) = peer else { return None };
    let address = u32::from_ne_bytes(peer.ip().octets());
    // The IPv6 table has a prefix before it.
    let (local, remote) = (format!("{address:08X}:{:04X}", peer.port()), format!(":{port:04X}"));
    let own = |line: &str| {
        let mut words = line.split_whitespace().skip(1);
        if !words.next()?.ends_with(&local) || !words.next()?.ends_with(&remote) {
            return None;
        }
        let (user, file) = (words.nth(4)?, words.nth(1)?);
        // Linux shows a socket without a process as the administrator's.
        if file == "0" { Some(NOBODY) } else { user.parse().ok() }
    };
    table.lines().find_map(own)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::net::{Ipv4Addr, TcpListener, TcpStream};

    use super::*;

    #[test]
    fn a_connection_of_this_user_is_known() {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
        let port = listener.local_addr().unwrap().port();
        let stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
        let peer = listener.accept().unwrap().1;
        assert_eq!(peer, stream.local_addr().unwrap());
        assert!(user_of(peer, port).is_none_or(|user| Some(user) == own()));
        assert!(is_own(peer, port));
    }

    #[cfg(target_endian = "little")]
    #[test]
    fn the_user_of_the_other_end_is_found() {
        let table = "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode
   0: 0100007F:1268 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 11 1 0 100 0
   1: 0100007F:1268 0100007F:B2C4 01 00000000:00000000 00:00000000 00000000  1000        0 12 1 0 20 4
   2: 0100007F:B2C4 0100007F:1268 01 00000000:00000000 00:00000000 00000000  1001        0 13 1 0 20 4
   3: 0100007F:B2C6 0100007F:1268 05 00000000:00000000 00:00000000 00000000     0        0 0 1 0 20 4
";
        let peer = |port: u16| SocketAddr::from((Ipv4Addr::LOCALHOST, port));
        assert_eq!(find(table, peer(0xB2C4), 0x1268), Some(1001));
        assert_eq!(find(table, peer(0xB2C5), 0x1268), None);
        assert_eq!(find(table, peer(0xB2C6), 0x1268), Some(NOBODY));
        assert_eq!(find(table, peer(0xB2C4), 0x1269), None);
        let mapped = table.replace("0100007F", "0000000000000000FFFF00000100007F");
        assert_eq!(find(&mapped, peer(0xB2C4), 0x1268), Some(1001));
    }
}
