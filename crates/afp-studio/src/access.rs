//! Access: a one-time code becomes a cookie; other hosts and pages are refused.

use std::io;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use afp_token::Token;
use axum::http::HeaderMap;
use axum::http::header::{COOKIE, HOST, ORIGIN};

use crate::lock::{CODE_LASTS, Lock};

/// The secrets of a browser, and the allowed origins.
#[derive(Clone, Debug)]
pub struct Secret {
    port: u16,
    /// The value of the cookie.
    token: Token,
    /// The unused code and its time.
    code: Arc<Mutex<Option<(Token, Instant)>>>,
    /// The lock in which a second studio leaves codes; `None` if locking is not possible.
    lock: Option<Arc<Lock>>,
    origins: Arc<[String]>,
}

impl Secret {
    /// Makes new secrets for the server on a port.
    ///
    /// # Errors
    /// The system has no randomness.
    pub(crate) fn new(port: u16, origins: Vec<String>, lock: Option<Lock>) -> io::Result<Secret> {
        Ok(Secret {
            port,
            token: Token::new()?,
            code: Arc::new(Mutex::new(Some((Token::new()?, Instant::now())))),
            lock: lock.map(Arc::new),
            origins: origins.into(),
        })
    }

    pub(crate) fn port(&self) -> u16 {
        self.port
    }

    pub fn address(&self) -> String {
        let code = self.code.lock().unwrap_or_else(PoisonError::into_inner);
        let code = code.as_ref().map_or("", |(code, _)| code.word());
        format!("http://127.0.0.1:{}/?code={code}", self.port)
    }

    /// Returns the cookie for a code, which then expires.
    pub fn redeem(&self, code: &str) -> Option<String> {
        if !self.redeems(code) && !self.lock.as_ref().is_some_and(|lock| lock.redeem(code)) {
            return None;
        }
        let (name, token) = (self.cookie(), self.token.word());
        Some(format!("{name}={token}; HttpOnly; SameSite=Strict; Path=/"))
    }

    /// Whether a code is the printed one, which then expires.
    fn redeems(&self, code: &str) -> bool {
        let mut kept = self.code.lock().unwrap_or_else(PoisonError::into_inner);
        let works =
            |(good, made): &mut (Token, Instant)| made.elapsed() <= CODE_LASTS && good.is(code);
        kept.take_if(works).is_some()
    }

    /// Whether a request names its page. A browser does so for every socket.
    pub fn has_origin(headers: &HeaderMap) -> bool {
        headers.contains_key(ORIGIN)
    }

    /// Whether a request is for this server, and from one of its pages.
    pub fn is_ours(&self, headers: &HeaderMap) -> bool {
        let named = |name| headers.get(name).map(|value| value.to_str().unwrap_or("?"));
        let hosts = ["127.0.0.1", "localhost", "[::1]"].map(|host| format!("{host}:{}", self.port));
        let tunnels = || self.origins.iter().filter_map(|origin| origin.split_once("://"));
        let host = named(HOST).is_some_and(|host| {
            hosts.iter().any(|own| own == host) || tunnels().any(|(_, own)| own == host)
        });
        // A page sends its origin whenever it opens a socket or sends data.
        let origin = named(ORIGIN).is_none_or(|origin| {
            let own =
                origin.strip_prefix("http://").is_some_and(|it| hosts.iter().any(|own| own == it));
            own || self.origins.iter().any(|allowed| allowed == origin)
        });
        host && origin
    }

    /// Whether a request has the cookie.
    pub fn knows(&self, headers: &HeaderMap) -> bool {
        let name = self.cookie();
        let cookies = headers.get_all(COOKIE).iter().filter_map(|value| value.to_str().ok());
        cookies
            .flat_map(|cookies| cookies.split(';'))
            .filter_map(|cookie| cookie.trim().split_once('='))
            .any(|(key, value)| key == name && self.token.is(value))
    }

    /// Cookies do not distinguish ports, so their names do.
    fn cookie(&self) -> String {
        format!("afp_studio_{}", self.port)
    }
}

#[cfg(test)]
mod tests {
    use axum::http::HeaderValue;

    use super::*;

    fn headers(pairs: &[(axum::http::HeaderName, &str)]) -> HeaderMap {
        let pairs = pairs.iter().cloned();
        pairs.map(|(name, value)| (name, HeaderValue::from_str(value).unwrap())).collect()
    }

    #[test]
    fn a_code_works_once_and_its_cookie_later() {
        let secret = Secret::new(4000, Vec::new(), None).unwrap();
        let address = secret.address();
        let code = address.split_once("code=").unwrap().1;
        assert_eq!(secret.redeem("guessed"), None);
        let cookie = secret.redeem(code).unwrap();
        assert!(cookie.contains("HttpOnly") && cookie.contains("SameSite=Strict"), "{cookie}");
        assert_eq!(secret.redeem(code), None);
        let value = cookie.split(';').next().unwrap();
        assert!(secret.knows(&headers(&[(COOKIE, &format!("a=b; {value}"))])));
        for wrong in ["", "afp_studio_4000=", "afp_studio_4000=0123", "afp_studio_4001=x"] {
            assert!(!secret.knows(&headers(&[(COOKIE, wrong)])), "{wrong}");
        }
    }

    #[test]
    fn other_hosts_and_pages_are_refused() {
        let secret = Secret::new(4000, vec!["https://lab.example".to_owned()], None).unwrap();
        let own = [
            &[(HOST, "127.0.0.1:4000")][..],
            &[(HOST, "localhost:4000"), (ORIGIN, "http://localhost:4000")],
            &[(HOST, "lab.example"), (ORIGIN, "https://lab.example")],
        ];
        for pairs in own {
            assert!(secret.is_ours(&headers(pairs)), "{pairs:?}");
        }
        let foreign = [
            &[][..],
            &[(HOST, "evil.example:4000")],
            &[(HOST, "127.0.0.1:4001")],
            &[(HOST, "127.0.0.1:4000"), (ORIGIN, "http://evil.example")],
            &[(HOST, "127.0.0.1:4000"), (ORIGIN, "https://127.0.0.1:4000")],
            &[(HOST, "127.0.0.1:4000"), (ORIGIN, "null")],
        ];
        for pairs in foreign {
            assert!(!secret.is_ours(&headers(pairs)), "{pairs:?}");
        }
    }
}
