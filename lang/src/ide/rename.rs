//! A name and another one go in; the places come out at which to write it, in all texts, or why that cannot be done.

use super::{Target, Workspace, path};
use crate::lexer::is_plain_text;
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Role, Symbol};
use crate::tree::Tree;

/// Why a name stays, for a person to read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal(pub String);

/// The name at `offset`, if it can be renamed.
pub fn prepare_rename(workspace: &Workspace, id: SourceId, offset: u32) -> Result<Span, Refusal> {
    target(workspace, id, offset).map(|(span, _)| span)
}

/// Writes `name` wherever the name at `offset` stands.
pub fn rename(
    workspace: &Workspace,
    id: SourceId,
    offset: u32,
    name: &str,
) -> Result<Vec<(Span, String)>, Refusal> {
    let (span, target) = target(workspace, id, offset)?;
    let namespace = target.symbol.namespace();
    let name = valid(name.trim(), namespace)?;
    // Another spelling of the same name is not taken.
    if !workspace.sources().text(span).eq_ignore_ascii_case(&name) {
        free(workspace, target, &name)?;
    }
    let found = workspace.occurrences(target);
    Ok(found.into_iter().map(|one| (one.span, name.clone())).collect())
}

/// What stands at `offset`, if it has a declaration.
fn target(workspace: &Workspace, id: SourceId, offset: u32) -> Result<(Span, Target), Refusal> {
    let Some(at) = workspace.at(id, offset) else {
        return Err(Refusal("there is no name here that could be changed".to_owned()));
    };
    let spelling = workspace.sources().text(at.span);
    match workspace.target(id, at.symbol) {
        Some(target) if !workspace.declarations(target).is_empty() => Ok((at.span, target)),
        Some(_) => Err(Refusal(format!("`{spelling}` is part of the language"))),
        None => {
            let what = at.symbol.namespace().describe();
            Err(Refusal(format!("the {what} `{spelling}` is not declared")))
        }
    }
}

/// The name as it is written, if it is one.
fn valid(name: &str, namespace: Namespace) -> Result<String, Refusal> {
    let variable = namespace == Namespace::Variable;
    let bare = if variable { name.strip_prefix('?').unwrap_or(name) } else { name };
    let delimiter = |letter: char| letter.is_whitespace() || "();?:".contains(letter);
    let opening = bare.chars().next();
    let fine = is_plain_text(bare)
        && !bare.contains(delimiter)
        && opening.is_some_and(|letter| {
            letter.is_ascii_alphabetic() || letter == '_' || letter.is_ascii_digit()
        })
        && bare.chars().any(|letter| letter.is_ascii_alphabetic());
    if !fine {
        let what = namespace.describe();
        return Err(Refusal(format!(
            "`{name}` is no name for a {what}: it takes letters, digits, `-` and `_`"
        )));
    }
    let reserved: &[&str] = match namespace {
        Namespace::Predicate | Namespace::Function => &WORDS,
        Namespace::Type => &["object", "either", "number"],
        _ => &[],
    };
    if reserved.iter().any(|word| word.eq_ignore_ascii_case(bare)) {
        return Err(Refusal(format!("`{bare}` is a word of the language")));
    }
    Ok(if variable { format!("?{bare}") } else { bare.to_owned() })
}

/// What a predicate or a function cannot be called, since it means something else at the head of a list.
const WORDS: [&str; 15] = [
    "and",
    "or",
    "not",
    "imply",
    "when",
    "forall",
    "exists",
    "assign",
    "increase",
    "decrease",
    "scale-up",
    "scale-down",
    "preference",
    "always",
    "sometime",
];

