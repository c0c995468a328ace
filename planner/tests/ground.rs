//! The grounder beside brute force: all bindings of all actions, formulas evaluated as they stand.

use std::collections::BTreeSet;

use lang::model::{
    Domain, Formula, NodeId, NodeKind, ObjectId, PredicateId, Problem, Term, VariableId,
};
use lang::source::Sources;
use planner::ground::{Outcome, ground};
use planner::limits::Limits;
use planner::normalize::normalize;
use proptest::prelude::*;

type Fact = (PredicateId, Vec<ObjectId>);
/// An action by its number, with its arguments.
type Instance = (u32, Vec<ObjectId>);
/// Takes an applicable instance, what it may add and what it may delete.
type Take<'a> = dyn FnMut(Instance, &[Fact], &[Fact]) + 'a;

/// What brute force knows of the facts.
struct Known<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    reachable: BTreeSet<Fact>,
    always: BTreeSet<Fact>,
}

impl Known<'_> {
    /// Whether a formula may hold (`may`), or must hold in every state, where `positive` is its sign.
    fn holds(
        &self,
        formula: &Formula,
        types: &[Vec<ObjectId>],
        id: NodeId,
        positive: bool,
        may: bool,
        binding: &mut [ObjectId],
    ) -> bool {
        let value = |term: &Term, binding: &[ObjectId]| match term {
            Term::Variable(variable) => binding[variable.index()],
            Term::Object(object) => *object,
        };
        match formula.kind(id) {
            NodeKind::Atom(atom) => {
                let fact = (
                    atom.predicate,
                    atom.arguments.iter().map(|term| value(term, binding)).collect(),
                );
                match (positive, may) {
                    (true, true) => self.reachable.contains(&fact),
                    (true, false) => self.always.contains(&fact),
                    (false, true) => !self.always.contains(&fact),
                    (false, false) => !self.reachable.contains(&fact),
                }
            }
            NodeKind::Action(_) => panic!("nothing here asks about joint actions"),
            NodeKind::Equal(left, right) => {
                (value(left, binding) == value(right, binding)) == positive
            }
            NodeKind::Not(child) => self.holds(formula, types, *child, !positive, may, binding),
            NodeKind::And(children) | NodeKind::Or(children) => {
                let conjunctive = matches!(formula.kind(id), NodeKind::And(_)) == positive;
                let mut truths = children
                    .iter()
                    .map(|&child| self.holds(formula, types, child, positive, may, binding));
                if conjunctive { truths.all(|truth| truth) } else { truths.any(|truth| truth) }
            }
            NodeKind::Imply(left, right) => {
                let left = self.holds(formula, types, *left, !positive, may, binding);
                let right = self.holds(formula, types, *right, positive, may, binding);
                if positive { left || right } else { left && right }
            }
            NodeKind::Forall(variables, child) | NodeKind::Exists(variables, child) => {
                let conjunctive = matches!(formula.kind(id), NodeKind::Forall(..)) == positive;
                let mut result = conjunctive;
                for_all(variables, types, binding, &mut |binding| {
                    let truth = self.holds(formula, types, *child, positive, may, binding);
                    result = if conjunctive { result && truth } else { result || truth };
                });
                result
            }
        }
    }

    fn root(
        &self,
        formula: &Formula,
        types: &[Vec<ObjectId>],
        may: bool,
        binding: &mut [ObjectId],
    ) -> bool {
        self.holds(formula, types, formula.root(), true, may, binding)
    }

    fn types(&self, scope: &lang::model::Scope) -> Vec<Vec<ObjectId>> {
        let fits = |variable: &lang::model::Variable, object: usize| {
            self.domain.has_type(&self.problem.objects[object], &variable.types)
        };
        scope
            .variables
            .iter()
            .map(|variable| {
                let count = self.problem.objects.len();
                (0..count)
                    .filter(|&object| fits(variable, object))
                    .map(|object| ObjectId(object as u32))
                    .collect()
            })
            .collect()
    }

    /// Adds what actions and axioms reach until nothing is new.
    fn saturate(&mut self) {
        loop {
            let before = self.reachable.len();
            let mut new = Vec::new();
            self.instances(&mut |_, added, _| new.extend(added.iter().cloned()));
            new.extend(self.derived(true));
            self.reachable.extend(new);
            if self.reachable.len() == before {
                return;
            }
        }
    }

    /// The heads of all axioms whose bodies may hold, or must hold.
    fn derived(&self, may: bool) -> Vec<Fact> {
        let mut derived = Vec::new();
        for axiom in &self.domain.axioms {
            let types = self.types(&axiom.scope);
            let mut binding = vec![ObjectId(0); types.len()];
            let parameters: Vec<VariableId> = (0..axiom.scope.parameters).map(VariableId).collect();
            for_all(&parameters, &types, &mut binding, &mut |binding| {
                if self.root(&axiom.body, &types, may, binding) {
                    derived.push((axiom.head, binding[..parameters.len()].to_vec()));
                }
            });
        }
        derived
    }

    /// Calls `found` with every applicable instance, what it may add and what it may delete.
    fn instances(&self, found: &mut Take) {
        for (number, action) in self.domain.actions.iter().enumerate() {
            let types = self.types(&action.scope);
            let mut binding = vec![ObjectId(0); types.len()];
            let parameters: Vec<VariableId> =
                (0..action.scope.parameters).map(VariableId).collect();
            for_all(&parameters, &types, &mut binding, &mut |binding| {
                if !self.root(&action.precondition, &types, true, binding) {
                    return;
                }
                let (mut added, mut deleted) = (Vec::new(), Vec::new());
                for effect in &action.effects {
                    for_all(&effect.variables, &types, binding, &mut |binding| {
                        if self.root(&effect.condition, &types, true, binding) {
                            for literal in &effect.literals {
                                let arguments =
                                    literal.atom.arguments.iter().map(|term| match term {
                                        Term::Variable(variable) => binding[variable.index()],
                                        Term::Object(object) => *object,
                                    });
                                let fact = (literal.atom.predicate, arguments.collect());
                                if literal.positive { added.push(fact) } else { deleted.push(fact) }
                            }
                        }
                    });
                }
                found((number as u32, binding[..parameters.len()].to_vec()), &added, &deleted);
            });
        }
    }

    /// The facts that hold in every state.
    fn constant(&self) -> BTreeSet<Fact> {
        let init = self.problem.init.iter().map(|fact| (fact.predicate, fact.arguments.to_vec()));
        let mut always: BTreeSet<Fact> =
            init.filter(|fact| !self.domain.predicates[fact.0.index()].derived).collect();
        self.instances(&mut |_, _, deleted| always.retain(|fact| !deleted.contains(fact)));
        let mut known = Known {
            domain: self.domain,
            problem: self.problem,
            reachable: self.reachable.clone(),
            always,
        };
        loop {
            let before = known.always.len();
            let new = known.derived(false);
            known.always.extend(new);
            if known.always.len() == before {
                return known.always;
            }
        }
    }
}

