//! Files beside the manifest, and the built-in toolboxes.

use std::io::ErrorKind;
use std::path::PathBuf;
use std::{env, fs};

use afp_dsl::source::Source;
use afp_dsl::toolbox::Toolboxes;
use proc_macro2::TokenStream;
use quote::quote;

/// A text and the expression that gives it to the program.
pub struct File {
    /// The text, for the compiler of plans.
    pub source: Source,
    /// `include_str!`, or the text itself where it is built in.
    pub text: TokenStream,
}

/// A toolbox file: one beside the manifest, else a built-in one.
///
/// # Errors
/// A sentence that says what is missing.
pub fn toolbox(path: &str) -> Result<File, String> {
    let builtin = afp_toolboxes::ALL.iter().find(|builtin| builtin.file_name == path);
    match (read(path), builtin) {
        (Err(_), Some(builtin)) => {
            let text = builtin.text;
            Ok(File { source: Source::new(path, text), text: quote!(#text) })
        }
        (read, _) => read,
    }
}

/// A file beside the manifest.
///
/// # Errors
/// A sentence that says what is missing.
pub fn read(path: &str) -> Result<File, String> {
    let text = fs::read_to_string(full(path))
        .map_err(|error| format!("error: cannot read '{}': {error}", full(path).display()))?;
    Ok(File { source: Source::new(path, text), text: included(path) })
}

/// The text of a plan file that another one uses.
///
/// # Errors
/// Why there is none.
pub fn used(path: &str) -> Result<String, String> {
    fs::read_to_string(full(path)).map_err(|error| match error.kind() {
        ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => error.to_string().to_lowercase(),
    })
}

/// The expression of the text of a file beside the manifest.
pub fn included(path: &str) -> TokenStream {
    let full = full(path).to_string_lossy().into_owned();
    quote!(include_str!(#full))
}

fn full(path: &str) -> PathBuf {
    let root = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    root.join(path)
}

/// The built-in toolboxes, then those of these files, each with the module that implements it;
/// and the expressions of the files' texts.
///
/// # Errors
/// A sentence that says what is missing.
pub fn toolboxes(files: &[(String, String)]) -> Result<(Toolboxes, Vec<TokenStream>), String> {
    let mut toolboxes = Toolboxes::default();
    for builtin in afp_toolboxes::ALL {
        toolboxes.add(Source::new(builtin.file_name, builtin.text), builtin.rust_path);
    }
    let mut texts = Vec::new();
    for (path, module) in files {
        let file = read(path)?;
        toolboxes.add(file.source, module);
        texts.push(file.text);
    }
    Ok((toolboxes, texts))
}
