//! A range of a text goes in; what can be done about the mistakes there comes out, as edits to choose from.

use super::layout::{Edit, difference};
use super::outline::{self, Section};
use super::{Workspace, hover, path, words};
use crate::diagnostic::{Applicability, Diagnostic, Severity};
use crate::mend;
use crate::model::{Domain, TypeId};
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Symbol};
use crate::tree::{NodeId, NodeKind, Tree};

/// One way to mend a mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remedy {
    /// What it does, as an instruction.
    pub title: String,
    /// The ranges to replace, and by what; they may lie in another text.
    pub edits: Vec<Edit>,
    /// Whether it can only have been meant so.
    pub safe: bool,
    /// Whether it mends the mistake; otherwise it only silences it.
    pub mends: bool,
    /// The code and the place of the mistake.
    pub about: (&'static str, Span),
}

/// What can be done about the mistakes between two bytes.
pub fn remedies(workspace: &Workspace, id: SourceId, start: u32, end: u32) -> Vec<Remedy> {
    let mut found = Vec::new();
    for one in &workspace.analysis(id).diagnostics.list {
        let at = one.primary.span;
        if at.source != id || at.start > end || start > at.end {
            continue;
        }
        let remedy = |title: String, edits: Vec<Edit>| Remedy {
            title,
            edits,
            safe: false,
            mends: true,
            about: (one.code, at),
        };
        for fix in &one.fixes {
            let safe = fix.applicability == Applicability::Safe;
            found.push(Remedy { safe, ..remedy(fix.title.clone(), fix.edits.clone()) });
        }
        if let Some((title, edit)) = addition(workspace, id, one) {
            found.push(remedy(title, vec![edit]));
        }
        if one.severity == Severity::Warning
            && let Some(edit) = silence(workspace, one)
        {
            let title = format!("silence with `; caveat: allow({})`", one.name);
            found.push(Remedy { mends: false, ..remedy(title, vec![edit]) });
        }
    }
    found
}

/// All safe fixes of a text in one.
pub fn fix_all(workspace: &Workspace, id: SourceId) -> Option<Edit> {
    let diagnostics = &workspace.analysis(id).diagnostics;
    let (mended, _) = mend::safely(diagnostics, workspace.sources(), id);
    difference(id, workspace.text(id), &mended)
}

/// The declaration that is missing.
fn addition(workspace: &Workspace, id: SourceId, one: &Diagnostic) -> Option<(String, Edit)> {
    let place = Place { workspace, id, tree: workspace.tree(id), domain: workspace.domain(id) };
    let name = workspace.sources().text(one.primary.span);
    let at = one.primary.span.start;
    match one.name {
        "unknown-predicate" => {
            let declared = format!("({name}{})", place.parameters(at));
            let title = format!("declare the predicate `{declared}`");
            Some((title, insert(workspace, workspace.home(id)?, ":predicates", &declared)?))
        }
        "unknown-function" => {
            let declared = format!("({name}{})", place.parameters(at));
            let title = format!("declare the function `{declared}`");
            let text = format!("{declared} - number");
            Some((title, insert(workspace, workspace.home(id)?, ":functions", &text)?))
        }
        "unknown-type" => {
            let title = format!("declare the type `{name}`");
            Some((title, insert(workspace, workspace.home(id)?, ":types", name)?))
        }
        "unknown-object" => {
            let (keyword, what) = if workspace.is_problem(id) {
                (":objects", "object")
            } else {
                (":constants", "constant")
            };
            let of = place.expected(at);
            let title = match &of {
                Some(of) => format!("declare the {what} `{name} - {of}`"),
                None => format!("declare the {what} `{name}`"),
            };
            let sections = outline::sections(&place.tree);
            let edit = if let Some(section) = sections.iter().find(|section| section.is(&[keyword]))
            {
                typed(&place.tree, section.node, 1, name, of.as_deref())
            } else {
                let text = of.map_or(name.to_owned(), |of| format!("{name} - {of}"));
                insert(workspace, id, keyword, &text)?
            };
            Some((title, edit))
        }
        "unknown-variable" => {
            let sections = outline::sections(&place.tree);
            let section = outline::around(&sections, at)?;
            let list = field(&place.tree, section.node, ":parameters")?;
            let of = place.expected(at);
            let title = format!("add `{name}` to the parameters of {}", section.describe());
            Some((title, typed(&place.tree, list, 0, name, of.as_deref())))
        }
        _ => None,
    }
}

