//! The module graph of a crate: which file names items that another file defines.
//!
//! A `use` and a path of two or more segments are arrows to the file that defines the item; every `pub use` on
//! the way is followed. Code of tests is left out, and so is a module's use of a module that contains it.

use std::collections::{BTreeMap, BTreeSet};

use quote::ToTokens;
use syn::{Attribute, Item, ItemMod, Meta};

use crate::paths::{self, Import};

/// Sources by their path below `src`.
pub type Sources = BTreeMap<String, String>;
/// The names that each file uses from another file.
pub type Arrows = BTreeMap<(String, String), BTreeSet<String>>;

/// A module. An inline module is part of its parent's file.
struct Module {
    file: String,
    parent: usize,
    items: BTreeSet<String>,
    children: BTreeMap<String, usize>,
    imports: Vec<Import>,
    paths: Vec<Vec<String>>,
}

/// A meaning of a name: a module, or an item that this module defines.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Meaning {
    Module(usize),
    Item(usize),
}

/// The modules of a crate; the first is the root.
struct Modules(Vec<Module>);

/// The arrows between the files of a crate with a `lib.rs`.
///
/// # Panics
/// A source is not valid Rust.
pub fn arrows(sources: &Sources) -> Arrows {
    let mut modules = Modules(Vec::new());
    modules.add_file("lib.rs", "", 0, sources);
    let mut arrows = Arrows::new();
    for (index, module) in modules.0.iter().enumerate() {
        let imports = module.imports.iter().map(|import| (&import.path, import.is_glob()));
        for (path, is_glob) in imports.chain(module.paths.iter().map(|path| (path, false))) {
            for file in modules.defining(index, path, is_glob) {
                let arrow = (module.file.clone(), file.to_owned());
                arrows.entry(arrow).or_default().insert(path.join("::"));
            }
        }
    }
    arrows
}

impl Modules {
    fn add_file(&mut self, file: &str, folder: &str, parent: usize, sources: &Sources) -> usize {
        let parsed = syn::parse_file(&sources[file]);
        let parsed = parsed.unwrap_or_else(|error| panic!("{file}: {error}"));
        self.add(file, folder, parent, parsed.items, sources)
    }

    fn add(
        &mut self,
        file: &str,
        folder: &str,
        parent: usize,
        items: Vec<Item>,
        sources: &Sources,
    ) -> usize {
        let index = self.0.len();
        self.0.push(Module {
            file: file.to_owned(),
            parent,
            items: BTreeSet::new(),
            children: BTreeMap::new(),
            imports: Vec::new(),
            paths: Vec::new(),
        });
        for item in items.into_iter().filter(|item| !is_test(attributes(item))) {
            if let Item::Mod(child) = item {
                self.add_child(index, child, folder, sources);
                continue;
            }
            let module = &mut self.0[index];
            module.items.extend(name(&item));
            paths::collect(item.into_token_stream(), &mut module.paths, &mut module.imports);
        }
        index
    }

    fn add_child(&mut self, index: usize, child: ItemMod, folder: &str, sources: &Sources) {
        let name = child.ident.to_string();
        let inner = format!("{folder}{name}/");
        let files = [format!("{folder}{name}.rs"), format!("{inner}mod.rs")];
        let added = match child.content {
            Some((_, items)) => {
                let file = self.0[index].file.clone();
                self.add(&file, &inner, index, items, sources)
            }
            None => match files.iter().find(|file| sources.contains_key(*file)) {
                Some(file) if name != "tests" => self.add_file(file, &inner, index, sources),
                _ => return,
            },
        };
        self.0[index].children.insert(name, added);
    }

    /// The other files that define the item of a path, without those of modules that contain this one.
    fn defining(&self, index: usize, path: &[String], is_glob: bool) -> BTreeSet<&str> {
        let mut above = BTreeSet::from([&*self.0[index].file]);
        let mut module = index;
        while module != 0 {
            module = self.0[module].parent;
            above.insert(&self.0[module].file);
        }
        let meanings = self.resolve(index, path, &mut BTreeSet::new());
        let defined = meanings.into_iter().filter_map(|meaning| match meaning {
            Meaning::Module(module) => is_glob.then_some(module),
            Meaning::Item(module) => Some(module),
        });
        defined.map(|module| &*self.0[module].file).filter(|file| !above.contains(file)).collect()
    }

