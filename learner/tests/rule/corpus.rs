//! What is learned from the traces of the corpus, beside the true domains.

use std::fs;
use std::path::{Path, PathBuf};

use lang::model::Domain;
use learner::rule::schema::Schema;
use learner::rule::{self, Learned, Options};
use learner::write;

use super::words::{domain, trace, warnings};

/// The true domain of a folder of the corpus and what is learned from its traces; none if the corpus is not there.
fn learn(name: &str, options: &Options) -> Option<(Domain, Learned)> {
    let root = match std::env::var_os("CAVEAT_SHARED") {
        Some(root) => PathBuf::from(root),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared"),
    };
    let folder = root.join("corpus/traces").join(name);
    let Ok(text) = fs::read_to_string(folder.join("domain.pddl")) else {
        eprintln!("SKIPPED: no traces at {}; set CAVEAT_SHARED", folder.display());
        return None;
    };
    let domain = domain(&text);
    let within = folder.join("trajectories");
    let entries = within.read_dir().or_else(|_| folder.read_dir()).expect("the folder can be read");
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| {
        let name = file.to_string_lossy();
        name.ends_with("_traj") || name.ends_with(".trajectory")
    });
    files.sort();
    let traces: Vec<_> = files
        .iter()
        .map(|file| {
            let text = fs::read_to_string(file).expect("traces are text");
            trace(&file.file_name().expect("it has one").to_string_lossy(), &domain, &text)
        })
        .collect();
    let learned = rule::learn(&domain, &traces, options);
    Some((domain, learned))
}

#[test]
fn every_action_of_amlgym_is_learned_and_demands_what_the_true_one_demands() {
    let names = [
        "barman",
        "blocksworld",
        "elevators",
        "ferry",
        "npuzzle",
        "rovers",
        "satellite",
        "transport",
    ];
    for name in names {
        let Some((domain, learned)) = learn(&format!("amlgym/{name}"), &Options::default()) else {
            return;
        };
        assert_eq!(learned.refused, [], "{name}");
        for action in &learned.actions {
            let truth = Schema::of(&domain.actions[action.action.index()]).expect("it is plain");
            let all = |of: &[_], within: &[_]| of.iter().all(|atom| within.contains(atom));
            assert!(all(&truth.required, &action.required), "{name}");
            assert!(all(&action.adds, &truth.adds), "{name}");
            assert!(all(&action.deletes, &truth.deletes), "{name}");
            assert!(all(&action.changed, &truth.deletes), "{name}");
        }
        assert_eq!(warnings(&write::text(&learned)), [""; 0], "{name}");
    }
}

#[test]
fn of_ma_sam_as_many_actions_are_safe_as_were_ever_seen() {
    for (name, safe) in [("blocks", 6), ("logistics", 8), ("overcooked", 9)] {
        let Some((_, learned)) = learn(&format!("ma-sam/{name}"), &Options::default()) else {
            return;
        };
        assert_eq!(learned.actions.len(), safe, "{name}");
        assert_eq!(warnings(&write::text(&learned)), [""; 0], "{name}");
    }
}
