//! Which tasks are measured: the full lists beside the benchmark files, the fixed subset, or a list of one's own.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

use crate::args::{self, List};

/// The fixed subset: list, domain and problem with tabs between.
const SUBSET: &str = include_str!("../../../tests/bench-40.txt");

/// One task: two paths relative to the folder of the benchmark files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Task {
    /// The domain file.
    pub domain: String,
    /// The problem file.
    pub problem: String,
}

/// The folder that holds `benchmarks`: `CAVEAT_SHARED`, else `../shared` from here or from a folder above.
pub(super) fn shared() -> io::Result<PathBuf> {
    let here = env::current_dir()?;
    let candidates: Vec<PathBuf> = match env::var_os("CAVEAT_SHARED") {
        Some(folder) => vec![PathBuf::from(folder)],
        None => here.ancestors().skip(1).map(|above| above.join("shared")).collect(),
    };
    candidates.into_iter().find(|folder| folder.join("benchmarks/ipc").is_dir()).ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::NotFound,
            "there is no folder of benchmarks; name the one that holds `benchmarks/ipc` in CAVEAT_SHARED",
        )
    })
}

/// The tasks that the command line asks for.
pub(super) fn chosen(arguments: &args::Bench, shared: &Path) -> io::Result<Vec<Task>> {
    if arguments.subset {
        return Ok(subset(arguments.list));
    }
    let name = match arguments.list {
        List::Opt => "opt.txt",
        List::Sat => "sat.txt",
        List::Ground => "ground.txt",
    };
    let file = arguments.tasks.clone().unwrap_or_else(|| shared.join("benchmarks").join(name));
    let text = fs::read_to_string(&file)
        .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", file.display())))?;
    Ok(text.lines().filter_map(pair).collect())
}

/// The fixed tasks of one list; grounding has no search to differ in and takes them all.
fn subset(list: List) -> Vec<Task> {
    let wanted = match list {
        List::Opt => Some("opt"),
        List::Sat => Some("sat"),
        List::Ground => None,
    };
    let lines = SUBSET.lines().filter(|line| !line.starts_with('#'));
    lines
        .filter_map(|line| line.split_once('\t'))
        .filter(|(name, _)| wanted.is_none_or(|wanted| wanted == *name))
        .filter_map(|(_, task)| pair(task))
        .collect()
}

/// A line of a list.
fn pair(line: &str) -> Option<Task> {
    let (domain, problem) = line.split_once('\t')?;
    Some(Task { domain: domain.to_string(), problem: problem.trim_end().to_string() })
}

#[cfg(test)]
mod tests {
    use super::{List, subset};

    #[test]
    fn the_subset_has_twenty_tasks_of_each_kind() {
        assert_eq!(subset(List::Opt).len(), 20);
        assert_eq!(subset(List::Sat).len(), 20);
        assert_eq!(subset(List::Ground).len(), 40);
    }
}
