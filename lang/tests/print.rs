//! What is printed reads as the same again, for any AST.

use lang::ast::{
    Action, ActionKind, Agent, Application, Axiom, Concurrency, Connective, Derived, Domain,
    DomainSection, Entry, EntryKind, Feature, Formula, FunctionGroup, Goal, Group, Head, Init,
    InitialNetwork, Method, Metric, Modality, Name, Network, Node, NodeKind, Operator, Participant,
    Place, Predicates, Private, Problem, ProblemSection, Quantifier, Subtask, Task, Time,
    TypeReference, TypedList, Unread,
};
use lang::diagnostic::Diagnostics;
use lang::print;
use lang::source::{Sources, Span};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

/// Words that are names, although some of them are keywords elsewhere.
const WORDS: [&str; 15] = [
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
        TypedList { groups, private: Vec::new() }
    })
}

/// Objects, some of which may be private.
fn objects() -> impl Strategy<Value = TypedList<'static>> {
    let private =
        list(word()).prop_map(|list| Private { keyword: name(":private"), groups: list.groups });
    (list(word()), vec(private, 0..2)).prop_map(|(list, private)| TypedList { private, ..list })
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
    Apply(Name<'static>, Vec<Name<'static>>),
    Node(NodeKind<'static>, Vec<Shape>),
}

fn term() -> impl Strategy<Value = Name<'static>> + Clone {
    prop_oneof![variable(), word()]
}

fn number() -> impl Strategy<Value = Name<'static>> + Clone {
    select(&NUMBERS[..]).prop_map(name)
}

/// Something with a value.
fn value() -> impl Strategy<Value = Shape> + Clone {
    let word = |name| Shape::Node(NodeKind::Word(name), Vec::new());
    let leaf = prop_oneof![
        number().prop_map(word),
        term().prop_map(word),
        select(vec!["#t", "?duration"]).prop_map(move |text| word(name(text))),
        (self::word(), vec(term(), 0..3)).prop_map(|(name, terms)| Shape::Apply(name, terms)),
    ];
    let computing = vec![Operator::Add, Operator::Subtract, Operator::Multiply, Operator::Divide];
    leaf.prop_recursive(3, 12, 3, move |inner| {
        prop_oneof![
            (select(computing.clone()), vec(inner.clone(), 0..4))
                .prop_map(|(operator, parts)| Shape::Node(NodeKind::Operator(operator), parts)),
            (self::word(), call(), vec(inner, 0..2)).prop_map(nested),
        ]
    })
}

/// The value of a function.
fn call() -> impl Strategy<Value = Shape> + Clone {
    (word(), vec(term(), 0..3)).prop_map(|(name, terms)| Shape::Apply(name, terms))
}

