//! Reads a linked image: its symbols and its code size.

use object::{Object, ObjectSection, ObjectSymbol, SectionKind};

use crate::shell::Failure;

#[derive(Debug, Default, PartialEq, Eq)]
pub struct Image {
    /// Every named symbol.
    pub symbols: Vec<String>,
    /// Size of code and constants, bytes.
    pub text: u64,
}

/// Reads an ELF image.
///
/// # Errors
/// The file is not an image, or has no symbols.
pub fn read(bytes: &[u8]) -> Result<Image, Failure> {
    let file = object::File::parse(bytes)?;
    let symbols: Vec<String> =
        file.symbols().filter_map(|symbol| symbol.name().ok().map(str::to_owned)).collect();
    if symbols.is_empty() {
        return Err(Failure("error: the image has no symbols".to_owned()));
    }
    let kept = file
        .sections()
        .filter(|section| matches!(section.kind(), SectionKind::Text | SectionKind::ReadOnlyData));
    Ok(Image { text: kept.map(|section| section.size()).sum(), symbols })
}

impl Image {
    /// The symbols that belong to panics.
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
    fn bytes_that_are_not_an_image_are_refused() {
        assert!(read(b"plan").is_err());
    }
}
