//! An error or a warning of the Rust compiler, from cargo's output.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::Value;

#[derive(Debug, Default)]
pub struct Message {
    /// Whether it is an error, and not a warning.
    pub is_error: bool,
    /// Its first sentence.
    pub title: String,
    /// The whole message as readable text, with colours.
    pub rendered: String,
    /// The folder of its package.
    pub package: PathBuf,
    /// Its place in the Rust code; `None` for a linker's message.
    pub place: Option<Place>,
    /// The title, the labels, and those of all its children.
    pub said: String,
}

/// A place in the Rust of a package.
#[derive(Debug, Default)]
pub struct Place {
    /// The file, relative to the package's folder or absolute.
    pub file: PathBuf,
    pub bytes: Range<usize>,
    /// Line and column in it, from 1.
    pub at: (usize, usize),
    /// The text of that line.
    pub line: String,
    /// The compiler's label.
    pub label: String,
}

impl Message {
    /// Reads a line of cargo; `None` for other lines, and for errors that only count others.
    pub fn read(line: &Value) -> Option<Message> {
        let about = line.get("message")?;
        let is_error = match about.get("level")?.as_str()? {
            "error" => true,
            "warning" => false,
            _ => return None,
        };
        let spans = about.get("spans")?.as_array()?;
        let primary = spans.iter().find(|span| span["is_primary"] == true);
        let title = text(about, "message");
        if primary.is_none() && (!is_error || title.starts_with("aborting due to ")) {
            return None;
        }
        let manifest = PathBuf::from(text(line, "manifest_path"));
        let mut said = String::new();
        collect(about, &mut said);
        Some(Message {
            is_error,
            title,
            rendered: text(about, "rendered"),
            package: manifest.parent().unwrap_or(Path::new("")).to_owned(),
            place: primary.and_then(Place::read),
            said,
        })
    }

    /// The message in one line: `src/lib.rs:12:5: mismatched types`.
    pub fn line(&self) -> String {
        let place = self.place.as_ref().map(|place| {
            let (line, column) = place.at;
            format!("{}:{line}:{column}: ", place.file.display())
        });
        format!("{}{}", place.unwrap_or_default(), self.title)
    }

    /// The file of its place.
    pub fn path(&self) -> Option<PathBuf> {
        Some(self.package.join(&self.place.as_ref()?.file))
    }
}

impl Place {
    fn read(span: &Value) -> Option<Place> {
        let number = |key: &str| span[key].as_u64().and_then(|n| usize::try_from(n).ok());
        Some(Place {
            file: text(span, "file_name").into(),
            bytes: number("byte_start")?..number("byte_end")?,
            at: (number("line_start")?, number("column_start")?),
            line: text(&span["text"][0], "text"),
            label: text(span, "label"),
        })
    }
}

fn text(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap_or_default().to_owned()
}

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
    fn a_message_has_its_primary_place() {
        let span = |primary, line: u32, label| {
            json!({ "is_primary": primary, "file_name": "src/lib.rs", "line_start": line,
                "byte_start": 40, "byte_end": 45, "column_start": 3, "label": label, "text": [{ "text": "  let x" }] })
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
        assert_eq!(message.path().as_deref(), Some(std::path::Path::new("/a/src/lib.rs")));
        assert_eq!(message.line(), "src/lib.rs:7:3: mismatched types");
        let place = message.place.unwrap();
        assert_eq!(
            (place.at, place.bytes, &*place.line, &*place.label),
            ((7, 3), 40..45, "  let x", "found")
        );
        assert_eq!(message.said, "mismatched types\nexpected\nfound\nbecause\n");
        line["message"]["spans"] = json!([]);
        line["message"]["message"] = json!("linker `cc` not found");
        assert!(Message::read(&line).unwrap().place.is_none(), "a linker knows no place");
        line["message"]["message"] = json!("aborting due to 1 previous error");
        assert!(Message::read(&line).is_none());
        line["message"]["level"] = json!("warning");
        line["message"]["message"] = json!("1 warning emitted");
        assert!(Message::read(&line).is_none());
        assert!(Message::read(&json!({ "reason": "build-finished" })).is_none());
    }
}
