//! What is printed reads as the same again, for any AST.

use lang::ast::{
    Action, Amount, Application, Connective, Derived, Domain, DomainSection, Entry, EntryKind,
    Feature, Formula, FunctionGroup, Group, Head, Init, Name, Node, NodeKind, Place, Problem,
    ProblemSection, Quantifier, TypeReference, TypedList, Unread,
};
use lang::diagnostic::Diagnostics;
use lang::print;
use lang::source::{Sources, Span};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

/// Words that are names, although some of them are keywords elsewhere.
const WORDS: [&str; 16] = [
    "a",
    "Block-A",
    "at",
    "over",
    "end",
    "object",
    "either",
    "15-puzzle",
    "x_1",
    "problem",
    "domain",
    "start",
    "2nd",
    "define",
    "p@q",
    "minimize",
];
const VARIABLES: [&str; 5] = ["?x", "?Y", "?from-1", "?object", "?at"];
const NUMBERS: [&str; 6] = ["0", "4.0", ".5", "5.", "-1", "1e3"];

fn name(text: &'static str) -> Name<'static> {
    Name { text, span: Span::default() }
}

fn word() -> impl Strategy<Value = Name<'static>> + Clone {
    select(&WORDS[..]).prop_map(name)
}

fn variable() -> impl Strategy<Value = Name<'static>> + Clone {
    select(&VARIABLES[..]).prop_map(name)
}

fn types() -> impl Strategy<Value = TypeReference<'static>> {
    vec(word(), 1..3).prop_map(|names| TypeReference { names })
}

/// Groups with types, then perhaps one without.
fn list(
    entry: impl Strategy<Value = Name<'static>> + Clone,
) -> impl Strategy<Value = TypedList<'static>> {
    let typed = (vec(entry.clone(), 1..3), types())
        .prop_map(|(names, types)| Group { names, types: Some(types) });
    let untyped = vec(entry, 1..3).prop_map(|names| Group { names, types: None });
    (vec(typed, 0..3), option::of(untyped)).prop_map(|(mut groups, last)| {
        groups.extend(last);
        TypedList { groups }
    })
}

fn head() -> impl Strategy<Value = Head<'static>> {
    (word(), list(variable())).prop_map(|(name, parameters)| Head {
        name,
        parameters,
        place: Place::default(),
    })
}

/// A formula before it is laid out flat.
#[derive(Debug, Clone)]
enum Shape {
    Atom(Name<'static>, Vec<Name<'static>>),
    Equal(Name<'static>, Name<'static>),
    Connective(Connective, Vec<Shape>),
    Quantifier(Quantifier, TypedList<'static>, Vec<Shape>),
    Increase(
        Name<'static>,
        Vec<Name<'static>>,
        Result<Name<'static>, (Name<'static>, Vec<Name<'static>>)>,
    ),
    Unread(Feature, Name<'static>, Name<'static>),
}

fn term() -> impl Strategy<Value = Name<'static>> + Clone {
    prop_oneof![variable(), word()]
}

fn shape() -> impl Strategy<Value = Shape> {
    let leaf = prop_oneof![
        6 => (word(), vec(term(), 0..4)).prop_map(|(name, terms)| Shape::Atom(name, terms)),
        1 => (term(), term()).prop_map(|(left, right)| Shape::Equal(left, right)),
        1 => (word(), vec(term(), 0..3), select(&NUMBERS[..]))
            .prop_map(|(function, terms, number)| Shape::Increase(function, terms, Ok(name(number)))),
        1 => (word(), vec(term(), 0..3), word(), vec(term(), 0..3))
            .prop_map(|(left, terms, right, others)| Shape::Increase(left, terms, Err((right, others)))),
        1 => Just(Shape::Unread(Feature::NumericConditions, name(">="), name("(>= (fuel ?x) 3)"))),
        1 => Just(Shape::Unread(Feature::Preferences, name("preference"), name("(preference soon  (at ?x))"))),
    ];
    let connectives =
        [Connective::And, Connective::Or, Connective::Not, Connective::Imply, Connective::When];
    leaf.prop_recursive(5, 24, 4, move |inner| {
        prop_oneof![
            (select(connectives.to_vec()), vec(inner.clone(), 0..4))
                .prop_map(|(word, parts)| Shape::Connective(word, parts)),
            (
                select(vec![Quantifier::Forall, Quantifier::Exists]),
                list(variable()),
                vec(inner, 0..3)
            )
                .prop_map(|(word, variables, parts)| Shape::Quantifier(word, variables, parts)),
        ]
    })
}