/// Where a name stands that is to be declared.
struct Place<'w> {
    workspace: &'w Workspace,
    id: SourceId,
    tree: Tree<'w>,
    domain: &'w Domain,
}

impl Place<'_> {
    /// The parameters that fit the terms to which the name at a byte is applied, each after a blank.
    fn parameters(&self, at: u32) -> String {
        let mut text = String::new();
        let mut taken: Vec<String> = Vec::new();
        let Some(list) =
            path(&self.tree, at).into_iter().rev().find(|&node| self.tree.is_list(node))
        else {
            return text;
        };
        for argument in self.tree.children(list).skip(1) {
            let word = self.tree.slice(argument);
            let of = self.types(argument);
            let mut name = match word.strip_prefix('?') {
                Some(bare) if !bare.is_empty() => format!("?{bare}"),
                _ => "?x".to_owned(),
            };
            if taken.contains(&name) {
                name = format!("{name}{}", taken.len() + 1);
            }
            text.push(' ');
            text.push_str(&name);
            if let Some(of) = of {
                text.push_str(" - ");
                text.push_str(&of);
            }
            taken.push(name);
        }
        text
    }

    /// The types of the term at a node, if the domain has types.
    fn types(&self, term: NodeId) -> Option<String> {
        let at = self.workspace.at(self.id, self.tree.node(term).start)?;
        let Symbol::Known(namespace, number) = at.symbol else { return None };
        let types = match namespace {
            Namespace::Variable => {
                &self.workspace.analysis(self.id).occurrences.variable(number)?.types
            }
            Namespace::Object => match self.domain.constants.get(number as usize) {
                Some(constant) => &constant.types,
                None => &self.workspace.problem(self.id)?.objects.get(number as usize)?.types,
            },
            _ => return None,
        };
        self.describe(types)
    }

    fn describe(&self, types: &[TypeId]) -> Option<String> {
        (self.domain.types.len() > 1).then(|| words::types(self.domain, types))
    }

    /// The types that are wanted where the term at a byte stands.
    fn expected(&self, at: u32) -> Option<String> {
        let path = path(&self.tree, at);
        let list = path.iter().rev().copied().find(|&node| self.tree.is_list(node))?;
        let index = self.tree.children(list).position(|child| self.tree.node(child).start == at)?;
        let head = self.tree.children(list).next()?;
        let callee = self.workspace.at(self.id, self.tree.node(head).start)?;
        let (_, parameters) = hover::parameters(self.domain, callee.symbol)?;
        self.describe(&parameters.get(index.checked_sub(1)?)?.types)
    }
}

/// The list that follows a field.
pub(super) fn field(tree: &Tree<'_>, list: NodeId, field: &str) -> Option<NodeId> {
    let mut children = tree.children(list);
    children.find(|&child| tree.slice(child).eq_ignore_ascii_case(field))?;
    children.next().filter(|&value| tree.is_list(value))
}

/// The sections of a domain and a problem in the order in which people write them.
const ORDER: [&str; 8] = [
    ":domain",
    ":requirements",
    ":types",
    ":constants",
    ":predicates",
    ":functions",
    ":objects",
    ":init",
];

/// Writes `text` at the end of a section, which is made if there is none.
fn insert(workspace: &Workspace, id: SourceId, keyword: &str, text: &str) -> Option<Edit> {
    let tree = workspace.tree(id);
    let sections = outline::sections(&tree);
    if let Some(section) = sections.iter().find(|section| section.is(&[keyword])) {
        return Some(append(&tree, section.node, text));
    }
    let rank = ORDER.iter().position(|&one| one == keyword)?;
    let before =
        |section: &&Section<'_>| !section.keyword.starts_with(':') || section.is(&ORDER[..rank]);
    let last = sections.iter().rfind(before)?;
    let span = Span { start: last.span.end, ..last.span };
    Some((span, format!("\n  ({keyword} {text})")))
}

