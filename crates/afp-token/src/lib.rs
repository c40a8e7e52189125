//! Random tokens by which clients are admitted, the same kind for debuggers, live streams and the studio.
#![forbid(unsafe_code)]

use std::fmt;
use std::io;

/// A token that admits whoever has it.
#[derive(Clone)]
pub struct Token(String);

impl Token {
    /// A new one: 128 random bits, as 32 hexadecimal digits.
    ///
    /// # Errors
    /// The machine has no randomness.
    pub fn new() -> io::Result<Token> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes).map_err(|why| io::Error::other(why.to_string()))?;
        Ok(Token(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    /// A word that is known already.
    pub fn from_word(word: &str) -> Token {
        Token(word.to_owned())
    }

    /// The word, for the one who is to know it.
    pub fn word(&self) -> &str {
        &self.0
    }

    /// Whether a text is the word, in a time that does not tell how much of it is.
    pub fn is(&self, said: &str) -> bool {
        let pairs = self.0.bytes().zip(said.bytes());
        let differing = pairs.fold(0, |all, (one, other)| all | (one ^ other));
        self.0.len() == said.len() && differing == 0
    }
}

/// Without the word: what is written down is read by others.
impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token(..)")
    }
}

#[cfg(test)]
mod tests {
    use super::Token;

    #[test]
    fn a_word_is_itself_and_no_other() {
        let token = Token::new().unwrap();
        assert_eq!(token.word().len(), 32);
        assert!(token.is(token.word()) && !token.is(Token::new().unwrap().word()));
        for wrong in ["", &token.word()[1..], &format!("{}0", token.word())] {
            assert!(!token.is(wrong), "{wrong}");
        }
        assert!(!format!("{token:?}").contains(token.word()));
    }
}
