//! Prints the files of a list, one on each line, that the parser reads without an error: the
//! reference for other grammars of the language.

use std::process::ExitCode;
use std::{env, fs};

use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::parse;

fn main() -> ExitCode {
    match env::args().nth(1).ok_or_else(|| "name the list".to_owned()).and_then(|list| sound(&list))
    {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::FAILURE
        }
    }
}

fn sound(list: &str) -> Result<(), String> {
    let read =
        |file: &str| fs::read_to_string(file).map_err(|why| format!("cannot read {file}: {why}"));
    for file in read(list)?.lines() {
        let mut diags = Diagnostics::default();
        parse(&read(file)?, 0, &mut diags);
        if !diags.has_errors() {
            println!("{file}");
        }
    }
    Ok(())
}
