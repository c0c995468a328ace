//! How messages look, apart from what they say.

use lang::diagnostic::{Diagnostics, not_utf8};
use lang::render;
use lang::source::{Sources, Span};

fn domain(text: &str) -> (Diagnostics, Sources) {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", text);
    let (_, diagnostics) = lang::read_domain(&sources, id);
    (diagnostics, sources)
}

#[test]
fn long_lines_are_cut_around_the_mark() {
    let actions = |name: &str| {
        let each: Vec<String> =
            (0..20).map(|n| format!(" (:action {name}{n} :effect (lit))")).collect();
        each.concat()
    };
    let (before, after) = (actions("a"), actions("b"));
    let text = format!(
        "(define (domain d) (:predicates (lit)){before} (:action wash :effect (wet)){after})"
    );
    let (diagnostics, sources) = domain(&text);
    insta::assert_snapshot!(render::full(&diagnostics, &sources, false));
}

#[test]
fn distant_lines_are_shown_apart() {
    let (first, rest) = ("(define (domain d)\n  (:predicates (p)\n", "\n; nothing".repeat(400));
    let (diagnostics, sources) = domain(&format!("{first}{rest}\n    (p ?x)))\n"));
    insta::assert_snapshot!(render::full(&diagnostics, &sources, false));
}

#[test]
fn marks_of_several_lines_end_with_the_first() {
    let (diagnostics, sources) = domain(
        "(define (domain d)\r\n  (:predicates (p))\r\n  (:action a :effect (not (p)\r\n    (p))))\r\n",
    );
    insta::assert_snapshot!(render::full(&diagnostics, &sources, false));
}

