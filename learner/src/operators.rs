//! Records of demonstrations go in; traces with named actions come out, and from them the operators (thesis, section 3.2.2 and algorithm 4).
//!
//! - [`record`]: what was observed, without the frames;
//! - [`deed`]: what each hand did, and which changes it brought about;
//! - [`synergy`]: which deeds only go together;
//! - [`words`], [`name`], [`line`](mod@line): the same as a trace in the words of a domain;
//! - [`letter`]: algorithm 4 to the letter, for comparison;
//! - [`track`], [`routine`]: how each was done, as way points.

pub mod record;
pub mod deed;
pub mod synergy;
pub mod words;
mod name;
pub mod line;
pub mod letter;
pub mod track;
pub mod routine;

use lang::model::{Domain, PredicateId};

use crate::rule::{self, Learned};

use deed::Deeds;
use line::Line;
use record::Record;
use synergy::Synergy;
use words::{Lexicon, Words};

/// How operators are learned.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// By which rule, and how noise is treated.
    pub rule: rule::Options,
    /// Which deeds of several hands are tied together.
    pub synergy: Synergy,
    /// Whether those who act become agents (MA-PDDL).
    pub agents: bool,
    /// The name of the domain.
    pub title: String,
}

/// What demonstrations taught.
#[derive(Debug, Clone)]
pub struct Taught {
    /// The operators, with the words that they are said in.
    pub learned: Learned,
    /// Each demonstration as deeds and as a trace, in the order in which they came.
    pub lines: Vec<(Deeds, Line)>,
    /// What the given domain has no words for, such as "the predicate `on-top`".
    pub missing: Vec<String>,
}

/// Learns from demonstrations, each with the words that fit its header, in the words of `known` or in their own.
pub fn learn(
    demonstrations: &[(Record, Words)],
    known: Option<&Domain>,
    options: &Options,
) -> Taught {
    let mut lexicon = Lexicon::new(&options.title, known);
    let mut lines = Vec::new();
    for (record, words) in demonstrations {
        let objects = lexicon.objects(&record.header, words);
        let mut found = deed::deeds(record, |hand, object| {
            lexicon.holdable(&record.header, words, &objects, hand, object)
        });
        synergy::tie(record, &mut found, options.synergy);
        let line = line::line(record, &found, words, &mut lexicon, options.agents);
        lines.push((found, line));
    }
    let traces: Vec<_> = lines.iter().map(|(_, line)| line.trace.clone()).collect();
    let domain = lexicon.domain();
    let hand = of_hands(&domain, demonstrations);
    let mut learned =
        rule::learn(&domain, &traces, &rule::Options { hand, ..options.rule.clone() });
    if options.agents {
        let told: Vec<(&Deeds, &Line)> = lines.iter().map(|(deeds, line)| (deeds, line)).collect();
        synergy::partners(&told, &mut learned);
    }
    Taught { learned, lines, missing: lexicon.missing.into_iter().collect() }
}

/// The predicates that say what a hand does; the rule of the thesis treats them in another way than those of the surroundings.
fn of_hands(domain: &Domain, demonstrations: &[(Record, Words)]) -> Vec<PredicateId> {
    let is_one = |name: &str| {
        demonstrations.iter().any(|(_, words)| {
            let vocabulary = &words.vocabulary;
            [
                &vocabulary.in_hand,
                &vocabulary.hand_empty,
                &vocabulary.acted_on,
                &vocabulary.hand_moves,
            ]
            .iter()
            .any(|pattern| pattern.predicate.eq_ignore_ascii_case(name))
        })
    };
    let places = domain.predicates.iter().enumerate();
    places
        .filter(|(_, predicate)| is_one(&predicate.name.text))
        .map(|(place, _)| PredicateId(place as u32))
        .collect()
}
