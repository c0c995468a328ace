//! Random tiny worlds of several agents go through the whole program; every plan that is lost, invented or longer than need be comes out.
//!
//! What is to be found is known from a second joint semantics that tries everything. `PROPTEST_CASES` says how many worlds there are.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use cli::exit::Exit;
use cli::terminal::Terminal;
use proptest::prelude::*;

use brute::{Least, Measure};
use naive::{Tally, World};
use random::Texts;
use tape::Tape;

#[path = "../lang/tests/joint/brute.rs"]
mod brute;
#[path = "../lang/tests/joint/ground.rs"]
mod ground;
#[path = "../lang/tests/joint/naive.rs"]
mod naive;
#[path = "../lang/tests/joint/random.rs"]
mod random;
#[path = "../lang/tests/joint/tape.rs"]
mod tape;
#[path = "../lang/tests/joint/text.rs"]
mod text;

/// Brute force gives up after so many joint actions; such worlds are passed over.
const TRIES: usize = 3_000;

/// How many worlds are tried.
fn cases() -> u32 {
    let asked = std::env::var_os("PROPTEST_CASES").is_some();
    if asked { ProptestConfig::default().cases } else { 300 }
}

/// Whether derived predicates depend on themselves, directly or by way of one another.
fn is_recursive(domain: &str) -> bool {
    let rules: Vec<(&str, &str)> = domain
        .lines()
        .filter_map(|line| line.trim().strip_prefix("(:derived (")?.split_once([' ', ')']))
        .collect();
    let asks = |body: &str, head: &str| {
        [' ', ')'].iter().any(|end| body.contains(&format!("({head}{end}")))
    };
    rules.iter().any(|(head, body)| {
        asks(body, head) || rules.iter().any(|(other, back)| asks(body, other) && asks(back, head))
    })
}

/// Plans in `folder`; what the plan amounts to under the second semantics, nothing if there is none.
fn plan(folder: &Path, world: &World, options: &[&str]) -> Result<Option<Tally>, String> {
    let file = folder.join("plan");
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let arguments = ["caveat", "plan"].iter().chain(options).map(OsString::from);
    let files = [&folder.join("domain.pddl"), &folder.join("problem.pddl")];
    let arguments = arguments
        .chain(["--plan-file".into(), file.clone().into()])
        .chain(files.map(|file| file.clone().into()));
    let exit = cli::call(arguments, &mut Terminal::new(&mut out, &mut err));
    match exit {
        Exit::Done => {}
        Exit::Unreachable | Exit::Exhausted => return Ok(None),
        other => return Err(format!("{other:?}: {}", String::from_utf8_lossy(&err))),
    }
    let text = fs::read_to_string(&file).map_err(|error| error.to_string())?;
    let read = naive::plan(&text).ok_or_else(|| format!("this is no joint plan:\n{text}"))?;
    let tally = world.judge(&read, world.safe).map_err(|reason| format!("{reason}\n{text}"))?;
    Ok(Some(tally))
}

/// How many of what is measured a plan has.
fn amount(measure: Measure, tally: Tally) -> i64 {
    match measure {
        Measure::Steps => tally.steps,
        Measure::Actions => tally.actions,
        Measure::Cost => tally.cost,
    }
}

/// Compares what the program finds in a world with what there is.
fn compare(
    texts: &Texts,
    concurrency: Option<&str>,
    (objective, measure): (&str, Measure),
) -> Result<(), String> {
    let mut world = ground::world(&texts.domain, &texts.problem);
    let mut options = Vec::new();
    if let Some(concurrency) = concurrency {
        world.safe = concurrency == "safe";
        options.extend(["--concurrency", concurrency]);
    }
    let known = match brute::least(&world, measure, TRIES) {
        Least::Is(known) => Some(known),
        Least::Unsolvable => None,
        Least::Unknown => return Ok(()),
    };
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    for (name, text) in [("domain.pddl", &texts.domain), ("problem.pddl", &texts.problem)] {
        fs::write(folder.path().join(name), text).map_err(|error| error.to_string())?;
    }
    // What recursive rules need cannot be said exactly: plans may be missed, and that is said.
    let approximate = world.safe && is_recursive(&texts.domain);
    let first = match plan(folder.path(), &world, &options) {
        Err(reason) if approximate && reason.starts_with("Incomplete") => return Ok(()),
        first => first?,
    };
    if first.is_some() != known.is_some() {
        return Err(format!("the first plan: {first:?}, the least {objective}: {known:?}"));
    }
    options.extend(["--optimal", "--objective", objective]);
    let best = plan(folder.path(), &world, &options)?.map(|tally| amount(measure, tally));
    if best != known && !(approximate && best > known) {
        return Err(format!("the best plan has {objective} {best:?}, the least is {known:?}"));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_joint_plan_is_lost_and_none_is_invented(bytes in proptest::collection::vec(any::<u8>(), 100..500)) {
        let mut tape = Tape::new(bytes);
        let objective = tape.below(3);
        let objectives = [("steps", Measure::Steps), ("actions", Measure::Actions), ("cost", Measure::Cost)];
        let concurrency = [None, None, Some("liberal"), Some("safe")][tape.below(4)];
        let texts = brute::texts(&mut tape);
        if let Err(wrong) = compare(&texts, concurrency, objectives[objective]) {
            prop_assert!(false, "{wrong}\nconcurrency: {concurrency:?}, {}\n{}\n{}", objectives[objective].0, texts.domain, texts.problem);
        }
    }
}
