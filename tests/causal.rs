//! Trials, models and command lines with mistakes go in; each gets a clear answer. And what two ways of reading trials say is the same.

use cli::exit::Exit;

use crate::desk::{Desk, shipped};

#[test]
fn what_cannot_be_learned_or_asked_is_said() {
    let desk = Desk::new();
    desk.write("empty.csv", "");
    desk.write("head.csv", "a,b\n");
    desk.write("cut.csv", "xOff,onTop\n0.5,1\n0.7");
    desk.write("missing.csv", "xOff,onTop\n0.5,1\n,0\n0.3,1\n");
    desk.write("constant.csv", "a,b\n1,x\n2,x\n1,x\n2,x\n");
    desk.write("failing.csv", "xOff,onTop\n1,0\n2,0\n1,0\n");
    desk.write("outside.csv", "xOff,yOff,dropOff,colorDown,colorUp,onTop\n9,0,1,red,red,1\n");
    desk.write("misspelt.json", "{\"caveat-recipe\": 1, \"variables\": [{\"name\": \"xOf\"}]}");
    desk.write("cyclic.json", "{\"caveat-network\":1,\"variables\":[{\"name\":\"a\",\"states\":{\"categories\":[\"0\",\"1\"]}},{\"name\":\"b\",\"states\":{\"categories\":[\"0\",\"1\"]}}],\"tables\":[{\"variable\":\"a\",\"parents\":[\"b\"],\"probabilities\":[[1,0],[0,1]]},{\"variable\":\"b\",\"parents\":[\"a\"],\"probabilities\":[[1,0],[0,1]]}]}");
    desk.write("cut.bif", "network n {\n}\nvariable a {\n  type discrete [ 2 ] { x, y };\n}\nprobability ( a ) {\n  table 0.5, ");
    desk.write("model.txt", "");
    let lines = [
        "discover nowhere.csv",
        "discover empty.csv",
        "discover head.csv",
        "discover cut.csv",
        "discover missing.csv",
        "discover missing.csv --missing drop --method hill",
        "discover constant.csv",
        "discover failing.csv --goal onTop=1",
        "discover domains/one-cube/trials.csv --goal onTop=2",
        "discover domains/one-cube/trials.csv --set xof",
        "discover domains/one-cube/trials.csv --set onTop --require xOff:onTop",
        "discover domains/one-cube/trials.csv --cuts xOff=quantile:0",
        "discover domains/one-cube/trials.csv --cuts colorUp=quantile:3",
        "discover domains/one-cube/trials.csv --method notears",
        "discover domains/one-cube/trials.csv --score bayes",
        "discover domains/one-cube/trials.csv --recipe misspelt.json",
        "discover domains/one-cube/trials.csv --alpha 1.5",
        "discover domains/one-cube/trials.csv --max-parents 1 --require xOff:onTop --require yOff:onTop",
        "fit domains/one-cube/trials.csv --arcs xOff:onTop,onTop:yOff,yOff:xOff -o o.cbn.json",
        "fit domains/one-cube/trials.csv --arcs xOf:onTop -o o.cbn.json",
        "fit outside.csv --model domains/one-cube/cube.cbn.json -o o.cbn.json",
        "fit domains/one-cube/trials.csv --model cyclic.json -o o.cbn.json",
        "show cut.bif",
        "show model.txt",
        "query domains/one-cube/cube.cbn.json onTpo",
        "query domains/one-cube/cube.cbn.json onTop --given xOff=77",
        "query domains/one-cube/cube.cbn.json onTop --given colorUp=purple",
        "query domains/one-cube/cube.cbn.json onTop --given xOff=0 --given xOff=2",
        "evaluate domains/one-cube/trials.csv",
        "evaluate domains/one-cube/trials.csv --goal onTp=1",
        "evaluate domains/one-cube/trials.csv --goal onTop=1 --group colourUp",
        "show domains/one-cube/cube.cbn.json --table ontop",
        "evaluate failing.csv --goal onTop=1",
        "evaluate domains/one-cube/trials.csv --goal onTop=1 --folds 1",
    ];
    let all = desk.told(lines.iter().map(|line| format!("caveat causal {line}")));
    assert!(!desk.path("o.cbn.json").exists(), "nothing is written where something is wrong");
    insta::assert_snapshot!(all);
}

