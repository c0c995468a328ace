//! Other people's tasks with the known length of the shortest joint plan go in; every difference from what brute force finds comes out.

use std::fs;
use std::path::PathBuf;

use crate::brute::{self, Least, Measure};
use crate::ground;

/// The folder beside the repository, or the one that the environment names.
fn folder() -> PathBuf {
    let beside = || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared"));
    let shared = std::env::var_os("CAVEAT_SHARED").map_or_else(beside, PathBuf::from);
    shared.join("corpus/mapddl")
}

#[test]
fn brute_force_finds_the_known_lengths() {
    let folder = folder();
    let Ok(expected) = fs::read_to_string(folder.join("expected.json")) else {
        eprintln!("SKIPPED: {} holds no tasks to compare with", folder.display());
        return;
    };
    let expected: serde_json::Value = serde_json::from_str(&expected).expect("it is JSON");
    let tasks = expected["expected"].as_object().expect("tasks by problem");
    assert!(tasks.len() >= 6, "only {} tasks", tasks.len());
    let read = |path: &str| {
        let path = folder.join(path);
        fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    let mut wrong = Vec::new();
    for (problem, known) in tasks {
        let domain = known["domain"].as_str().expect("a path");
        let world = ground::world(&read(domain), &read(problem));
        let known = match known["opt_joint_steps"].as_i64().expect("a number") {
            -1 => Least::Unsolvable,
            steps => Least::Is(steps),
        };
        let found = brute::least(&world, Measure::Steps, 1_000_000);
        if found != known {
            wrong.push(format!("{problem}: {found:?}, not {known:?}"));
        }
    }
    assert_eq!(wrong, [""; 0]);
}
