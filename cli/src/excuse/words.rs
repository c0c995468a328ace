//! Facts and changes go in; clauses of English sentences come out: `pink-drawer is open`, `the key were in box`.
//!
//! A fact about one object is an adjective of it, one about two a relation between them. Predicates that read otherwise (`has-image`, `can-reach`) keep
//! their verb, and whatever has more arguments is quoted as it is written.

use lang::model::{Domain, Fact, ObjectId, Problem};
use planner::excuse::Change;

/// The names by which a domain and a problem speak.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// The domain.
    pub domain: &'a Domain,
    /// The problem, with all objects.
    pub problem: &'a Problem,
}

/// How a fact stands in a sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mood {
    /// It is so.
    Is,
    /// It is not so.
    IsNot,
    /// If it were so.
    Were,
    /// If it were not so.
    WereNot,
}

/// Words that begin the name of a predicate and are verbs of their own.
const VERBS: [&str; 8] = ["has", "have", "can", "needs", "knows", "contains", "supports", "wants"];

impl Words<'_> {
    /// An object.
    pub fn object(self, object: ObjectId) -> String {
        self.problem.objects[object.index()].name.text.clone()
    }

    /// A fact as PDDL.
    pub fn atom(self, fact: &Fact) -> String {
        let mut text = format!("({}", self.domain.predicates[fact.predicate.index()].name.text);
        for &object in &fact.arguments {
            text.push(' ');
            text.push_str(&self.object(object));
        }
        text.push(')');
        text
    }

    /// The name of a predicate as words, its verb apart.
    fn predicate(self, fact: &Fact) -> (Option<String>, String) {
        let name =
            self.domain.predicates[fact.predicate.index()].name.text.replace(['-', '_'], " ");
        let name = name.to_lowercase();
        let (first, rest) = name.split_once(' ').unwrap_or((&name, ""));
        if first == "is" && !rest.is_empty() {
            return (None, rest.to_owned());
        }
        match VERBS.contains(&first) {
            true => (Some(first.to_owned()), rest.to_owned()),
            false => (None, name),
        }
    }

    /// A fact as a clause. `it` says whether its subject was named just before.
    pub fn clause(self, fact: &Fact, mood: Mood, it: bool) -> String {
        let (is, holds) = match mood {
            Mood::Is => ("is", "holds"),
            Mood::IsNot => ("is not", "does not hold"),
            Mood::Were => ("were", "held"),
            Mood::WereNot => ("were not", "did not hold"),
        };
        let subject = |object: ObjectId| if it { "it".to_owned() } else { self.object(object) };
        let (verb, rest) = self.predicate(fact);
        match (&*fact.arguments, verb) {
            ([one], None) => format!("{} {is} {rest}", subject(*one)),
            ([one, other], None) => {
                format!("{} {is} {rest} {}", subject(*one), self.object(*other))
            }
            ([one, others @ ..], Some(verb)) if others.len() < 2 => {
                let verb = match (mood, verb.as_str()) {
                    (Mood::Is, verb) => verb.to_owned(),
                    (Mood::IsNot, "can") => "cannot".to_owned(),
                    (Mood::Were, "can") => "could".to_owned(),
                    (Mood::WereNot, "can") => "could not".to_owned(),
                    (Mood::Were, "has") => "had".to_owned(),
                    (Mood::IsNot, "has") => "does not have".to_owned(),
                    (Mood::WereNot, "has") => "did not have".to_owned(),
                    (mood, _) => return self.quoted(fact, mood, holds),
                };
                let others: String =
                    others.iter().map(|&other| format!(" {}", self.object(other))).collect();
                let rest = if rest.is_empty() { rest } else { format!(" {rest}") };
                format!("{} {verb}{rest}{others}", subject(*one))
            }
            _ => self.quoted(fact, mood, holds),
        }
    }

    fn quoted(self, fact: &Fact, _: Mood, holds: &str) -> String {
        format!("`{}` {holds}", self.atom(fact))
    }

    /// What an action does that makes a fact true: `makes pink-drawer open`.
    pub fn makes(self, fact: &Fact) -> String {
        let (verb, rest) = self.predicate(fact);
        match (&*fact.arguments, verb) {
            ([one], None) => format!("makes {} {rest}", self.object(*one)),
            ([one, other], None) => {
                format!("makes {} {rest} {}", self.object(*one), self.object(*other))
            }
            _ => format!("makes `{}` true", self.atom(fact)),
        }
    }

    /// What a goal asks for, after "the goal needs": `red-plate inside pink-drawer`.
    pub fn wish(self, fact: &Fact) -> String {
        let (verb, rest) = self.predicate(fact);
        match (&*fact.arguments, verb) {
            ([one], None) => format!("{} {rest}", self.object(*one)),
            ([one, other], None) => format!("{} {rest} {}", self.object(*one), self.object(*other)),
            _ => format!("`{}`", self.atom(fact)),
        }
    }

    /// A change as a clause after "if".
    pub fn change(self, change: &Change, it: bool) -> String {
        if let Some((object, of)) = change.object {
            let (name, of) = (self.object(object), &self.domain.types[of.index()].name.text);
            return format!("there were another {of}, {name}");
        }
        match (&change.from, &change.to) {
            (_, Some(to)) => self.clause(to, Mood::Were, it),
            (Some(from), None) => self.clause(from, Mood::WereNot, it),
            (None, None) => String::new(),
        }
    }
}

/// Parts of a sentence, with commas and a last "and".
pub fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
