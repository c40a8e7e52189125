//! Random tokens that admit clients, for debuggers, live streams and the studio.
#![forbid(unsafe_code)]

use std::fmt;
use std::io;

/// A token that admits its holder.
#[derive(Clone)]
pub struct Token(String);

impl Token {
    /// A new token: 128 random bits, as 32 hexadecimal digits.
    ///
    /// # Errors
    /// The machine has no source of randomness.
    pub fn new() -> io::Result<Token> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes).map_err(|why| io::Error::other(why.to_string()))?;
        Ok(Token(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    pub fn from_word(word: &str) -> Token {
        Token(word.to_owned())
    }

    /// The word, for its recipient.
    pub fn word(&self) -> &str {
        &self.0
    }

    /// Whether a text is the word. The time does not reveal how much of it is right.
    pub fn is(&self, said: &str) -> bool {
        let pairs = self.0.bytes().zip(said.bytes());
        let differing = pairs.fold(0, |all, (one, other)| all | (one ^ other));
        self.0.len() == said.len() && differing == 0
    }
}

/// Without the word, because others may read the output.
impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token(..)")
    }
}

#[cfg(test)]
mod tests {
    use super::Token;

    #[test]
    fn a_word_only_equals_itself() {
        let token = Token::new().unwrap();
        assert_eq!(token.word().len(), 32);
        assert!(token.is(token.word()) && !token.is(Token::new().unwrap().word()));
        for wrong in ["", &token.word()[1..], &format!("{}0", token.word())] {
            assert!(!token.is(wrong), "{wrong}");
        }
        assert!(!format!("{token:?}").contains(token.word()));
    }
}
