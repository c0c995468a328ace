//! Relations between hands and objects go in; facts in the words of a domain come out.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::log::{Fact, HandId, Header, ObjectId};

/// What can be observed between hands and objects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Relation {
    /// The first object rests on the second.
    OnTop,
    /// The first object is in the hollow of the second.
    Inside,
    /// A joint of the object is open.
    Open,
    /// All joints of the object are closed: the contrary of [`Relation::Open`].
    Closed,
    /// Nothing is on top of the object, or at the place.
    Clear,
    /// The surfaces of both objects meet; symmetric.
    Touching,
    /// The first object stands in the way of a joint of the second.
    Blocks,
    /// Nothing stands in the way of the object's joints.
    Unblocked,
    /// The object is within the reach of the hand.
    Reachable,
    /// The object, or the hand, is at the place.
    At,
    /// The first object is smaller than the second, which is of the same type; known from the header.
    Smaller,
    /// The hand holds the object.
    InHand,
    /// The hand holds nothing.
    HandEmpty,
    /// The hand approaches the object or works on it.
    ActedOn,
    /// The hand moves.
    HandMoves,
    /// The log itself says so.
    Given,
}

impl Relation {
    /// Those that are observed unless something else is said.
    pub const DEFAULT: [Relation; 12] = [
        Relation::OnTop,
        Relation::Inside,
        Relation::Open,
        Relation::Closed,
        Relation::Clear,
        Relation::Blocks,
        Relation::Unblocked,
        Relation::Reachable,
        Relation::At,
        Relation::Smaller,
        Relation::InHand,
        Relation::HandEmpty,
    ];

    /// Whether it says something of one hand and what it does, and nothing of the surroundings; algorithm 4 keeps the two apart.
    pub fn of_hand(self) -> bool {
        matches!(
            self,
            Relation::InHand | Relation::HandEmpty | Relation::ActedOn | Relation::HandMoves
        )
    }
}

/// One thing in a [`Ground`] relation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Thing {
    /// A hand.
    Hand(HandId),
    /// An object.
    Object(ObjectId),
}

/// A relation of certain things, in the order of the roles in [`Vocabulary`].
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ground {
    /// The relation.
    pub relation: Relation,
    /// The things, one for each role.
    pub things: Vec<Thing>,
}

/// How each relation is written as a fact.
///
/// A pattern is an atom, such as `(on ?above ?below)`, whose variables are roles of the relation; roles may be left out or change places.
/// Variables of other names stand for the roles in their order, if there are as many.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
#[expect(missing_docs, reason = "each field is the pattern of the relation of its name")]
pub struct Vocabulary {
    pub on_top: Pattern,
    pub inside: Pattern,
    pub open: Pattern,
    pub closed: Pattern,
    pub clear: Pattern,
    pub touching: Pattern,
    pub blocks: Pattern,
    pub unblocked: Pattern,
    pub reachable: Pattern,
    pub at: Pattern,
    pub smaller: Pattern,
    pub in_hand: Pattern,
    pub hand_empty: Pattern,
    pub acted_on: Pattern,
    pub hand_moves: Pattern,
}

impl Default for Vocabulary {
    fn default() -> Self {
        let pattern = |text: &str| text.parse().expect("the default patterns are well formed");
        Self {
            on_top: pattern("(on-top ?above ?below)"),
            inside: pattern("(inside ?thing ?container)"),
            open: pattern("(open ?object)"),
            closed: pattern("(closed ?object)"),
            clear: pattern("(clear ?object)"),
            touching: pattern("(touching ?first ?second)"),
            blocks: pattern("(blocks ?obstacle ?object)"),
            unblocked: pattern("(unblocked ?object)"),
            reachable: pattern("(reachable ?object ?hand)"),
            at: pattern("(at ?thing ?spot)"),
            smaller: pattern("(smaller ?small ?large)"),
            in_hand: pattern("(in-hand ?object ?hand)"),
            hand_empty: pattern("(hand-empty ?hand)"),
            acted_on: pattern("(acted-on ?object ?hand)"),
            hand_moves: pattern("(hand-moves ?hand)"),
        }
    }
}

