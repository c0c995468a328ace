//! A valid [`Text`] goes in; the same text with one mistake comes out, if there is a place for a mistake of that kind.
//!
//! When a change counts as a mistake, and which lines are right for the message:
//!
//! - A dropped or doubled parenthesis always counts.
//!   Of a dropped `)` a reader cannot tell where in its list it stood:
//!   right is every line from that of its `(` to that of the `)`.
//!   Of parentheses on one line with at most blanks between them, `)))`, one can be dropped as well as the other, with the same result:
//!   right is what is right for any of them.
//!   Of a dropped `(` and of a doubled parenthesis the line is that of the change.
//! - A misspelt word has one letter too many, too few, changed, or two that changed places.
//!   Only uses are misspelt: a declaration that is misspelt cannot be told from uses that are.
//!   What is used and never declared, such as a type that stands after a `-` in `:types` only, counts as declaration.
//!   It does not count if the new word exists too, in the same role: that is another text and not a misspelt one;
//!   and a single letter is neither dropped nor changed, since nothing would be left of the word.
//! - A dropped argument counts where a predicate or a function that is declared once is applied.
//!   Right are the lines of the atom.
//! - Swapped arguments count where one of the two may not stand where the other stood, by the declared types.
//!   Right are the lines of the two.
//! - A dropped requirement counts if the text uses something that no other of its requirements allows;
//!   see `requirement.rs`. Right are the lines of such uses, and that of `:requirements`.

use std::ops::{Range, RangeInclusive};

use lang::lexer::TokenKind;
use lang::model::TypeId;
use lang::symbol::{Namespace, Symbol};
use lang::tree::NodeId;

use crate::requirement;
use crate::text::{Random, Text, line_of};

/// A way to break a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    DropClose,
    DropOpen,
    DoubleClose,
    DoubleOpen,
    Predicate,
    Function,
    Variable,
    Type,
    Object,
    Connective,
    Field,
    Section,
    Requirement,
    DropArgument,
    SwapArguments,
    DropRequirement,
}

/// All of them.
pub const KINDS: [Kind; 16] = [
    Kind::DropClose,
    Kind::DropOpen,
    Kind::DoubleClose,
    Kind::DoubleOpen,
    Kind::Predicate,
    Kind::Function,
    Kind::Variable,
    Kind::Type,
    Kind::Object,
    Kind::Connective,
    Kind::Field,
    Kind::Section,
    Kind::Requirement,
    Kind::DropArgument,
    Kind::SwapArguments,
    Kind::DropRequirement,
];

impl Kind {
    /// As the table has it, and as `--show` takes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::DropClose => "drop-close",
            Self::DropOpen => "drop-open",
            Self::DoubleClose => "double-close",
            Self::DoubleOpen => "double-open",
            Self::Predicate => "misspell-predicate",
            Self::Function => "misspell-function",
            Self::Variable => "misspell-variable",
            Self::Type => "misspell-type",
            Self::Object => "misspell-object",
            Self::Connective => "misspell-connective",
            Self::Field => "misspell-field",
            Self::Section => "misspell-section",
            Self::Requirement => "misspell-requirement",
            Self::DropArgument => "drop-argument",
            Self::SwapArguments => "swap-arguments",
            Self::DropRequirement => "drop-requirement",
        }
    }
}

/// A broken text.
pub struct Mutation {
    pub text: String,
    /// What was done, for a reader of the failures.
    pub what: String,
    /// Where.
    pub at: usize,
    /// The lines on which it may be reported.
    pub lines: Vec<RangeInclusive<usize>>,
    /// Of a misspelt word: how it was spelt, and where the misspelling stands.
    pub original: Option<(String, Range<usize>)>,
}

/// Breaks the text in one place.
pub fn mutate(kind: Kind, text: &Text<'_>, random: &mut Random) -> Option<Mutation> {
    match kind {
        Kind::DropClose | Kind::DropOpen | Kind::DoubleClose | Kind::DoubleOpen => {
            parenthesis(kind, text, random)
        }
        Kind::Predicate => name(Namespace::Predicate, text, random),
        Kind::Function => name(Namespace::Function, text, random),
        Kind::Variable => name(Namespace::Variable, text, random),
        Kind::Type => name(Namespace::Type, text, random),
        Kind::Object => name(Namespace::Object, text, random),
        Kind::Connective | Kind::Field | Kind::Section | Kind::Requirement => {
            keyword(kind, text, random)
        }
        Kind::DropArgument => drop_argument(text, random),
        Kind::SwapArguments => swap_arguments(text, random),
        Kind::DropRequirement => drop_requirement(text, random),
    }
}