    /// The meanings of a path in a module: none if another crate defines it.
    fn resolve<'a>(
        &'a self,
        from: usize,
        path: &'a [String],
        seen: &mut BTreeSet<(usize, &'a str)>,
    ) -> BTreeSet<Meaning> {
        let mut found = BTreeSet::from([Meaning::Module(from)]);
        for (position, name) in path.iter().enumerate() {
            let of = |meaning| match (meaning, &**name) {
                (Meaning::Item(_), _) => BTreeSet::from([meaning]),
                (Meaning::Module(_), "crate") => BTreeSet::from([Meaning::Module(0)]),
                (Meaning::Module(_), "self") => BTreeSet::from([meaning]),
                (Meaning::Module(module), "super") => {
                    [Meaning::Module(self.0[module].parent)].into()
                }
                (Meaning::Module(module), _) => {
                    let mut found = self.lookup(module, name, seen);
                    // A macro may create an item without another definition.
                    if found.is_empty() && position > 0 && !self.imports(module, name) {
                        found.insert(Meaning::Item(module));
                    }
                    found
                }
            };
            // Only types and modules continue a path, and those have one namespace.
            let is_module = |meaning: &Meaning| matches!(meaning, Meaning::Module(_));
            if found.iter().any(is_module) {
                found.retain(is_module);
            }
            found = found.into_iter().flat_map(of).collect();
        }
        found
    }

    fn imports(&self, module: usize, name: &str) -> bool {
        self.0[module].imports.iter().any(|import| import.name.as_deref() == Some(name))
    }

    /// The meanings of a name in a module, in all namespaces.
    fn lookup<'a>(
        &'a self,
        index: usize,
        name: &'a str,
        seen: &mut BTreeSet<(usize, &'a str)>,
    ) -> BTreeSet<Meaning> {
        let module = &self.0[index];
        let mut found: BTreeSet<_> =
            module.children.get(name).map(|child| Meaning::Module(*child)).into_iter().collect();
        found.extend(module.items.contains(name).then_some(Meaning::Item(index)));
        if !seen.insert((index, name)) {
            return found;
        }
        for import in module.imports.iter().filter(|import| import.name.as_deref() == Some(name)) {
            found.extend(self.resolve(index, &import.path, seen));
        }
        if found.is_empty() {
            for import in module.imports.iter().filter(|import| import.is_glob()) {
                for meaning in self.resolve(index, &import.path, seen) {
                    if let Meaning::Module(module) = meaning {
                        found.extend(self.lookup(module, name, seen));
                    }
                }
            }
        }
        seen.remove(&(index, name));
        found
    }
}

/// The sets of two or more files that reach each other.
pub fn circles(arrows: &Arrows) -> BTreeSet<BTreeSet<&str>> {
    let mut next: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (from, to) in arrows.keys() {
        next.entry(from).or_default().insert(to);
    }
    let reached = |from: &'_ str| {
        let mut reached = BTreeSet::new();
        let mut open: Vec<&str> = next.get(from).into_iter().flatten().copied().collect();
        while let Some(file) = open.pop() {
            if reached.insert(file) {
                open.extend(next.get(file).into_iter().flatten());
            }
        }
        reached
    };
    let reached: BTreeMap<_, _> = next.keys().map(|&file| (file, reached(file))).collect();
    let circle = |(&file, below): (&&'_ str, &BTreeSet<_>)| {
        let is_back = |other: &&str| reached.get(other).is_some_and(|all| all.contains(file));
        below.iter().copied().filter(is_back).collect::<BTreeSet<_>>()
    };
    reached.iter().map(circle).filter(|circle| circle.len() > 1).collect()
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("cfg") => {
            let condition = list.tokens.to_string();
            condition == "test" || condition.starts_with("all (test")
        }
        _ => attribute.path().is_ident("test"),
    })
}

fn name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}

#[cfg(test)]
mod tests;
