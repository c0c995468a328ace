//! Facts and changes go in; clauses of English sentences come out: `pink-drawer is open`, `the key were in box`.
//!
//! A fact about one object is an adjective of it, one about two a relation between them; where a noun gives each thing one value, it is what the thing has
//! (`the charge of rover1 is level6`). Predicates that begin with a verb (`has-image`, `blocks`) keep it, and whatever has more arguments is quoted as it is
//! written.

use std::fmt::{self, Write};

use lang::condition::Condition;
use lang::model::{Domain, Fact, ObjectId, PredicateId, Problem, Term, VariableId};
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

/// Words that begin the name of a predicate and end like a verb, but are none.
const NO_VERBS: [&str; 8] =
    ["across", "towards", "besides", "always", "as", "its", "this", "sometimes"];

/// What a word that begins the name of a predicate is as a verb without its ending; nothing if it is none.
fn verb(word: &str) -> Option<&str> {
    match word {
        "has" => Some("have"),
        "can" => Some("can"),
        _ if NO_VERBS.contains(&word) || word.ends_with("ss") || word.ends_with("us") => None,
        _ if word.len() < 4 => None,
        _ if ["ches", "shes", "xes", "sses"].iter().any(|end| word.ends_with(end)) => {
            Some(&word[..word.len() - 2])
        }
        _ => word.strip_suffix('s'),
    }
}

/// Words that relate two things, so that a name that begins or ends with one is no noun: the prepositions of English, and adjectives that compare.
const RELATIONS: &str = "aboard about above across after against ahead along alongside among around as at before behind below beneath \
    beside besides between beyond by close down during equal far for free from in inside into larger left less like near next of off \
    on onto opposite out outside over past right same similar since smaller than through to towards under underneath until up upon with within";

/// How participles and adjectives end: `connected`, `holding`, `visible`, `adjacent`.
const ADJECTIVES: [&str; 7] = ["ed", "ing", "able", "ible", "jacent", "parallel", "held"];

/// Whether words are a noun, as far as their form shows.
fn is_noun(words: &str) -> bool {
    let (first, last) = (words.split(' ').next(), words.split(' ').next_back());
    let relates =
        |word: Option<&str>| word.is_none_or(|word| RELATIONS.split(' ').any(|one| one == word));
    !relates(first) && !relates(last) && !ADJECTIVES.iter().any(|end| words.ends_with(end))
}

