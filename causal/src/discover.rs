//! Counts and knowledge go in; the graph that explains them best comes out (thesis §2.1.3.1).
//!
//! Whatever learns sees the variables in the order of their names, and draws no random numbers. So neither the order of columns nor
//! threads nor a seed changes what is learned.

mod exact;
mod greedy;
mod order;
mod climb;
mod constraint;
mod blanket;

use thiserror::Error;

use crate::count::{CountError, Counter, Counts};
use crate::graph::Dag;
use crate::independence::{Test, Tester};
use crate::knowledge::{Knowledge, KnowledgeError, Rules};
use crate::pattern::Pattern;
use crate::score::{Score, Scorer};
use crate::set::MOST_VARIABLES;
use crate::variable::{Variable, VariableId};

/// How a graph is learned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// The best graph where that can be proven in seconds, else a search over classes of graphs.
    Auto,
    /// The best graph: dynamic programming over sets of variables (Silander and Myllymäki 2006).
    Exact,
    /// Greedy equivalence search (Chickering 2002).
    Greedy,
    /// Search over orders: best order score search (Andrews et al. 2023).
    Order,
    /// Hill climbing over graphs.
    Hill,
    /// Hill climbing that also goes down, and not back (tabu search; Glover 1989).
    Tabu,
    /// Tests of independence: PC in its stable form (Colombo and Maathuis 2014).
    Pc,
    /// Markov blankets by growing and shrinking (Margaritis 2003).
    GrowShrink,
    /// Markov blankets by incremental association (Tsamardinos et al. 2003).
    Iamb,
    /// Hill climbing among what tests leave (max-min hill climbing; Tsamardinos et al. 2006).
    Mmhc,
}

impl Method {
    /// All of them, in the order in which they are offered.
    pub const ALL: [Self; 10] = [
        Self::Auto,
        Self::Exact,
        Self::Greedy,
        Self::Order,
        Self::Hill,
        Self::Tabu,
        Self::Pc,
        Self::GrowShrink,
        Self::Iamb,
        Self::Mmhc,
    ];

    /// What it is called on the command line and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Exact => "exact",
            Self::Greedy => "greedy",
            Self::Order => "order",
            Self::Hill => "hill",
            Self::Tabu => "tabu",
            Self::Pc => "pc",
            Self::GrowShrink => "grow-shrink",
            Self::Iamb => "iamb",
            Self::Mmhc => "mmhc",
        }
    }

    /// What it is, in a few words.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Auto => "The best graph up to 20 variables, else greedy",
            Self::Exact => "The best graph, by dynamic programming",
            Self::Greedy => "Greedy equivalence search",
            Self::Order => "Best order score search",
            Self::Hill => "Hill climbing",
            Self::Tabu => "Tabu search",
            Self::Pc => "PC in its stable form",
            Self::GrowShrink => "Markov blankets by growing and shrinking",
            Self::Iamb => "Markov blankets by incremental association",
            Self::Mmhc => "Max-min hill climbing",
        }
    }
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// How to learn.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// The learner.
    pub method: Method,
    /// What graphs are judged by.
    pub score: Score,
    /// What tests independence.
    pub test: Test,
    /// Variables are independent where a dependence would look as strong by chance with at least this probability.
    pub alpha: f64,
    /// As many parents as a variable has at most; as many as can be searched where none is given.
    pub max_parents: Option<usize>,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            method: Method::Auto,
            score: Score::Bic,
            test: Test::G2,
            alpha: 0.01,
            max_parents: None,
        }
    }
}

/// What was learned.
#[derive(Debug, Clone, PartialEq)]
pub struct Discovery {
    /// A graph of the class that fits the data, as knowledge allows.
    pub graph: Dag,
    /// Which of its arcs data and knowledge direct.
    pub pattern: Pattern,
    /// The score of the graph.
    pub score: f64,
    /// Who learned it.
    pub method: Method,
    /// As many parents as a variable could have.
    pub max_parents: usize,
    /// How many local scores or tests were asked for.
    pub asked: usize,
    /// What a person should know: tests that contradicted each other, variables that never vary.
    pub notes: Vec<String>,
}

impl Discovery {
    /// As many parents as a variable could have, where a graph of so many variables could have had more and the learner promises the
    /// best.
    pub fn narrowed(&self, variables: usize) -> Option<usize> {
        let narrow = self.method == Method::Exact && self.max_parents + 1 < variables;
        narrow.then_some(self.max_parents)
    }
}

