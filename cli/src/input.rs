//! Paths of a domain and a problem go in; both as checked models come out, or what is wrong with them is said.

mod team;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use lang::diagnostic::{Diagnostic, Diagnostics, Severity, not_utf8, unsupported_feature};
use lang::execute::joint::Concurrency;
use lang::model::{Domain, Problem};
use lang::portability::{self, Tool};
use lang::source::{SourceId, Sources, Span};
use lang::{Kind, allow, lint, mend, render};
use planner::normalize::Unsupported;

use crate::args::{ConcurrencyName, OutputFormat};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// The files read so far, each once, so that the standard input can be named as any of them.
#[derive(Debug, Default)]
pub struct Reader {
    /// Their texts.
    pub sources: Sources,
    taken: Vec<(PathBuf, SourceId)>,
    /// For each text that is not UTF-8 throughout, the diagnostic that says so: what else is wrong with it follows from that.
    broken: Vec<Diagnostic>,
    /// Texts that stand for those of files, since they are to be written there.
    mended: BTreeMap<PathBuf, String>,
    /// The programs that are to read the files, too.
    tools: Vec<Tool>,
}

/// A task.
#[derive(Debug)]
pub struct Input {
    /// The files that it was read from.
    pub reader: Reader,
    /// The domain.
    pub domain: Domain,
    /// The problem.
    pub problem: Problem,
}

/// Why there is no task.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// A file is missing or wrong.
    Wrong,
    /// The files are well formed but ask for what is not read yet.
    Unsupported,
}

impl Refusal {
    /// How `plan` ends then.
    pub fn of_plan(self) -> Exit {
        match self {
            Self::Wrong => Exit::Input,
            Self::Unsupported => Exit::Unsupported,
        }
    }
}

impl Reader {
    /// A reader that warns of what `tools` refuse or misread.
    pub fn of(tools: &[Tool]) -> Self {
        Self { tools: tools.to_vec(), ..Self::default() }
    }

    /// Everything that is wrong with the files in `paths`: domains alone, problems with the domain that is among the files
    /// or else lies beside them.
    pub fn check(&mut self, paths: &[PathBuf]) -> Result<Diagnostics, Complaint> {
        let mut found = match self.team(paths)? {
            Some(team) => self.join(&team)?.2,
            None => self.each(paths)?,
        };
        for path in paths.iter().filter(|path| !team::is_list(path)) {
            let id = self.take(path)?;
            let wrong =
                |one: &Diagnostic| one.severity == Severity::Error && one.primary.span.source == id;
            // What a mistake makes of a file is no matter of who reads it.
            if !found.list.iter().any(wrong) {
                found.append(portability::check(&self.sources, id, &self.tools));
            }
        }
        allow::apply(&mut found, &self.sources);
        self.settle(&mut found);
        // File by file and line by line, whichever step found it.
        found.list.sort_by_key(|one| (one.primary.span.source, one.primary.span.start));
        Ok(found)
    }

    /// What is wrong with files of which each stands for itself.
    fn each(&mut self, paths: &[PathBuf]) -> Result<Diagnostics, Complaint> {
        let mut found = Diagnostics::default();
        let mut domains = Vec::new();
        for path in paths {
            if !matches!(self.kind(path)?, Some(Kind::Problem { .. })) {
                domains.push(self.checked(path, &mut found)?);
            }
        }
        for path in paths {
            let Some(Kind::Problem { domain: wanted, .. }) = self.kind(path)? else { continue };
            let id = self.take(path)?;
            let named = |(domain, _): &&(Domain, bool)| {
                wanted.as_ref().is_none_or(|wanted| domain.name.text.eq_ignore_ascii_case(wanted))
            };
            let beside = if domains.iter().any(|domain| named(&domain)) {
                None
            } else if domains.is_empty() {
                Some(self.find_domain(path)?)
            } else {
                // Where no other file has that name, the domain that was given is meant, and the name is the mistake.
                let usual = usual_domains(path);
                match domains_beside(path, &usual, wanted.as_deref()).as_slice() {
                    [only] => Some(only.clone()),
                    _ => None,
                }
            };
            if let Some(beside) = beside {
                // Its warnings are for whoever checks it; its errors explain errors of the problem.
                let mut more = Diagnostics::default();
                let domain = self.checked(&beside, &mut more)?;
                more.list.retain(|diagnostic| diagnostic.severity == Severity::Error);
                found.append(more);
                domains.push(domain);
            }
            let (domain, sound) =
                domains.iter().find(named).or(domains.last()).expect("one has just been added");
            let (problem, more) = lang::read_problem(&self.sources, id, domain);
            let sound = *sound && !more.has_errors();
            found.append(more);
            if sound {
                found.append(lint::problem(domain, &problem));
                found.append(lint::text(&self.sources, id, domain));
            }
            lint::tell_factors(&mut found, domain, &problem);
        }
        Ok(found)
    }

