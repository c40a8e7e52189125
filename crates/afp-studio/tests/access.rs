//! Access to the server from outside, for a browser, another user and another page.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::thread;
use std::time::Duration;

use afp_lsp::NoFiles;
use afp_studio::{Opened, Options, Studio};

fn options(folder: &Path, own: Option<&Path>) -> Options {
    let (folder, own, program) = (folder.to_owned(), own.map(Path::to_owned), "afpc".into());
    let (port, origins, examples) = (0, Vec::new(), Vec::new());
    Options { folder, open: None, port, origins, program, examples, own }
}

/// Serves on a free port until the end of the test.
fn serve(options: &Options) -> (u16, String) {
    let Opened::Here(studio) = Studio::open(options, || Box::new(NoFiles)).unwrap() else {
        panic!("somebody else serves it");
    };
    let address = studio.address();
    let rest = address.strip_prefix("http://127.0.0.1:").unwrap();
    let (port, code) = rest.split_once("/?code=").unwrap();
    let (port, code) = (port.parse().unwrap(), code.to_owned());
    thread::spawn(move || studio.serve(std::sync::mpsc::channel().0));
    (port, code)
}

/// The response to a request with these header lines.
fn get(port: u16, path: &str, lines: &[&str]) -> String {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(20))).unwrap();
    let own = format!("Host: 127.0.0.1:{port}");
    let own: &[&str] =
        if lines.iter().any(|line| line.starts_with("Host:")) { &[] } else { &[&own] };
    let lines = own.iter().chain(lines).map(|line| format!("{line}\r\n")).collect::<String>();
    write!(stream, "GET {path} HTTP/1.1\r\n{lines}Connection: close\r\n\r\n").unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

fn status(answer: &str) -> &str {
    answer.split(' ').nth(1).unwrap()
}

#[test]
fn a_code_opens_once_and_other_pages_never() {
    let (port, code) = serve(&options(&std::env::temp_dir(), None));
    assert_eq!(status(&get(port, "/", &[])), "403");
    assert_eq!(status(&get(port, "/main.js", &[])), "403");
    assert_eq!(status(&get(port, "/?code=0123", &[])), "403");
    let foreign = ["Host: evil.example"];
    assert_eq!(status(&get(port, &format!("/?code={code}"), &foreign)), "403");

    let entered = get(port, &format!("/?code={code}"), &[]);
    assert_eq!(status(&entered), "303", "{entered}");
    let line = entered.lines().find(|line| line.to_lowercase().starts_with("set-cookie:")).unwrap();
    let cookie = line.split([':', ';']).nth(1).unwrap().trim();
    let cookie = format!("Cookie: {cookie}");
    assert_eq!(status(&get(port, &format!("/?code={code}"), &[])), "403", "it works once");

    let colours = get(port, "/drawing.css", &[&cookie]);
    assert_eq!(status(&colours), "200");
    assert!(colours.contains(".afp-plan") && colours.contains("nosniff"), "{colours}");
    assert_eq!(status(&get(port, "/..%2fCargo.toml", &[&cookie])), "404");

    let page = "Origin: http://evil.example";
    assert_eq!(status(&get(port, "/lsp", &[&cookie, page])), "403");
    let upgrade = ["Connection: Upgrade", "Upgrade: websocket", "Sec-WebSocket-Version: 13"];
    let key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==";
    let without = [upgrade[1], upgrade[2], key];
    assert_eq!(status(&get(port, "/lsp", &without)), "403", "a socket needs the cookie");
    let of_page = [&without[..], &[&cookie]].concat();
    assert_eq!(status(&get(port, "/lsp", &of_page)), "403", "a socket needs the page's origin");
}

#[test]
fn a_second_studio_opens_the_page_of_the_first() {
    let (folder, own) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut options = options(folder.path(), Some(own.path()));
    let (port, first) = serve(&options);
    let plan = folder.path().join("a plan.afp");
    options.open = Some(plan.clone());
    let Opened::Elsewhere(address) = Studio::open(&options, || Box::new(NoFiles)).unwrap() else {
        panic!("two serve one folder");
    };
    let path = address.strip_prefix(&format!("http://127.0.0.1:{port}")).unwrap();
    let entered = get(port, path, &[]);
    assert_eq!(status(&entered), "303", "{entered}");
    let shown = format!("location: /#{}\r\n", afp_lsp::uri_of(plan.to_str().unwrap()));
    assert!(entered.contains("set-cookie") && entered.contains(&shown), "{entered}");
    assert_eq!(status(&get(port, path, &[])), "403", "it works once");
    assert_eq!(
        status(&get(port, &format!("/?code={first}"), &[])),
        "303",
        "so does the printed one"
    );
}