impl Words<'_> {
    /// The noun that a fact gives a value: the name of its predicate, if it is one and things have one such value each in the initial state.
    fn noun(self, fact: &Fact) -> Option<String> {
        let (verb, name) = self.predicate(fact);
        let written = self.domain.predicates[fact.predicate.index()].name.text.to_lowercase();
        let says_so = written.starts_with("is-") || written.starts_with("is_");
        if fact.arguments.len() != 2 || verb.is_some() || says_so || !is_noun(&name) {
            return None;
        }
        let alike = self.problem.init.iter().filter(|other| other.predicate == fact.predicate);
        let mut things: Vec<ObjectId> = alike.map(|other| other.arguments[0]).collect();
        let all = things.len();
        things.sort_unstable();
        things.dedup();
        (things.len() == all && all > 0).then_some(name)
    }

    /// What a clause about a fact is about: a thing, or what it has.
    pub fn subject(self, fact: &Fact) -> Option<(ObjectId, Option<PredicateId>)> {
        let noun = self.noun(fact).map(|_| fact.predicate);
        fact.arguments.first().map(|&object| (object, noun))
    }

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
        match verb(first) {
            Some(_) => (Some(first.to_owned()), rest.to_owned()),
            None => (None, name),
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
        if let (Some(noun), [one, other]) = (self.noun(fact), &*fact.arguments) {
            let value = self.object(*other);
            let subject =
                if it { "it".to_owned() } else { format!("the {noun} of {}", self.object(*one)) };
            return format!("{subject} {is} {value}");
        }
        let (verb, rest) = self.predicate(fact);
        match (&*fact.arguments, verb) {
            ([one], None) => format!("{} {is} {rest}", subject(*one)),
            ([one, other], None) => {
                format!("{} {is} {rest} {}", subject(*one), self.object(*other))
            }
            ([one, others @ ..], Some(verb)) if others.len() < 2 => {
                let bare = super::words::verb(&verb).unwrap_or(&verb);
                let verb = match (mood, verb.as_str()) {
                    (Mood::Is, verb) => verb.to_owned(),
                    (Mood::IsNot, "can") => "cannot".to_owned(),
                    (Mood::Were, "can") => "could".to_owned(),
                    (Mood::WereNot, "can") => "could not".to_owned(),
                    (Mood::Were, "has") => "had".to_owned(),
                    (Mood::IsNot, _) => format!("does not {bare}"),
                    (Mood::Were, _) => format!("did {bare}"),
                    (Mood::WereNot, _) => format!("did not {bare}"),
                };
                let others: Vec<String> = others.iter().map(|&other| self.object(other)).collect();
                let others = others.iter().fold(String::new(), |text, other| text + " " + other);
                let rest = if rest.is_empty() { rest } else { format!(" {rest}") };
                format!("{} {verb}{rest}{others}", subject(*one))
            }
            _ => format!("`{}` {holds}", self.atom(fact)),
        }
    }

    /// What an action does that makes a fact true: `makes pink-drawer open`.
    pub fn makes(self, fact: &Fact) -> String {
        if let (Some(noun), [one, other]) = (self.noun(fact), &*fact.arguments) {
            return format!("makes the {noun} of {} {}", self.object(*one), self.object(*other));
        }
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
        if let (Some(noun), [one, other]) = (self.noun(fact), &*fact.arguments) {
            return format!("the {noun} of {} to be {}", self.object(*one), self.object(*other));
        }
        let (verb, rest) = self.predicate(fact);
        match (&*fact.arguments, verb) {
            ([one], None) => format!("{} {rest}", self.object(*one)),
            ([one, other], None) => format!("{} {rest} {}", self.object(*one), self.object(*other)),
            _ => format!("`{}`", self.atom(fact)),
        }
    }

    /// A condition without variables of its own as PDDL.
    pub fn condition(self, condition: &Condition) -> String {
        let term = |term: &Term| match term {
            Term::Object(object) => self.object(*object),
            Term::Variable(variable) => {
                self.problem.goal_scope.variables[variable.index()].name.text.clone()
            }
        };
        let list = |head: &str, parts: &[Condition]| {
            let parts: Vec<String> = parts.iter().map(|part| self.condition(part)).collect();
            format!("({head} {})", parts.join(" "))
        };
        let signed = |text: String, holds: bool| {
            if holds { text } else { format!("(not {text})") }
        };
        let variables = |variables: &[VariableId]| {
            let names: Vec<String> =
                variables.iter().map(|one| term(&Term::Variable(*one))).collect();
            names.join(" ")
        };
        match condition {
            Condition::Atom(atom, holds) => {
                let name = &self.domain.predicates[atom.predicate.index()].name.text;
                let arguments =
                    atom.arguments.iter().fold(String::new(), |text, one| text + " " + &term(one));
                signed(format!("({name}{arguments})"), *holds)
            }
            Condition::Equal(left, right, holds) => {
                signed(format!("(= {} {})", term(left), term(right)), *holds)
            }
            Condition::Action(..) => unreachable!("goals do not ask about joint actions"),
            Condition::All(parts) => list("and", parts),
            Condition::Any(parts) => list("or", parts),
            Condition::Forall(bound, body) => {
                format!("(forall ({}) {})", variables(bound), self.condition(body))
            }
            Condition::Exists(bound, body) => {
                format!("(exists ({}) {})", variables(bound), self.condition(body))
            }
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

/// Adds to a text.
pub fn add(text: &mut String, more: impl fmt::Display) {
    write!(text, "{more}").expect("a string takes all that is written to it");
}

/// Parts of a sentence, with commas and a last "and".
pub fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
