//! A place in a text goes in; what is known of the name there comes out, as Markdown.

use std::fmt::Write;

use super::outline::{self, Section};
use super::{Target, Workspace, comment, glossary, words};
use crate::model::{Doing, Domain, Signature, TypeId, Variable};
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Occurrence, Role, Symbol};
use crate::tree::Tree;

/// What there is to say of the name at `offset`, and where that name stands.
pub fn hover(workspace: &Workspace, id: SourceId, offset: u32) -> Option<(Span, String)> {
    let Some(at) = workspace.at(id, offset) else { return keyword(workspace, id, offset) };
    let target = workspace.target(id, at.symbol)?;
    Some((at.span, describe(workspace, id, target)?))
}

/// What a word of the language means.
fn keyword(workspace: &Workspace, id: SourceId, offset: u32) -> Option<(Span, String)> {
    let tree = workspace.tree(id);
    let path = super::path(&tree, offset);
    let [.., list, word] = path.as_slice() else { return None };
    let spelling = tree.slice(*word);
    let heads = tree.children(*list).next() == Some(*word);
    if tree.is_list(*word) || !heads && !spelling.starts_with(':') {
        return None;
    }
    let meaning = glossary::meaning(spelling)?;
    Some((tree.span(*word), format!("`{spelling}`: {meaning}\n")))
}

/// The declaration, what its author says of it, and what is done with it.
pub(super) fn describe(workspace: &Workspace, id: SourceId, target: Target) -> Option<String> {
    let domain = workspace.domain(id);
    let tree = workspace.tree(target.home);
    let mut text = format!("```pddl\n{}\n```\n", declaration(workspace, &tree, domain, target)?);
    let declared = workspace.declarations(target);
    // A comment speaks of what a line declares, and not of its parameters.
    let declares = target.symbol.namespace() != Namespace::Variable;
    let declared = declared.first().filter(|_| declares);
    let said = declared.map(|&span| comment::about(workspace, &tree, span));
    if let Some(said) = said.filter(|said| !said.is_empty()) {
        // Two blanks at the end of a line keep the author's lines in Markdown.
        let _ = writeln!(text, "\n{}\n", said.replace('\n', "  \n"));
    }
    let facts = match target.symbol.namespace() {
        Namespace::Predicate | Namespace::Function => uses(workspace, id, &tree, target),
        Namespace::Type => hierarchy(workspace, id, domain, target),
        Namespace::Action => doings(workspace, &tree, target),
        _ => Vec::new(),
    };
    for fact in facts {
        let _ = writeln!(text, "- {fact}");
    }
    Some(text)
}

/// The thing as it is declared.
fn declaration(
    workspace: &Workspace,
    tree: &Tree<'_>,
    domain: &Domain,
    target: Target,
) -> Option<String> {
    let Symbol::Known(namespace, number) = target.symbol else { return None };
    let index = number as usize;
    let text = match namespace {
        Namespace::Predicate => {
            let predicate = domain.predicates.get(index)?;
            let head = words::head(domain, &predicate.name.text, &predicate.parameters);
            if predicate.derived { format!("{head} ; derived") } else { head }
        }
        Namespace::Function => {
            let function = domain.functions.get(index)?;
            let head = words::head(domain, &function.name.text, &function.parameters);
            let values = function.values.as_ref();
            format!(
                "{head} - {}",
                values.map_or("number".to_owned(), |of| words::types(domain, of))
            )
        }
        Namespace::Type => {
            let of = domain.types.get(index)?;
            let above = if of.parents.is_empty() { &[TypeId(0)][..] } else { &of.parents };
            match index {
                0 => "object".to_owned(),
                _ => format!("{} - {}", of.name.text, words::types(domain, above)),
            }
        }
        Namespace::Object => {
            let (object, what) = match domain.constants.get(index) {
                Some(constant) => (constant, "constant"),
                None => (workspace.problem(target.home)?.objects.get(index)?, "object"),
            };
            format!("{} - {} ; {what}", object.name.text, words::types(domain, &object.types))
        }
        Namespace::Variable => {
            let variable = workspace.analysis(target.home).occurrences.variable(number)?;
            let sections = outline::sections(tree);
            let owner = owner(tree, &sections, number);
            format!("{} ; {owner}", words::variable(domain, variable))
        }
        Namespace::Domain => format!("(domain {})", domain.name.text),
        Namespace::Problem => format!("(problem {})", workspace.problem(target.home)?.name.text),
        Namespace::Action | Namespace::Task => {
            signature(domain, &signature_at(domain, number)?.name.text, number)?
        }
        Namespace::Method | Namespace::Subtask | Namespace::Preference | Namespace::Constraint => {
            let span = workspace.declarations(target).into_iter().next()?;
            format!("{} ; {}", workspace.sources().text(span), namespace.describe())
        }
    };
    Some(text)
}

