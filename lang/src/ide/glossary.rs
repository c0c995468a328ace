//! The words of the language: what each of them means, and what is written with it.
//!
//! In what is written, `$1` and `${1:name}` are places to fill in, and `$0` is where the cursor ends.

/// A word, what it means, and what is written with it behind its parenthesis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word {
    pub(super) text: &'static str,
    pub(super) meaning: &'static str,
    pub(super) snippet: &'static str,
}

const fn word(text: &'static str, meaning: &'static str, snippet: &'static str) -> Word {
    Word { text, meaning, snippet }
}

/// The sections of a domain.
pub(super) const DOMAIN: [Word; 14] = [
    word(":requirements", "the parts of the language that are used", ":requirements $0"),
    word(":types", "the types of objects", ":types $0"),
    word(":constants", "objects that every problem has", ":constants $0"),
    word(":predicates", "what can be true or false", ":predicates\n    ($0)"),
    word(":functions", "what has a value", ":functions\n    ($0)"),
    word(
        ":action",
        "what can be done at once",
        ":action ${1:name}\n    :parameters ($2)\n    :precondition (and $3)\n    :effect (and $0)",
    ),
    word(
        ":durative-action",
        "what takes time",
        ":durative-action ${1:name}\n    :parameters ($2)\n    :duration (= ?duration ${3:1})\n    :condition (and $4)\n    :effect (and $0)",
    ),
    word(":derived", "a predicate that follows from others", ":derived (${1:name}) $0"),
    word(
        ":process",
        "what goes on while its condition holds",
        ":process ${1:name}\n    :parameters ($2)\n    :precondition (and $3)\n    :effect (and $0)",
    ),
    word(
        ":event",
        "what happens as soon as its condition holds",
        ":event ${1:name}\n    :parameters ($2)\n    :precondition (and $3)\n    :effect (and $0)",
    ),
    word(":constraints", "what must hold along the whole plan", ":constraints (and $0)"),
    word(":task", "what methods take apart", ":task ${1:name} :parameters ($0)"),
    word(
        ":method",
        "a way to take a task apart",
        ":method ${1:name}\n    :parameters ($2)\n    :task (${3:task})\n    :precondition (and $4)\n    :ordered-subtasks (and $0)",
    ),
    word(
        ":concurrency-constraint",
        "how many agents may or must act together",
        ":concurrency-constraint ${1:name}\n    :parameters ($2)\n    :bounds (${3:1} ${4:inf})\n    :actions ($0)",
    ),
];

/// The sections of a problem.
pub(super) const PROBLEM: [Word; 8] = [
    word(":domain", "the domain to which the problem belongs", ":domain $0"),
    word(":requirements", "the parts of the language that are used", ":requirements $0"),
    word(":objects", "what there is", ":objects $0"),
    word(":init", "what holds at first", ":init\n    ($0)"),
    word(":goal", "what is to hold in the end", ":goal (and $0)"),
    word(":metric", "what makes one plan better than another", ":metric minimize ($0)"),
    word(":constraints", "what must hold along the whole plan", ":constraints (and $0)"),
    word(
        ":htn",
        "the tasks to be done",
        ":htn\n    :parameters ($1)\n    :ordered-subtasks (and $0)",
    ),
];

/// The fields of sections, with the sections that have them.
pub(super) const FIELDS: [(&[&str], Word); 17] = [
    (
        &[
            ":action",
            ":durative-action",
            ":process",
            ":event",
            ":task",
            ":method",
            ":htn",
            ":concurrency-constraint",
        ],
        word(":parameters", "the variables, with their types", ":parameters ($0)"),
    ),
    (
        &[":action", ":process", ":event", ":method"],
        word(":precondition", "what must hold before", ":precondition (and $0)"),
    ),
    (&[":durative-action"], word(":duration", "how long it takes", ":duration (= ?duration $0)")),
    (&[":durative-action"], word(":condition", "what must hold, and when", ":condition (and $0)")),
    (
        &[":action", ":durative-action", ":process", ":event"],
        word(":effect", "what changes", ":effect (and $0)"),
    ),
    (&[":action", ":durative-action"], word(":agent", "who acts", ":agent ?${1:a} - ${0:agent}")),
    (&[":action"], word(":observe", "what is seen", ":observe $0")),
    (&[":method"], word(":task", "the task that is taken apart", ":task ($0)")),
    (
        &[":method", ":htn"],
        word(":ordered-subtasks", "what to do, one after the other", ":ordered-subtasks (and $0)"),
    ),
    (&[":method", ":htn"], word(":subtasks", "what to do, in some order", ":subtasks (and $0)")),
    (
        &[":method", ":htn"],
        word(":ordered-tasks", "as `:ordered-subtasks`", ":ordered-tasks (and $0)"),
    ),
    (&[":method", ":htn"], word(":tasks", "as `:subtasks`", ":tasks (and $0)")),
    (&[":method", ":htn"], word(":ordering", "which comes before which", ":ordering (and (< $0))")),
    (&[":method", ":htn"], word(":constraints", "which variables differ", ":constraints (and $0)")),
    (
        &[":concurrency-constraint"],
        word(":bounds", "how many at least and at most", ":bounds (${1:1} ${0:inf})"),
    ),
    (
        &[":concurrency-constraint"],
        word(
            ":actions",
            "which actions, and in which of their parameters they meet",
            ":actions (($0))",
        ),
    ),
    (&[":event", ":process"], word(":comment", "words for people", ":comment $0")),
];

