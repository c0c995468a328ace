//! `caveat causal`: trials and models go in; models, answers and how good they are come out.

mod complain;
mod trials;
mod model;
mod discover;
mod linear;
#[cfg(feature = "datafusion")]
mod cluster;
mod fit;
mod show;
mod query;
mod evaluate;
mod ask;
mod explain;
mod prevent;
mod transfer;

use crate::args::causal::{Causal, What};
use crate::exit::Exit;
use crate::terminal::Terminal;

/// Runs the verb.
pub fn run(arguments: &Causal, terminal: &mut Terminal) -> Exit {
    let done = match &arguments.what {
        What::Discover(arguments) => discover::run(arguments, terminal),
        What::Fit(arguments) => fit::run(arguments, terminal),
        What::Show(arguments) => show::run(arguments, terminal),
        What::Query(arguments) => query::run(arguments, terminal),
        What::Evaluate(arguments) => evaluate::run(arguments, terminal),
        What::Explain(arguments) => explain::run(arguments, terminal),
        What::Prevent(arguments) => prevent::run(arguments, terminal),
        What::Transfer(arguments) => transfer::run(arguments, terminal),
    };
    done.unwrap_or_else(|complaint| {
        terminal.say(complaint);
        Exit::Failed
    })
}