/// Why nothing was learned.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DiscoverError {
    /// Less than two variables.
    #[error("a graph needs two variables, and there {}", if *.0 == 1 { "is one" } else { "is none" })]
    TooFew(usize),
    /// More variables than sets hold.
    #[error("{0} variables; graphs are learned over at most {MOST_VARIABLES}")]
    TooMany(usize),
    /// More variables than can be searched exactly.
    #[error("the best graph of {0} variables cannot be proven; up to {most} can, and `greedy` takes more", most = exact::MOST)]
    TooManyForExact(usize),
    /// No trials.
    #[error("there is no trial")]
    NoTrials,
    /// A level of significance that is none.
    #[error("alpha is {0}; it is a probability between 0 and 1")]
    Alpha(f64),
    /// A weight of a prior that is none.
    #[error("the prior of BDeu is worth {0} trials; it must be more than 0")]
    Weight(f64),
    /// Knowledge that cannot be used.
    #[error(transparent)]
    Knowledge(#[from] KnowledgeError),
    /// No graph has so few parents and all arcs that are required.
    #[error("`{0}` has more required causes than a variable may have parents, which is {1}")]
    TooManyRequired(String, usize),
    /// Counting failed.
    #[error(transparent)]
    Count(#[from] CountError),
}

/// The same trials, with the variables in the order of their names.
struct Sorted<'a> {
    counter: &'a dyn Counter,
    order: Vec<VariableId>,
    variables: Vec<Variable>,
}

impl<'a> Sorted<'a> {
    fn new(counter: &'a dyn Counter) -> Self {
        let all = counter.variables();
        let mut order: Vec<VariableId> = (0..all.len() as u16).map(VariableId).collect();
        order.sort_by(|one, other| all[one.index()].name.cmp(&all[other.index()].name));
        let variables = order.iter().map(|id| all[id.index()].clone()).collect();
        Self { counter, order, variables }
    }
}

impl Counter for Sorted<'_> {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn rows(&self) -> u64 {
        self.counter.rows()
    }

    fn count(&self, sets: &[Vec<VariableId>]) -> Result<Vec<Counts>, CountError> {
        let turned: Vec<Vec<VariableId>> =
            sets.iter().map(|set| set.iter().map(|id| self.order[id.index()]).collect()).collect();
        self.counter.count(&turned)
    }
}

/// What all learners are given.
struct Job<'a> {
    scorer: &'a Scorer<'a>,
    tester: &'a Tester<'a>,
    rules: &'a Rules,
    alpha: f64,
    max_parents: usize,
}

/// What a learner finds: a graph, or a pattern that may have none.
enum Found {
    Graph(Dag),
    Pattern(Pattern, Vec<String>),
}

/// Learns a graph.
pub fn discover(
    counter: &dyn Counter,
    knowledge: &Knowledge,
    config: &Config,
) -> Result<Discovery, DiscoverError> {
    let many = counter.variables().len();
    if many > MOST_VARIABLES {
        return Err(DiscoverError::TooMany(many));
    }
    let given = knowledge.rules(counter.variables())?;
    check(counter, config, many)?;
    let sorted = Sorted::new(counter);
    let rules = given.reordered(&sorted.order);
    let method = match config.method {
        Method::Auto if many <= exact::MOST => Method::Exact,
        Method::Auto => Method::Greedy,
        Method::Exact if many > exact::MOST => return Err(DiscoverError::TooManyForExact(many)),
        method => method,
    };
    let max_parents = config.max_parents.unwrap_or_else(|| match method {
        Method::Exact => exact::parents(many),
        _ => many - 1,
    });
    for (at, variable) in sorted.variables.iter().enumerate() {
        if rules.required(VariableId(at as u16)).len() > max_parents {
            return Err(DiscoverError::TooManyRequired(variable.name.clone(), max_parents));
        }
    }
    let scorer = Scorer::new(&sorted, config.score);
    let tester = Tester::new(&sorted, config.test);
    let job =
        Job { scorer: &scorer, tester: &tester, rules: &rules, alpha: config.alpha, max_parents };
    let found = match method {
        Method::Exact | Method::Auto => Found::Graph(exact::search(&job)),
        Method::Greedy => Found::Graph(greedy::search(&job)),
        Method::Order => Found::Graph(order::search(&job)),
        Method::Hill => Found::Graph(climb::search(&job, &climb::Candidates::all(&job), false)),
        Method::Tabu => Found::Graph(climb::search(&job, &climb::Candidates::all(&job), true)),
        Method::Mmhc => Found::Graph(climb::search(&job, &blanket::max_min(&job), false)),
        Method::Pc => constraint::pc(&job),
        Method::GrowShrink => blanket::grow_shrink(&job),
        Method::Iamb => blanket::iamb(&job),
    };
    if let Some(error) = scorer.failure().or_else(|| tester.failure()) {
        return Err(error.into());
    }
    let mut notes = constants(&sorted)?;
    let (graph, pattern) = match found {
        Found::Graph(graph) => (graph.clone(), known(&graph, &rules)),
        Found::Pattern(pattern, more) => {
            notes.extend(more);
            settle(&pattern, &rules, &sorted.variables, &mut notes)
        }
    };
    let score = scorer.total(&graph);
    if let Some(error) = scorer.failure() {
        return Err(error.into());
    }
    let asked = match method {
        Method::Pc | Method::GrowShrink | Method::Iamb => tester.asked(),
        _ => scorer.asked(),
    };
    let arcs =
        graph.arcs().map(|(from, to)| (sorted.order[from.index()], sorted.order[to.index()]));
    Ok(Discovery {
        graph: Dag::of_arcs(many, arcs).expect("a graph has no cycle under other names"),
        pattern: pattern.renumbered(&sorted.order),
        score,
        method,
        max_parents,
        asked,
        notes,
    })
}