/// What may stand at the head of a condition.
pub(super) const CONDITION: [Word; 12] = [
    word("and", "all of them hold", "and $0"),
    word("or", "one of them holds", "or $0"),
    word("not", "it does not hold", "not ($0)"),
    word("imply", "the second holds or the first does not", "imply ($1) ($0)"),
    word("forall", "it holds for all", "forall (${1:?x}) ($0)"),
    word("exists", "it holds for one", "exists (${1:?x}) ($0)"),
    word("=", "both are the same", "= $1 $0"),
    word(">", "the first is more", "> $1 $0"),
    word("<", "the first is less", "< $1 $0"),
    word(">=", "the first is no less", ">= $1 $0"),
    word("<=", "the first is no more", "<= $1 $0"),
    word("preference", "good to have", "preference ${1:name} ($0)"),
];

/// When a part of a durative action holds or happens.
pub(super) const TIMES: [Word; 3] = [
    word("at start", "at its start", "at start ($0)"),
    word("over all", "all the while", "over all ($0)"),
    word("at end", "at its end", "at end ($0)"),
];

/// What may stand at the head of a constraint on the whole plan.
pub(super) const CONSTRAINT: [Word; 9] = [
    word("always", "in every state", "always ($0)"),
    word("sometime", "in some state", "sometime ($0)"),
    word("at-most-once", "in one stretch of states at most", "at-most-once ($0)"),
    word("at end", "in the last state", "at end ($0)"),
    word("within", "before some time", "within ${1:10} ($0)"),
    word("sometime-after", "some time after the first", "sometime-after ($1) ($0)"),
    word("sometime-before", "some time before the first", "sometime-before ($1) ($0)"),
    word("always-within", "soon after the first", "always-within ${1:10} ($2) ($0)"),
    word("hold-after", "from some time on", "hold-after ${1:10} ($0)"),
];

/// What may stand at the head of an effect.
pub(super) const EFFECT: [Word; 9] = [
    word("and", "all of them happen", "and $0"),
    word("not", "it becomes false", "not ($0)"),
    word("when", "it happens if something holds", "when ($1) ($0)"),
    word("forall", "it happens to all", "forall (${1:?x}) ($0)"),
    word("increase", "a value grows", "increase ($1) $0"),
    word("decrease", "a value shrinks", "decrease ($1) $0"),
    word("assign", "a value is set", "assign ($1) $0"),
    word("scale-up", "a value is multiplied", "scale-up ($1) $0"),
    word("scale-down", "a value is divided", "scale-down ($1) $0"),
];

/// What may stand at the head of an entry of the initial state.
pub(super) const INIT: [Word; 3] = [
    word("=", "a function has a value at first", "= ($1) $0"),
    word("not", "it is false at first", "not ($0)"),
    word("at", "it becomes true at some time", "at ${1:10} ($0)"),
];

/// What may stand at the head of a number.
pub(super) const NUMBER: [Word; 4] = [
    word("+", "the sum", "+ $1 $0"),
    word("-", "the difference", "- $1 $0"),
    word("*", "the product", "* $1 $0"),
    word("/", "the quotient", "/ $1 $0"),
];

/// What may be asked for in a metric.
pub(super) const METRIC: [Word; 2] = [
    word("minimize", "as little as possible", "minimize ($0)"),
    word("maximize", "as much as possible", "maximize ($0)"),
];

/// The flags that people use, with what they allow.
pub(super) const REQUIREMENTS: [(&str, &str); 28] = [
    (":strips", "adding and deleting atoms; always there"),
    (":typing", "types"),
    (":negative-preconditions", "`not` in conditions"),
    (":disjunctive-preconditions", "`or` and `imply` in conditions"),
    (":equality", "`=` between terms"),
    (":existential-preconditions", "`exists` in conditions"),
    (":universal-preconditions", "`forall` in conditions"),
    (":quantified-preconditions", "`exists` and `forall` in conditions"),
    (":conditional-effects", "`when` and `forall` in effects"),
    (":adl", "all of the above"),
    (":derived-predicates", "`:derived` rules"),
    (":action-costs", "`total-cost` and its increase"),
    (":numeric-fluents", "numbers that change"),
    (":object-fluents", "functions with objects as values"),
    (":durative-actions", "actions that take time"),
    (":duration-inequalities", "bounds on durations"),
    (":continuous-effects", "`#t`: change while time passes"),
    (":timed-initial-literals", "`(at TIME …)` in `:init`"),
    (":preferences", "`preference` in goals and conditions"),
    (":constraints", "`:constraints` on the whole plan"),
    (":time", "processes and events"),
    (":hierarchy", "tasks and methods"),
    (":method-preconditions", "conditions of methods"),
    (":multi-agent", "`:agent` of actions"),
    (":unfactored-privacy", "`(:private …)` with its agent"),
    (":factored-privacy", "`(:private …)` of the one agent"),
    (":concurrency-network", "`:concurrency-constraint`"),
    (":non-deterministic", "`oneof` in effects"),
];

/// What a word of the language means where it stands at the head of a list or as a keyword.
pub(super) fn meaning(spelling: &str) -> Option<&'static str> {
    let tables: [&[Word]; 9] =
        [&DOMAIN, &PROBLEM, &CONDITION, &TIMES, &CONSTRAINT, &EFFECT, &INIT, &NUMBER, &METRIC];
    let fields = FIELDS.iter().map(|(_, word)| word);
    let words = tables.into_iter().flatten().chain(fields);
    let found = words.map(|one| (one.text, one.meaning)).chain(REQUIREMENTS);
    let mut found = found.filter(|(one, _)| one.eq_ignore_ascii_case(spelling));
    found.next().map(|(_, meaning)| meaning)
}
