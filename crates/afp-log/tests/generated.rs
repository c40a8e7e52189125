//! The Rust code and the descriptors under `src/proto` agree with the `.proto` files.
//!
//! `AFP_BLESS=1 cargo test -p afp-log --test generated` rewrites them. This builds the crate, so
//! run it before you use a new item of a `.proto` file.

use std::fs;
use std::path::{Path, PathBuf};

use prost::Message;

fn package() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn check(kept: PathBuf, fresh: &[u8]) {
    if std::env::var_os("AFP_BLESS").is_some() {
        fs::write(kept, fresh).unwrap();
        return;
    }
    let old = fs::read(&kept).unwrap();
    assert!(old == fresh, "{} is stale; run with AFP_BLESS=1", kept.display());
}

#[test]
fn generated_files_are_fresh() {
    for name in ["afp", "foxglove"] {
        let file = format!("{name}.proto");
        let mut set = protox::compile([&file], [package().join("proto")]).unwrap();
        let out = tempfile::tempdir().unwrap();
        prost_build::Config::new().out_dir(out.path()).compile_fds(set.clone()).unwrap();
        for described in &mut set.file {
            described.source_code_info = None;
        }
        let kept = package().join("src/proto");
        check(kept.join(format!("{name}.fds")), &set.encode_to_vec());
        let rust = fs::read(out.path().join(format!("{name}.rs"))).unwrap();
        check(kept.join(format!("{name}.rs")), &rust);
    }
}
