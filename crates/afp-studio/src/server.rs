//! HTTP requests: access is checked first, then the page, its files and its socket are served.

use std::collections::HashMap;
use std::net::{SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::{io, thread};

use afp_token::Token;
use axum::Router;
use axum::body::Body;
use axum::extract::{ConnectInfo, Path, Query, Request, State, WebSocketUpgrade};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::serve::ListenerExt;

use crate::access::Secret;
use crate::debugging::{self, Debuggers};
use crate::files::LONGEST;
use crate::room::Room;
use crate::sockets::{self, Sockets};
use crate::{Debugging, page, peer};

/// The longest frame; it fits the longest text with all letters escaped.
const LONGEST_FRAME: usize = 6 * LONGEST + (1 << 20);

#[derive(Clone)]
struct Shared {
    secret: Secret,
    sockets: Sockets,
    debuggers: Debuggers,
}

/// Serves until the program is asked to end.
pub(crate) async fn serve(
    listener: TcpListener,
    secret: Secret,
    (room, program): (Room, PathBuf),
    debuggers: Sender<Debugging>,
) -> io::Result<()> {
    let (sockets, end) = Sockets::new();
    let jobs = sockets.jobs(program, room.folder().root().to_owned());
    let worker = thread::spawn(move || sockets::run(room, end, jobs));
    let debuggers = Debuggers::new(debuggers);
    let shared = Shared { secret, sockets: sockets.clone(), debuggers };
    let routes = Router::new()
        .route("/", get(index))
        .route("/lsp", get(texts))
        .route("/dap", get(debugger))
        .route("/drawing.css", get(colours))
        .route("/{name}", get(file))
        .layer(from_fn_with_state(shared.clone(), guard))
        .with_state(shared);
    let routes = routes.into_make_service_with_connect_info::<SocketAddr>();
    listener.set_nonblocking(true)?;
    // Nagle's algorithm would delay each second message by 40 ms.
    let listener = tokio::net::TcpListener::from_std(listener)?.tap_io(|stream| {
        let _ = stream.set_nodelay(true);
    });
    let served = tokio::select! {
        served = async { axum::serve(listener, routes).await } => served,
        asked = asked_to_end() => asked,
    };
    sockets.end();
    let _ = tokio::task::spawn_blocking(move || worker.join()).await;
    served
}

/// Waits for Ctrl-C, the end of the terminal, or a termination signal.
#[cfg(unix)]
async fn asked_to_end() -> io::Result<()> {
    use tokio::signal::unix::{SignalKind, signal};
    let mut terminated = signal(SignalKind::terminate())?;
    let mut hung_up = signal(SignalKind::hangup())?;
    tokio::select! {
        asked = tokio::signal::ctrl_c() => asked,
        _ = terminated.recv() => Ok(()),
        _ = hung_up.recv() => Ok(()),
    }
}

#[cfg(not(unix))]
async fn asked_to_end() -> io::Result<()> {
    tokio::signal::ctrl_c().await
}

/// Rejects foreign requests and requests without a cookie, and sets the page's security policy.
async fn guard(State(shared): State<Shared>, request: Request, next: Next) -> Response {
    let headers = request.headers();
    let is_socket = matches!(request.uri().path(), "/lsp" | "/dap");
    if !shared.secret.is_ours(headers) || is_socket && !Secret::has_origin(headers) {
        return (StatusCode::FORBIDDEN, "this server answers only its own page\n").into_response();
    }
    let enters = request.uri().path() == "/" && request.uri().query().is_some();
    if !enters && !shared.secret.knows(headers) {
        let words = "this address needs a code: open the address that 'afpc studio' prints\n";
        return (StatusCode::FORBIDDEN, words).into_response();
    }
    let mut response = next.run(request).await;
    let headers = response.headers_mut();
    for (name, value) in [
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

/// Serves the page, after changing a code in its address into a cookie.
async fn index(
    State(shared): State<Shared>,
    ConnectInfo(peer): ConnectInfo<SocketAddr>,
    Query(query): Query<HashMap<String, String>>,
    headers: HeaderMap,
) -> Response {
    if let Some(code) = query.get("code") {
        let known = shared.secret.knows(&headers);
        let away = away(query.get("file"));
        if !known && !peer::is_own(peer, shared.secret.port()) {
            let words = "this code belongs to another user of this machine\n";
            return (StatusCode::FORBIDDEN, words).into_response();
        }
        return match shared.secret.redeem(code) {
            Some(cookie) => ([(header::SET_COOKIE, cookie)], away).into_response(),
            None if known => away,
            None => {
                let words = "this code has been used or is too old: start 'afpc studio' again\n";
                (StatusCode::FORBIDDEN, words).into_response()
            }
        };
    }
    if !shared.secret.knows(&headers) {
        return StatusCode::FORBIDDEN.into_response();
    }
    let Some((bytes, kind)) = page::file("index.html") else {
        let words = "the page is not built yet: run 'cargo xtask studio'\n";
        return (StatusCode::SERVICE_UNAVAILABLE, words).into_response();
    };
    let Ok(nonce) = Token::new() else {
        return StatusCode::INTERNAL_SERVER_ERROR.into_response();
    };
    let text = String::from_utf8_lossy(&bytes).replace("__NONCE__", nonce.word());
    let policy = format!(
        "default-src 'none'; script-src 'self'; style-src 'self' 'nonce-{}'; img-src 'self' data: blob:; \
         connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        nonce.word()
    );
    let headers = [
        (header::CONTENT_TYPE, kind.to_owned()),
        (HeaderName::from_static("content-security-policy"), policy),
    ];
    (headers, text).into_response()
}

/// Redirects to the page without the code, which must not stay in the history, and to a file.
fn away(file: Option<&String>) -> Response {
    let page = file.map_or("/".to_owned(), |path| format!("/#{}", afp_lsp::uri_of(path)));
    (StatusCode::SEE_OTHER, [(header::LOCATION, page)]).into_response()
}

async fn file(Path(name): Path<String>) -> Response {
    match page::file(&name) {
        Some((bytes, kind)) => {
            ([(header::CONTENT_TYPE, kind)], Body::from(bytes.into_owned())).into_response()
        }
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

/// The colours of drawings, shared by the page, the book and print.
async fn colours() -> Response {
    let sheet = afp_draw::sheet(afp_draw::Theme::Auto, false) + &afp_draw::properties();
    ([(header::CONTENT_TYPE, "text/css; charset=utf-8")], sheet).into_response()
}

async fn texts(State(shared): State<Shared>, upgrade: WebSocketUpgrade) -> Response {
    limited(upgrade).on_upgrade(move |socket| sockets::talk(socket, shared.sockets))
}

async fn debugger(State(shared): State<Shared>, upgrade: WebSocketUpgrade) -> Response {
    limited(upgrade).on_upgrade(move |socket| debugging::talk(socket, shared.debuggers))
}

fn limited(upgrade: WebSocketUpgrade) -> WebSocketUpgrade {
    upgrade.max_message_size(LONGEST_FRAME).max_frame_size(LONGEST_FRAME)
}