fn parenthesis(kind: Kind, text: &Text<'_>, random: &mut Random) -> Option<Mutation> {
    let wanted = match kind {
        Kind::DropClose | Kind::DoubleClose => TokenKind::Close,
        _ => TokenKind::Open,
    };
    let places: Vec<usize> =
        (0..text.tokens.len()).filter(|&index| text.tokens[index].kind == wanted).collect();
    let index = *random.pick(&places)?;
    let at = text.tokens[index].start as usize;
    let line = line_of(text.whole, at);
    let mut broken = text.whole.to_owned();
    let paren = if wanted == TokenKind::Open { "(" } else { ")" };
    let (lines, verb) = match kind {
        Kind::DropClose => {
            broken.remove(at);
            // The run of `)` with at most blanks between them.
            let touches = |&other: &usize| {
                let there = text.tokens[other].start as usize;
                let between = &text.whole[at.min(there)..at.max(there)];
                between.bytes().all(|byte| matches!(byte, b')' | b' ' | b'\t'))
                    && text.tokens[other].kind == TokenKind::Close
            };
            let before = (0..index).rev().take_while(touches);
            let after = (index..text.tokens.len()).take_while(touches);
            let ends = before.chain(after).map(|other| text.tokens[other].end);
            let first = ends
                .filter_map(|end| {
                    text.tree
                        .nodes()
                        .iter()
                        .find(|node| node.end == end && node.kind == lang::tree::NodeKind::List)
                })
                .map(|list| line_of(text.whole, list.start as usize))
                .min();
            (first.unwrap_or(line)..=line, "dropped")
        }
        Kind::DropOpen => {
            broken.remove(at);
            (line..=line, "dropped")
        }
        _ => {
            broken.insert_str(at, paren);
            (line..=line, "doubled")
        }
    };
    let column = at - text.whole[..at].rfind('\n').map_or(0, |end| end + 1) + 1;
    let what = format!("`{paren}` {verb} at {line}:{column}");
    Some(Mutation { text: broken, what, at, lines: vec![lines], original: None })
}

/// The word with one mistake of a typist in it.
fn misspell(word: &str, random: &mut Random) -> Option<String> {
    let letters: Vec<usize> =
        word.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()).map(|(at, _)| at).collect();
    let at = *random.pick(&letters)?;
    let letter = ["a", "c", "e", "i", "l", "n", "o", "r", "s", "t"][random.below(10)];
    let mut broken = word.to_owned();
    let way = if letters.len() < 2 { 2 } else { random.below(4) };
    match way {
        0 => {
            let next = letters.iter().copied().find(|&next| next == at + 1)?;
            let pair = format!("{}{}", &word[next..=next], &word[at..=at]);
            broken.replace_range(at..=next, &pair);
        }
        1 => {
            broken.remove(at);
        }
        2 => broken.insert_str(at, letter),
        _ => broken.replace_range(at..=at, letter),
    }
    (!broken.eq_ignore_ascii_case(word)).then_some(broken)
}

/// The text with another word at `range`.
fn replaced(text: &Text<'_>, start: u32, end: u32, word: &str) -> Mutation {
    let (start, end) = (start as usize, end as usize);
    let mut broken = text.whole.to_owned();
    broken.replace_range(start..end, word);
    let line = line_of(text.whole, start);
    let original = &text.whole[start..end];
    Mutation {
        text: broken,
        what: format!("`{original}` misspelt as `{word}` on line {line}"),
        at: start,
        lines: vec![line..=line],
        original: Some((original.to_owned(), start..start + word.len())),
    }
}

/// Words that mean something at the start of a formula.
const WORDS: [&str; 26] = [
    "and",
    "or",
    "not",
    "imply",
    "forall",
    "exists",
    "when",
    "either",
    "increase",
    "decrease",
    "assign",
    "scale-up",
    "scale-down",
    "at",
    "over",
    "all",
    "start",
    "end",
    "preference",
    "always",
    "sometime",
    "within",
    "oneof",
    "probabilistic",
    "define",
    "object",
];