/// Whether nothing else has the name where it would be used.
fn free(workspace: &Workspace, target: Target, name: &str) -> Result<(), Refusal> {
    let namespace = target.symbol.namespace();
    if namespace == Namespace::Variable {
        return free_variable(workspace, target, name);
    }
    for id in workspace.group(target.home) {
        let taken = workspace.analysis(id).occurrences.list.iter().find(|one| {
            one.symbol.namespace() == namespace
                && one.symbol != target.symbol
                && one.role == Role::Declare
                && workspace.sources().text(one.span).eq_ignore_ascii_case(name)
        });
        if taken.is_some() {
            let what = namespace.describe();
            let place = &workspace.sources().get(id).name;
            return Err(Refusal(format!("there is another {what} `{name}` in {place}")));
        }
    }
    // An object must not get the name of a constant of its domain either.
    let above = workspace.home(target.home).filter(|&home| home != target.home);
    if namespace == Namespace::Object && above.is_some() {
        let constants = &workspace.domain(target.home).constants;
        if constants.iter().any(|constant| constant.name.text.eq_ignore_ascii_case(name)) {
            return Err(Refusal(format!("the domain has a constant `{name}`")));
        }
    }
    Ok(())
}

/// Whether no other variable of that name can be seen from where this one can.
fn free_variable(workspace: &Workspace, target: Target, name: &str) -> Result<(), Refusal> {
    let tree = workspace.tree(target.home);
    let Symbol::Known(_, declared) = target.symbol else { return Ok(()) };
    let own = extent(&tree, declared);
    for other in &workspace.analysis(target.home).occurrences.variables {
        let at = other.name.span.start;
        let theirs = extent(&tree, at);
        let meets = theirs.start < own.end && own.start < theirs.end;
        if at != declared && meets && bare(&other.name.text).eq_ignore_ascii_case(bare(name)) {
            return Err(Refusal(format!("there is another variable `{name}` here")));
        }
    }
    Ok(())
}

fn bare(variable: &str) -> &str {
    variable.strip_prefix('?').unwrap_or(variable)
}

/// The list in which a variable can be seen that is declared at a byte.
pub(super) fn extent(tree: &Tree<'_>, declared: u32) -> Span {
    let mut path = path(tree, declared);
    path.pop();
    let Some(list) = path.pop() else { return Span::new(tree.source, declared, declared) };
    let first = tree.children(list).next();
    let names =
        first.is_some_and(|first| !tree.is_list(first) && !tree.slice(first).starts_with('?'));
    let above = path.last().copied();
    let rule = above.and_then(|above| super::outline::head(tree, above));
    let heads_rule = rule.is_some_and(|head| head.eq_ignore_ascii_case(":derived"));
    match above {
        Some(above) if !names || heads_rule => tree.span(above),
        _ => tree.span(list),
    }
}

#[cfg(test)]
mod tests {
    use super::{prepare_rename, rename};
    use crate::ide::fixture::{DOMAIN, PROBLEM, edited, workspace};

    /// The texts after the name at the cursor is renamed, or why it is not.
    #[track_caller]
    fn renamed(texts: &[&str], name: &str) -> Result<Vec<String>, String> {
        let (workspace, id, offset) = workspace(texts);
        let edits = rename(&workspace, id, offset, name).map_err(|refusal| refusal.0)?;
        Ok(edited(&workspace, &edits))
    }

    /// With the cursor behind the first `place`.
    #[track_caller]
    fn domain(place: &str, name: &str) -> Result<Vec<String>, String> {
        renamed(&[&DOMAIN.replacen(place, &format!("{place}$0"), 1), PROBLEM, PLAN], name)
    }

    const PLAN: &str = "(MOVE mug shelf sink)\n(wash mug)\n";

    #[test]
    fn predicates_everywhere() {
        let texts = domain("(clean", "tidy").expect("it can be renamed");
        assert_eq!(
            texts,
            [DOMAIN.replace("clean", "tidy"), PROBLEM.replace("clean", "tidy"), PLAN.to_owned()]
        );
    }

    #[test]
    fn other_kinds_of_names() {
        let texts = domain(":action move", "carry").expect("it can be renamed");
        assert_eq!(texts[0], DOMAIN.replace("action move", "action carry"));
        assert_eq!(texts[2], "(carry mug shelf sink)\n(wash mug)\n");
        let texts = domain("(:types cup", "mugs").expect("it can be renamed");
        assert_eq!(texts[1], PROBLEM.replace("- cup", "- mugs"));
        let texts = domain("constants sink", "basin").expect("it can be renamed");
        assert_eq!(texts[0], DOMAIN.replace("sink", "basin"));
        assert_eq!(texts[2], PLAN.replace("sink", "basin"));
        let texts = domain("(domain kitchen", "galley").expect("it can be renamed");
        assert_eq!(texts[1], PROBLEM.replace("kitchen", "galley"));
        let texts = domain("(effort", "toil").expect("it can be renamed");
        assert_eq!(texts[1], PROBLEM.replace("effort", "toil"));
    }

