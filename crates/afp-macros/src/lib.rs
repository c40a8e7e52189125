//! The macros `plan!` and `toolbox!`, thin over `afp-dsl`.