    /// Applies safe fixes to the files in `paths` until there are none left, and writes those that changed.
    ///
    /// The result is the reader of the mended texts, what is left, and how many fixes were applied. A round of fixes after which there
    /// are more errors than before is taken back.
    pub fn fix(paths: &[PathBuf], tools: &[Tool]) -> Result<(Self, Diagnostics, usize), Complaint> {
        let mut reader = Self::of(tools);
        let mut found = reader.check(paths)?;
        let mut fixed = 0;
        for _ in 0..ROUNDS {
            let mut mended = reader.mended.clone();
            let mut count = 0;
            for path in paths.iter().filter(|path| !files::is_stdin(path)) {
                let id = reader.take(path)?;
                if reader.broken.iter().any(|broken| broken.primary.span.source == id) {
                    continue;
                }
                let (text, applied) = mend::safely(&found, &reader.sources, id);
                if applied > 0 {
                    count += applied;
                    mended.insert(path.clone(), text);
                }
            }
            if count == 0 {
                break;
            }
            let mut next = Self { mended, ..Self::of(tools) };
            let left = next.check(paths)?;
            if errors(&left) > errors(&found) {
                break;
            }
            fixed += count;
            (reader, found) = (next, left);
        }
        for (path, text) in &reader.mended {
            files::write(path, text.as_bytes())?;
        }
        Ok((reader, found, fixed))
    }

    /// Puts the diagnostics of texts that are not UTF-8 in the place of all others about them.
    pub fn settle(&self, found: &mut Diagnostics) {
        for broken in &self.broken {
            let source = broken.primary.span.source;
            found.list.retain(|diagnostic| diagnostic.primary.span.source != source);
            found.list.push(broken.clone());
        }
    }

    /// Reads a domain and adds what is wrong with it; says whether it is without errors.
    fn checked(
        &mut self,
        path: &Path,
        found: &mut Diagnostics,
    ) -> Result<(Domain, bool), Complaint> {
        let id = self.take(path)?;
        let (domain, more) = lang::read_domain(&self.sources, id);
        let sound = !more.has_errors();
        found.append(more);
        if sound {
            found.append(lint::domain(&domain));
            found.append(lint::text(&self.sources, id, &domain));
        }
        Ok((domain, sound))
    }

    /// Reads a file, unless it has been read.
    pub fn take(&mut self, path: &Path) -> Result<SourceId, Complaint> {
        if let Some((_, id)) = self.taken.iter().find(|(taken, _)| taken == path) {
            return Ok(*id);
        }
        let text = match self.mended.get(path) {
            Some(text) => files::Text { text: text.clone(), bad: None },
            None => files::read(path)?,
        };
        let end = text.text.len() as u32;
        let id = self.sources.add(files::name(path), text.text);
        if let Some(bad) = text.bad {
            self.broken.push(not_utf8::not_utf8(bad, Span::new(id, end, end)));
        }
        self.taken.push((path.to_path_buf(), id));
        Ok(id)
    }

    /// Whether the text of a file has been read, under this name or another.
    pub fn has_read(&self, path: &Path) -> bool {
        let Ok(path) = path.canonicalize() else { return false };
        self.taken.iter().any(|(taken, _)| taken.canonicalize().is_ok_and(|taken| taken == path))
    }

    /// What a file defines, if anything.
    pub fn kind(&mut self, path: &Path) -> Result<Option<Kind>, Complaint> {
        let id = self.take(path)?;
        Ok(lang::detect(&self.sources, id))
    }

    /// The models of the task that the paths of a command line name, with what is wrong with them.
    fn models(
        &mut self,
        paths: &[PathBuf],
        verb: &str,
    ) -> Result<(Domain, Problem, Diagnostics), Complaint> {
        let files = self.expand(paths)?;
        if let Some(team) = self.team(&files)? {
            return self.join(&team);
        }
        let (domain, problem) = self.task(&files, verb)?;
        let (domain, mut found) = lang::read_domain(&self.sources, domain);
        let (problem, more) = lang::read_problem(&self.sources, problem, &domain);
        found.append(more);
        Ok((domain, problem, found))
    }

