//! Files and open documents go in; a [`Workspace`] of what is in them comes out, with each problem beside its domain.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use gen_lsp_types::{Position, Range, Uri};
use lang::Kind;
use lang::ide::Workspace;
use lang::source::{SourceId, Span};

use super::address;
use super::position::{Encoding, Lines};
use crate::files;
use crate::input::{choose, is_domain, usual_names};

/// The texts of an editor and of the folders around them.
#[derive(Debug, Default)]
pub struct Folder {
    /// What the texts mean.
    pub workspace: Workspace,
    /// The folders that the editor has opened.
    pub roots: Vec<PathBuf>,
    /// What columns count.
    pub encoding: Encoding,
    ids: BTreeMap<PathBuf, SourceId>,
    documents: BTreeMap<SourceId, Document>,
}

/// What is known of a text beside the text.
#[derive(Debug)]
struct Document {
    path: PathBuf,
    /// Where its lines begin; made when it is asked for.
    lines: std::cell::OnceCell<Lines>,
    /// How the file was when it was read last.
    stamp: Option<Stamp>,
    /// Its address and version while the editor has it open.
    open: Option<(Uri, i32)>,
}

/// When a file was changed last, and its length then.
type Stamp = (SystemTime, u64);

/// No more files than this are looked at in the folders of the editor.
const MANY: usize = 1000;

impl Folder {
    /// An editor opens a document.
    pub fn open(&mut self, uri: Uri, version: i32, text: String) -> SourceId {
        let path = address::path(&uri);
        let id = self.put(&path, text, None);
        if let Some(document) = self.documents.get_mut(&id) {
            document.open = Some((uri, version));
        }
        self.load_around(&path);
        self.pair();
        id
    }

    /// An editor changes a part of a document, or all of it.
    pub fn change(&mut self, id: SourceId, version: i32, range: Option<Range>, text: String) {
        let before = self.workspace.kind(id).cloned();
        match range.map(|range| self.span(id, range)) {
            Some(span) => self.workspace.splice(span, &text),
            None => self.workspace.replace(id, text),
        }
        if let Some(document) = self.documents.get_mut(&id) {
            document.lines.take();
            if let Some((_, known)) = &mut document.open {
                *known = version;
            }
        }
        if self.workspace.kind(id) != before.as_ref() {
            self.pair();
        }
    }

    /// An editor closes a document: from now on the file counts.
    pub fn close(&mut self, id: SourceId) {
        let Some(document) = self.documents.get_mut(&id) else { return };
        document.open = None;
        document.stamp = None;
        let path = document.path.clone();
        self.load(&path);
        self.pair();
    }

    /// Looks again at files that may have changed.
    pub fn refresh(&mut self, paths: &[PathBuf]) {
        for path in paths {
            self.load(path);
        }
        self.pair();
    }

    /// Looks again at the files on which the open texts depend, which may change without a word from the editor.
    pub fn refresh_partners(&mut self) {
        let opened = self.opened();
        let partners = opened.iter().filter_map(|&id| self.workspace.partner(id));
        let more: Vec<SourceId> = partners.collect();
        let above = more.iter().filter_map(|&id| self.workspace.partner(id));
        let all: BTreeSet<SourceId> = more.iter().copied().chain(above).collect();
        let paths: Vec<PathBuf> = all.iter().map(|id| self.documents[id].path.clone()).collect();
        let mut changed = false;
        for path in paths {
            changed |= self.load(&path);
        }
        if changed {
            self.pair();
        }
    }

    /// The text at an address, if it is known.
    pub fn id(&self, uri: &Uri) -> Option<SourceId> {
        self.ids.get(&address::path(uri)).copied()
    }

    /// The texts that the editor has open, in the order of their paths.
    pub fn opened(&self) -> Vec<SourceId> {
        let ids = self.ids.values().copied();
        ids.filter(|id| self.documents.get(id).is_some_and(|one| one.open.is_some())).collect()
    }

    /// The address of a text: while it is open, as the editor spells it.
    pub fn uri(&self, id: SourceId) -> Uri {
        let document = &self.documents[&id];
        match &document.open {
            Some((uri, _)) => uri.clone(),
            None => address::uri(&document.path),
        }
    }

    /// The version of a text that is open.
    pub fn version(&self, id: SourceId) -> Option<i32> {
        self.documents.get(&id)?.open.as_ref().map(|(_, version)| *version)
    }

    fn lines(&self, id: SourceId) -> &Lines {
        let lines = &self.documents[&id].lines;
        lines.get_or_init(|| Lines::new(self.workspace.text(id), self.encoding))
    }

    /// The byte at a position.
    pub fn offset(&self, id: SourceId, position: Position) -> u32 {
        let offset = self.lines(id).offset(position);
        self.workspace.text(id).floor_char_boundary(offset as usize) as u32
    }