fn name(namespace: Namespace, text: &Text<'_>, random: &mut Random) -> Option<Mutation> {
    let uses = text.uses(namespace);
    let span = random.pick(&uses)?.span;
    if namespace == Namespace::Type {
        let section = text.section_at(span.start).map(|(_, keyword)| text.tree.slice(keyword));
        if section.is_some_and(|keyword| keyword.eq_ignore_ascii_case(":types")) {
            return None;
        }
    }
    let broken = misspell(text.slice(span.start, span.end), random)?;
    let within = match namespace {
        // Another action may have a variable of that name.
        Namespace::Variable => text.section_at(span.start).map(|(section, _)| section),
        _ => None,
    };
    let taken = text.is_taken(namespace, &broken, within)
        || namespace == Namespace::Predicate && text.is_taken(Namespace::Function, &broken, None)
        || namespace == Namespace::Function && text.is_taken(Namespace::Predicate, &broken, None)
        || WORDS.iter().any(|word| word.eq_ignore_ascii_case(&broken));
    (!taken).then(|| replaced(text, span.start, span.end, &broken))
}

fn keyword(kind: Kind, text: &Text<'_>, random: &mut Random) -> Option<Mutation> {
    let tree = &text.tree;
    let sections = text.sections();
    let mut words: Vec<NodeId> = Vec::new();
    for &(section, keyword) in &sections {
        let children = tree.children(section).skip(1).filter(|&word| !tree.is_list(word));
        let is = |word: &str| tree.slice(keyword).eq_ignore_ascii_case(word);
        match kind {
            Kind::Section => words.push(keyword),
            Kind::Requirement if is(":requirements") => words.extend(children),
            Kind::Field if is(":action") || is(":durative-action") => {
                words.extend(children.filter(|&word| tree.slice(word).starts_with(':')));
            }
            Kind::Connective if is(":action") || is(":derived") || is(":goal") => {
                let inside = section.0..tree.node(section).next;
                let heads = inside.map(NodeId).filter(|&list| tree.is_list(list));
                let heads = heads.filter_map(|list| tree.children(list).next());
                words.extend(heads.filter(|&head| {
                    WORDS[..7].iter().any(|word| word.eq_ignore_ascii_case(tree.slice(head)))
                }));
            }
            _ => {}
        }
    }
    let node = tree.node(*random.pick(&words)?);
    let broken = misspell(text.slice(node.start, node.end), random)?;
    let taken = text.is_taken(Namespace::Predicate, &broken, None)
        || words.iter().any(|&word| tree.slice(word).eq_ignore_ascii_case(&broken))
        || WORDS.iter().any(|word| word.eq_ignore_ascii_case(&broken));
    (!taken).then(|| replaced(text, node.start, node.end, &broken))
}

/// Where a predicate or a function is applied: its list, and its arguments.
fn applications(text: &Text<'_>) -> Vec<(NodeId, Symbol, Vec<NodeId>)> {
    let tree = &text.tree;
    let mut uses = text.uses(Namespace::Predicate);
    uses.extend(text.uses(Namespace::Function));
    uses.iter()
        .filter_map(|one| {
            let list = text.list_at(one.span.start)?;
            let mut children = tree.children(list);
            let head = children.next()?;
            let arguments: Vec<NodeId> = children.collect();
            let plain = arguments.iter().all(|&argument| !tree.is_list(argument));
            let is_head = tree.node(head).start == one.span.start;
            (is_head && plain && !arguments.is_empty()).then_some((list, one.symbol, arguments))
        })
        .collect()
}

fn drop_argument(text: &Text<'_>, random: &mut Random) -> Option<Mutation> {
    let all = applications(text);
    let (list, _, arguments) = random.pick(&all)?;
    let argument = text.tree.node(*random.pick(arguments)?);
    let (start, end) = (argument.start as usize, argument.end as usize);
    let mut broken = text.whole.to_owned();
    broken.replace_range(start..end, "");
    let first = line_of(text.whole, text.tree.node(*list).start as usize);
    let last = line_of(text.whole, start);
    let what = format!("`{}` dropped on line {last}", &text.whole[start..end]);
    Some(Mutation { text: broken, what, at: start, lines: vec![first..=last], original: None })
}

