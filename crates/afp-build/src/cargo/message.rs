//! An error or a warning of the Rust compiler, as cargo hands it on.

use std::path::{Path, PathBuf};

use serde_json::Value;

/// What the compiler says.
#[derive(Debug, Default)]
pub struct Message {
    /// Whether it is an error; else it is a warning.
    pub is_error: bool,
    /// The sentence at its head.
    pub title: String,
    /// All of it as people read it, with colours.
    pub rendered: String,
    /// The folder of the package that it is about.
    pub package: PathBuf,
    /// The file that it points at, below the folder of the package or absolute.
    pub file: PathBuf,
    /// Line and column in it, from 1.
    pub place: (usize, usize),
    /// The text of that line.
    pub line: String,
    /// The title, the labels, and the same of all that stands below it.
    pub said: String,
}

impl Message {
    /// Reads a line of cargo; `None` for what is no error or warning at a place.
    pub fn read(line: &Value) -> Option<Message> {
        let about = line.get("message")?;
        let is_error = match about.get("level")?.as_str()? {
            "error" => true,
            "warning" => false,
            _ => return None,
        };
        let spans = about.get("spans")?.as_array()?;
        let primary = spans.iter().find(|span| span["is_primary"] == true)?;
        let text = |value: &Value, key: &str| value[key].as_str().unwrap_or("").to_owned();
        let number = |key: &str| primary[key].as_u64().and_then(|n| usize::try_from(n).ok());
        let manifest = PathBuf::from(text(line, "manifest_path"));
        let mut said = String::new();
        collect(about, &mut said);
        Some(Message {
            is_error,
            title: text(about, "message"),
            rendered: text(about, "rendered"),
            package: manifest.parent().unwrap_or(Path::new("")).to_owned(),
            file: text(primary, "file_name").into(),
            place: (number("line_start")?, number("column_start")?),
            line: text(&primary["text"][0], "text"),
            said,
        })
    }

    /// The file that it points at.
    pub fn path(&self) -> PathBuf {
        self.package.join(&self.file)
    }
}

/// Gathers the sentences of a message.
fn collect(message: &Value, said: &mut String) {
    let mut add = |value: &Value| {
        said.push_str(value.as_str().unwrap_or(""));
        said.push('\n');
    };
    add(&message["message"]);
    for span in message["spans"].as_array().into_iter().flatten() {
        add(&span["label"]);
    }
    for child in message["children"].as_array().into_iter().flatten() {
        collect(child, said);
    }
}

#[cfg(test)]
mod tests {
    use super::Message;
    use serde_json::json;

    #[test]
    fn a_message_is_read_from_its_primary_place() {
        let span = |primary, line: u32, label| {
            json!({ "is_primary": primary, "file_name": "src/lib.rs", "line_start": line,
                "column_start": 3, "label": label, "text": [{ "text": "  let x" }] })
        };
        let child = json!({ "message": "because", "spans": [], "children": [] });
        let mut line = json!({
            "reason": "compiler-message",
            "manifest_path": "/a/Cargo.toml",
            "message": {
                "level": "error", "message": "mismatched types", "rendered": "error: all",
                "spans": [span(false, 1, "expected"), span(true, 7, "found")],
                "children": [child],
            },
        });
        let message = Message::read(&line).unwrap();
        assert!(message.is_error);
        assert_eq!(message.path(), std::path::Path::new("/a/src/lib.rs"));
        assert_eq!((message.place, &*message.line), ((7, 3), "  let x"));
        assert_eq!(message.said, "mismatched types\nexpected\nfound\nbecause\n");
        line["message"]["spans"] = json!([]);
        assert!(Message::read(&line).is_none(), "'aborting due to 1 previous error' has no place");
        assert!(Message::read(&json!({ "reason": "build-finished" })).is_none());
    }
}
