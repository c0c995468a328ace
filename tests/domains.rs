//! The reference domains go in; each file must check without a word.

use std::fs;
use std::path::{Path, PathBuf};

use lang::render;
use lang::source::{SourceId, Sources};

use crate::costs::{self, Known};

#[test]
fn every_domain_and_problem_checks_without_a_word() {
    for name in domains::NAMES {
        let mut sources = Sources::default();
        let id = add(&mut sources, &domains::folder().join(name).join("domain.pddl"));
        let (domain, diagnostics) = lang::read_domain(&sources, id);
        assert_eq!(render::concise(&diagnostics, &sources), "");
        for (problem, known) in problems(name) {
            let id = add(&mut sources, &problem);
            let (_, diagnostics) = lang::read_problem(&sources, id, &domain);
            let said = render::concise(&diagnostics, &sources);
            // That a goal is out of reach is worth a warning where it is so.
            let expected = |line: &&str| known != Known::Unsolvable || !line.contains("W0701");
            assert_eq!(said.lines().filter(expected).collect::<Vec<_>>(), [""; 0]);
        }
    }
}

/// Reads a file into `sources`.
fn add(sources: &mut Sources, path: &Path) -> SourceId {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    sources.add(path.display().to_string(), text)
}

/// The problems of a domain, with what is known of each.
fn problems(name: &str) -> impl Iterator<Item = (PathBuf, Known)> {
    let folder = domains::folder().join(name);
    costs::read(name)
        .into_iter()
        .map(move |(problem, known)| (folder.join(problem).with_extension("pddl"), known))
}
