//! Command lines that repeat a run with `afpc run`.

use afp_core::Duration;

/// How long `afpc run` lets a plan run in virtual time by default.
pub const DEFAULT_UNTIL: Duration = Duration::from_secs(60);

/// A word as a shell takes it: quoted where it has to be.
///
/// ```
/// use afp_session::shell_word;
///
/// assert_eq!(shell_word("plans/square.afp"), "plans/square.afp");
/// assert_eq!(shell_word("name=it's"), r"'name=it'\''s'");
/// ```
pub fn shell_word(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "._-+=:/,@%".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}
