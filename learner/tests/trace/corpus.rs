//! The traces of the corpus are read without a fault and written so that they read the same.

use std::fs;
use std::path::{Path, PathBuf};

use learner::trace::{self, Reading};

use super::words::domain;

/// The folders of a corpus of traces, if it is there.
fn folders(name: &str) -> Vec<PathBuf> {
    let root = match std::env::var_os("CAVEAT_SHARED") {
        Some(root) => PathBuf::from(root),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    let root = root.join("corpus/traces").join(name);
    let Ok(entries) = root.read_dir() else {
        eprintln!("SKIPPED: no traces at {}; set CAVEAT_SHARED", root.display());
        return Vec::new();
    };
    let mut folders: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    folders.sort();
    folders
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = folder.read_dir().expect("the folder can be read");
    entries.map(|entry| entry.expect("the folder can be read").path()).collect()
}

#[test]
fn traces_of_amlgym() {
    for folder in folders("amlgym") {
        let text = fs::read_to_string(folder.join("domain.pddl")).expect("there is a domain");
        let domain = domain(&text);
        for file in files(&folder.join("trajectories")) {
            let text = fs::read_to_string(&file).expect("traces are text");
            let (trace, faults) = trace::read(&text, &domain, &Reading::default());
            assert_eq!(faults, [], "{}", file.display());
            assert_eq!(trace.states.len(), trace.steps.len() + 1);
            let words = |text: &str| text.replace(['(', ')'], " ").split_whitespace().count();
            let printed = trace::print(&trace, &domain);
            assert_eq!(words(&printed), words(&text), "{}", file.display());
            let (again, faults) = trace::read(&printed, &domain, &Reading::default());
            assert_eq!(faults, []);
            assert_eq!(again.states.len(), trace.states.len());
        }
    }
}

#[test]
fn traces_of_ma_sam() {
    let agents = [("blocks", 4), ("logistics", 7), ("overcooked", 2)];
    for folder in folders("ma-sam") {
        let name = folder.file_name().expect("it has a name").to_string_lossy().into_owned();
        let text = fs::read_to_string(folder.join("domain.pddl")).expect("there is a domain");
        let domain = domain(&text);
        let traces = files(&folder);
        for file in
            traces.iter().filter(|file| file.extension().is_some_and(|end| end == "trajectory"))
        {
            let text = fs::read_to_string(file).expect("traces are text");
            let (trace, faults) = trace::read(&text, &domain, &Reading::default());
            assert_eq!(faults, [], "{}", file.display());
            let slots = agents.iter().find(|(of, _)| *of == name).expect("it is known").1;
            assert!(trace.steps.iter().all(|joint| joint.parts.len() == slots));
            let printed = trace::print_joint(&trace, &domain);
            let (again, faults) = trace::read(&printed, &domain, &Reading::default());
            assert_eq!(faults, []);
            assert_eq!(trace::print_joint(&again, &domain).len(), printed.len());
        }
    }
}