/// Writes `text` after the last part of a list, on a line of its own if that part has one.
fn append(tree: &Tree<'_>, list: NodeId, text: &str) -> Edit {
    let last = tree.children(list).last().map_or(list, |last| last);
    let node = tree.node(last);
    let end = if last == list { node.start + 1 } else { node.end };
    let line = tree.input()[..node.start as usize].rfind('\n').map_or(0, |at| at + 1);
    let indent = &tree.input()[line..node.start as usize];
    let alone = last != list && !indent.is_empty() && indent.trim().is_empty();
    let gap = if alone { format!("\n{indent}") } else { " ".to_owned() };
    (Span::new(tree.source, end, end), format!("{gap}{text}"))
}

/// Writes a name into a typed list, of which `skip` words come before the names, so that no other name changes its type.
fn typed(tree: &Tree<'_>, list: NodeId, skip: usize, name: &str, of: Option<&str>) -> Edit {
    let names: Vec<NodeId> = tree.children(list).skip(skip).collect();
    let Some(of) = of else { return append_name(tree, list, skip, name) };
    let text = format!("{name} - {of}");
    let tail = names.len().checked_sub(2).map(|at| tree.slice(names[at]));
    if names.is_empty() || tail == Some("-") {
        return append_name(tree, list, skip, &text);
    }
    let at = tree.node(names[0]).start;
    (Span::new(tree.source, at, at), format!("{text} "))
}

/// As [`append`], without a blank after the parenthesis of an empty list.
fn append_name(tree: &Tree<'_>, list: NodeId, skip: usize, text: &str) -> Edit {
    let (span, new) = append(tree, list, text);
    if skip == 0 && tree.children(list).next().is_none() {
        return (span, text.to_owned());
    }
    (span, new)
}

/// The comment that silences a warning, at the end of its line.
fn silence(workspace: &Workspace, one: &Diagnostic) -> Option<Edit> {
    let at = one.primary.span;
    let text = workspace.text(at.source);
    let end =
        text[at.start as usize..].find('\n').map_or(text.len(), |end| at.start as usize + end);
    let end = at.start as usize + text[at.start as usize..end].trim_end().len();
    let tree = workspace.tree(at.source);
    let commented = tree.nodes().iter().any(|node| {
        node.kind == NodeKind::Comment && (node.start as usize) < end && end <= node.end as usize
    });
    let span = Span::new(at.source, end as u32, end as u32);
    (!commented).then(|| (span, format!(" ; caveat: allow({})", one.name)))
}

#[cfg(test)]
mod tests {
    use super::{fix_all, remedies};
    use crate::ide::fixture::{DOMAIN, PROBLEM, edited, workspace};
    use crate::source::SourceId;

    /// What is offered at the cursor: the titles, and the texts after each.
    #[track_caller]
    fn offered(texts: &[&str]) -> Vec<(String, Vec<String>)> {
        let (workspace, id, offset) = workspace(texts);
        let found = remedies(&workspace, id, offset, offset).into_iter();
        found.map(|one| (one.title, edited(&workspace, &one.edits))).collect()
    }

    /// That something is offered, and what it makes of a text.
    #[track_caller]
    fn makes(texts: &[&str], title: &str, text: usize, part: &str) {
        let offered = offered(texts);
        let titles: Vec<&str> = offered.iter().map(|(title, _)| title.as_str()).collect();
        let (_, made) =
            offered.iter().find(|(one, _)| one == title).unwrap_or_else(|| panic!("{titles:?}"));
        assert!(made[text].contains(part), "{}", made[text]);
    }

    #[test]
    fn what_the_checker_proposes() {
        let text = DOMAIN.replace("(clean ?d) (inc", "(cl$0aen ?d) (inc");
        makes(&[&text], "replace with `clean`", 0, "(clean ?d) (inc");
    }

