//! A size, a scenario and a number of plates to store go in; a kitchen without a plan comes out, as files.
//!
//! `cargo run -p caveat-domains --example kitchen -- 10 II 8 FOLDER` writes `domain.pddl` and `problem.pddl` of a kitchen with ten drawers,
//! eight of which are needed, and which `domains/src/kitchen.rs` describes.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use domains::kitchen::{Kitchen, Scenario};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match write(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(complaint) => {
            eprintln!("{complaint}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the files that the command line asks for.
fn write(arguments: &[String]) -> Result<(), String> {
    let [size, scenario, goals, folder] = arguments else {
        return Err("usage: kitchen SIZE I|II GOALS FOLDER".to_string());
    };
    let number = |text: &String| text.parse().map_err(|_| format!("`{text}` is no number"));
    let named =
        Scenario::of(scenario).ok_or_else(|| format!("`{scenario}` is neither I nor II"))?;
    let kitchen = Kitchen::new(number(size)?, named, number(goals)?)
        .ok_or_else(|| format!("of {size} plates, {goals} cannot be stored"))?;
    let folder = Path::new(folder);
    let failed = |error| format!("{}: {error}", folder.display());
    fs::create_dir_all(folder).map_err(failed)?;
    fs::write(folder.join("domain.pddl"), named.domain()).map_err(failed)?;
    fs::write(folder.join("problem.pddl"), kitchen.problem()).map_err(failed)
}