fn for_all(
    variables: &[VariableId],
    types: &[Vec<ObjectId>],
    binding: &mut [ObjectId],
    found: &mut dyn FnMut(&mut [ObjectId]),
) {
    let Some((first, rest)) = variables.split_first() else { return found(binding) };
    for &object in &types[first.index()] {
        binding[first.index()] = object;
        for_all(rest, types, binding, found);
    }
}

/// The reachable facts that may change, and the instances that may change something; none if the goal cannot be reached.
fn brute_force(domain: &Domain, problem: &Problem) -> Option<(BTreeSet<Fact>, BTreeSet<Instance>)> {
    let mut always = BTreeSet::new();
    loop {
        let reachable = problem
            .init
            .iter()
            .filter(|fact| !domain.predicates[fact.predicate.index()].derived)
            .map(|fact| (fact.predicate, fact.arguments.to_vec()))
            .collect();
        let mut known = Known { domain, problem, reachable, always };
        known.saturate();
        let now = known.constant();
        if now != known.always {
            always = now;
            continue;
        }
        let types = known.types(&problem.goal_scope);
        let mut binding = vec![ObjectId(0); types.len()];
        if !known.root(&problem.goal, &types, true, &mut binding) {
            return None;
        }
        let mut instances = BTreeSet::new();
        known.instances(&mut |instance, added, deleted| {
            let adds = added.iter().any(|fact| !known.always.contains(fact));
            let deletes = deleted.iter().any(|fact| known.reachable.contains(fact));
            if adds || deletes {
                instances.insert(instance);
            }
        });
        return Some((&known.reachable - &known.always, instances));
    }
}