    #[test]
    fn a_predicate_with_its_types() {
        let text = DOMAIN.replace("(clean ?d) (inc", "(polished$0 ?d sink) (inc");
        makes(
            &[&text],
            "declare the predicate `(polished ?d - dish ?x - place)`",
            0,
            "    (clean ?d - dish)\n    (polished ?d - dish ?x - place))",
        );
        let text = PROBLEM.replace("(clean mug)", "(broken$0 mug)");
        makes(
            &[DOMAIN, &text],
            "declare the predicate `(broken ?x - cup)`",
            0,
            "    (clean ?d - dish)\n    (broken ?x - cup))",
        );
    }

    #[test]
    fn a_section_is_made_where_there_is_none() {
        let text = "(define (domain d)\n  (:requirements :strips)\n  (:action a :effect (p$0)))";
        makes(
            &[text],
            "declare the predicate `(p)`",
            0,
            "(:requirements :strips)\n  (:predicates (p))\n  (:action",
        );
    }

    #[test]
    fn functions_types_and_objects() {
        let text = DOMAIN.replace("(effort ?d))))", "(toil$0 ?d))))");
        makes(
            &[&text],
            "declare the function `(toil ?d - dish)`",
            0,
            "(effort ?d - dish) - number (toil ?d - dish) - number)",
        );
        let text = DOMAIN.replace("(?d - dish ?from", "(?d - bottle$0 ?from");
        makes(&[&text], "declare the type `bottle`", 0, "dish place bottle)");
        let text = PROBLEM
            .replace("(at mug shelf)", "(at mug$0 cupboard)")
            .replace("mug$0 cup", "mug cup$0");
        makes(
            &[DOMAIN, &text],
            "declare the object `cupboard - place`",
            1,
            "(:objects mug - cup shelf - place cupboard - place)",
        );
        let text = DOMAIN.replace("(at ?d sink)", "(at ?d table$0)");
        makes(
            &[&text],
            "declare the constant `table - place`",
            0,
            "(:constants sink - place table - place)",
        );
    }

    #[test]
    fn a_type_goes_before_names_without_one() {
        let text = PROBLEM
            .replace("mug - cup shelf - place", "mug shelf")
            .replace("(at mug shelf)", "(at mug hook$0)");
        makes(
            &[DOMAIN, &text],
            "declare the object `hook - place`",
            1,
            "(:objects hook - place mug shelf)",
        );
    }

    #[test]
    fn a_parameter() {
        let text = DOMAIN.replace("(at ?d sink)", "(at ?d ?where$0)");
        makes(
            &[&text],
            "add `?where` to the parameters of action `wash`",
            0,
            ":parameters (?d - dish ?where - place)",
        );
        let text =
            "(define (domain d) (:predicates (p ?x)) (:action a :parameters () :effect (p ?y$0)))";
        makes(&[text], "add `?y` to the parameters of action `a`", 0, ":parameters (?y) :effect");
    }

    #[test]
    fn a_requirement_and_silence() {
        let text = DOMAIN.replace("(at ?d sink)", "(n$0ot (clean ?d))");
        makes(
            &[&text],
            "declare `:negative-preconditions`",
            0,
            "(:requirements :typing :action-costs :negative-preconditions)",
        );
        makes(
            &[&text],
            "silence with `; caveat: allow(missing-requirement)`",
            0,
            "(not (clean ?d)) ; caveat: allow(missing-requirement)\n",
        );
        // Where there is a comment already, another one would not be seen.
        let text = text.replace("(clean ?d))\n", "(clean ?d)) ; so\n");
        assert!(offered(&[&text]).iter().all(|(title, _)| !title.starts_with("silence")));
    }

    #[test]
    fn all_that_is_safe() {
        let text = "(define (domain d) (:predicate (p)) (:action a :paramters () :effect (p)))";
        let (workspace, ..) = workspace(&[text]);
        let edit = fix_all(&workspace, SourceId(1)).expect("there is something to mend");
        let mended = &edited(&workspace, &[edit])[0];
        assert_eq!(
            mended,
            "(define (domain d) (:predicates (p)) (:action a :parameters () :effect (p)))"
        );
        let (workspace, ..) = super::super::fixture::workspace(&[mended]);
        assert_eq!(fix_all(&workspace, SourceId(1)), None);
    }
}