    /// The bytes of a range.
    pub fn span(&self, id: SourceId, range: Range) -> Span {
        let (start, end) = (self.offset(id, range.start), self.offset(id, range.end));
        Span::new(id, start.min(end), end.max(start))
    }

    /// The position of a byte.
    pub fn position(&self, id: SourceId, offset: u32) -> Position {
        self.lines(id).position(offset)
    }

    /// The range of a span, in the text in which it lies.
    pub fn range(&self, span: Span) -> Range {
        self.lines(span.source).range(span)
    }

    /// Whether a place can be shown: that of the domain which nobody has found cannot.
    pub fn is_known(&self, span: Span) -> bool {
        self.documents.contains_key(&span.source)
    }

    /// Reads everything in which names of the text `id` may stand.
    pub fn load_all(&mut self, id: SourceId) {
        let mut folders: BTreeSet<PathBuf> = self.roots.iter().cloned().collect();
        for one in [Some(id), self.workspace.home(id)].into_iter().flatten() {
            if let Some(document) = self.documents.get(&one) {
                folders.insert(files::folder(&document.path).to_path_buf());
            }
        }
        self.load_below(folders);
    }

    /// Reads the folders that the editor has opened.
    pub fn load_roots(&mut self) {
        self.load_below(self.roots.iter().cloned().collect());
    }

    fn load_below(&mut self, folders: BTreeSet<PathBuf>) {
        let mut waiting: Vec<PathBuf> = folders.into_iter().rev().collect();
        let mut found = BTreeSet::new();
        while let Some(folder) = waiting.pop().filter(|_| found.len() < MANY) {
            let entries = fs::read_dir(&folder).into_iter().flatten().flatten();
            for entry in entries {
                let path = entry.path();
                let hidden = entry.file_name().as_encoded_bytes().starts_with(b".");
                // A link to a folder may lead back to where it is.
                match entry.file_type() {
                    Ok(kind) if kind.is_dir() && !hidden => waiting.push(path),
                    Ok(kind) if !kind.is_dir() && (files::is_pddl(&path) || is_plan(&path)) => {
                        found.insert(path);
                    }
                    _ => {}
                }
            }
        }
        // What is gone is seen by looking at what was there.
        found.extend(self.ids.keys().cloned());
        for path in found {
            self.load(&path);
        }
        self.pair();
    }

    /// Reads what lies beside a file, and what may be its domain in the folders above.
    fn load_around(&mut self, path: &Path) {
        if !address::is_file(path) {
            return;
        }
        let mut folder = path.parent();
        while let Some(at) = folder {
            for file in files::beside(&at.join("-")) {
                self.load(&file);
            }
            let inside = self.roots.iter().any(|root| at != root && at.starts_with(root));
            folder = at.parent().filter(|_| inside);
        }
    }

    /// Reads a file, if it has changed since it was read last and is not open; says whether it was read.
    fn load(&mut self, path: &Path) -> bool {
        let known = self.ids.get(path).and_then(|id| self.documents.get(id));
        if !address::is_file(path) || known.is_some_and(|document| document.open.is_some()) {
            return false;
        }
        let data = fs::metadata(path).ok().filter(fs::Metadata::is_file);
        let stamp = data.and_then(|data| Some((data.modified().ok()?, data.len())));
        if known.is_some_and(|document| document.stamp.is_some() && document.stamp == stamp) {
            return false;
        }
        match stamp.and_then(|_| files::read(path).ok()) {
            Some(text) => {
                self.put(path, text.text, stamp);
                true
            }
            // A file that is gone says nothing any more.
            None if known.is_some() => {
                self.put(path, String::new(), None);
                true
            }
            None => false,
        }
    }

    fn put(&mut self, path: &Path, text: String, stamp: Option<Stamp>) -> SourceId {
        let id = match self.ids.get(path) {
            Some(&id) => {
                if self.workspace.text(id) != text {
                    self.workspace.replace(id, text);
                }
                id
            }
            None => self.workspace.add(path.display().to_string(), text, is_plan(path)),
        };
        self.ids.insert(path.to_path_buf(), id);
        let path = path.to_path_buf();
        let open = self.documents.remove(&id).and_then(|document| document.open);
        let document = Document { path, lines: std::cell::OnceCell::new(), stamp, open };
        self.documents.insert(id, document);
        id
    }

    /// Finds the domain of each problem, and the problem of each plan.
    fn pair(&mut self) {
        let texts: Vec<(PathBuf, SourceId)> =
            self.ids.iter().map(|(path, &id)| (path.clone(), id)).collect();
        let (plans, others): (Vec<_>, Vec<_>) =
            texts.into_iter().partition(|(_, id)| self.workspace.is_plan(*id));
        for (path, id) in &others {
            let partner = match self.workspace.kind(*id) {
                Some(Kind::Problem { domain, .. }) => self.find_domain(path, domain.as_deref()),
                _ => None,
            };
            self.workspace.pair(*id, partner);
        }
        for (path, id) in &plans {
            let partner = self.find_problem(path, *id);
            self.workspace.pair(*id, partner);
        }
    }

