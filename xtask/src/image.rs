//! Looks into a linked image: its symbols and the size of its code.

use object::{Object, ObjectSection, ObjectSymbol, SectionKind};

use crate::shell::Failure;

/// The facts of an image that the gate checks.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Image {
    /// Every named symbol.
    pub symbols: Vec<String>,
    /// Bytes of code and constants.
    pub text: u64,
}

/// Reads an ELF image.
///
/// # Errors
/// Not an image, or one without symbols, in which nothing could be found.
pub fn read(bytes: &[u8]) -> Result<Image, Failure> {
    let file = object::File::parse(bytes)?;
    let symbols: Vec<String> =
        file.symbols().filter_map(|symbol| symbol.name().ok().map(str::to_owned)).collect();
    if symbols.is_empty() {
        return Err(Failure("error: the image has no symbols to look at".to_owned()));
    }
    let kept = file
        .sections()
        .filter(|section| matches!(section.kind(), SectionKind::Text | SectionKind::ReadOnlyData));
    Ok(Image { text: kept.map(|section| section.size()).sum(), symbols })
}

impl Image {
    /// The symbols that have to do with panics.
    pub fn panics(&self) -> Vec<&str> {
        self.symbols.iter().map(String::as_str).filter(|name| name.contains("panic")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_of_this_test_can_panic_and_has_code() {
        let path = std::env::current_exe().expect("a test runs from a file");
        let image = read(&std::fs::read(path).expect("that file can be read")).expect("an image");
        assert!(!image.panics().is_empty());
        assert!(image.text > 0);
    }

    #[test]
    fn bytes_that_are_no_image_are_refused() {
        assert!(read(b"plan").is_err());
    }
}
