//! Two networks go in; which causes of success in the one stand for which in the other comes out, each pair with a score and a reason.
//!
//! This is `rel()` of equation 2.14, which the thesis leaves to people. Names tell most: their words, with common words counting less,
//! and the numbers at their ends. Units, ranges of values and roles confirm it or speak against it. `xOff_1` is the same as `xOff`, since
//! it is the first of its kind; `xOff_2` is related to it.

use std::collections::BTreeMap;

use super::name::{Name, Weights};
use super::relation::{Pair, Relation, VERSION};
use super::{Ends, overlap, unit};
use crate::network::Network;
use crate::variable::{Role, Variable, VariableId};

/// Variables are related where their score is at least this.
pub const RELATED: f64 = 0.6;

/// What names, units, values and roles weigh in a score; what is not known of two variables is left out.
const NAMES: f64 = 0.6;
const UNITS: f64 = 0.15;
const VALUES: f64 = 0.15;
const ROLES: f64 = 0.1;

/// What is left of a score where units or roles contradict each other.
const CONTRADICTED: f64 = 0.5;

/// A variable of the source and one of the target, with how well they go together.
struct Candidate {
    source: VariableId,
    target: VariableId,
    /// How many places further in its row of numbered variables the target is.
    shift: i64,
    /// Whether they are the same.
    same: bool,
    score: f64,
    why: String,
}

/// A cause of success, with its name in its parts and its place among those that differ from it by the number alone.
struct Cause<'a> {
    id: VariableId,
    variable: &'a Variable,
    name: Name,
    place: i64,
}

/// Finds which causes of success in the source stand for which in the target.
///
/// A way of cross replacement shifts all numbered variables by as many places, so that what belongs together stays together, and puts a
/// variable of the target into the source that has no counterpart of its own; of several ways those stay that put in the most.
pub fn relation(ends: &Ends) -> Relation {
    let sources = causes(ends.source, ends.source_goal.0);
    let targets = causes(ends.target, ends.target_goal.0);
    let names = |network: &Network| -> Vec<Name> {
        network.variables().iter().map(|variable| Name::of(&variable.name)).collect()
    };
    let weights = Weights::of([&names(ends.source), &names(ends.target)]);
    let mut candidates: Vec<Candidate> = Vec::new();
    for source in &sources {
        for target in &targets {
            candidates.extend(candidate(source, target, &weights));
        }
    }
    let best = |of: VariableId, keep: &dyn Fn(&Candidate) -> bool| -> Option<&Candidate> {
        let mut best: Option<&Candidate> = None;
        for one in candidates.iter().filter(|one| one.source == of && keep(one)) {
            if best.is_none_or(|best| one.score > best.score) {
                best = Some(one);
            }
        }
        best
    };
    let direct: Vec<&Candidate> =
        sources.iter().filter_map(|source| best(source.id, &|one| one.same)).collect();
    let is_new = |id: VariableId| direct.iter().all(|one| one.target != id);
    let mut ways: BTreeMap<i64, Vec<&Candidate>> = BTreeMap::new();
    for one in candidates.iter().filter(|one| !one.same) {
        ways.entry(one.shift).or_default();
    }
    for (&shift, way) in &mut ways {
        way.extend(
            sources
                .iter()
                .filter_map(|source| best(source.id, &|one| !one.same && one.shift == shift)),
        );
    }
    ways.retain(|_, way| way.iter().any(|one| is_new(one.target)));
    let most = ways.values().map(Vec::len).max().unwrap_or(0);
    let pair = |one: &Candidate| Pair {
        source: ends.source.variable(one.source).name.clone(),
        target: ends.target.variable(one.target).name.clone(),
        score: Some((one.score * 100.0).round() / 100.0),
        why: Some(one.why.clone()),
    };
    let cross = ways.into_values().filter(|way| way.len() == most).map(|mut way| {
        // What has no relative but itself stays where it is.
        for source in &sources {
            if candidates.iter().all(|one| one.source != source.id || one.same) {
                way.extend(best(source.id, &|one| one.same));
            }
        }
        way.sort_by_key(|one| one.source);
        way.into_iter().map(pair).collect()
    });
    Relation {
        version: VERSION,
        cross: cross.collect(),
        direct: direct.into_iter().map(pair).collect(),
    }
}

