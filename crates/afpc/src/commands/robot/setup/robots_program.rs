//! The computer that a program needs, from the head of its file (ELF) and the versions that it names.

/// The prefix of the versions of the GNU C library.
const GLIBC: &[u8] = b"GLIBC_";

/// The computer that a program needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    pub architecture: &'static str,
    /// The version of glibc; `None` for a program that needs no C library.
    pub libc: Option<(u32, u32)>,
}

impl Needs {
    pub fn of(program: &[u8]) -> Needs {
        let starts = program.windows(GLIBC.len()).enumerate();
        let starts = starts.filter(|(_, window)| *window == GLIBC).map(|(at, _)| at + GLIBC.len());
        let versions = starts.filter_map(|at| version(program.get(at..)?));
        Needs { architecture: architecture(program), libc: versions.max() }
    }
}

/// The processor of a program.
pub fn architecture(program: &[u8]) -> &'static str {
    match program.get(18..20) {
        Some([0x3e, 0]) => "x86_64",
        Some([0xb7, 0]) => "aarch64",
        Some([0x28, 0]) => "arm",
        _ => "another processor",
    }
}

/// A version such as `2.36` at the start of bytes.
pub fn version(bytes: &[u8]) -> Option<(u32, u32)> {
    let is_of_version = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let length = bytes.iter().take(12).take_while(|byte| is_of_version(byte)).count();
    let text = std::str::from_utf8(bytes.get(..length)?).ok()?;
    let mut numbers = text.split('.').map(str::parse);
    Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_names_its_processor_and_its_newest_version_of_glibc() {
        let mut program = vec![0; 64];
        program[18] = 0xb7;
        program.extend(b"GLIBC_2.9\0GLIBC_2.34\0GLIBC_2.2.5\0GLIBC_PRIVATE\0GLIBC_");
        assert_eq!(Needs::of(&program), Needs { architecture: "aarch64", libc: Some((2, 34)) });
        let nothing = Needs { architecture: "another processor", libc: None };
        assert_eq!(Needs::of(b"#!/bin/sh\n"), nothing);
    }
}