    /// The domain and the problem among the paths of a command line; a domain that is left out is looked for.
    pub fn task(
        &mut self,
        paths: &[PathBuf],
        verb: &str,
    ) -> Result<(SourceId, SourceId), Complaint> {
        match paths {
            [problem] => {
                if let Some(Kind::Domain { .. }) = self.kind(problem)? {
                    return Err(Complaint::with_help(
                        format!("`{}` is a domain, and there is no problem", files::name(problem)),
                        format!(
                            "name the problem as well: caveat {verb} {} PROBLEM",
                            listed(paths)
                        ),
                    ));
                }
                let domain = self.find_domain(problem)?;
                Ok((self.take(&domain)?, self.take(problem)?))
            }
            [domain, problem] => {
                let kinds = (self.kind(domain)?, self.kind(problem)?);
                let message = match kinds {
                    (Some(Kind::Problem { .. }), Some(Kind::Domain { .. })) => {
                        "the domain comes first, then the problem"
                    }
                    (Some(Kind::Domain { .. }), Some(Kind::Domain { .. })) => {
                        "both files are domains"
                    }
                    (Some(Kind::Problem { .. }), Some(Kind::Problem { .. })) => {
                        "both files are problems"
                    }
                    _ => return Ok((self.take(domain)?, self.take(problem)?)),
                };
                let help = match kinds {
                    (Some(Kind::Problem { .. }), Some(Kind::Domain { .. })) => {
                        format!("caveat {verb} {}", listed(&[problem.clone(), domain.clone()]))
                    }
                    (Some(Kind::Domain { .. }), _) => {
                        format!("caveat {verb} {} PROBLEM", listed(&paths[..1]))
                    }
                    _ => format!("caveat {verb} DOMAIN {}", listed(&paths[1..])),
                };
                Err(Complaint::with_help(message, help))
            }
            several => Err(Complaint::with_help(
                format!("these are {} files, and a task is a domain and a problem", several.len()),
                format!(
                    "caveat {verb} DOMAIN PROBLEM, or the files of all agents of a task in the factored form"
                ),
            )),
        }
    }

    /// The domain of the problem in `path`, which lies beside it.
    pub fn find_domain(&mut self, path: &Path) -> Result<PathBuf, Complaint> {
        if files::is_stdin(path) {
            return Err(Complaint::with_help(
                "the domain of a problem on the standard input cannot be found beside it",
                "name the domain as well: DOMAIN -",
            ));
        }
        let wanted = match self.kind(path)? {
            Some(Kind::Problem { domain, .. }) => domain,
            _ => None,
        };
        let usual = usual_domains(path);
        let name = files::name(path);
        let beside = domains_beside(path, &usual, wanted.as_deref());
        let wanted = wanted
            .map_or_else(|| "a domain".to_string(), |wanted| format!("the domain `{wanted}`"));
        match beside.as_slice() {
            [only] => Ok(only.clone()),
            // That it defines another domain is said when the problem is read.
            [] => usual.into_iter().next().ok_or_else(|| {
                Complaint::with_help(
                    format!("no file beside `{name}` defines {wanted}"),
                    format!("name the domain before the problem: DOMAIN {name}"),
                )
            }),
            several => Err(Complaint::with_help(
                format!("several files beside `{name}` define {wanted}: {}", listed(several)),
                format!(
                    "name one of them before the problem, such as: {} {name}",
                    several[0].display()
                ),
            )),
        }
    }
}

/// The files beside a problem that are called as its domain usually is, the most usual first.
fn usual_domains(path: &Path) -> Vec<PathBuf> {
    usual_names(path).into_iter().filter(|file| file != path && file.is_file()).collect()
}

/// What a domain beside a problem is usually called, the most usual first.
pub fn usual_names(path: &Path) -> Vec<PathBuf> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let short = stem.split('-').next().unwrap_or(&stem);
    let names = [
        "domain.pddl".to_string(),
        "domain.hddl".to_string(),
        format!("{stem}-domain.pddl"),
        format!("domain_{stem}.pddl"),
        format!("domain-{stem}.pddl"),
        format!("{short}-domain.pddl"),
    ];
    names.into_iter().map(|name| path.with_file_name(name)).collect()
}

