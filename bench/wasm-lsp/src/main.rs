//! The language server as a program for the web.
//!
//! Messages come in on standard input and go out on standard output, one per line, with an empty
//! line after the responses to each message. The first input line is an object of files: texts by
//! path. A Node.js test uses the same conversations as the server's own tests.

use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};

use afp_lsp::{Host, Message, Server};

struct Files(BTreeMap<String, String>);

impl Host for Files {
    fn read(&self, path: &str) -> Result<String, String> {
        self.0.get(path).cloned().ok_or_else(|| "there is no such file".to_owned())
    }

    fn plan_files(&self, folder: &str) -> Vec<String> {
        let below = |path: &&String| path.starts_with(folder) && path.ends_with(".afp");
        self.0.keys().filter(below).cloned().collect()
    }

    fn built_in(&self, _: &str, _: &str) -> Option<String> {
        None
    }
}

fn main() -> io::Result<()> {
    let mut lines = io::stdin().lock().lines();
    let files = lines.next().transpose()?.unwrap_or_default();
    let mut server = Server::new(Box::new(Files(serde_json::from_str(&files)?)));
    let mut out = io::stdout().lock();
    for line in lines {
        let message: Message = serde_json::from_str(&line?)?;
        let mut said = server.handle(message);
        said.extend(server.idle());
        for message in said {
            writeln!(out, "{}", serde_json::to_value(&message)?)?;
        }
        writeln!(out)?;
    }
    Ok(())
}
