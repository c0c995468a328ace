//! Models go in that know something and models that are to know it; what is carried over is said, and mistakes get a clear answer.

use cli::exit::Exit;

use crate::desk::{Desk, shipped};

/// A model of one cause and its goal.
fn model(cause: &str, states: &str, goal: &str) -> String {
    let count = if states.contains("intervals") { 2 } else { states.matches(',').count() + 1 };
    let even = vec![(1.0 / count as f64).to_string(); count].join(",");
    let rows = vec!["[0.25,0.75]"; count].join(",");
    format!(
        "{{\"caveat-network\":1{goal},\"variables\":[{{\"name\":\"{cause}\",\"states\":{states}}},\
         {{\"name\":\"stays\",\"states\":{{\"categories\":[\"0\",\"1\"]}}}}],\
         \"tables\":[{{\"variable\":\"{cause}\",\"parents\":[],\"probabilities\":[[{even}]]}},\
         {{\"variable\":\"stays\",\"parents\":[\"{cause}\"],\"probabilities\":[{rows}]}}]}}"
    )
}

const GOAL: &str = ",\"goal\":{\"variable\":\"stays\",\"state\":\"1\"}";

#[test]
fn what_cannot_be_carried_over_is_said() {
    let desk = Desk::new();
    let cut = "{\"intervals\":[-3,0,3]}";
    desk.write("far.json", &model("speed", cut, GOAL));
    desk.write("no-goal.json", &model("xOff", cut, ""));
    desk.write("plate.json", &model("kind", "{\"categories\":[\"plate\",\"dish\"]}", GOAL));
    desk.write("bowl.json", &model("kind", "{\"categories\":[\"bowl\",\"glass\"]}", GOAL));
    let pair = |from: &str, to: &str| {
        format!(
            "{{\"caveat-relation\":1,\"direct\":[{{\"source\":\"{from}\",\"target\":\"{to}\"}}]}}"
        )
    };
    desk.write("misspelt-relation.json", &pair("xOf", "speed"));
    desk.write("colour-relation.json", &pair("colorUp", "speed"));
    desk.write("kind-relation.json", &pair("kind", "kind"));
    desk.write("old-relation.json", "{\"caveat-relation\": 0}");
    desk.write("few.csv", "speed,stays\n1,1\n2,0\n");
    let cube = "domains/one-cube/cube.cbn.json";
    let lines = [
        format!("{cube} far.json -o o.json"),
        format!("{cube} far.json --relations-only"),
        format!("no-goal.json {cube} -o o.json"),
        format!("{cube} no-goal.json -o o.json"),
        format!("{cube} far.json --relate misspelt-relation.json -o o.json"),
        format!("{cube} far.json --relate colour-relation.json -o o.json"),
        format!("{cube} far.json --relate old-relation.json -o o.json"),
        "plate.json bowl.json -o o.json".to_owned(),
        "plate.json bowl.json --relate kind-relation.json -o o.json".to_owned(),
        format!("{cube} {cube} --weight -1 -o o.json"),
        format!("{cube} {cube} --source-goal onTop=2 -o o.json"),
        format!("{cube} --trials few.csv --goal stays=1 -o o.json"),
        cube.to_owned(),
        format!("{cube} {cube} --sweep 1,5"),
        "far.json far.json --test few.csv --learning-curve 0,5".to_owned(),
    ];
    let all = desk.told(lines.iter().map(|line| format!("caveat causal transfer {line}")));
    assert!(!desk.path("o.json").exists(), "nothing is written where something is wrong");
    insta::assert_snapshot!(all);
}

#[test]
fn a_model_carried_over_to_itself_is_itself() {
    let desk = Desk::new();
    let cube = "domains/one-cube/cube.cbn.json";
    let said = desk.ends(
        Exit::Done,
        &format!("caveat causal transfer {cube} {cube} --zero-shot --weight 5 -o same.json"),
    );
    insta::assert_snapshot!(said);
    let parse = |text: &str| -> serde_json::Value { serde_json::from_str(text).expect("JSON") };
    let (old, new) = (parse(&shipped("one-cube/cube.cbn.json")), parse(&desk.file("same.json")));
    let goal = |json: &serde_json::Value| -> Vec<f64> {
        let tables = json["tables"].as_array().expect("there are tables");
        let table = tables.iter().find(|table| table["variable"] == "onTop").expect("it has one");
        let rows = table["probabilities"].as_array().expect("it has rows").iter();
        rows.flat_map(|row| row.as_array().expect("a row is a list").clone())
            .map(|one| one.as_f64().expect("it holds numbers"))
            .collect()
    };
    for (one, other) in goal(&old).iter().zip(&goal(&new)) {
        assert!((one - other).abs() < 1e-12);
    }
    assert_eq!(new["about"]["transfer"]["strategy"], "minimal");
    assert!(desk.ends(Exit::Done, "caveat causal show same.json").contains("has a prior from"));
}

#[test]
fn the_examples_of_carrying_over_run() {
    let desk = Desk::new();
    let mut said = String::new();
    for command in desk.examples("caveat causal transfer").iter().flat_map(|one| one.split(" && "))
    {
        said = desk.ends(Exit::Done, command);
    }
    assert!(said.contains("minimal, worth 20"), "{said}");
    assert!(desk.file("curve.svg").contains("failures avoided"));
}