/// The files beside `path` that define the domain `wanted`, or any domain: the first of the `usual` ones that does, or else all others.
fn domains_beside(path: &Path, usual: &[PathBuf], wanted: Option<&str>) -> Vec<PathBuf> {
    let defines = |file: &Path| {
        let mut sources = Sources::default();
        let id = sources.add(files::name(file), fs::read_to_string(file).unwrap_or_default());
        is_domain(lang::detect(&sources, id).as_ref(), wanted)
    };
    choose(usual, || files::beside(path), defines)
}

/// Whether a file defines the domain `wanted`, or any domain.
pub fn is_domain(kind: Option<&Kind>, wanted: Option<&str>) -> bool {
    match (kind, wanted) {
        (Some(Kind::Domain { name }), Some(wanted)) => name.eq_ignore_ascii_case(wanted),
        (Some(Kind::Domain { .. }), None) => true,
        _ => false,
    }
}

/// The first of the `usual` files that defines what is wanted, or else all others that do.
pub fn choose(
    usual: &[PathBuf],
    others: impl FnOnce() -> Vec<PathBuf>,
    mut defines: impl FnMut(&Path) -> bool,
) -> Vec<PathBuf> {
    if let Some(found) = usual.iter().find(|file| defines(file)) {
        return vec![found.clone()];
    }
    others().into_iter().filter(|file| defines(file)).collect()
}

impl Input {
    /// Shows one diagnostic.
    pub fn report(&self, diagnostic: Diagnostic, format: OutputFormat, terminal: &mut Terminal) {
        let mut list = Diagnostics::default();
        list.push(diagnostic);
        terminal.talk(rendered(&self.reader.sources, &list, format, terminal.colour));
    }
}

/// Reads the task that `paths` name. What is wrong is said: errors only, since warnings are for `check`.
pub fn load(
    mut reader: Reader,
    verb: &str,
    paths: &[PathBuf],
    format: OutputFormat,
    terminal: &mut Terminal,
) -> Result<Input, Refusal> {
    let (domain, problem, mut found) = match reader.models(paths, verb) {
        Ok(models) => models,
        Err(complaint) => {
            terminal.say(complaint);
            return Err(Refusal::Wrong);
        }
    };
    reader.settle(&mut found);
    found.list.retain(|diagnostic| diagnostic.severity == Severity::Error);
    if !found.list.is_empty() {
        terminal.talk(rendered(&reader.sources, &found, format, terminal.colour));
        return Err(Refusal::Wrong);
    }
    let refusals = lang::refusals(domain.uses.iter().chain(&problem.uses));
    if !refusals.list.is_empty() {
        terminal.talk(rendered(&reader.sources, &refusals, format, terminal.colour));
        return Err(Refusal::Unsupported);
    }
    if let Some(note) = team::one_of_several(&domain) {
        terminal.say(note);
    }
    Ok(Input { reader, domain, problem })
}

/// What the command line asks for, or else what the domain means.
pub fn concurrency(asked: Option<ConcurrencyName>, input: &Input) -> Concurrency {
    match asked {
        Some(ConcurrencyName::Liberal) => Concurrency::Liberal,
        Some(ConcurrencyName::Safe) => Concurrency::Safe,
        None => Concurrency::of(&input.domain),
    }
}

/// How often fixes are applied at most, since one may uncover another.
const ROUNDS: usize = 8;

fn errors(found: &Diagnostics) -> usize {
    found.list.iter().filter(|one| one.severity == Severity::Error).count()
}

/// What the planner does not plan, as a diagnostic.
pub fn unsupported(unsupported: &Unsupported) -> Diagnostic {
    unsupported_feature::RULE.at(
        unsupported.span,
        unsupported.message.clone(),
        "this cannot be planned",
    )
}

/// Diagnostics as text.
pub fn rendered(
    sources: &Sources,
    found: &Diagnostics,
    format: OutputFormat,
    colour: bool,
) -> String {
    match format {
        OutputFormat::Full => render::full(found, sources, colour),
        OutputFormat::Concise => render::concise(found, sources),
        OutputFormat::Json => render::json(found, sources),
        OutputFormat::Sarif => render::sarif(found, sources),
        OutputFormat::Github => render::github(found, sources),
    }
}

/// Paths as they stand on a command line.
pub fn listed(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(" ")
}
