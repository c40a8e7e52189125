//! Admission of clients: by host and origin, then by a token.

use std::io;
use std::net::{IpAddr, SocketAddr};

use afp_token::Token;
use tungstenite::handshake::server::Request;

/// The rights of a client.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// May only watch.
    Watcher,
    /// May write entries, press buttons, inject faults and stop the plan.
    Operator,
}

#[derive(Clone, Debug)]
pub(crate) struct Tokens {
    pub operator: Token,
    pub watcher: Token,
}

/// The reason for a rejection, with the HTTP status.
pub(crate) type Refusal = (u16, &'static str);

impl Tokens {
    /// Random tokens.
    ///
    /// # Errors
    /// The machine has no source of randomness.
    pub fn new() -> io::Result<Tokens> {
        Ok(Tokens { operator: Token::new()?, watcher: Token::new()? })
    }

    fn role(&self, said: &str) -> Option<Role> {
        let all = [(&self.operator, Role::Operator), (&self.watcher, Role::Watcher)];
        // All tokens are compared, so that the time does not reveal the matching one.
        let found = all.map(|(token, role)| token.is(said).then_some(role));
        found.into_iter().flatten().next()
    }

    /// The role of a request.
    ///
    /// # Errors
    /// The host name or the page is not allowed, or the token is missing.
    pub fn admit(&self, request: &Request, at: SocketAddr) -> Result<Role, Refusal> {
        let header = |name: &str| request.headers().get(name).map(|value| value.to_str());
        match header("host") {
            Some(Ok(host)) if is_own_name(host, at) => {}
            _ => return Err((403, "unknown host name: use the server's IP address\n")),
        }
        match header("origin") {
            None => {}
            Some(Ok(origin)) if is_known_page(origin) => {}
            _ => return Err((403, "pages from that origin are not allowed\n")),
        }
        let query = request.uri().query().unwrap_or_default();
        let said = query.split('&').find_map(|pair| pair.strip_prefix("token="));
        let said = said.ok_or((401, "use the printed address, with '?token='\n"))?;
        self.role(said).ok_or((401, "wrong token: use the printed address\n"))
    }
}

/// Whether a host is this machine's address or `localhost`: other names may point elsewhere
/// tomorrow.
fn is_own_name(host: &str, at: SocketAddr) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.parse() == Ok(at.port()) => name,
        _ => return false,
    };
    name == "localhost" || name.trim_matches(['[', ']']).parse::<IpAddr>().is_ok()
}

/// Whether a page is from this machine or from Foxglove.
fn is_known_page(origin: &str) -> bool {
    let Some((scheme, rest)) = origin.split_once("://") else { return false };
    let host = match rest.rsplit_once(':') {
        Some((host, port)) if port.bytes().all(|digit| digit.is_ascii_digit()) => host,
        _ => rest,
    };
    let loopback = host == "localhost"
        || host.trim_matches(['[', ']']).parse::<IpAddr>().is_ok_and(|ip| ip.is_loopback());
    loopback || (scheme == "https" && host.ends_with(".foxglove.dev"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn admitted(host: &str, origin: Option<&str>, query: &str) -> Result<Role, u16> {
        let tokens =
            Tokens { operator: Token::from_word("steer"), watcher: Token::from_word("watch") };
        let mut request = Request::builder().uri(format!("/{query}")).header("host", host);
        if let Some(origin) = origin {
            request = request.header("origin", origin);
        }
        let request = request.body(()).expect("a request");
        let at = SocketAddr::from(([127, 0, 0, 1], 8765));
        tokens.admit(&request, at).map_err(|(code, _)| code)
    }

    #[test]
    fn a_token_admits_a_client_with_a_name_of_the_machine() {
        for host in ["127.0.0.1:8765", "localhost:8765", "[::1]:8765", "192.168.0.7:8765"] {
            assert_eq!(admitted(host, None, "?token=steer"), Ok(Role::Operator));
            assert_eq!(admitted(host, None, "?a=b&token=watch"), Ok(Role::Watcher));
            for query in ["", "?token=", "?token=stee", "?token=steers", "?nottoken=steer"] {
                assert_eq!(admitted(host, None, query), Err(401), "{query}");
            }
        }
    }

    #[test]
    fn other_hosts_and_pages_are_rejected_even_with_a_token() {
        for host in
            ["evil.example:8765", "127.0.0.1:80", "127.0.0.1", "localhost.evil.example:8765", ""]
        {
            assert_eq!(admitted(host, None, "?token=steer"), Err(403), "{host}");
        }
        let own = "127.0.0.1:8765";
        for page in ["http://localhost:3000", "https://app.foxglove.dev", "http://127.0.0.1"] {
            assert_eq!(admitted(own, Some(page), "?token=steer"), Ok(Role::Operator), "{page}");
        }
        for page in
            ["https://evil.example", "http://app.foxglove.dev", "https://foxglove.dev.evil", "null"]
        {
            assert_eq!(admitted(own, Some(page), "?token=steer"), Err(403), "{page}");
        }
    }
}