/// What is declared at a byte of the domain and can be done.
pub(super) fn signature_at(domain: &Domain, declared: u32) -> Option<&Signature> {
    domain.signatures.iter().find(|one| one.name.span.start == declared)
}

/// `(:action drive :parameters (?t - truck))`.
fn signature(domain: &Domain, name: &str, declared: u32) -> Option<String> {
    let found = signature_at(domain, declared)?;
    let keyword = match found.doing {
        Doing::Action(kind) => kind.keyword(),
        Doing::Task => ":task",
    };
    let shown: Vec<String> =
        found.parameters.iter().map(|one| words::variable(domain, one)).collect();
    Some(format!("({keyword} {name}\n  :parameters ({}))", shown.join(" ")))
}

/// Whose variable it is that is declared at a byte: "parameter of action `drive`".
fn owner(tree: &Tree<'_>, sections: &[Section<'_>], declared: u32) -> String {
    let path = super::path(tree, declared);
    let heads: Vec<&str> =
        path.iter().rev().filter_map(|&list| outline::head(tree, list)).collect();
    let binder = heads.first().filter(|head| !head.starts_with('?'));
    let quantifier = heads
        .iter()
        .find(|head| head.eq_ignore_ascii_case("forall") || head.eq_ignore_ascii_case("exists"));
    let section = outline::around(sections, declared);
    match (binder, quantifier, section) {
        (Some(head), _, Some(section)) if section.is(&[":predicates"]) => {
            format!("parameter of `{head}`")
        }
        (Some(head), _, Some(section)) if section.is(&[":functions"]) => {
            format!("parameter of `{head}`")
        }
        (_, Some(quantifier), Some(section)) => {
            format!("bound by `{quantifier}` in {}", section.describe())
        }
        (_, _, Some(section)) => format!("parameter of {}", section.describe()),
        _ => "variable".to_owned(),
    }
}