fn apply(
    name: Name<'static>,
    arguments: &[Name<'static>],
    terms: &mut Vec<Name<'static>>,
) -> Application<'static> {
    let start = terms.len() as u32;
    terms.extend_from_slice(arguments);
    Application { name, arguments: start..terms.len() as u32 }
}

fn flatten(shape: &Shape, formula: &mut Formula<'static>) {
    let index = formula.nodes.len();
    let terms = &mut formula.terms;
    let mut children: &[Shape] = &[];
    let kind = match shape {
        Shape::Atom(name, arguments) => NodeKind::Atom(apply(*name, arguments, terms)),
        Shape::Equal(left, right) => NodeKind::Equal(apply(name("="), &[*left, *right], terms)),
        Shape::Connective(word, parts) => {
            children = parts;
            NodeKind::Connective(*word)
        }
        Shape::Quantifier(word, variables, parts) => {
            children = parts;
            NodeKind::Quantifier(*word, variables.clone())
        }
        Shape::Increase(function, arguments, amount) => {
            let function = apply(*function, arguments, terms);
            let amount = match amount {
                Ok(number) => Amount::Number(*number),
                Err((name, arguments)) => {
                    Amount::Function(apply(*name, arguments, terms), Place::default())
                }
            };
            NodeKind::Increase(function, amount)
        }
        Shape::Unread(feature, keyword, node) => {
            NodeKind::Unread(Unread { feature: *feature, keyword: *keyword, node: *node })
        }
    };
    formula.nodes.push(Node { kind, next: 0, place: Place::default(), keyword: Place::default() });
    for child in children {
        flatten(child, formula);
    }
    formula.nodes[index].next = formula.nodes.len() as u32;
}

fn formula() -> impl Strategy<Value = Formula<'static>> {
    shape().prop_map(|shape| {
        let mut formula = Formula::default();
        flatten(&shape, &mut formula);
        formula
    })
}

fn unread(feature: Feature, keyword: &'static str, node: &'static str) -> Unread<'static> {
    Unread { feature, keyword: name(keyword), node: name(node) }
}

fn action() -> impl Strategy<Value = Action<'static>> {
    let duration =
        option::of(Just(unread(Feature::DurativeActions, ":duration", "(= ?duration 5)")));
    (word(), list(variable()), option::of(formula()), option::of(formula()), duration).prop_map(
        |(name, parameters, precondition, effect, duration)| Action {
            name,
            parameters,
            preconditions: precondition.into_iter().collect(),
            effects: effect.into_iter().collect(),
            unread: duration.into_iter().collect(),
            place: Place::default(),
        },
    )
}

fn function_groups() -> impl Strategy<Value = Vec<FunctionGroup<'static>>> {
    let typed = (vec(head(), 1..3), types())
        .prop_map(|(heads, types)| FunctionGroup { heads, types: Some(types) });
    let untyped = vec(head(), 1..3).prop_map(|heads| FunctionGroup { heads, types: None });
    (vec(typed, 0..3), option::of(untyped)).prop_map(|(mut groups, last)| {
        groups.extend(last);
        groups
    })
}