#[test]
fn trials_that_are_read_anew_say_what_trials_in_memory_say() {
    let desk = Desk::new();
    let text = shipped("one-cube/trials.csv");
    let lines: Vec<&str> = text.lines().collect();
    desk.write("1.csv", &lines[..1200].join("\n"));
    desk.write("2.csv", &format!("{}\n{}", lines[0], lines[1200..].join("\n")));
    let known = "--recipe domains/one-cube/recipe.json --goal onTop=1";
    for (files, more, to) in
        [("domains/one-cube/trials.csv", "", "held"), ("1.csv 2.csv", "--stream", "read")]
    {
        desk.ends(
            Exit::Done,
            &format!("caveat causal discover {files} {known} {more} -o {to}.cbn.json"),
        );
        desk.ends(
            Exit::Done,
            &format!(
                "caveat causal fit {files} --model {to}.cbn.json {more} -o {to}-again.cbn.json"
            ),
        );
    }
    let tables = |name: &str| {
        let json: serde_json::Value = serde_json::from_str(&desk.file(name)).expect("it is JSON");
        (json["variables"].clone(), json["tables"].clone())
    };
    assert_eq!(tables("held.cbn.json"), tables("read.cbn.json"));
    assert_eq!(tables("held-again.cbn.json"), tables("read-again.cbn.json"));
    assert_eq!(
        tables("held.cbn.json"),
        tables("held-again.cbn.json"),
        "fitting again changes nothing"
    );
}

#[test]
fn the_model_that_ships_is_learned_from_the_trials_that_ship() {
    let desk = Desk::new();
    desk.ends(Exit::Done, "caveat causal discover domains/one-cube/trials.csv --recipe domains/one-cube/recipe.json --goal onTop=1 -o new.cbn.json");
    let (new, ships) = (desk.file("new.cbn.json"), shipped("one-cube/cube.cbn.json"));
    let without_files = |text: &str| -> serde_json::Value {
        let mut json: serde_json::Value = serde_json::from_str(text).expect("it is JSON");
        json["about"].as_object_mut().expect("it says where it comes from").remove("files");
        json
    };
    assert_eq!(without_files(&new), without_files(&ships));
}

#[test]
fn drawn_trials_teach_the_model_that_they_were_drawn_from() {
    let desk = Desk::new();
    let drawn = desk.ends(
        Exit::Done,
        "caveat causal query domains/one-cube/cube.cbn.json --sample 20000 --seed 3",
    );
    desk.write("drawn.csv", &drawn);
    let said = desk
        .ends(Exit::Done, "caveat causal discover drawn.csv --recipe domains/one-cube/recipe.json");
    for arc in
        ["xOff -> onTop", "yOff -> onTop", "dropOff -> onTop", "without an arc: colorDown, colorUp"]
    {
        assert!(said.contains(arc), "{said}");
    }
}

/// What a verb's `--help` shows is what a newcomer types first.
#[test]
fn the_examples_of_the_help_run() {
    for verb in ["", "discover", "fit", "show", "query", "evaluate", "explain", "prevent"] {
        let desk = Desk::new();
        for example in desk.examples(&format!("caveat causal {verb}")) {
            // A forest that is tuned in each fold takes a minute; its own tests are elsewhere.
            desk.ends(Exit::Done, &example.replace(" --forest", ""));
        }
    }
}