/// The causes of a goal.
fn causes(network: &Network, goal: VariableId) -> Vec<Cause<'_>> {
    let names: Vec<Name> =
        network.variables().iter().map(|variable| Name::of(&variable.name)).collect();
    let place = |name: &Name| {
        let mut numbers: Vec<Option<u32>> =
            names.iter().filter(|one| one.words == name.words).map(|one| one.number).collect();
        numbers.sort_unstable();
        numbers.iter().position(|number| *number == name.number).unwrap_or(0) as i64
    };
    network
        .graph()
        .parents(goal)
        .iter()
        .map(|&id| {
            let name = names[id.index()].clone();
            Cause { id, variable: network.variable(id), place: place(&name), name }
        })
        .collect()
}

/// Two causes as a pair, where they are related.
fn candidate(source: &Cause, target: &Cause, weights: &Weights) -> Option<Candidate> {
    // What cannot be put in is no help, whatever it is called.
    overlap(source.variable, target.variable).ok()?;
    let one_name = source.name.words == target.name.words;
    let alike = if one_name { 1.0 } else { weights.alike(&source.name, &target.name) };
    let (mut score, mut weight) = (NAMES * alike, NAMES);
    let mut why = vec![match (one_name, source.name.number, target.name.number) {
        (true, own, other) if own == other => "one name".to_owned(),
        (true, own, other) => {
            let number = |number: Option<u32>| {
                number.map_or_else(|| "no number".to_owned(), |number| number.to_string())
            };
            format!("one name, {} and {}", number(own), number(other))
        }
        _ => format!("names alike by {}", percent(alike)),
    }];
    let mut contradicted = false;
    if let (Some(own), Some(other)) = (&source.variable.unit, &target.variable.unit) {
        weight += UNITS;
        if own == other {
            score += UNITS;
            why.push(format!("both in {own}"));
        } else if unit::factor(Some(own), Some(other)).is_some() {
            score += UNITS;
            why.push(format!("in {own} and {other}"));
        } else {
            contradicted = true;
        }
    }
    if let Some(common) = overlap::common(source.variable, target.variable) {
        weight += VALUES;
        score += VALUES * common;
        let what = if source.variable.is_ordered() { "ranges overlap" } else { "values agree" };
        why.push(format!("{what} by {}", percent(common)));
    }
    if let (Some(own), Some(other)) = (source.variable.role, target.variable.role) {
        weight += ROLES;
        if own == other {
            score += ROLES;
            why.push(
                match own {
                    Role::Treatment => "both set before the trial",
                    Role::Outcome => "both outcomes",
                }
                .to_owned(),
            );
        } else {
            contradicted = true;
        }
    }
    let score = score / weight * if contradicted { CONTRADICTED } else { 1.0 };
    let shift = target.place - source.place;
    (score >= RELATED).then(|| Candidate {
        source: source.id,
        target: target.id,
        shift,
        same: one_name && shift == 0,
        score,
        why: why.join(", "),
    })
}

