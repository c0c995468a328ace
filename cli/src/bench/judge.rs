//! A task and a plan file of either program go in; what this project's validator says of the plan comes out.

use std::path::{Path, PathBuf};

use lang::validate::{self, Verdict};

use crate::input::Reader;

/// What the validator says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Judgement {
    /// Valid, at this cost.
    Valid(String),
    /// Not valid, for this reason.
    Invalid(String),
}

/// Judges the plan in a file.
pub(super) fn judge(domain: &Path, problem: &Path, plan: &Path) -> Judgement {
    let mut reader = Reader::default();
    let paths: [PathBuf; 2] = [domain.to_path_buf(), problem.to_path_buf()];
    let task = reader
        .task(&paths, "validate")
        .and_then(|(domain, problem)| Ok((domain, problem, reader.take(plan)?)));
    let (domain, problem, plan) = match task {
        Ok(ids) => ids,
        Err(complaint) => return Judgement::Invalid(complaint.message),
    };
    let (domain, mut found) = lang::read_domain(&reader.sources, domain);
    let (problem, more) = lang::read_problem(&reader.sources, problem, &domain);
    found.append(more);
    found.append(lang::refusals(domain.uses.iter().chain(&problem.uses)));
    let (listing, more) = lang::plan::read(&reader.sources, plan, &domain, &problem);
    found.append(more);
    if found.has_errors() {
        return Judgement::Invalid("the files do not check".to_string());
    }
    match validate::validate(&domain, &problem, &listing.plan) {
        Ok(Verdict::Valid(success)) => Judgement::Valid(success.cost.normalize().to_string()),
        Ok(verdict @ Verdict::Invalid(_)) => {
            let story = validate::story(&verdict, &domain, &problem, &listing.plan);
            Judgement::Invalid(story.lines().next().unwrap_or("the plan fails").to_string())
        }
        Err(_) => Judgement::Invalid("the axioms of the domain have no meaning".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Judgement, judge};
    use std::fs;
    use std::path::Path;

    #[test]
    fn a_plan_is_judged_whoever_made_it() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let plan = folder.path().join("plan");
        let domains = Path::new(env!("CARGO_MANIFEST_DIR")).join("../domains/hanoi");
        let (domain, problem) = (domains.join("domain.pddl"), domains.join("p01.pddl"));
        fs::write(&plan, "; nothing\n").expect("a file can be written");
        assert!(
            matches!(judge(&domain, &problem, &plan), Judgement::Invalid(reason) if reason.contains("goal"))
        );
        assert!(matches!(judge(&problem, &domain, &plan), Judgement::Invalid(_)));
        assert!(matches!(judge(&domain, &problem, Path::new("none")), Judgement::Invalid(_)));
    }
}
