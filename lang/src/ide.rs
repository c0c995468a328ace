//! The texts of a folder go in as a [`Workspace`]; what an editor asks about them comes out as plain data.
//!
//! Places are byte offsets and [`Span`]s; the protocol of the editor is not known here.
//! Every text is analysed when something is asked about it, and once until it or what it depends on changes.
//! What one analysis finds is kept in owned data: the tree is cheap and made again for what needs it.

mod words;
mod outline;
mod comment;
mod reference;
mod rename;
mod hover;
mod layout;
mod glossary;
mod context;
mod complete;
mod signature;
mod symbols;
mod paint;
mod fold;
mod hint;
mod lens;
mod calls;
mod lineage;
mod assist;
mod plan;
#[cfg(test)]
mod fixture;

use std::cell::OnceCell;

use crate::allow;
use crate::diagnostic::Diagnostics;
use crate::lint;
use crate::model::{Domain, Problem};
use crate::reader::{Kind, detect, index_domain, index_problem};
use crate::source::{SourceId, Sources, Span};
use crate::symbol::{Namespace, Occurrence, Occurrences, Role, Symbol};
use crate::tree::{self, NodeId, NodeKind, Tree};

pub use assist::{Remedy, fix_all, remedies};
pub use calls::{Call, Caller, caller, incoming, outgoing};
pub use complete::{Completion, Completions, Item, complete};
pub use fold::{Fold, FoldKind, folds, selections};
pub use hint::{Hint, hints};
pub use hover::hover;
pub use layout::{Edit, difference, format};
pub use lens::{Lens, lenses};
pub use lineage::{above, below, type_at, typed_as};
pub use paint::{Paint, Painted, paint};
pub use reference::{achievers, definition, highlights, references};
pub use rename::{Refusal, prepare_rename, rename};
pub use signature::{Signature, signature};
pub use symbols::{Entry, Found, outline, search};

/// The texts of a folder and what they have to do with one another.
#[derive(Debug)]
pub struct Workspace {
    sources: Sources,
    /// One for each source.
    files: Vec<File>,
}

/// What is known of one text.
#[derive(Debug, Default)]
struct File {
    /// What it defines, as far as its beginning says so; nothing for a plan.
    kind: Option<Kind>,
    /// Whether it is a plan.
    plan: bool,
    /// The domain of a problem, the problem of a plan.
    partner: Option<SourceId>,
    analysis: OnceCell<Analysis>,
}

/// What one text means.
#[derive(Debug, Default)]
pub struct Analysis {
    /// The model of a domain.
    pub domain: Option<Domain>,
    /// The model of a problem.
    pub problem: Option<Problem>,
    /// Its names.
    pub occurrences: Occurrences,
    /// What is wrong with it. Places may lie in the domain of a problem, or in the problem of a plan.
    pub diagnostics: Diagnostics,
}

/// Names the empty text that stands for a domain nobody has found.
const NOWHERE: SourceId = SourceId(0);

/// What a name means, wherever it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Target {
    /// The text whose declarations give it a meaning.
    pub home: SourceId,
    /// What it means there.
    pub symbol: Symbol,
}

impl Default for Workspace {
    fn default() -> Self {
        let mut sources = Sources::default();
        sources.add("", "");
        Self { sources, files: vec![File::default()] }
    }
}