fn percent(share: f64) -> String {
    format!("{:.0} %", share * 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Dag;
    use crate::network::Conditional;

    /// A network in which all variables but the last one cause it.
    fn network(mut causes: Vec<Variable>) -> Network {
        let goal = causes.len() as u16;
        causes.push(Variable::of_words("goal", ["0", "1"]));
        let rows: usize = causes[..usize::from(goal)].iter().map(Variable::arity).product();
        let mut tables: Vec<Conditional> = causes[..usize::from(goal)]
            .iter()
            .map(|one| vec![1.0 / one.arity() as f64; one.arity()])
            .map(|probabilities| Conditional { probabilities, ..Conditional::default() })
            .collect();
        tables.push(Conditional { probabilities: vec![0.5; 2 * rows], ..Conditional::default() });
        let arcs = (0..goal).map(|id| (VariableId(id), VariableId(goal)));
        let graph = Dag::of_arcs(usize::from(goal) + 1, arcs).unwrap();
        Network::new(causes, graph, tables).unwrap()
    }

    fn offsets(names: &[&str]) -> Vec<Variable> {
        let cut = |name: &&str| Variable {
            unit: Some("cm".to_owned()),
            role: Some(Role::Treatment),
            ..Variable::of_intervals(*name, vec![-3.0, 0.0, 3.0])
        };
        names.iter().map(cut).collect()
    }

    /// What is found, as `a=b` for what is the same and `a~b` for what is related, a line for each way.
    fn found(source: Vec<Variable>, target: Vec<Variable>) -> String {
        let (source, target) = (network(source), network(target));
        let goal = |network: &Network| (network.named("goal").unwrap(), 1);
        let ends = Ends {
            source: &source,
            source_goal: goal(&source),
            target: &target,
            target_goal: goal(&target),
        };
        let relation = relation(&ends);
        let way = |pairs: &Vec<Pair>, sign: &str| -> String {
            let pairs: Vec<String> =
                pairs.iter().map(|pair| format!("{}{sign}{}", pair.source, pair.target)).collect();
            pairs.join(" ")
        };
        let mut lines = vec![way(&relation.direct, "=")];
        lines.extend(relation.cross.iter().map(|pairs| way(pairs, "~")));
        lines.join("\n")
    }

    #[test]
    fn the_first_of_a_row_is_the_same_and_the_others_are_related() {
        assert_eq!(
            found(offsets(&["xOff", "yOff"]), offsets(&["xOff_1", "yOff_1", "xOff_2", "yOff_2"])),
            "xOff=xOff_1 yOff=yOff_1\nxOff~xOff_2 yOff~yOff_2"
        );
        assert_eq!(
            found(
                offsets(&["xOff", "yOff"]),
                offsets(&["xOff0", "xOff1", "xOff2", "yOff0", "yOff1", "yOff2"])
            ),
            "xOff=xOff0 yOff=yOff0\nxOff~xOff1 yOff~yOff1\nxOff~xOff2 yOff~yOff2"
        );
        // The two upper cubes of three are a tower of two, too.
        assert_eq!(
            found(offsets(&["xOff_1", "xOff_2"]), offsets(&["xOff_1", "xOff_2", "xOff_3"])),
            "xOff_1=xOff_1 xOff_2=xOff_2\nxOff_1~xOff_2 xOff_2~xOff_3"
        );
    }

    #[test]
    fn where_all_is_the_same_nothing_else_is_related() {
        let names = ["xOff_1", "yOff_1", "xOff_2", "yOff_2"];
        assert_eq!(
            found(offsets(&names), offsets(&names)),
            "xOff_1=xOff_1 yOff_1=yOff_1 xOff_2=xOff_2 yOff_2=yOff_2"
        );
        assert_eq!(
            found(offsets(&["xOff_1", "xOff_2"]), offsets(&["xOff"])),
            "xOff_1=xOff",
            "the second cube is nowhere in the target"
        );
    }

    #[test]
    fn other_names_for_one_thing_are_related_and_other_things_are_not() {
        assert_eq!(
            found(offsets(&["xOff", "dropOff"]), offsets(&["offset_x", "drop_height"])),
            "\nxOff~offset_x dropOff~drop_height"
        );
        assert_eq!(found(offsets(&["xOff"]), offsets(&["yOff", "size"])), "");
        let mut late = offsets(&["xOff"]);
        late[0].unit = Some("s".to_owned());
        assert_eq!(found(offsets(&["xOff"]), late), "", "what is measured in seconds is no offset");
        let kinds = |words: [&str; 2]| vec![Variable::of_words("kind", words)];
        assert_eq!(found(kinds(["plate", "bowl"]), kinds(["bowl", "glass"])), "kind=kind");
        assert_eq!(found(kinds(["plate", "dish"]), kinds(["bowl", "glass"])), "");
    }

    #[test]
    fn a_pair_says_why() {
        let (source, target) =
            (network(offsets(&["xOff"])), network(offsets(&["xOff_1", "xOff_2"])));
        let ends = Ends {
            source: &source,
            source_goal: (VariableId(1), 1),
            target: &target,
            target_goal: (VariableId(2), 1),
        };
        let why = relation(&ends).cross[0][0].why.clone().unwrap();
        assert_eq!(
            why,
            "one name, no number and 2, both in cm, ranges overlap by 100 %, both set before the trial"
        );
    }
}