    #[test]
    fn a_variable_keeps_its_mark_and_its_action() {
        for name in ["?dish", "dish"] {
            let texts = domain(":parameters (?d", name).expect("it can be renamed");
            let (head, wash) = DOMAIN.split_at(DOMAIN.find("  ; Water").expect("it is there"));
            let (wash, move_) = wash.split_at(wash.find("  (:action move").expect("it is there"));
            assert_eq!(texts[0], format!("{head}{}{move_}", wash.replace("?d", "?dish")));
        }
    }

    #[test]
    fn an_object_in_a_problem_and_its_plan() {
        let text = PROBLEM.replacen("(at mug", "(at m$0ug", 1);
        let texts = renamed(&[DOMAIN, &text, PLAN], "jug").expect("it can be renamed");
        assert_eq!(
            texts,
            [DOMAIN.to_owned(), PROBLEM.replace("mug", "jug"), PLAN.replace("mug", "jug")]
        );
    }

    #[test]
    fn what_is_taken_or_no_name_is_refused() {
        let refused = |place, name| domain(place, name).expect_err("it cannot be renamed");
        assert_eq!(
            refused("(clean", "AT"),
            "there is another predicate `AT` in 1.pddl".replace("1.", "0.")
        );
        assert_eq!(refused("(clean", "not"), "`not` is a word of the language");
        assert_eq!(
            refused(":parameters (?d - dish ?from", "to"),
            "there is another variable `?to` here"
        );
        assert_eq!(refused("constants sink", "mug"), "there is another object `mug` in 1.pddl");
        for name in ["", "a b", "(a", "?x", "ä", "12", ":x", "-"] {
            assert!(refused("(clean", name).contains("is no name for a predicate"), "{name}");
        }
        assert_eq!(refused(") - number", "n"), "there is no name here that could be changed");
        let text = PROBLEM.replacen("(at mug", "(at m$0ug", 1);
        let refusal = renamed(&[DOMAIN, &text], "sink").expect_err("it is taken");
        assert_eq!(refusal, "the domain has a constant `sink`");
    }

    #[test]
    fn variables_of_one_name_do_not_meet() {
        let text = "(define (domain d) (:predicates (p ?x ?y) (q ?z$0))
  (:action a :parameters (?x) :precondition (and (forall (?y) (p ?x ?y)) (exists (?z) (p ?x ?z))) :effect (q ?x)))";
        // The parameters of declarations and of sibling quantifiers are apart from one another.
        assert!(renamed(&[text], "x").is_ok());
        let text = text.replace("$0", "").replace("(?y) (p", "(?y$0) (p");
        assert!(renamed(&[&text], "z").is_ok());
        assert!(renamed(&[&text], "x").is_err());
    }

    #[test]
    fn another_case_is_the_same_name() {
        assert!(
            domain("(clean", "Clean").expect("it can be renamed")[0].contains("(Clean ?d - dish)")
        );
    }

    #[test]
    fn what_can_be_renamed_is_said_before() {
        let at = |text: &str| {
            let (workspace, id, offset) = workspace(&[text]);
            let span = prepare_rename(&workspace, id, offset);
            span.map(|span| workspace.sources().text(span).to_owned()).map_err(|refusal| refusal.0)
        };
        assert_eq!(at(&DOMAIN.replace("(clean ?d)", "(cl$0ean ?d)")), Ok("clean".to_owned()));
        let unknown = at(&DOMAIN.replace("(clean ?d) (", "(cl$0en ?d) ("));
        assert_eq!(unknown, Err("the predicate `clen` is not declared".to_owned()));
    }
}
