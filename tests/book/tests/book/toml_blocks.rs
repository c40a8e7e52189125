//! Worlds, project files and manifests in the book.

use afp_book::Block;
use afp_sim::World;
use toml_edit::DocumentMut;

use crate::blocks;

#[test]
fn toml_files_are_valid() {
    for block in blocks("toml") {
        let read = match () {
            () if block.has("world") => {
                World::parse(&block.text).map(drop).map_err(|e| e.to_string())
            }
            () if block.has("project") => project(&block),
            () if block.has("cargo") => manifest(&block),
            () => Err("says neither 'world' nor 'project' nor 'cargo'".to_owned()),
        };
        assert_eq!(read, Ok(()), "{}", block.place());
    }
}

fn project(block: &Block) -> Result<(), String> {
    let (_, mistakes) = afp_project::read(&block.text);
    mistakes.first().map_or(Ok(()), |mistake| Err(mistake.to_string()))
}

/// A manifest names crates of this workspace, with existing features, or registry crates with a
/// version.
fn manifest(block: &Block) -> Result<(), String> {
    let document: DocumentMut = block.text.parse().map_err(|error| format!("{error}"))?;
    let tables = ["dependencies", "dev-dependencies"]
        .into_iter()
        .filter_map(|name| document.get(name)?.as_table());
    for (name, item) in tables.flat_map(|table| table.iter()) {
        if item.get("version").is_some() && !name.starts_with("afp") {
            continue;
        }
        let folder = format!("{}/../../crates/{name}/Cargo.toml", env!("CARGO_MANIFEST_DIR"));
        let theirs = std::fs::read_to_string(folder).map_err(|_| format!("no crate '{name}'"))?;
        let theirs: DocumentMut = theirs.parse().map_err(|error| format!("{error}"))?;
        let features = item.get("features").and_then(|features| features.as_array());
        for feature in features.into_iter().flatten().filter_map(|feature| feature.as_str()) {
            if theirs.get("features").and_then(|all| all.get(feature)).is_none() {
                return Err(format!("'{name}' has no feature '{feature}'"));
            }
        }
    }
    Ok(())
}
