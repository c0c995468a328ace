//! Paths go in: folders, lists of agents, files. The files of each agent come out, one domain and one problem for each.
//!
//! A domain and a problem belong to one agent if their names are the same but for the words: `domain-truck1.pddl`
//! and `problem-truck1.pddl`, or `domain.pddl` and `problem.pddl` in a folder called `truck1`.

use std::fs;
use std::path::{Path, PathBuf};

use lang::Kind;
use lang::diagnostic::Diagnostics;
use lang::factored::{self, Part};
use lang::lint;
use lang::model::{Domain, Problem, Requirement};
use lang::source::Span;

use super::{Reader, listed};
use crate::files::{self, Complaint};

/// The files of all agents.
#[derive(Debug)]
pub struct Team {
    pairs: Vec<Pair>,
    /// The list of the agents.
    list: Option<PathBuf>,
}

/// The files of one agent.
#[derive(Debug)]
struct Pair {
    key: String,
    domain: PathBuf,
    problem: PathBuf,
}

/// Whether a path is called as lists of agents are.
pub fn is_list(path: &Path) -> bool {
    path.extension().is_some_and(|end| end.eq_ignore_ascii_case("addl"))
}

/// What is left of the name of a file without the words that say what it defines, in lower case.
fn key(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let bare = stem.replacen("domain", "", 1).replacen("problem", "", 1);
    let key = bare.trim_matches(['-', '_', '.']);
    if !key.is_empty() {
        return key.to_owned();
    }
    let folder = path.parent().and_then(Path::file_name).unwrap_or_default();
    folder.to_string_lossy().to_ascii_lowercase()
}

/// What an agent may be called of which a file has this key: `pfile1-truck1` is of `pfile1-truck1` or of `truck1`.
fn suggested(key: &str) -> Vec<&str> {
    let parts = key.match_indices(['-', '_']).map(|(at, _)| &key[at + 1..]);
    std::iter::once(key).chain(parts).collect()
}

impl Reader {
    /// How many of the paths of a command line, from the first, name the task; the rest are plans.
    pub fn leading(&mut self, paths: &[PathBuf]) -> Result<usize, Complaint> {
        let mut several = false;
        let (mut domains, mut count) = (0, 0);
        for path in paths {
            if path.is_dir() || is_list(path) {
                several = true;
            } else {
                match self.kind(path) {
                    Ok(Some(Kind::Domain { .. })) => domains += 1,
                    Ok(Some(Kind::Problem { .. })) => {}
                    Err(complaint) if count == 0 => return Err(complaint),
                    // The first file is no plan, whatever it is.
                    _ if count == 0 => {}
                    _ => break,
                }
            }
            count += 1;
        }
        let pair =
            if matches!(self.kind_of_file(&paths[0]), Some(Kind::Domain { .. })) { 2 } else { 1 };
        Ok(if several || domains > 1 { count } else { pair.min(paths.len()) })
    }

    fn kind_of_file(&mut self, path: &Path) -> Option<Kind> {
        if path.is_dir() { None } else { self.kind(path).ok().flatten() }
    }

    /// The files that paths stand for: of a folder and of a list, those of all agents, and the list.
    ///
    /// A folder without files of agents stands for all files of PDDL in it.
    pub fn expand(&mut self, paths: &[PathBuf]) -> Result<Vec<PathBuf>, Complaint> {
        let mut all: Vec<PathBuf> = Vec::new();
        for path in paths {
            if path.is_dir() {
                all.extend(self.folder(path)?);
            } else if is_list(path) && paths.len() == 1 {
                all.extend(self.listed(path)?);
            } else {
                all.push(path.clone());
            }
        }
        Ok(all)
    }

