//! Reads a SAS+ file, runs one strategy and prints what it did: `sas FILE [STRATEGY] [SECONDS] [--anytime]`.
//!
//! It is how the search is compared with other planners on equal ground tasks.

use std::process::ExitCode;
use std::time::Duration;

use planner::limits::{Limits, Stop};
use planner::sas;
use planner::search::{self, Config, Strategy};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let anytime = arguments.iter().any(|argument| argument == "--anytime");
    let positional: Vec<&String> =
        arguments.iter().filter(|argument| !argument.starts_with("--")).collect();
    let Some(file) = positional.first() else {
        eprintln!("usage: sas FILE [STRATEGY] [SECONDS] [--anytime]");
        return ExitCode::from(2);
    };
    let strategy = match positional.get(1).map_or(Ok(Strategy::Optimal), |text| text.parse()) {
        Ok(strategy) => strategy,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    let seconds: u64 = positional.get(2).and_then(|text| text.parse().ok()).unwrap_or(30);
    let named = match std::fs::read_to_string(file)
        .map_err(|error| error.to_string())
        .and_then(|text| sas::read::read(&text).map_err(|error| error.to_string()))
    {
        Ok(named) => named,
        Err(message) => {
            eprintln!("{file}: {message}");
            return ExitCode::from(2);
        }
    };
    let limits = Limits::default();
    let watchdog = limits.clone();
    std::thread::spawn(move || {
        while cpu() < seconds as f64 {
            std::thread::sleep(Duration::from_millis(20));
        }
        watchdog.stop(Stop::Time);
    });
    let read = cpu();
    let config = Config { strategy, anytime, ..Config::default() };
    let outcome = search::run(&named.task, &config, &limits, &mut |plan, cost| {
        println!("plan of {} steps, cost {cost}, after {:.3} s", plan.len(), cpu());
        if std::env::var_os("SAS_PRINT").is_some() {
            for operator in plan {
                println!("({})", named.operators[operator.index()]);
            }
        }
    });
    let searched = (cpu() - read).max(0.01);
    println!("{} on {file}", search::choose(&named.task, strategy));
    println!(
        "{:?}{}, read {read:.3} s, searched {searched:.3} s",
        outcome.status,
        if outcome.optimal { " (optimal)" } else { "" }
    );
    println!("{:?}", outcome.statistics);
    println!(
        "{:.0} expanded/s, {:.0} evaluated/s",
        outcome.statistics.expanded as f64 / searched,
        outcome.statistics.evaluated as f64 / searched
    );
    ExitCode::SUCCESS
}

/// Seconds of CPU time of this process, in steps of a hundredth: others may be using the machine.
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> =
        text.rsplit(')').next().unwrap_or_default().split_ascii_whitespace().collect();
    [11, 12].iter().filter_map(|&field| fields.get(field)?.parse::<f64>().ok()).sum::<f64>() / 100.0
}