#[test]
fn what_cannot_be_explained_or_prevented_is_said() {
    let desk = Desk::new();
    desk.write("bad.words.json", "{\"variables\": {\"xOff\": {\"subject\": \"it\"}}}");
    desk.write(
        "few.csv",
        "xOff,yOff,dropOff,colorDown,colorUp\n0.1,0.1,1,red,red\n9,0,1,red,red\n",
    );
    let cube = "domains/one-cube/cube.cbn.json";
    let at = "--at xOff=0.3,yOff=2.1,dropOff=1.5";
    let lines = [
        format!("explain {cube}"),
        format!("explain {cube} --at xOff=0.3,yOff=2.1"),
        format!("explain {cube} --at xOff=0.3,yOf=2.1"),
        format!("explain {cube} --at xOff=77,yOff=0,dropOff=1"),
        format!("explain {cube} {at} --goal onTop=2"),
        format!("explain {cube} {at} --fixed xOff,yOff,dropOff,colorDown,colorUp"),
        format!("explain {cube} {at} --free colorUp"),
        format!("explain {cube} {at} --free dropOff"),
        format!("explain {cube} {at} --weight yOff=0"),
        format!("explain {cube} {at} --words bad.words.json"),
        format!("explain {cube} --at xOff=0,yOff=0,dropOff=1"),
        format!("explain {cube} {at} --least-trials 100000"),
        format!("explain {cube} --trials few.csv --row 7"),
        format!("explain {cube} --trials few.csv"),
        format!("explain {cube} {at},onTop=1"),
        format!("explain {cube} {at} --threshold 1.5"),
        format!("prevent {cube} {at} --act-below 0.9 --threshold 0.8"),
        format!("prevent {cube} {at} --fixed yOff --threshold 0.99"),
        format!("prevent {cube} --trials few.csv -o corrected.parquet"),
        format!("prevent {cube} --trials few.csv -o corrected.csv"),
        "explain domains/one-cube/trials.csv --at xOff=0".to_owned(),
    ];
    let all = desk.told(lines.iter().map(|line| format!("caveat causal {line}")));
    assert!(desk.file("corrected.csv").ends_with("\n9,0,1,red,red,outside\n"));
    insta::assert_snapshot!(all);
}

#[test]
fn explanations_are_told_in_a_sentence_and_as_json() {
    let desk = Desk::new();
    let cube = "domains/one-cube/cube.cbn.json";
    let mut all = String::new();
    for line in [
        "--at xOff=0.3,yOff=2.1,dropOff=1.5",
        "--at xOff=2.4,yOff=2.1,dropOff=9 --audience engineer --probabilities",
        "--at xOff=0.3,yOff=2.1,dropOff=1.5 --weight yOff=3 --trace",
        "--at xOff=0.3,yOff=2.1,dropOff=1.5 --output-format json",
    ] {
        all += &desk.shown(Exit::Done, &format!("caveat causal explain {cube} {line}"));
    }
    insta::assert_snapshot!(all);
}

/// What is corrected is what the model then expects to succeed, and what is kept is as it was.
#[test]
fn a_corrected_file_needs_no_correction() {
    let desk = Desk::new();
    let cube = "domains/one-cube/cube.cbn.json";
    desk.ends(
        Exit::Done,
        &format!("caveat causal prevent {cube} --trials domains/one-cube/trials.csv -o once.csv"),
    );
    let said = desk
        .ends(Exit::Done, &format!("caveat causal prevent {cube} --trials once.csv -o twice.csv"));
    assert_eq!(said, "3000 trials: 3000 kept, 0 corrected, 0 beyond help\n");
    let rows = |text: &str| -> Vec<String> {
        text.lines()
            .skip(1)
            .map(|line| line.rsplit_once(',').expect("a last cell").0.to_owned())
            .collect()
    };
    let (once, before) = (desk.file("once.csv"), shipped("one-cube/trials.csv"));
    for (after, before) in once.lines().zip(before.lines()).skip(1) {
        assert!(
            !after.ends_with(",keep") || after == format!("{before},keep"),
            "{after}\n{before}"
        );
    }
    let twice: Vec<String> = rows(&desk.file("twice.csv"));
    assert!(twice.iter().zip(rows(&once)).all(|(twice, once)| twice.starts_with(&once)));
}