fn check(counter: &dyn Counter, config: &Config, many: usize) -> Result<(), DiscoverError> {
    if many < 2 {
        return Err(DiscoverError::TooFew(many));
    }
    if counter.rows() == 0 {
        return Err(DiscoverError::NoTrials);
    }
    if !(config.alpha > 0.0 && config.alpha < 1.0) {
        return Err(DiscoverError::Alpha(config.alpha));
    }
    match config.score {
        Score::Bdeu(weight) if weight.is_nan() || weight <= 0.0 => {
            Err(DiscoverError::Weight(weight))
        }
        _ => Ok(()),
    }
}

/// What to say of variables that never vary.
fn constants(sorted: &Sorted) -> Result<Vec<String>, CountError> {
    let sets: Vec<Vec<VariableId>> =
        (0..sorted.variables.len() as u16).map(|id| vec![VariableId(id)]).collect();
    let counts = sorted.count(&sets)?;
    let constant = |counts: &Counts| counts.iter().filter(|&&count| count > 0).count() < 2;
    Ok(sorted
        .variables
        .iter()
        .zip(&counts)
        .filter(|(_, counts)| constant(counts))
        .map(|(variable, _)| {
            format!("`{}` is the same in every trial: no arc of it can be learned", variable.name)
        })
        .collect())
}

/// The class of a graph, with what knowledge directs.
fn known(graph: &Dag, rules: &Rules) -> Pattern {
    let mut pattern = Pattern::of(graph);
    if rules.is_free() {
        return pattern;
    }
    for (one, other) in pattern.undirected() {
        // The graph obeys the rules, so that its own direction is always allowed.
        let (parent, child) =
            if graph.parents(other).contains(&one) { (one, other) } else { (other, one) };
        if !rules.allows(child, parent) || rules.required(child).contains(parent) {
            pattern.direct(parent, child);
        }
    }
    pattern.close();
    pattern
}

/// A graph of a pattern that tests made, and the pattern that it has. Where tests contradict each other so that no graph has the
/// pattern, the graph takes as much of it as can be, and a note says so.
fn settle(
    pattern: &Pattern,
    rules: &Rules,
    variables: &[Variable],
    notes: &mut Vec<String>,
) -> (Dag, Pattern) {
    let mut pattern = pattern.clone();
    for (one, other) in pattern.undirected() {
        match (rules.allows(one, other), rules.allows(other, one)) {
            (true, false) => pattern.direct(one, other),
            (false, true) => pattern.direct(other, one),
            _ => {}
        }
    }
    pattern.close();
    let obeys = |graph: &Dag| graph.arcs().all(|(from, to)| rules.allows(from, to));
    if let Some(graph) = pattern.extension().filter(obeys) {
        return (graph, pattern);
    }
    // Arcs join one by one, first what knowledge requires, then what is directed, then the rest; each against its direction where only
    // so there is no cycle.
    let required =
        pattern.ids().flat_map(|to| rules.required(to).iter().map(move |from| (from, to)));
    let arcs: Vec<(VariableId, VariableId)> =
        required.chain(pattern.arcs()).chain(pattern.undirected()).collect();
    let mut parents: Vec<Vec<VariableId>> = vec![Vec::new(); pattern.len()];
    for (from, to) in arcs {
        let joined = parents[to.index()].contains(&from) || parents[from.index()].contains(&to);
        for (from, to) in [(from, to), (to, from)] {
            if joined || !rules.allows(from, to) {
                continue;
            }
            parents[to.index()].push(from);
            if Dag::new(parents.clone()).is_ok() {
                break;
            }
            parents[to.index()].pop();
        }
    }
    let graph = Dag::new(parents).expect("no arc that closes a cycle was taken");
    let settled = known(&graph, rules);
    let name = |id: VariableId| variables[id.index()].name.as_str();
    let other = |one: &Pattern, from: VariableId, to: VariableId| {
        one.between(from, to) != pattern.between(from, to)
    };
    let changed: Vec<String> = pattern
        .ids()
        .flat_map(|one| pattern.ids().map(move |two| (one, two)))
        .filter(|&(one, two)| one < two && other(&settled, one, two))
        .map(|(one, two)| format!("{}, {}", name(one), name(two)))
        .collect();
    notes.push(format!(
        "the tests contradict each other: no graph has exactly the independences that they found; \
         the graph differs from them between {}",
        changed.join("; ")
    ));
    (graph, settled)
}
