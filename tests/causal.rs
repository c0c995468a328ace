//! Trials, models and command lines with mistakes go in; each gets a clear answer. And what two ways of reading trials say is the same.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use cli::exit::Exit;
use cli::terminal::Terminal;

/// A folder with a few files, in which `caveat causal` is called.
struct Desk {
    folder: tempfile::TempDir,
}

impl Desk {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("there is room for a folder") }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("the file can be written");
    }

    /// Calls the verb; words that begin with `@` are files of this folder, or of the one cube.
    fn call(&self, line: &str) -> (Exit, String) {
        let cube = domains::folder().join("one-cube");
        let words = line.split_whitespace().map(|word| match word.strip_prefix('@') {
            Some(name) if ["trials.csv", "recipe.json", "cube.cbn.json"].contains(&name) => {
                cube.join(name).into()
            }
            Some(name) => self.path(name).into(),
            None => word.into(),
        });
        let words: Vec<std::ffi::OsString> =
            ["caveat".into(), "causal".into()].into_iter().chain(words).collect();
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let mut terminal = Terminal::new(&mut out, &mut err);
        let exit = cli::call(words, &mut terminal);
        drop(terminal);
        let text = |bytes| String::from_utf8(bytes).expect("the program prints UTF-8");
        let said = format!("{}{}", text(out), text(err));
        let here = format!("{}/", self.folder.path().display());
        (exit, said.replace(&here, "").replace(&format!("{}/", cube.display()), ""))
    }
}

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
    desk.write("recipe.json", "{\"caveat-recipe\": 1, \"variables\": [{\"name\": \"xOf\"}]}");
    desk.write("cyclic.json", "{\"caveat-network\":1,\"variables\":[{\"name\":\"a\",\"states\":{\"categories\":[\"0\",\"1\"]}},{\"name\":\"b\",\"states\":{\"categories\":[\"0\",\"1\"]}}],\"tables\":[{\"variable\":\"a\",\"parents\":[\"b\"],\"probabilities\":[[1,0],[0,1]]},{\"variable\":\"b\",\"parents\":[\"a\"],\"probabilities\":[[1,0],[0,1]]}]}");
    desk.write("cut.bif", "network n {\n}\nvariable a {\n  type discrete [ 2 ] { x, y };\n}\nprobability ( a ) {\n  table 0.5, ");
    desk.write("model.txt", "");
    let lines = [
        "discover @nowhere.csv",
        "discover @empty.csv",
        "discover @head.csv",
        "discover @cut.csv",
        "discover @missing.csv",
        "discover @missing.csv --missing drop --method hill",
        "discover @constant.csv",
        "discover @failing.csv --goal onTop=1",
        "discover @trials.csv --goal onTop=2",
        "discover @trials.csv --set xof",
        "discover @trials.csv --set onTop --require xOff:onTop",
        "discover @trials.csv --cuts xOff=quantile:0",
        "discover @trials.csv --cuts colorUp=quantile:3",
        "discover @trials.csv --method notears",
        "discover @trials.csv --score bayes",
        "discover @trials.csv --alpha 1.5",
        "discover @trials.csv --max-parents 1 --require xOff:onTop --require yOff:onTop",
        "fit @trials.csv --arcs xOff:onTop,onTop:yOff,yOff:xOff -o @o.cbn.json",
        "fit @trials.csv --arcs xOf:onTop -o @o.cbn.json",
        "fit @outside.csv --model @cube.cbn.json -o @o.cbn.json",
        "fit @trials.csv --model @cyclic.json -o @o.cbn.json",
        "show @cut.bif",
        "show @model.txt",
        "query @cube.cbn.json onTpo",
        "query @cube.cbn.json onTop --given xOff=77",
        "query @cube.cbn.json onTop --given colorUp=purple",
        "query @cube.cbn.json onTop --given xOff=0 --given xOff=2",
        "evaluate @trials.csv",
        "evaluate @failing.csv --goal onTop=1",
        "evaluate @trials.csv --goal onTop=1 --folds 1",
    ];
    let mut all = String::new();
    for line in lines {
        let (exit, said) = desk.call(line);
        writeln!(all, "$ caveat causal {line}\n{said}[{exit:?}]\n").expect("a string takes all");
    }
    assert!(!desk.path("o.cbn.json").exists(), "nothing is written where something is wrong");
    insta::assert_snapshot!(all);
}

#[test]
fn trials_that_are_read_anew_say_what_trials_in_memory_say() {
    let desk = Desk::new();
    let text =
        fs::read_to_string(domains::folder().join("one-cube/trials.csv")).expect("the trials ship");
    let lines: Vec<&str> = text.lines().collect();
    desk.write("1.csv", &lines[..1200].join("\n"));
    desk.write("2.csv", &format!("{}\n{}", lines[0], lines[1200..].join("\n")));
    let known = "--recipe @recipe.json --goal onTop=1";
    for (files, more, to) in [("@trials.csv", "", "held"), ("@1.csv @2.csv", "--stream", "read")] {
        let (exit, said) = desk.call(&format!("discover {files} {known} {more} -o @{to}.cbn.json"));
        assert_eq!(exit, Exit::Done, "{said}");
        let (exit, said) = desk
            .call(&format!("fit {files} --model @{to}.cbn.json {more} -o @{to}-again.cbn.json"));
        assert_eq!(exit, Exit::Done, "{said}");
    }
    let tables = |name: &str| {
        let text = fs::read_to_string(desk.path(name)).expect("the model was written");
        let json: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
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
    let (exit, said) =
        desk.call("discover @trials.csv --recipe @recipe.json --goal onTop=1 -o @new.cbn.json");
    assert_eq!(exit, Exit::Done, "{said}");
    let new = fs::read_to_string(desk.path("new.cbn.json")).expect("the model was written");
    let ships = fs::read_to_string(domains::folder().join("one-cube/cube.cbn.json"))
        .expect("the model ships");
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
    let (exit, drawn) = desk.call("query @cube.cbn.json --sample 20000 --seed 3");
    assert_eq!(exit, Exit::Done);
    desk.write("drawn.csv", &drawn);
    let (exit, said) = desk.call("discover @drawn.csv --recipe @recipe.json");
    assert_eq!(exit, Exit::Done, "{said}");
    for arc in
        ["xOff -> onTop", "yOff -> onTop", "dropOff -> onTop", "without an arc: colorDown, colorUp"]
    {
        assert!(said.contains(arc), "{said}");
    }
}
