//! The kept texts of the fuzzer go in; every promise that one of them breaks comes out.

use std::collections::BTreeSet;
use std::fs;
use std::panic;
use std::path::{Path, PathBuf};

#[path = "fuzz/promises.rs"]
mod promises;

/// The kept texts together stay smaller than this, in bytes.
const LARGEST: u64 = 200_000;

/// The files and folders in a folder of `tests/fuzz`, in order.
fn entries(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(folder);
    let entries = fs::read_dir(folder).expect("the folder can be listed");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("it is listed").path()).collect();
    paths.sort();
    paths
}

/// The names of files and folders without their ending.
fn stems(paths: &[PathBuf]) -> BTreeSet<String> {
    let stem = |path: &PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    paths.iter().filter_map(stem).collect()
}

#[test]
fn every_target_has_its_fuzzer_and_kept_texts() {
    let names: BTreeSet<String> =
        promises::TARGETS.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(stems(&entries("corpus")), names);
    assert_eq!(stems(&entries("targets")), names);
    let manifest =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/Cargo.toml"))
            .expect("the fuzzers have a manifest");
    for name in names {
        assert!(manifest.contains(&format!("path = \"targets/{name}.rs\"")), "{name} is built");
        let texts = entries(&format!("corpus/{name}")).len();
        assert!(texts >= 5, "{name} has only {texts} texts");
    }
}

#[test]
fn kept_texts_keep_every_promise() {
    let folders = entries("corpus");
    let files: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| entries(folder.to_str().expect("names are ours")))
        .collect();
    let mut size = 0;
    let mut wrong = Vec::new();
    for file in &files {
        let bytes = fs::read(file).expect("a kept text can be read");
        size += bytes.len() as u64;
        // Whatever the text was found with, the other promises hold for it too.
        for (target, _) in promises::TARGETS {
            if panic::catch_unwind(|| promises::keep(target, &bytes)).is_err() {
                wrong.push(format!("{target}: {}", file.display()));
            }
        }
    }
    assert!(size < LARGEST, "the kept texts have {size} bytes");
    assert_eq!(wrong, [""; 0], "what each of them panicked with stands above");
}