/// The types of a term.
fn types_of(text: &Text<'_>, term: NodeId) -> Option<(Vec<TypeId>, bool)> {
    let start = text.tree.node(term).start;
    let found = text.names.iter().find(|one| one.span.start == start)?;
    let mut sources = lang::source::Sources::default();
    let id = sources.add("text", text.whole);
    match found.symbol {
        Symbol::Known(Namespace::Variable, declared) => {
            let variables = if text.is_domain {
                lang::index_domain(&sources, id).2
            } else {
                lang::index_problem(&sources, id, text.domain).2
            };
            Some((variables.variable(declared)?.types.clone(), false))
        }
        Symbol::Known(Namespace::Object, index) => {
            if text.is_domain {
                return Some((text.domain.constants.get(index as usize)?.types.clone(), true));
            }
            let problem = lang::read_problem(&sources, id, text.domain).0;
            Some((problem.objects.get(index as usize)?.types.clone(), true))
        }
        _ => None,
    }
}

fn swap_arguments(text: &Text<'_>, random: &mut Random) -> Option<Mutation> {
    let all = applications(text);
    let (_, symbol, arguments) = random.pick(&all)?;
    let first = random.below(arguments.len());
    let second = random.below(arguments.len());
    if first >= second {
        return None;
    }
    let parameters = match *symbol {
        Symbol::Known(Namespace::Predicate, id) => {
            &text.domain.predicates.get(id as usize)?.parameters
        }
        Symbol::Known(Namespace::Function, id) => {
            &text.domain.functions.get(id as usize)?.parameters
        }
        _ => return None,
    };
    let fits = |(have, all): &(Vec<TypeId>, bool), at: usize| {
        let Some(parameter) = parameters.get(at) else { return true };
        let wanted = if parameter.types.is_empty() { &[TypeId(0)] } else { &parameter.types[..] };
        let below = |&one: &TypeId| wanted.iter().any(|&above| text.domain.is_subtype(one, above));
        // An object has all of its types; a variable has one of them.
        if *all { have.iter().any(below) } else { have.iter().all(below) }
    };
    let types = (types_of(text, arguments[first])?, types_of(text, arguments[second])?);
    if fits(&types.0, second) && fits(&types.1, first) {
        return None;
    }
    let (a, b) = (text.tree.node(arguments[first]), text.tree.node(arguments[second]));
    let words = (text.slice(a.start, a.end), text.slice(b.start, b.end));
    let broken = format!(
        "{}{}{}{}{}",
        &text.whole[..a.start as usize],
        words.1,
        text.slice(a.end, b.start),
        words.0,
        &text.whole[b.end as usize..]
    );
    let lines = [a.start, b.start].map(|at| line_of(text.whole, at as usize));
    Some(Mutation {
        text: broken,
        what: format!("`{}` and `{}` swapped on line {}", words.0, words.1, lines[0]),
        at: a.start as usize,
        lines: lines.map(|line| line..=line).to_vec(),
        original: None,
    })
}

fn drop_requirement(text: &Text<'_>, random: &mut Random) -> Option<Mutation> {
    let tree = &text.tree;
    let is = |keyword: NodeId| tree.slice(keyword).eq_ignore_ascii_case(":requirements");
    let (section, keyword) =
        text.sections().into_iter().find(|&(_, keyword)| text.is_domain && is(keyword))?;
    let words: Vec<NodeId> = tree.children(section).skip(1).collect();
    let dropped = *random.pick(&words)?;
    let others: Vec<requirement::Feature> = words
        .iter()
        .filter(|&&word| word != dropped)
        .flat_map(|&word| requirement::allows(tree.slice(word)).iter().copied())
        .collect();
    let uses = requirement::uses(text);
    let lost = requirement::allows(tree.slice(dropped)).iter();
    let lost = lost.filter(|feature| !others.contains(feature));
    let mut lines: Vec<RangeInclusive<usize>> =
        lost.filter_map(|feature| uses.get(feature)).flatten().map(|&line| line..=line).collect();
    if lines.is_empty() {
        return None;
    }
    let line = line_of(text.whole, tree.node(keyword).start as usize);
    lines.push(line..=line);
    let node = tree.node(dropped);
    let mut broken = text.whole.to_owned();
    broken.replace_range(node.start as usize..node.end as usize, "");
    let what = format!("`{}` dropped", tree.slice(dropped));
    Some(Mutation { text: broken, what, at: node.start as usize, lines, original: None })
}