#[test]
fn columns_count_characters() {
    let (diagnostics, sources) =
        domain("\u{feff}(define (domain d) ; é\n (:predicates (p)) (:action äö :effect (q)))\n");
    insta::assert_snapshot!(render::concise(&diagnostics, &sources), @r"
    domain.pddl:2:29: error[E0006] invalid-character: invalid character `ä` (U+00E4)
    domain.pddl:2:30: error[E0006] invalid-character: invalid character `ö` (U+00F6)
    domain.pddl:2:41: error[E0101] unknown-predicate: unknown predicate `q`
    ");
}

#[test]
fn color_is_only_for_terminals() {
    let (diagnostics, sources) = domain("(define (domain d) (:action a :effect (q)))\n");
    assert!(!render::full(&diagnostics, &sources, false).contains('\u{1b}'));
    assert!(render::full(&diagnostics, &sources, true).contains('\u{1b}'));
}

#[test]
fn summaries_count() {
    let (mut diagnostics, _) = domain(
        "(define (domain d) (:predicates (p ?x)) (:action a :parameters (?x) :effect (q)))\n",
    );
    assert_eq!(render::summary(&diagnostics).as_deref(), Some("1 error, 1 warning"));
    diagnostics.append(diagnostics.clone());
    assert_eq!(render::summary(&diagnostics).as_deref(), Some("2 errors, 2 warnings"));
    assert_eq!(render::summary(&Diagnostics::default()), None);
}

#[test]
fn nobody_reads_a_thousand_messages() {
    let uses: Vec<String> = (0..1000).map(|n| format!("(p{n})")).collect();
    let uses = uses.join("\n");
    let (diagnostics, sources) =
        domain(&format!("(define (domain d) (:action a :effect (and {uses})))\n"));
    let text = render::full(&diagnostics, &sources, false);
    assert!(text.ends_with("… and 900 more like these\n"), "{}", &text[text.len() - 200..]);
    assert_eq!(render::concise(&diagnostics, &sources).lines().count(), 1000);
}

#[test]
fn bytes_that_are_no_text_are_reported_where_they_are() {
    let mut sources = Sources::default();
    let id = sources.add("domain.pddl", "(define (domain caf");
    let list = vec![not_utf8::not_utf8(19, Span::new(id, 19, 19))];
    insta::assert_snapshot!(render::full(&Diagnostics { list }, &sources, false));
}

/// A problem that does not fit its domain, so that a message speaks of both files.
fn both() -> (Diagnostics, Sources) {
    let mut sources = Sources::default();
    let domain = sources.add(
        "my domain.pddl",
        "(define (domain d)\n (:requirements :typng)\n (:types cup)\n (:predicates (lit) (clean ?c - cup)))\n",
    );
    let problem = sources.add(
        "p.pddl",
        "(define (problem p) (:domain d)\n (:objects é - cup)\n (:init (clean é é))\n (:goal (lti)))\n",
    );
    let (domain, mut diagnostics) = lang::read_domain(&sources, domain);
    diagnostics.append(lang::read_problem(&sources, problem, &domain).1);
    (diagnostics, sources)
}

#[test]
fn json_for_programs() {
    let (diagnostics, sources) = both();
    insta::assert_snapshot!(render::json(&diagnostics, &sources));
}

#[test]
fn commands_for_github() {
    let (diagnostics, sources) = both();
    insta::assert_snapshot!(render::github(&diagnostics, &sources));
}

#[test]
fn sarif_for_tools() {
    let (diagnostics, sources) = both();
    let text = render::sarif(&diagnostics, &sources);
    let mut log: serde_json::Value = serde_json::from_str(&text).expect("SARIF is JSON");
    let driver = &mut log["runs"][0]["tool"]["driver"];
    let rules = driver["rules"].as_array().expect("a list of rules").clone();
    assert_eq!(rules.len(), lang::diagnostic::RULES.len());
    // One rule shows how all look.
    driver["rules"] = serde_json::json!([rules[0]]);
    for result in log["runs"][0]["results"].as_array().expect("a list of results") {
        let index = result["ruleIndex"].as_u64().expect("an index");
        assert_eq!(rules[index as usize]["id"], result["ruleId"]);
    }
    insta::assert_snapshot!(serde_json::to_string_pretty(&log).expect("a value can be written"));
}

/// Whether a value is as the published schema says: as much of JSON Schema as that uses.
fn conforms(value: &serde_json::Value, schema: &serde_json::Value, root: &serde_json::Value) {
    let schema = match schema["$ref"].as_str() {
        Some(path) => root.pointer(path.trim_start_matches('#')).expect("what is named exists"),
        None => schema,
    };
    if let Some(wanted) = schema.get("const") {
        assert_eq!(value, wanted);
    }
    if let Some(choice) = schema["enum"].as_array() {
        assert!(choice.contains(value), "{value} is none of {choice:?}");
    }
    let kind = match value {
        serde_json::Value::Null => "null",
        serde_json::Value::Bool(_) => "boolean",
        serde_json::Value::Number(_) => "integer",
        serde_json::Value::String(_) => "string",
        serde_json::Value::Array(_) => "array",
        serde_json::Value::Object(_) => "object",
    };
    match &schema["type"] {
        serde_json::Value::String(wanted) => assert_eq!(kind, wanted, "{value}"),
        serde_json::Value::Array(wanted) => {
            assert!(wanted.iter().any(|one| one == kind), "{value}");
        }
        _ => {}
    }
    for item in value.as_array().into_iter().flatten() {
        conforms(item, &schema["items"], root);
    }
    let Some(fields) = value.as_object() else { return };
    for required in schema["required"].as_array().expect("an object says what it must have") {
        let name = required.as_str().expect("a name");
        assert!(fields.contains_key(name), "{name} is missing");
    }
    for (name, field) in fields {
        let schema = schema["properties"].get(name);
        conforms(field, schema.unwrap_or_else(|| panic!("{name} is not described")), root);
    }
}

#[test]
fn json_is_as_the_schema_says() {
    let (diagnostics, sources) = both();
    let value = serde_json::from_str(&render::json(&diagnostics, &sources)).expect("JSON");
    let schema = serde_json::from_str(include_str!("../../docs/diagnostics.schema.json"))
        .expect("the schema is JSON");
    conforms(&value, &schema, &schema);
}
