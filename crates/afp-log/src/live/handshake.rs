//! The handshake with a client: admission, a place, and the protocol.

use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

use tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tungstenite::http::HeaderValue;
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{WebSocket, accept_hdr_with_config};

use super::admission::{Refusal, Role, Tokens};
use super::hub::{Hub, Place};
use super::paced::Paced;
use super::protocol::NAMES;

/// The longest message of a client, in bytes.
const LONGEST: usize = 1 << 20;
/// The maximum time of a write before requests are read again.
const WRITE: Duration = Duration::from_millis(100);

pub(crate) struct Admitted {
    pub socket: WebSocket<Paced>,
    pub role: Role,
    /// Held while the client is connected.
    pub place: Place,
}

/// Admits a client; `None` for a rejected or aborted connection. The owner of the other end of the
/// stream limits the time.
#[allow(clippy::result_large_err)] // The type is that of the library.
pub(crate) fn handshake(stream: TcpStream, hub: &Arc<Hub>, tokens: &Tokens) -> Option<Admitted> {
    // A stream from a non-blocking listener may be non-blocking, too.
    stream.set_nonblocking(false).ok()?;
    stream.set_nodelay(true).ok()?;
    stream.set_write_timeout(Some(WRITE)).ok()?;
    let at = stream.local_addr().ok()?;
    let mut admitted = None;
    let admit = |request: &Request, mut response: Response| {
        let role = tokens.admit(request, at).and_then(|role| Ok((role, name(request)?)));
        let all = role.and_then(|(role, name)| Ok((role, name, Hub::take_place(hub).ok_or(FULL)?)));
        match all {
            Ok((role, name, place)) => {
                admitted = Some((role, place));
                let header = HeaderValue::from_static(name);
                response.headers_mut().insert("sec-websocket-protocol", header);
                Ok(response)
            }
            Err((code, why)) => Err(refused(code, why)),
        }
    };
    let limits =
        WebSocketConfig::default().max_message_size(Some(LONGEST)).max_frame_size(Some(LONGEST));
    let socket = accept_hdr_with_config(Paced::new(stream), admit, Some(limits)).ok()?;
    let (role, place) = admitted?;
    Some(Admitted { socket, role, place })
}

const FULL: Refusal = (503, "too many clients are connected\n");

/// The protocol's name that both sides support.
fn name(request: &Request) -> Result<&'static str, Refusal> {
    let offered = request.headers().get_all("sec-websocket-protocol");
    let offered = offered.iter().filter_map(|value| value.to_str().ok());
    let offered: Vec<_> = offered.flat_map(|all| all.split(',')).map(str::trim).collect();
    let known = NAMES.into_iter().find(|name| offered.contains(name));
    known.ok_or((400, "this server speaks 'foxglove.sdk.v1', which the client did not request\n"))
}

fn refused(code: u16, why: &str) -> ErrorResponse {
    let mut response = ErrorResponse::new(Some(why.to_owned()));
    *response.status_mut() = code.try_into().unwrap_or_default();
    response
}