fn read(domain: &str, problem: &str) -> (Domain, Problem) {
    let mut sources = Sources::default();
    let domain_id = sources.add("domain.pddl", domain);
    let problem_id = sources.add("problem.pddl", problem);
    let (domain, diagnostics) = lang::read_domain(&sources, domain_id);
    assert!(!diagnostics.has_errors(), "{}", lang::render::full(&diagnostics, &sources, false));
    let (problem, diagnostics) = lang::read_problem(&sources, problem_id, &domain);
    assert!(!diagnostics.has_errors(), "{}", lang::render::full(&diagnostics, &sources, false));
    (domain, problem)
}

/// The facts of the domain's own predicates and the instances that the grounder finds; none if it says that the goal is out of reach.
fn grounded(domain: &Domain, problem: &Problem) -> Option<(BTreeSet<Fact>, BTreeSet<Instance>)> {
    let normal = normalize(domain, problem).expect("the problem can be planned");
    match ground(domain, problem, &normal, &Limits::default()).expect("nothing stops it") {
        Outcome::Unsolvable => None,
        Outcome::Grounded(grounded) => {
            let arguments = |range: &std::ops::Range<u32>| {
                grounded.arguments[range.start as usize..range.end as usize].to_vec()
            };
            let own = grounded
                .facts
                .iter()
                .filter(|fact| fact.predicate.index() < domain.predicates.len());
            let facts: BTreeSet<Fact> =
                own.map(|fact| (fact.predicate, arguments(&fact.arguments))).collect();
            let instances = grounded
                .operators
                .iter()
                .map(|operator| (operator.action.0, arguments(&operator.arguments)));
            Some((facts, instances.collect::<BTreeSet<Instance>>()))
        }
    }
}

/// The instances that change something in one of the first `limit` states, and whether one of them is a goal state.
fn explore(domain: &Domain, problem: &Problem, limit: usize) -> (BTreeSet<Instance>, bool) {
    let init = problem.init.iter().map(|fact| (fact.predicate, fact.arguments.to_vec()));
    let initial: BTreeSet<Fact> =
        init.filter(|fact| !domain.predicates[fact.0.index()].derived).collect();
    let mut states = vec![initial.clone()];
    let mut seen = BTreeSet::from([initial]);
    let (mut useful, mut solved) = (BTreeSet::new(), false);
    let mut next = 0;
    while next < states.len() && next < limit {
        // In a state what may hold is what must hold, but for what axioms derive from it.
        let mut known = Known {
            domain,
            problem,
            reachable: states[next].clone(),
            always: states[next].clone(),
        };
        for _ in &domain.axioms {
            let derived = known.derived(true);
            known.reachable.extend(derived);
            known.always = known.reachable.clone();
        }
        let types = known.types(&problem.goal_scope);
        solved |= known.root(&problem.goal, &types, true, &mut vec![ObjectId(0); types.len()]);
        known.instances(&mut |instance, added, deleted| {
            let mut after = states[next].clone();
            after.retain(|fact| !deleted.contains(fact));
            after.extend(added.iter().cloned());
            if after != states[next] {
                useful.insert(instance);
                if seen.insert(after.clone()) {
                    states.push(after);
                }
            }
        });
        next += 1;
    }
    (useful, solved)
}

/// The grounder invents nothing that brute force under delete relaxation does not find, and loses nothing that is of use in a reachable state.
#[track_caller]
fn check_bounds(domain_text: &str, problem_text: &str) {
    let (domain, problem) = read(domain_text, problem_text);
    let context = format!("\n{domain_text}\n{problem_text}");
    let (useful, solved) = explore(&domain, &problem, 200);
    let Some((facts, instances)) = grounded(&domain, &problem) else {
        assert!(!solved, "a goal state is reachable{context}");
        return;
    };
    let (relaxed_facts, relaxed_instances) =
        brute_force(&domain, &problem).expect("brute force reaches what the grounder reaches");
    assert!(facts.is_subset(&relaxed_facts), "{facts:?}\n{relaxed_facts:?}{context}");
    assert!(
        instances.is_subset(&relaxed_instances),
        "{instances:?}\n{relaxed_instances:?}{context}"
    );
    assert!(useful.is_subset(&instances), "{useful:?}\n{instances:?}{context}");
}

/// Facts and instances are exactly those of brute force under delete relaxation.
#[track_caller]
fn check(domain_text: &str, problem_text: &str) {
    let (domain, problem) = read(domain_text, problem_text);
    assert_eq!(
        grounded(&domain, &problem),
        brute_force(&domain, &problem),
        "\n{domain_text}\n{problem_text}"
    );
}