fn domain() -> impl Strategy<Value = Domain<'static>> {
    let flags = select(vec![":strips", ":ADL", ":typing"]).prop_map(name);
    let derived = (head(), formula()).prop_map(|(head, body)| Derived {
        head,
        body: Some(body),
        place: Place::default(),
    });
    let section = prop_oneof![
        vec(flags, 0..3).prop_map(DomainSection::Requirements),
        list(word()).prop_map(DomainSection::Types),
        list(word()).prop_map(DomainSection::Constants),
        vec(head(), 0..4).prop_map(DomainSection::Predicates),
        function_groups().prop_map(DomainSection::Functions),
        action().prop_map(DomainSection::Action),
        derived.prop_map(DomainSection::Derived),
        Just(DomainSection::Unread(unread(
            Feature::Processes,
            ":event",
            "(:event boom :parameters () :effect (lit))"
        ))),
    ];
    (word(), vec(section, 0..6)).prop_map(|(name, sections)| Domain { name, sections })
}

fn init() -> impl Strategy<Value = Init<'static>> {
    let entry = (0..4_u8, word(), vec(word(), 0..4), select(&NUMBERS[..]));
    vec(entry, 0..6).prop_map(|entries| {
        let mut init = Init::default();
        for (choice, predicate, arguments, number) in entries {
            let kind = match choice {
                0 => EntryKind::Absent(apply(predicate, &arguments, &mut init.terms)),
                1 => EntryKind::Value(apply(predicate, &arguments, &mut init.terms), name(number)),
                2 => EntryKind::Unread(unread(Feature::TimedLiterals, "at", "(at 5 (lit))")),
                _ => EntryKind::Fact(apply(predicate, &arguments, &mut init.terms)),
            };
            init.entries.push(Entry { kind, place: Place::default() });
        }
        init
    })
}

fn problem() -> impl Strategy<Value = Problem<'static>> {
    let section = prop_oneof![
        word().prop_map(ProblemSection::Domain),
        list(word()).prop_map(ProblemSection::Objects),
        init().prop_map(ProblemSection::Init),
        formula().prop_map(|goal| ProblemSection::Goal(vec![goal])),
        word().prop_map(|function| ProblemSection::Metric(function, Place::default())),
        Just(ProblemSection::Unread(unread(
            Feature::Constraints,
            ":constraints",
            "(:constraints (always (p)))"
        ))),
    ];
    (word(), vec(section, 0..5)).prop_map(|(name, sections)| Problem { name, sections })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn a_printed_domain_reads_as_the_same(domain in domain()) {
        let mut sources = Sources::default();
        let id = sources.add("printed.pddl", print::domain(&domain));
        let mut diagnostics = Diagnostics::default();
        let again = lang::parse_domain(&sources, id, &mut diagnostics);
        prop_assert_eq!(&again, &domain, "{}", sources.get(id).text);
        prop_assert_eq!(diagnostics.list, []);
    }

    #[test]
    fn a_printed_problem_reads_as_the_same(problem in problem()) {
        let mut sources = Sources::default();
        let id = sources.add("printed.pddl", print::problem(&problem));
        let mut diagnostics = Diagnostics::default();
        let again = lang::parse_problem(&sources, id, &mut diagnostics);
        prop_assert_eq!(&again, &problem, "{}", sources.get(id).text);
        prop_assert_eq!(diagnostics.list, []);
    }
}

#[test]
fn the_fixtures_are_printed_as_they_read() {
    let mut sources = Sources::default();
    let domain = sources.add("domain.pddl", include_str!("fixtures/domain.pddl"));
    let domain = print::domain(&lang::parse_domain(&sources, domain, &mut Diagnostics::default()));
    insta::assert_snapshot!(domain);
    let problem = sources.add("problem.pddl", include_str!("fixtures/problem.pddl"));
    let problem =
        print::problem(&lang::parse_problem(&sources, problem, &mut Diagnostics::default()));
    insta::assert_snapshot!(problem);
}
