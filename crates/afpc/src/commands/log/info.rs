//! `afpc log FILE info`: the contents of the file.

use std::fmt::Write;
use std::path::Path;

use afp_log::LogData;

/// The facts of a log, line by line.
pub(super) fn text(path: &Path, log: &LogData) -> String {
    let mut text = String::new();
    let mut line = |key: &str, value: &str| {
        // Values of several lines stay in their column.
        for (n, value) in value.lines().enumerate() {
            let key = if n == 0 { key } else { "" };
            let _ = writeln!(text, "{key:>18}  {value}");
        }
    };
    line("file", &path.display().to_string());
    line("bytes", &log.bytes.to_string());
    if let Some((first, last)) = log.span {
        line("from", &format!("{:.3} s", first.as_secs_f64()));
        line("to", &format!("{:.3} s", last.as_secs_f64()));
    }
    line("whole", log.cut_short.as_deref().unwrap_or("yes"));
    for (key, value) in &log.facts {
        line(key, value);
    }
    for (name, content) in &log.attachments {
        line("attachment", &format!("{name}, {} bytes", content.len()));
    }
    let _ = writeln!(text, "\n{:>9}  {:<20}  schema", "messages", "topic");
    for (topic, info) in &log.topics {
        let _ = writeln!(text, "{:>9}  {topic:<20}  {}", info.messages, info.schema);
    }
    text
}