impl Workspace {
    /// Takes in a text; `plan` says that it is one.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        text: impl Into<String>,
        plan: bool,
    ) -> SourceId {
        let id = self.sources.add(name, text);
        self.files.push(File { plan, ..File::default() });
        self.changed(id);
        id
    }

    /// Puts another text in the place of one.
    pub fn replace(&mut self, id: SourceId, text: impl Into<String>) {
        self.sources.replace(id, text);
        self.changed(id);
    }

    /// Puts `new` in the place of a part of a text.
    pub fn splice(&mut self, span: Span, new: &str) {
        self.sources.splice(span, new);
        self.changed(span.source);
    }

    /// Says which domain a problem belongs to, or which problem a plan.
    pub fn pair(&mut self, id: SourceId, partner: Option<SourceId>) {
        if self.files[id.0 as usize].partner != partner {
            self.files[id.0 as usize].partner = partner;
            self.forget(id);
        }
    }

    fn changed(&mut self, id: SourceId) {
        let file = &mut self.files[id.0 as usize];
        file.kind = if file.plan { None } else { detect(&self.sources, id) };
        self.forget(id);
    }

    /// Drops what was found out about a text and about those that depend on it.
    fn forget(&mut self, id: SourceId) {
        for id in self.group(id) {
            self.files[id.0 as usize].analysis.take();
        }
    }

    /// The problems of a domain, the plans of a problem.
    pub fn dependents(&self, id: SourceId) -> impl Iterator<Item = SourceId> + '_ {
        let files = self.files.iter().enumerate();
        files.filter(move |(_, file)| file.partner == Some(id)).map(|(at, _)| SourceId(at as u32))
    }

    /// All texts.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// One text.
    pub fn text(&self, id: SourceId) -> &str {
        &self.sources.get(id).text
    }

    /// What a text defines, as far as its beginning says so.
    pub fn kind(&self, id: SourceId) -> Option<&Kind> {
        self.files[id.0 as usize].kind.as_ref()
    }

    /// Whether a text is a plan.
    pub fn is_plan(&self, id: SourceId) -> bool {
        self.files[id.0 as usize].plan
    }

    /// Whether a text is a problem.
    pub fn is_problem(&self, id: SourceId) -> bool {
        matches!(self.kind(id), Some(Kind::Problem { .. }))
    }

    /// The domain of a problem, the problem of a plan.
    pub fn partner(&self, id: SourceId) -> Option<SourceId> {
        self.files[id.0 as usize].partner
    }

    /// The text of the domain that gives the names of `id` their meaning: itself, if it is one.
    pub fn home(&self, id: SourceId) -> Option<SourceId> {
        let mut at = id;
        if self.is_plan(at) {
            at = self.partner(at)?;
        }
        if self.is_problem(at) {
            at = self.partner(at)?;
        }
        (!self.is_problem(at) && !self.is_plan(at)).then_some(at)
    }

    /// What a text means.
    pub fn analysis(&self, id: SourceId) -> &Analysis {
        self.files[id.0 as usize].analysis.get_or_init(|| self.analyse(id))
    }

    /// The domain that gives the names of `id` their meaning; an empty one where none is known.
    pub fn domain(&self, id: SourceId) -> &Domain {
        let found = self.home(id).and_then(|home| self.analysis(home).domain.as_ref());
        found
            .or(self.analysis(NOWHERE).domain.as_ref())
            .expect("the empty text is read as a domain")
    }

    /// The problem that `id` is or, as a plan, belongs to.
    pub fn problem(&self, id: SourceId) -> Option<&Problem> {
        let id = if self.is_plan(id) { self.partner(id)? } else { id };
        self.analysis(id).problem.as_ref()
    }

    /// The tree of a text.
    pub fn tree(&self, id: SourceId) -> Tree<'_> {
        tree::parse(id, self.text(id), &mut Diagnostics::default())
    }

    fn analyse(&self, id: SourceId) -> Analysis {
        let mut analysis = if self.is_plan(id) {
            plan::analyse(self, id)
        } else if self.is_problem(id) {
            self.analyse_problem(id)
        } else {
            self.analyse_domain(id)
        };
        let found = &mut analysis.diagnostics;
        allow::apply_in(found, &self.sources, [Some(id), self.partner(id)].into_iter().flatten());
        // What is wrong with a comment of the domain is said where the domain is looked at.
        let elsewhere = |one: &crate::diagnostic::Diagnostic| one.primary.span.source != id;
        found.list.retain(|one| !(one.name == "unknown-allow" && elsewhere(one)));
        found.list.sort_by_key(|one| (one.primary.span.source, one.primary.span.start));
        analysis
    }

    fn analyse_domain(&self, id: SourceId) -> Analysis {
        let (domain, mut diagnostics, occurrences) = index_domain(&self.sources, id);
        if diagnostics.has_errors() {
            // A file that has just been made is no mistake yet.
            if tree::parse(id, self.text(id), &mut Diagnostics::default()).roots().next().is_none()
            {
                diagnostics.list.clear();
            }
        } else {
            diagnostics.append(lint::domain(&domain));
        }
        Analysis { domain: Some(domain), problem: None, occurrences, diagnostics }
    }

    fn analyse_problem(&self, id: SourceId) -> Analysis {
        let domain = self.domain(id);
        let (problem, mut diagnostics, occurrences) = index_problem(&self.sources, id, domain);
        match self.partner(id).map(|home| &self.analysis(home).diagnostics) {
            Some(others) if !others.has_errors() && !diagnostics.has_errors() => {
                diagnostics.append(lint::problem(domain, &problem));
            }
            Some(_) => {}
            // What the domain would require is not known.
            None => diagnostics.list.retain(|one| one.name != "missing-requirement"),
        }
        Analysis { domain: None, problem: Some(problem), occurrences, diagnostics }
    }

    /// The name at a byte, or just before it, as a cursor stands.
    pub fn at(&self, id: SourceId, offset: u32) -> Option<Occurrence> {
        self.analysis(id).occurrences.at(offset).copied()
    }

    /// What a name in the text `id` means; nothing if nothing declares it.
    pub fn target(&self, id: SourceId, symbol: Symbol) -> Option<Target> {
        let Symbol::Known(namespace, number) = symbol else { return None };
        let home = match namespace {
            Namespace::Object if number < self.domain(id).constants.len() as u32 => {
                self.home(id)?
            }
            Namespace::Object if self.is_plan(id) => self.partner(id)?,
            Namespace::Variable | Namespace::Subtask | Namespace::Problem | Namespace::Object => id,
            Namespace::Preference if self.declares(id, symbol) => id,
            _ => self.home(id)?,
        };
        Some(Target { home, symbol })
    }

    fn declares(&self, id: SourceId, symbol: Symbol) -> bool {
        let Symbol::Known(_, byte) = symbol else { return false };
        self.at(id, byte).is_some_and(|at| at.symbol == symbol && at.span.start == byte)
    }

    /// How many names of a text mean nothing.
    pub fn unknown(&self, id: SourceId) -> usize {
        let names = self.analysis(id).occurrences.list.iter();
        names.filter(|one| matches!(one.symbol, Symbol::Unknown(_))).count()
    }

    /// The texts in which something of the text `home` may be named: itself, then what depends on it.
    fn group(&self, home: SourceId) -> Vec<SourceId> {
        let mut group = vec![home];
        let mut at = 0;
        while at < group.len() {
            for dependent in self.dependents(group[at]) {
                if !group.contains(&dependent) {
                    group.push(dependent);
                }
            }
            at += 1;
        }
        group
    }

    /// Every place at which something is named, its own text first.
    pub fn occurrences(&self, target: Target) -> Vec<Occurrence> {
        let texts = match target.symbol.namespace() {
            Namespace::Variable | Namespace::Subtask => vec![target.home],
            _ => self.group(target.home),
        };
        let mut found = Vec::new();
        for id in texts {
            let here = self.analysis(id).occurrences.list.iter();
            found.extend(
                here.filter(|one| {
                    one.symbol == target.symbol && self.target(id, one.symbol) == Some(target)
                })
                .copied(),
            );
        }
        found
    }

    /// The names that a text declares: where a declaration says so, and the first mention of a type that only ever stands above others.
    fn declared(&self, id: SourceId) -> Vec<Occurrence> {
        let list = &self.analysis(id).occurrences.list;
        let declares = |one: &&Occurrence| one.role == Role::Declare;
        let types = self.analysis(id).domain.as_ref().map_or(0, |domain| domain.types.len());
        let mut known = vec![false; types];
        // Everything is an object, and nobody needs to say so.
        let mut first = |one: &Occurrence| match one.symbol {
            Symbol::Known(Namespace::Type, of) if of > 0 => {
                known.get_mut(of as usize).is_some_and(|known| !std::mem::replace(known, true))
            }
            _ => false,
        };
        list.iter().filter(declares).for_each(|one| {
            first(one);
        });
        list.iter().filter(|one| one.role == Role::Declare || first(one)).copied().collect()
    }

    /// Where something is declared. What is only ever used, as a type above others may be, counts as declared where it stands first.
    pub fn declarations(&self, target: Target) -> Vec<Span> {
        let here = self.analysis(target.home).occurrences.list.iter();
        let here: Vec<_> = here.filter(|one| one.symbol == target.symbol).collect();
        let declared: Vec<Span> =
            here.iter().filter(|one| one.role == Role::Declare).map(|one| one.span).collect();
        if declared.is_empty() && target.symbol.namespace() == Namespace::Type {
            return here.first().map(|one| one.span).into_iter().collect();
        }
        declared
    }
}

/// The lists around a byte, the outermost first, and last the word there, if there is one.
fn path(tree: &Tree<'_>, offset: u32) -> Vec<NodeId> {
    let mut path = Vec::new();
    let (mut at, mut end) = (0, tree.nodes().len() as u32);
    while at < end {
        let node = tree.nodes()[at as usize];
        let inside = node.start <= offset && offset < node.end
            || offset == node.end && node.kind == NodeKind::Atom;
        if !inside {
            at = node.next;
            continue;
        }
        match node.kind {
            NodeKind::List | NodeKind::OpenList => {
                path.push(NodeId(at));
                (at, end) = (at + 1, node.next);
            }
            NodeKind::Atom => {
                path.push(NodeId(at));
                break;
            }
            _ if offset == node.start => at = node.next,
            _ => break,
        }
    }
    path
}
