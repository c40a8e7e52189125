//! Reads a linked image: its symbols, its code size, and the bytes for a board's flash.

use std::collections::BTreeMap;

use object::elf::PT_LOAD;
use object::read::elf::{ElfFile32, ProgramHeader};
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

/// The bytes of an UF2 block with its payload, and of the payload.
const BLOCK: usize = 512;
const PAGE: usize = 256;
/// The numbers that begin and end a block, the flag of a block with a family, and the family of the
/// Pico's microcontroller.
const BEGIN: [u32; 2] = [0x0a32_4655, 0x9e5d_5157];
const END: u32 = 0x0ab1_6f30;
const HAS_FAMILY: u32 = 0x2000;
const RP2040: u32 = 0xe48b_ff56;

/// The UF2 file of an image for a Raspberry Pi Pico, which is copied to the Pico's drive.
///
/// # Errors
/// The file is not an image.
pub fn uf2(bytes: &[u8]) -> Result<Vec<u8>, Failure> {
    let file = ElfFile32::<object::Endianness>::parse(bytes)?;
    let endian = file.endian();
    let mut pages: BTreeMap<u32, [u8; PAGE]> = BTreeMap::new();
    for header in file.elf_program_headers() {
        if header.p_type(endian) != PT_LOAD {
            continue;
        }
        let data = header.data(endian, bytes).map_err(|()| "a segment is not in the file")?;
        for (at, byte) in (header.p_paddr(endian)..).zip(data) {
            let within = at % PAGE as u32;
            pages.entry(at - within).or_insert([0; PAGE])[within as usize] = *byte;
        }
    }
    let count = pages.len() as u32;
    let block = |(number, (at, page)): (usize, (u32, [u8; PAGE]))| {
        let [first, second] = BEGIN;
        let numbers = [first, second, HAS_FAMILY, at, PAGE as u32, number as u32, count, RP2040];
        let mut block: Vec<u8> = numbers.iter().flat_map(|it| it.to_le_bytes()).collect();
        block.extend(page);
        block.resize(BLOCK - 4, 0);
        block.extend(END.to_le_bytes());
        block
    };
    Ok(pages.into_iter().enumerate().flat_map(block).collect())
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
        assert!(read(b"plan").is_err() && uf2(b"plan").is_err());
    }
}