    /// The domain of a problem: beside it as the command line finds it, or else in a folder above, or else anywhere.
    fn find_domain(&self, path: &Path, wanted: Option<&str>) -> Option<SourceId> {
        let domain = |file: &Path, wanted: Option<&str>| {
            self.ids.get(file).is_some_and(|&id| is_domain(self.workspace.kind(id), wanted))
        };
        let mut folder = Some(files::folder(path));
        while let Some(at) = folder.filter(|_| address::is_file(path)) {
            let here = at.join(path.file_name().unwrap_or_default());
            let usual = usual_names(&here);
            let others = || self.beside(&here);
            let found = choose(&usual, others, |file| file != path && domain(file, wanted));
            // Of several that have the name the one that is being written is meant.
            let open = found.iter().find(|file| self.version(self.ids[*file]).is_some());
            if let Some(found) = open.or(found.first()) {
                return Some(self.ids[found]);
            }
            folder = at.parent();
        }
        let anywhere = self.ids.keys().find(|file| wanted.is_some() && domain(file, wanted));
        // That it defines another domain is said when the problem is read.
        let usual = usual_names(path);
        let found = anywhere.or_else(|| usual.iter().find(|file| domain(file, None)))?;
        self.ids.get(found).copied()
    }

    /// The problem of a plan: the one of its name, or the one whose objects it names.
    fn find_problem(&mut self, path: &Path, plan: SourceId) -> Option<SourceId> {
        let named = named_problem(self.workspace.text(plan)).map(str::to_owned);
        let stem = path.file_name()?.to_str()?.split('.').next()?.to_owned();
        let beside = self.beside(path);
        let problems: Vec<(String, SourceId)> = beside
            .into_iter()
            .filter(|file| self.workspace.is_problem(self.ids[file]))
            .filter_map(|file| Some((file.file_stem()?.to_str()?.to_owned(), self.ids[&file])))
            .collect();
        let is_named = |(_, id): &&(String, SourceId)| match (self.workspace.kind(*id), &named) {
            (Some(Kind::Problem { name, .. }), Some(wanted)) => name.eq_ignore_ascii_case(wanted),
            _ => false,
        };
        let found = problems
            .iter()
            .find(is_named)
            .or_else(|| problems.iter().find(|(name, _)| *name == stem))
            .or_else(|| problems.iter().find(|_| problems.len() == 1))
            .or_else(|| problems.iter().find(|(name, _)| name == "problem"));
        if let Some(&(_, found)) = found {
            return Some(found);
        }
        let mut best: Option<(usize, SourceId)> = None;
        for (_, problem) in problems.into_iter().take(TRIED) {
            self.workspace.pair(plan, Some(problem));
            let unknown = self.workspace.unknown(plan);
            if best.is_none_or(|(least, _)| unknown < least) {
                best = Some((unknown, problem));
            }
        }
        best.map(|(_, problem)| problem)
    }

    /// The known files in the folder of `path`, in the order of their names.
    fn beside(&self, path: &Path) -> Vec<PathBuf> {
        let folder = files::folder(path);
        let inside = self.ids.keys().filter(|file| files::folder(file) == folder && *file != path);
        inside.cloned().collect()
    }
}

/// So many problems are tried for a plan whose name says nothing.
const TRIED: usize = 32;

/// The problem that a comment at the head of a plan names: `;;!problem: NAME`.
fn named_problem(text: &str) -> Option<&str> {
    let head = text.lines().take_while(|line| line.starts_with(';') || line.trim().is_empty());
    head.filter_map(|line| line.split_once("!problem:")).map(|(_, name)| name.trim()).next()
}

/// Whether a file is called as plans are.
pub fn is_plan(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let numbered = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let bare = numbered.strip_suffix('.').unwrap_or(numbered);
    let ends = |name: &str| Path::new(name).extension().is_some_and(|ending| ending == "plan");
    name.starts_with("sas_plan") || ends(bare) || ends(&name)
}

#[cfg(test)]
mod tests {
    use super::{is_plan, named_problem};
    use std::path::Path;

    #[test]
    fn plans_are_known_by_their_names() {
        for name in ["p01.plan", "p01.plan.3", "sas_plan", "sas_plan.12", "X.PLAN"] {
            assert!(is_plan(Path::new(name)), "{name}");
        }
        for name in ["plan.pddl", "domain.pddl", "planner.py", "a.plan.txt"] {
            assert!(!is_plan(Path::new(name)), "{name}");
        }
    }

    #[test]
    fn a_plan_may_name_its_problem() {
        assert_eq!(named_problem(";;!domain: d\n;;!problem: p\n(a)"), Some("p"));
        assert_eq!(named_problem("(a)\n;;!problem: p"), None);
    }
}