#[test]
fn the_reference_domains_ground_as_brute_force_does() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../domains");
    let mut count = 0;
    for entry in std::fs::read_dir(&folder).expect("the folder of domains is there") {
        let path = entry.expect("it can be listed").path();
        let (domain, problem) = (path.join("domain.pddl"), path.join("p01.pddl"));
        if domain.exists() && problem.exists() {
            let text = |path| std::fs::read_to_string(path).expect("it can be read");
            check(&text(domain), &text(problem));
            count += 1;
        }
    }
    assert!(count >= 8, "only {count} domains");
}

/// A random condition over `?x` and `?y`, static predicates `s` and `t`, and `p` and `q`, which change.
fn condition(depth: u32) -> BoxedStrategy<String> {
    let term = prop_oneof![Just("?x"), Just("?y"), Just("a"), Just("?z")];
    let atom = (
        prop_oneof![Just("s"), Just("p"), Just("t"), Just("q"), Just("d"), Just("=")],
        term.clone(),
        term,
    )
        .prop_map(|(predicate, left, right)| match predicate {
            "s" | "p" | "d" => format!("({predicate} {left})"),
            _ => format!("({predicate} {left} {right})"),
        });
    let leaf = prop_oneof![3 => atom.clone(), 1 => atom.prop_map(|atom| format!("(not {atom})"))];
    leaf.prop_recursive(depth, 8, 3, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..3)
                .prop_map(|parts| format!("(and {})", parts.join(" "))),
            prop::collection::vec(inner.clone(), 0..3)
                .prop_map(|parts| format!("(or {})", parts.join(" "))),
            inner.clone().prop_map(|part| format!("(not {part})")),
            (inner.clone(), inner.clone())
                .prop_map(|(left, right)| format!("(imply {left} {right})")),
            inner.clone().prop_map(|part| format!("(forall (?z - u) {part})")),
            inner.prop_map(|part| format!("(exists (?z) {part})")),
        ]
    })
    .prop_map(|text| if text.contains("?z") { format!("(exists (?z) {text})") } else { text })
    .boxed()
}

fn effect() -> BoxedStrategy<String> {
    let literal = prop_oneof![
        Just("(p ?x)"),
        Just("(p ?y)"),
        Just("(not (p ?x))"),
        Just("(q ?x ?y)"),
        Just("(not (q ?x ?y))"),
        Just("(q ?y a)")
    ];
    prop_oneof![
        3 => literal.clone().prop_map(str::to_owned),
        1 => (condition(1), literal.clone()).prop_map(|(condition, literal)| format!("(when {condition} {literal})")),
        1 => (condition(1), literal).prop_map(|(condition, literal)| {
            format!("(forall (?w - u) (when {} {}))", condition.replace("?y", "?w"), literal.replace("?y", "?w"))
        }),
    ]
    .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn nothing_useful_is_lost_and_nothing_is_invented_on_random_problems(
        conditions in prop::collection::vec(condition(3), 2),
        effects in prop::collection::vec(prop::collection::vec(effect(), 1..3), 2),
        derived in condition(2),
        goal in condition(2),
        facts in prop::collection::vec(prop::sample::select(vec![
            "(s a)", "(s b)", "(s c)", "(t a b)", "(t b c)", "(t c a)", "(t a a)", "(p a)", "(p b)", "(q a b)", "(q c c)",
        ]), 0..7),
    ) {
        // One axiom over facts, so that a state decides at once what is derived.
        let derived = derived.replace("?y", "a").replace("(d ", "(p ");
        let goal = goal.replace("?x", "b").replace("?y", "c");
        let domain = format!(
            "(define (domain random) (:requirements :adl :derived-predicates) (:types u) (:constants a - u)
              (:predicates (s ?a) (t ?a ?b) (p ?a) (q ?a ?b) (d ?a))
              (:derived (d ?x - u) {derived})
              (:action one :parameters (?x ?y - u) :precondition {} :effect (and {}))
              (:action two :parameters (?x - u ?y) :precondition {} :effect (and {})))",
            conditions[0], effects[0].join(" "), conditions[1], effects[1].join(" "),
        );
        let problem = format!(
            "(define (problem random) (:domain random) (:objects b - u c) (:init {}) (:goal {goal}))",
            facts.join(" "),
        );
        check_bounds(&domain, &problem);
    }
}