fn nested((name, first, mut parts): (Name<'static>, Shape, Vec<Shape>)) -> Shape {
    parts.insert(0, first);
    Shape::Node(NodeKind::Nested(name), parts)
}

/// A modality with points in time, as many as it takes.
fn modality() -> impl Strategy<Value = (Modality, Vec<Name<'static>>)> + Clone {
    let all = vec![
        Modality::Always,
        Modality::Sometime,
        Modality::Within,
        Modality::AtMostOnce,
        Modality::SometimeAfter,
        Modality::SometimeBefore,
        Modality::AlwaysWithin,
        Modality::HoldDuring,
        Modality::HoldAfter,
    ];
    (select(all), vec(number(), 2)).prop_map(|(modality, mut times)| {
        times.truncate(modality.operands().0);
        (modality, times)
    })
}

fn shape() -> impl Strategy<Value = Shape> {
    let comparing = vec![
        Operator::Equal,
        Operator::Less,
        Operator::LessEqual,
        Operator::Greater,
        Operator::GreaterEqual,
    ];
    let changing = vec![
        Operator::Assign,
        Operator::Increase,
        Operator::Decrease,
        Operator::ScaleUp,
        Operator::ScaleDown,
    ];
    let leaf = prop_oneof![
        6 => (word(), vec(term(), 0..4)).prop_map(|(name, terms)| Shape::Apply(name, terms)),
        2 => (select(comparing), vec(value(), 0..3))
            .prop_map(|(operator, parts)| Shape::Node(NodeKind::Operator(operator), parts)),
        1 => (select(changing), call(), value())
            .prop_map(|(operator, target, amount)| {
                Shape::Node(NodeKind::Operator(operator), vec![target, amount])
            }),
        1 => (select(vec!["p", "on-top", "busy"]).prop_map(name), call(), vec(value(), 0..2))
            .prop_map(nested),
        1 => Just(Shape::Node(
            NodeKind::Unread(unread(Feature::Nondeterminism, "oneof", "(oneof (p)  (q))")),
            Vec::new(),
        )),
    ];
    let connectives =
        [Connective::And, Connective::Or, Connective::Not, Connective::Imply, Connective::When];
    leaf.prop_recursive(5, 24, 4, move |inner| {
        prop_oneof![
            3 => (select(connectives.to_vec()), vec(inner.clone(), 0..4))
                .prop_map(|(word, parts)| Shape::Node(NodeKind::Connective(word), parts)),
            2 => (
                select(vec![Quantifier::Forall, Quantifier::Exists]),
                list(variable()),
                vec(inner.clone(), 0..3)
            )
                .prop_map(|(word, variables, parts)| {
                    Shape::Node(NodeKind::Quantifier(word, variables), parts)
                }),
            1 => (select(vec![Time::AtStart, Time::AtEnd, Time::OverAll]), inner.clone())
                .prop_map(|(time, part)| Shape::Node(NodeKind::Timed(time), vec![part])),
            1 => (option::of(word()), inner.clone())
                .prop_map(|(name, part)| Shape::Node(NodeKind::Preference(name), vec![part])),
            1 => (modality(), inner.clone(), inner)
                .prop_map(|((modality, times), one, two)| {
                    let mut parts = vec![one, two];
                    parts.truncate(modality.operands().1);
                    Shape::Node(NodeKind::Trajectory(modality, times), parts)
                }),
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
    let (kind, children): (_, &[Shape]) = match shape {
        Shape::Apply(name, arguments) => (NodeKind::Apply(apply(*name, arguments, terms)), &[]),
        Shape::Node(kind, children) => (kind.clone(), children),
    };
    formula.nodes.push(Node { kind, next: 0, place: Place::default(), keyword: Place::default() });
    for child in children {
        flatten(child, formula);
    }
    formula.nodes[index].next = formula.nodes.len() as u32;
}

fn flat(shape: impl Strategy<Value = Shape>) -> impl Strategy<Value = Formula<'static>> {
    shape.prop_map(|shape| {
        let mut formula = Formula::default();
        flatten(&shape, &mut formula);
        formula
    })
}

fn formula() -> impl Strategy<Value = Formula<'static>> {
    flat(shape())
}

fn unread(feature: Feature, keyword: &'static str, node: &'static str) -> Unread<'static> {
    Unread { feature, keyword: name(keyword), node: name(node) }
}

fn agent() -> impl Strategy<Value = Agent<'static>> {
    let variable = (variable(), option::of(types()));
    prop_oneof![variable, word().prop_map(|name| (name, None))].prop_map(|(agent, types)| Agent {
        keyword: name(":agent"),
        name: agent,
        types,
    })
}

fn action() -> impl Strategy<Value = Action<'static>> {
    let kinds =
        vec![ActionKind::Instant, ActionKind::Durative, ActionKind::Process, ActionKind::Event];
    let head = (select(kinds), word(), option::of(agent()), list(variable()));
    let body = (option::of(formula()), option::of(formula()), formula(), any::<bool>());
    (head, body).prop_map(|(head, (precondition, effect, duration, observes))| {
        let (kind, name, agent, parameters) = head;
        let durative = kind == ActionKind::Durative;
        let may_act = durative || kind == ActionKind::Instant;
        let observes = observes && kind == ActionKind::Instant;
        let observe = unread(Feature::Nondeterminism, ":observe", "(lit)");
        Action {
            kind,
            name,
            agent: agent.filter(|_| may_act),
            parameters,
            durations: durative.then_some(duration).into_iter().collect(),
            preconditions: precondition.into_iter().collect(),
            effects: effect.into_iter().collect(),
            unread: observes.then_some(observe).into_iter().collect(),
            place: Place::default(),
        }
    })
}

fn network() -> impl Strategy<Value = Network<'static>> {
    let subtask = (option::of(word()), word(), vec(term(), 0..3));
    let ordering = vec((word(), word()), 0..3);
    (any::<bool>(), vec(subtask, 0..3), ordering, option::of(formula())).prop_map(
        |(ordered, parts, ordering, constraints)| {
            let mut network = Network { ordered, ordering, ..Network::default() };
            network.constraints.extend(constraints);
            for (label, task, arguments) in parts {
                let task = apply(task, &arguments, &mut network.terms);
                network.subtasks.push(Subtask { label, task, place: Place::default() });
            }
            network
        },
    )
}