    fn folder(&mut self, folder: &Path) -> Result<Vec<PathBuf>, Complaint> {
        // The name of any file in it will do.
        let inside = folder.join("domain.pddl");
        let (mut all, mut lists): (Vec<PathBuf>, Vec<PathBuf>) =
            (files::beside(&inside), Vec::new());
        all.extend(inside.is_file().then_some(inside));
        all.sort();
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            lists.extend(Some(folder.join(entry.file_name())).filter(|path| is_list(path)));
        }
        if all.is_empty() {
            let message =
                format!("there are no files of PDDL in the folder `{}`", folder.display());
            return Err(Complaint::new(message));
        }
        let mut keys = Vec::new();
        for path in &all {
            if self.is_factored(path)? {
                keys.push(key(path));
            }
        }
        if keys.len() > 1 {
            all.retain(|path| keys.contains(&key(path)));
        }
        // One list is that of these agents; of several only the command line can choose.
        if let ([list], true) = (lists.as_slice(), keys.len() > 1) {
            all.push(list.clone());
        }
        Ok(all)
    }

    /// The files of the agents in a list, which lie beside it, and the list.
    fn listed(&mut self, path: &Path) -> Result<Vec<PathBuf>, Complaint> {
        let id = self.take(path)?;
        let (list, _) = factored::read_list(&self.sources, id);
        let agents: Vec<String> =
            list.agents.iter().map(|agent| agent.text.to_ascii_lowercase()).collect();
        let mut all = files::beside(path);
        all.retain(|file| {
            suggested(&key(file)).iter().any(|name| agents.iter().any(|agent| agent == name))
        });
        if all.is_empty() {
            return Err(Complaint::with_help(
                format!("no files beside `{}` are those of its agents", files::name(path)),
                "they are called domain-AGENT.pddl and problem-AGENT.pddl",
            ));
        }
        all.push(path.to_path_buf());
        Ok(all)
    }

    /// Whether a file is the domain of one agent.
    fn is_factored(&mut self, path: &Path) -> Result<bool, Complaint> {
        if !matches!(self.kind(path)?, Some(Kind::Domain { .. })) {
            return Ok(false);
        }
        let id = self.take(path)?;
        let (domain, _) = lang::read_domain(&self.sources, id);
        Ok(domain.requirements.contains(&Requirement::FactoredPrivacy))
    }

    /// The files of agents among `paths`, if it is these that they name.
    pub fn team(&mut self, paths: &[PathBuf]) -> Result<Option<Team>, Complaint> {
        let (mut domains, mut problems) = (Vec::new(), Vec::new());
        let mut list = None;
        for path in paths {
            if is_list(path) {
                if let Some(first) = list.replace(path.clone()) {
                    let both = listed(&[first, path.clone()]);
                    return Err(Complaint::new(format!("there are two lists of agents: {both}")));
                }
                continue;
            }
            match self.kind(path)? {
                Some(Kind::Problem { .. }) => problems.push(path.clone()),
                _ => domains.push(path.clone()),
            }
        }
        let mut factored = list.is_some();
        for domain in domains.iter().filter(|_| domains.len() > 1) {
            factored |= self.is_factored(domain)?;
        }
        if !factored {
            return Ok(None);
        }
        let mut pairs = Vec::new();
        for domain in domains {
            let key = key(&domain);
            let own: Vec<PathBuf> =
                problems.extract_if(.., |problem| self::key(problem) == key).collect();
            match own.as_slice() {
                [] => return Err(alone(&domain, &key, "problem")),
                [problem] => {
                    let problem = problem.clone();
                    pairs.push(Pair { key, domain, problem });
                }
                several => {
                    let message =
                        format!("agent `{key}` has several problems: {}", listed(several));
                    return Err(Complaint::with_help(message, "name one problem for each agent"));
                }
            }
        }
        match problems.first() {
            Some(problem) => Err(alone(problem, &key(problem), "domain")),
            None => Ok(Some(Team { pairs, list })),
        }
    }

    /// Reads the files of all agents. Where one of them is wrong, or they disagree, the models are only a part of the task.
    pub fn join(&mut self, team: &Team) -> Result<(Domain, Problem, Diagnostics), Complaint> {
        let mut found = Diagnostics::default();
        let mut parts = Vec::new();
        for Pair { key, domain, problem } in &team.pairs {
            let ids = [self.take(domain)?, self.take(problem)?];
            let (domain, mut more) = lang::read_domain(&self.sources, ids[0]);
            let (model, also) = lang::read_problem(&self.sources, ids[1], &domain);
            more.append(also);
            let sound = !more.has_errors();
            found.append(more);
            if sound {
                for id in ids {
                    found.append(lint::text(&self.sources, id, &domain));
                }
                let agent = factored::agent(&domain, &model, &suggested(key)).map(str::to_owned);
                let agent = agent.ok_or_else(|| nobody(problem))?;
                parts.push(Part { agent, domain, problem: model });
            }
        }
        let (domain, problem, more) = factored::merge(&parts);
        if !found.has_errors() {
            let sound = !more.has_errors();
            found.append(more);
            if sound {
                // What one agent does not use, another may.
                found.append(lint::domain(&domain));
                found.append(lint::problem(&domain, &problem));
            }
            if let Some(list) = &team.list {
                let id = self.take(list)?;
                let whole = Span::new(id, 0, self.sources.get(id).text.trim_end().len() as u32);
                let (list, more) = factored::read_list(&self.sources, id);
                found.append(more);
                found.append(factored::check_list(&list, &parts, whole));
            }
        }
        Ok((domain, problem, found))
    }
}

impl Team {
    /// All files, in the order in which they are read.
    pub fn files(&self) -> Vec<PathBuf> {
        let pairs = self.pairs.iter().flat_map(|pair| [pair.domain.clone(), pair.problem.clone()]);
        pairs.chain(self.list.clone()).collect()
    }
}

/// A file without the other one of its agent.
fn alone(file: &Path, key: &str, missing: &str) -> Complaint {
    let other = file.with_file_name(format!("{missing}-{key}.pddl"));
    let help = if other.is_file() {
        format!("name it as well: {}", other.display())
    } else {
        "the files of an agent are called domain-AGENT.pddl and problem-AGENT.pddl".to_owned()
    };
    Complaint::with_help(
        format!("there is no {missing} that goes with `{}`", files::name(file)),
        help,
    )
}

/// The files of an agent of which nobody knows the name.
fn nobody(problem: &Path) -> Complaint {
    Complaint::with_help(
        format!("whose files `{}` and its domain are cannot be told", files::name(problem)),
        "call them domain-AGENT.pddl and problem-AGENT.pddl, after an object of the problem",
    )
}

/// What is to be said where the files of one agent are all that is there.
pub fn one_of_several(domain: &Domain) -> Option<&'static str> {
    let factored = domain.requirements.contains(&Requirement::FactoredPrivacy);
    factored.then_some(
        "note: this is the task as one agent sees it (`:factored-privacy`); name the files of all agents, or their folder, for the task of all",
    )
}