/// The names of the sections in which a name has one of these roles, each once.
pub(super) fn owners<'s>(
    sections: &'s [Section<'_>],
    occurrences: &[Occurrence],
    roles: &[Role],
) -> Vec<&'s str> {
    let mut found: Vec<&str> = Vec::new();
    for one in occurrences.iter().filter(|one| roles.contains(&one.role)) {
        let section = outline::around(sections, one.span.start);
        let Some(section) = section.filter(|section| !section.is(&[":predicates", ":functions"]))
        else {
            continue;
        };
        let name = section.name.map_or(section.keyword, |(name, _)| name);
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// Who reads a predicate or a function, and who changes it; in a problem also how often it stands in the initial state.
fn uses(workspace: &Workspace, id: SourceId, tree: &Tree<'_>, target: Target) -> Vec<String> {
    let named = |id: SourceId| -> Vec<Occurrence> {
        let here = workspace.analysis(id).occurrences.list.iter();
        here.filter(|one| one.symbol == target.symbol).copied().collect()
    };
    let sections = outline::sections(tree);
    let here = named(target.home);
    let mut facts = Vec::new();
    let kinds: &[(&str, &[Role])] = match target.symbol.namespace() {
        Namespace::Predicate => &[
            ("read by", &[Role::Read]),
            ("added by", &[Role::Add]),
            ("deleted by", &[Role::Delete]),
        ],
        _ => &[("read by", &[Role::Read]), ("written by", &[Role::Write])],
    };
    for (words, roles) in kinds {
        let owners = owners(&sections, &here, roles);
        if !owners.is_empty() {
            facts.push(format!("{words} {}", words::listed(owners)));
        }
    }
    let changed = here.iter().any(|one| matches!(one.role, Role::Add | Role::Delete | Role::Write));
    if !changed {
        facts.push("never changed by an action".to_owned());
    }
    if id != target.home && workspace.is_problem(id) {
        let there = named(id);
        let initial = there.iter().filter(|one| one.role == Role::Initial).count();
        let read = there.iter().filter(|one| one.role == Role::Read).count();
        facts.push(format!(
            "{} here",
            words::count(initial, "initial entry").replace("entrys", "entries")
        ));
        if read > 0 {
            facts.push("named in the goal or the metric".to_owned());
        }
    }
    facts
}

/// What is above and below a type, and which objects are of it.
fn hierarchy(workspace: &Workspace, id: SourceId, domain: &Domain, target: Target) -> Vec<String> {
    let Symbol::Known(_, number) = target.symbol else { return Vec::new() };
    let of = TypeId(number);
    let name = |id: &TypeId| domain.types[id.index()].name.text.as_str();
    let mut facts = Vec::new();
    let above: Vec<&str> = domain.types[of.index()]
        .ancestors
        .iter()
        .filter(|&&above| above != of && above != TypeId(0))
        .map(name)
        .collect();
    if !above.is_empty() {
        facts.push(format!("above it: {}", words::listed(above)));
    }
    let ids: Vec<TypeId> = (0..domain.types.len() as u32).map(TypeId).collect();
    let below: Vec<&str> =
        ids.iter().filter(|&&sub| sub != of && domain.is_subtype(sub, of)).map(name).collect();
    if !below.is_empty() {
        facts.push(format!("below it: {}", words::listed(below)));
    }
    let objects = workspace.problem(id).map_or(&domain.constants, |problem| &problem.objects);
    let those: Vec<&str> = objects
        .iter()
        .filter(|object| domain.has_type(object, &[of]))
        .map(|object| object.name.text.as_str())
        .collect();
    if !those.is_empty() {
        facts.push(format!("{}: {}", words::count(those.len(), "object"), words::listed(those)));
    }
    facts
}

/// What an action reads and changes.
fn doings(workspace: &Workspace, tree: &Tree<'_>, target: Target) -> Vec<String> {
    let Symbol::Known(_, declared) = target.symbol else { return Vec::new() };
    let sections = outline::sections(tree);
    let Some(section) = outline::around(&sections, declared) else { return Vec::new() };
    let inside =
        workspace.analysis(target.home).occurrences.within(section.span.start, section.span.end);
    let mut facts = Vec::new();
    for (words, role) in [
        ("reads", Role::Read),
        ("adds", Role::Add),
        ("deletes", Role::Delete),
        ("writes", Role::Write),
    ] {
        let mut names: Vec<&str> = Vec::new();
        for one in inside.iter().filter(|one| one.role == role) {
            let kind = one.symbol.namespace();
            let name = workspace.sources().text(one.span);
            if matches!(kind, Namespace::Predicate | Namespace::Function) && !names.contains(&name)
            {
                names.push(name);
            }
        }
        if !names.is_empty() {
            facts.push(format!("{words} {}", words::listed(names)));
        }
    }
    facts
}

/// The parameters of what is applied at a place: of a predicate, a function, an action or a task.
pub(super) fn parameters(domain: &Domain, symbol: Symbol) -> Option<(&str, &[Variable])> {
    let Symbol::Known(namespace, number) = symbol else { return None };
    match namespace {
        Namespace::Predicate => {
            let found = domain.predicates.get(number as usize)?;
            Some((&found.name.text, &found.parameters))
        }
        Namespace::Function => {
            let found = domain.functions.get(number as usize)?;
            Some((&found.name.text, &found.parameters))
        }
        Namespace::Action | Namespace::Task => {
            let found = signature_at(domain, number)?;
            Some((&found.name.text, &found.parameters))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::hover;
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};

    #[track_caller]
    fn shown(texts: &[&str]) -> Option<String> {
        let (workspace, id, offset) = workspace(texts);
        hover(&workspace, id, offset).map(|(_, text)| text)
    }

    /// With the cursor at the end of the first `place` in the domain.
    #[track_caller]
    fn domain(place: &str) -> String {
        shown(&[&DOMAIN.replacen(place, &format!("{place}$0"), 1)])
            .expect("there is something to say")
    }

    #[track_caller]
    fn problem(place: &str) -> String {
        let text = PROBLEM.replacen(place, &format!("{place}$0"), 1);
        shown(&[DOMAIN, &text]).expect("there is something to say")
    }

    #[test]
    fn predicates_with_their_comment_and_their_users() {
        assert_eq!(
            domain("(at"),
            "```pddl
(at ?d - dish ?p - place)
```

where a dish stands

- read by `wash`, `move`
- added by `move`
- deleted by `move`
"
        );
        assert_eq!(
            problem("(clean"),
            "```pddl
(clean ?d - dish)
```

nothing sticks to it

- added by `wash`
- 0 initial entries here
- named in the goal or the metric
"
        );
    }

    #[test]
    fn functions() {
        assert_eq!(
            problem("(effort"),
            "```pddl
(effort ?d - dish) - number
```
- read by `wash`
- never changed by an action
- 1 initial entry here
"
        );
        assert_eq!(
            domain("(increase (total-cost"),
            "```pddl\n(total-cost) - number\n```\n- written by `wash`\n"
        );
    }

    #[test]
    fn types_with_those_around_them() {
        assert_eq!(
            problem("mug - cup"),
            "```pddl\ncup - dish\n```\n- above it: `dish`\n- 1 object: `mug`\n"
        );
        assert_eq!(
            domain("?d - dish"),
            "```pddl\ndish - object\n```\n- below it: `cup`, `plate`\n"
        );
    }

    #[test]
    fn objects_variables_and_actions() {
        assert_eq!(problem("(at mug"), "```pddl\nmug - cup ; object\n```\n");
        assert_eq!(domain("?d sink"), "```pddl\nsink - place ; constant\n```\n");
        assert_eq!(
            domain("(at ?d ?from"),
            "```pddl\n?from - place ; parameter of action `move`\n```\n"
        );
        assert_eq!(domain("(at ?d"), "```pddl\n?d - dish ; parameter of `at`\n```\n");
        assert_eq!(
            domain(":action wash"),
            "```pddl
(:action wash
  :parameters (?d - dish))
```

Water does it.

- reads `at`, `effort`
- adds `clean`
- writes `total-cost`
"
        );
    }

    #[test]
    fn what_quantifiers_bind() {
        let text = DOMAIN.replace("(at ?d sink)", "(forall (?e - cup) (at ?$0e sink))");
        assert_eq!(
            shown(&[&text]).as_deref(),
            Some("```pddl\n?e - cup ; bound by `forall` in action `wash`\n```\n")
        );
    }

    #[test]
    fn words_of_the_language() {
        assert_eq!(domain(":typing"), "`:typing`: types\n");
        assert_eq!(domain("(and"), "`and`: all of them hold\n");
        assert_eq!(domain(":precondition"), "`:precondition`: what must hold before\n");
    }

    #[test]
    fn nothing_where_nothing_is_known() {
        assert_eq!(
            shown(&[&DOMAIN.replace("(clean ?d) (increase", "(cle$0en ?d) (increase")]),
            None
        );
        assert_eq!(shown(&[&DOMAIN.replace("; Water", "; W$0ater")]), None);
        assert_eq!(shown(&["$0"]), None);
    }

    #[test]
    fn plans_know_actions_and_objects() {
        let text = shown(&[DOMAIN, PROBLEM, "(mo$0ve mug shelf sink)"]).expect("it is an action");
        assert!(text.starts_with("```pddl\n(:action move\n"), "{text}");
        let text = shown(&[DOMAIN, PROBLEM, "(move mug she$0lf sink)"]).expect("it is an object");
        assert_eq!(text, "```pddl\nshelf - place ; object\n```\n");
    }
}