fn method() -> impl Strategy<Value = Method<'static>> {
    let task = flat((word(), vec(term(), 0..3)).prop_map(|(task, terms)| {
        let task = if task.text == "and" { name("tidy") } else { task };
        Shape::Apply(task, terms)
    }));
    (word(), list(variable()), task, option::of(formula()), network()).prop_map(
        |(name, parameters, task, precondition, network)| Method {
            name,
            parameters,
            task: Some(task),
            preconditions: precondition.into_iter().collect(),
            network,
            place: Place::default(),
        },
    )
}

fn concurrency() -> impl Strategy<Value = Concurrency<'static>> {
    let participant = (word(), vec(number(), 0..3)).prop_map(|(action, positions)| Participant {
        action,
        positions,
        place: Place::default(),
    });
    (word(), list(variable()), vec(participant, 0..3)).prop_map(
        |(constraint, parameters, actions)| Concurrency {
            name: constraint,
            parameters,
            bounds: vec![name("1"), name("inf")],
            actions,
            place: Place::default(),
        },
    )
}

fn predicates() -> impl Strategy<Value = Vec<Predicates<'static>>> {
    let private = (list(variable()), vec(head(), 0..3)).prop_map(|(owner, heads)| Predicates {
        private: Some(name(":private")),
        owner,
        heads,
    });
    let public = vec(head(), 1..4).prop_map(|heads| Predicates {
        private: None,
        owner: TypedList::default(),
        heads,
    });
    (option::of(public), vec(private, 0..2)).prop_map(|(public, private)| {
        let mut all: Vec<_> = public.into_iter().collect();
        all.extend(private);
        all
    })
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
        objects().prop_map(DomainSection::Constants),
        predicates().prop_map(DomainSection::Predicates),
        function_groups().prop_map(DomainSection::Functions),
        action().prop_map(DomainSection::Action),
        derived.prop_map(DomainSection::Derived),
        (list(variable()), formula(), formula()).prop_map(|(variables, context, implies)| {
            let (context, implies) = (Some(context), Some(implies));
            DomainSection::Axiom(Axiom { keyword: name(":axiom"), variables, context, implies })
        }),
        vec(formula(), 1).prop_map(|all| DomainSection::Constraints(name(":constraints"), all)),
        (word(), list(variable())).prop_map(|(name, parameters)| {
            DomainSection::Task(Task { name, parameters, place: Place::default() })
        }),
        method().prop_map(DomainSection::Method),
        concurrency().prop_map(DomainSection::Concurrency),
        vec(word(), 2)
            .prop_map(|both| DomainSection::Dependence(name(":positive-dependence"), both)),
        Just(DomainSection::Unread(unread(
            Feature::Axioms,
            ":timeless",
            "(:timeless (lit)  (dark))"
        ))),
    ];
    (word(), vec(section, 0..6)).prop_map(|(name, sections)| Domain { name, sections })
}

fn init() -> impl Strategy<Value = Init<'static>> {
    let entry = (0..5_u8, word(), vec(word(), 0..4), select(&NUMBERS[..]), option::of(number()));
    vec(entry, 0..6).prop_map(|entries| {
        let mut init = Init::default();
        for (choice, predicate, arguments, number, time) in entries {
            let kind = match choice {
                0 => EntryKind::Absent(apply(predicate, &arguments, &mut init.terms)),
                1 => EntryKind::Value(apply(predicate, &arguments, &mut init.terms), name(number)),
                2 => EntryKind::Value(apply(predicate, &arguments, &mut init.terms), name("a")),
                3 => EntryKind::Unread(unread(Feature::Nondeterminism, "oneof", "(oneof (p) (q))")),
                _ => EntryKind::Fact(apply(predicate, &arguments, &mut init.terms)),
            };
            init.entries.push(Entry { kind, time, place: Place::default() });
        }
        init
    })
}

fn problem() -> impl Strategy<Value = Problem<'static>> {
    let section = prop_oneof![
        word().prop_map(ProblemSection::Domain),
        objects().prop_map(ProblemSection::Objects),
        init().prop_map(ProblemSection::Init),
        (option::of(agent()), formula())
            .prop_map(|(agent, goal)| ProblemSection::Goal(Goal { agent, formulas: vec![goal] })),
        (option::of(agent()), select(vec!["minimize", "maximize"]), flat(value())).prop_map(
            |(agent, direction, value)| ProblemSection::Metric(Metric {
                keyword: name(":metric"),
                agent,
                direction: name(direction),
                value: Some(value),
            })
        ),
        vec(formula(), 1).prop_map(|all| ProblemSection::Constraints(name(":constraints"), all)),
        (list(variable()), network()).prop_map(|(parameters, network)| {
            let keyword = name(":htn");
            ProblemSection::Network(InitialNetwork { keyword, parameters, network })
        }),
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
