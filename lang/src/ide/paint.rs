//! A text goes in; its words come out with what each of them is, for colours.

use super::{Workspace, glossary};
use crate::lexer::is_dash;
use crate::source::{SourceId, Span};
use crate::symbol::{Namespace, Occurrence, Role, Symbol};
use crate::tree::{Node, NodeId, NodeKind, Tree};

/// What a word is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each says its name")]
pub enum Paint {
    Keyword,
    Type,
    Predicate,
    Function,
    Variable,
    /// A variable that an action, a method or a declaration has as a parameter.
    Parameter,
    Object,
    Action,
    /// What the text defines, and names of parts of it.
    Name,
    Number,
    Operator,
    Comment,
}

/// A word with what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Painted {
    /// The word.
    pub span: Span,
    /// What it is.
    pub paint: Paint,
    /// Whether it is declared here.
    pub declares: bool,
    /// Whether it gets another value here.
    pub changes: bool,
}

/// All words of a text that are something, in their order.
pub fn paint(workspace: &Workspace, id: SourceId) -> Vec<Painted> {
    let tree = workspace.tree(id);
    let parameters = parameters(&tree);
    let mut names = workspace.analysis(id).occurrences.list.iter().peekable();
    let mut painted = Vec::new();
    // Whether the next word is the first of its list.
    let mut heads = false;
    for (at, node) in tree.nodes().iter().enumerate() {
        let span = Span::new(id, node.start, node.end);
        let plain = |paint| Painted { span, paint, declares: false, changes: false };
        match node.kind {
            NodeKind::List | NodeKind::OpenList => heads = true,
            NodeKind::Comment => painted.push(plain(Paint::Comment)),
            NodeKind::Space | NodeKind::Stray => {}
            NodeKind::Atom => {
                while names.next_if(|name| name.span.start < node.start).is_some() {}
                let known = names.peek().and_then(|name| named(name, &parameters));
                match known.filter(|name| name.span == span) {
                    Some(name) => painted.push(name),
                    None => painted.extend(word(tree.slice(NodeId(at as u32)), heads).map(plain)),
                }
                heads = false;
            }
        }
    }
    painted
}

/// The lists of parameters, in the order of the text.
fn parameters(tree: &Tree<'_>) -> Vec<Node> {
    let mut found = Vec::new();
    let mut last = "";
    for (at, node) in tree.nodes().iter().enumerate() {
        match node.kind {
            NodeKind::Atom => last = tree.slice(NodeId(at as u32)),
            NodeKind::List | NodeKind::OpenList => {
                let lists = [":parameters", ":predicates", ":functions"];
                if lists.iter().any(|one| one.eq_ignore_ascii_case(last)) {
                    found.push(*node);
                }
                last = "";
            }
            _ => {}
        }
    }
    found
}

fn named(name: &Occurrence, parameters: &[Node]) -> Option<Painted> {
    let paint = match name.symbol.namespace() {
        Namespace::Type => Paint::Type,
        Namespace::Predicate => Paint::Predicate,
        Namespace::Function => Paint::Function,
        Namespace::Object => Paint::Object,
        Namespace::Action | Namespace::Task | Namespace::Method => Paint::Action,
        Namespace::Variable => {
            let Symbol::Known(_, declared) = name.symbol else { return None };
            let before = parameters.partition_point(|list| list.start <= declared);
            let inside = before.checked_sub(1).is_some_and(|at| declared < parameters[at].end);
            if inside { Paint::Parameter } else { Paint::Variable }
        }
        Namespace::Domain
        | Namespace::Problem
        | Namespace::Preference
        | Namespace::Subtask
        | Namespace::Constraint => Paint::Name,
    };
    Some(Painted {
        span: name.span,
        paint,
        declares: name.role == Role::Declare,
        changes: matches!(name.role, Role::Add | Role::Delete | Role::Write),
    })
}

/// What a word is that is no name.
fn word(text: &str, heads: bool) -> Option<Paint> {
    if text.starts_with(':') {
        return Some(Paint::Keyword);
    }
    if text.starts_with('?') {
        return Some(Paint::Variable);
    }
    let number = text.trim_start_matches(['-', '+', '.']);
    if number.starts_with(|letter: char| letter.is_ascii_digit()) {
        return Some(Paint::Number);
    }
    let signs = ["=", "<", ">", "<=", ">=", "+", "*", "/", "#t"];
    if is_dash(text) || signs.contains(&text) {
        return Some(Paint::Operator);
    }
    let is = |words: &[&str]| words.iter().any(|one| one.eq_ignore_ascii_case(text));
    let leading = [
        "define",
        "domain",
        "problem",
        "either",
        "at",
        "over",
        "oneof",
        "probabilistic",
        "unknown",
    ];
    if heads && (is(&leading) || glossary::meaning(text).is_some()) {
        return Some(Paint::Keyword);
    }
    if is(&["start", "end", "all", "minimize", "maximize"]) {
        return Some(Paint::Keyword);
    }
    is(&["object", "number"]).then_some(Paint::Type)
}

#[cfg(test)]
mod tests {
    use super::{Paint, paint};
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};
    use crate::source::SourceId;

    fn painted(texts: &[&str], id: u32) -> Vec<(String, Paint, bool, bool)> {
        let (workspace, ..) = workspace(texts);
        let found = paint(&workspace, SourceId(id)).into_iter();
        found
            .map(|one| {
                let text = workspace.sources().text(one.span).to_owned();
                (text, one.paint, one.declares, one.changes)
            })
            .collect()
    }

    #[test]
    fn every_word_of_a_domain() {
        let found = painted(&[DOMAIN], 1);
        let has = |text: &str, paint, declares, changes| {
            let wanted = (text.to_owned(), paint, declares, changes);
            assert!(found.contains(&wanted), "{wanted:?} is missing in {found:#?}");
        };
        has("define", Paint::Keyword, false, false);
        has("kitchen", Paint::Name, true, false);
        has(":typing", Paint::Keyword, false, false);
        has("cup", Paint::Type, true, false);
        has("-", Paint::Operator, false, false);
        has("sink", Paint::Object, true, false);
        has("at", Paint::Predicate, true, false);
        has("at", Paint::Predicate, false, true);
        has("?from", Paint::Parameter, true, false);
        has("; Water does it.", Paint::Comment, false, false);
        has("wash", Paint::Action, true, false);
        has("total-cost", Paint::Function, false, true);
        has("and", Paint::Keyword, false, false);
        has("number", Paint::Type, false, false);
        let words = crate::lexer::lex(DOMAIN).into_iter().filter(|token| {
            matches!(token.kind, crate::lexer::TokenKind::Atom | crate::lexer::TokenKind::Comment)
        });
        assert_eq!(found.len(), words.count());
    }

    #[test]
    fn numbers_objects_and_what_quantifiers_bind() {
        let text = PROBLEM.replace("(clean mug)", "(forall (?c - cup) (clean ?c))");
        let found = painted(&[DOMAIN, &text], 2);
        let has = |text: &str, paint, declares| {
            assert!(
                found.contains(&(text.to_owned(), paint, declares, false)),
                "{text} in {found:#?}"
            );
        };
        has("2", Paint::Number, false);
        has("mug", Paint::Object, true);
        has("?c", Paint::Variable, true);
        has("?c", Paint::Variable, false);
    }
}