impl Vocabulary {
    /// The pattern of a relation and the names of its roles; none for [`Relation::Given`].
    fn entry(&self, relation: Relation) -> Option<(&Pattern, &'static [&'static str])> {
        Some(match relation {
            Relation::OnTop => (&self.on_top, &["above", "below"]),
            Relation::Inside => (&self.inside, &["thing", "container"]),
            Relation::Open => (&self.open, &["object"]),
            Relation::Closed => (&self.closed, &["object"]),
            Relation::Clear => (&self.clear, &["object"]),
            Relation::Touching => (&self.touching, &["first", "second"]),
            Relation::Blocks => (&self.blocks, &["obstacle", "object"]),
            Relation::Unblocked => (&self.unblocked, &["object"]),
            Relation::Reachable => (&self.reachable, &["object", "hand"]),
            Relation::At => (&self.at, &["thing", "spot"]),
            Relation::Smaller => (&self.smaller, &["small", "large"]),
            Relation::InHand => (&self.in_hand, &["object", "hand"]),
            Relation::HandEmpty => (&self.hand_empty, &["hand"]),
            Relation::ActedOn => (&self.acted_on, &["object", "hand"]),
            Relation::HandMoves => (&self.hand_moves, &["hand"]),
            Relation::Given => return None,
        })
    }

    /// Says which pattern has variables that are no roles of its relation.
    pub fn check(&self, relations: &[Relation]) -> Result<(), BadPattern> {
        for &relation in relations {
            if let Some((pattern, roles)) = self.entry(relation) {
                pattern.roles(roles)?;
            }
        }
        Ok(())
    }

    /// The fact that a relation is in these words; none where a pattern does not fit or the log gives the fact itself.
    pub fn fact(&self, header: &Header, ground: &Ground) -> Option<Fact> {
        let (pattern, roles) = self.entry(ground.relation)?;
        let arguments = pattern
            .roles(roles)
            .ok()?
            .into_iter()
            .map(|role| match ground.things[role] {
                Thing::Hand(hand) => header.hands[hand.index()].name.clone(),
                Thing::Object(object) => header.objects[object.index()].name.clone(),
            })
            .collect();
        Some(Fact { predicate: pattern.predicate.clone(), arguments })
    }
}

/// An atom with variables, such as `(on ?above ?below)`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Pattern {
    /// Its predicate.
    pub predicate: String,
    /// Its variables without their question marks.
    pub variables: Vec<String>,
}

/// Why a text is no [`Pattern`], or does not fit its relation.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BadPattern {
    /// It is no atom.
    #[error("`{0}` is no atom with variables, such as `(on-top ?above ?below)`")]
    Form(String),
    /// A variable is no role.
    #[error("`{pattern}` has a variable `?{variable}`; here they are {roles}")]
    Role {
        /// The whole pattern.
        pattern: String,
        /// The variable.
        variable: String,
        /// All roles, as a sentence lists them.
        roles: String,
    },
}

impl Pattern {
    /// For each variable the place of its role.
    fn roles(&self, roles: &[&str]) -> Result<Vec<usize>, BadPattern> {
        let named: Vec<Option<usize>> = self
            .variables
            .iter()
            .map(|variable| roles.iter().position(|role| role == variable))
            .collect();
        if named.iter().all(Option::is_none) && named.len() == roles.len() {
            return Ok((0..roles.len()).collect());
        }
        self.variables
            .iter()
            .zip(named)
            .map(|(variable, role)| {
                role.ok_or_else(|| BadPattern::Role {
                    pattern: self.to_string(),
                    variable: variable.clone(),
                    roles: roles
                        .iter()
                        .map(|role| format!("`?{role}`"))
                        .collect::<Vec<_>>()
                        .join(" and "),
                })
            })
            .collect()
    }
}

impl std::str::FromStr for Pattern {
    type Err = BadPattern;

    fn from_str(text: &str) -> Result<Self, BadPattern> {
        let bad = || BadPattern::Form(text.to_string());
        let inner = text.trim().strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
        let mut words = inner.ok_or_else(bad)?.split_whitespace();
        let predicate = words.next().filter(|word| is_name(word)).ok_or_else(bad)?;
        let variables = words
            .map(|word| word.strip_prefix('?').filter(|name| is_name(name)).map(String::from))
            .collect::<Option<Vec<_>>>()
            .ok_or_else(bad)?;
        Ok(Self { predicate: predicate.to_string(), variables })
    }
}

/// Whether a word can be a name in PDDL.
fn is_name(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_alphabetic())
        && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}

impl fmt::Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}", self.predicate)?;
        for variable in &self.variables {
            write!(f, " ?{variable}")?;
        }
        write!(f, ")")
    }
}

impl TryFrom<String> for Pattern {
    type Error = BadPattern;

    fn try_from(text: String) -> Result<Self, BadPattern> {
        text.parse()
    }
}

impl From<Pattern> for String {
    fn from(pattern: Pattern) -> Self {
        pattern.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roles_may_change_places_be_left_out_or_have_other_names() {
        let roles = |text: &str, roles: &[&str]| text.parse::<Pattern>().unwrap().roles(roles);
        assert_eq!(roles("(under ?below ?above)", &["above", "below"]), Ok(vec![1, 0]));
        assert_eq!(roles("(holding ?object)", &["object", "hand"]), Ok(vec![0]));
        assert_eq!(roles("(hand-clear)", &["hand"]), Ok(vec![]));
        assert_eq!(roles("(blocks ?chair ?drawer)", &["obstacle", "object"]), Ok(vec![0, 1]));
        assert_eq!(
            roles("(holding ?thing)", &["object", "hand"]).unwrap_err().to_string(),
            "`(holding ?thing)` has a variable `?thing`; here they are `?object` and `?hand`"
        );
    }

    #[test]
    fn what_is_no_atom_is_no_pattern() {
        for text in ["on ?a ?b", "(on a)", "()", "(?on)", "(on ?)"] {
            assert_eq!(text.parse::<Pattern>(), Err(BadPattern::Form(text.to_string())));
        }
    }
}
