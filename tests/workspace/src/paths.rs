//! Imports and paths in the tokens of an item, macro calls and blocks included.

use proc_macro2::{TokenStream, TokenTree};
use syn::{ItemUse, UseTree};

/// A name that a `use` brings into a module.
pub(crate) struct Import {
    /// The name. Without one every name of the module comes in.
    pub name: Option<String>,
    pub path: Vec<String>,
}

impl Import {
    pub fn is_glob(&self) -> bool {
        self.name.is_none()
    }
}

/// Appends the imports, and the paths of two or more segments.
pub(crate) fn collect(
    tokens: TokenStream,
    paths: &mut Vec<Vec<String>>,
    imports: &mut Vec<Import>,
) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut path = Path::default();
    let mut position = 0;
    while let Some(token) = tokens.get(position) {
        position += 1;
        match token {
            TokenTree::Ident(word) if word == "use" => {
                paths.extend(path.finish());
                if let Some((length, item)) = item_use(&tokens[position - 1..]) {
                    if item.leading_colon.is_none() {
                        flatten(&item.tree, &mut Vec::new(), imports);
                    }
                    position += length - 1;
                }
            }
            TokenTree::Ident(name) => paths.extend(path.push(name.to_string())),
            TokenTree::Punct(mark) if mark.as_char() == ':' => path.colons += 1,
            TokenTree::Group(group) => {
                paths.extend(path.finish());
                collect(group.stream(), paths, imports);
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => paths.extend(path.finish()),
        }
    }
    paths.extend(path.finish());
}

/// A path that is being read.
#[derive(Default)]
struct Path {
    segments: Vec<String>,
    colons: usize,
}

impl Path {
    /// Adds a name; returns the path before it if a new one begins.
    fn push(&mut self, name: String) -> Option<Vec<String>> {
        let continues = self.colons == 2 && !self.segments.is_empty();
        let is_foreign = self.colons >= 2;
        let before = if continues { None } else { self.finish() };
        if !continues && is_foreign {
            // No module has this name: another crate, or part of a type, defines the path.
            self.segments.push(String::new());
        }
        self.segments.push(name);
        self.colons = 0;
        before
    }

    fn finish(&mut self) -> Option<Vec<String>> {
        self.colons = 0;
        Some(std::mem::take(&mut self.segments)).filter(|path| path.len() > 1)
    }
}

/// The `use` at the beginning, with its number of tokens. Inside a macro it may be invalid Rust.
fn item_use(tokens: &[TokenTree]) -> Option<(usize, ItemUse)> {
    let is_end =
        |token: &TokenTree| matches!(token, TokenTree::Punct(mark) if mark.as_char() == ';');
    let length = tokens.iter().position(is_end)? + 1;
    let item = syn::parse2(tokens[..length].iter().cloned().collect()).ok()?;
    Some((length, item))
}

fn flatten(tree: &UseTree, path: &mut Vec<String>, imports: &mut Vec<Import>) {
    let import = |name: String, last: &str| {
        let path = path.iter().map(String::as_str).chain([last]).filter(|&name| name != "self");
        let mut path: Vec<_> = path.map(str::to_owned).collect();
        if path.is_empty() {
            path.push("self".to_owned());
        }
        let own = path.last().filter(|_| name == "self").cloned();
        Import { name: Some(own.unwrap_or(name)), path }
    };
    match tree {
        UseTree::Path(tree) => {
            path.push(tree.ident.to_string());
            flatten(&tree.tree, path, imports);
            path.pop();
        }
        UseTree::Name(tree) => {
            imports.push(import(tree.ident.to_string(), &tree.ident.to_string()))
        }
        UseTree::Rename(tree) => {
            imports.push(import(tree.rename.to_string(), &tree.ident.to_string()));
        }
        UseTree::Glob(_) => imports.push(Import { name: None, path: path.clone() }),
        UseTree::Group(group) => group.items.iter().for_each(|tree| flatten(tree, path, imports)),
    }
}
