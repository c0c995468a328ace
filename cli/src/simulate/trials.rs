//! A world of trials and how many are wanted go in; a file of trials comes out, and beside it a sheet that says what they are.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use ::causal::source::write::{Head, Writer};
use ::causal::variable::Role;
use domains::trial::stack::{Parameters, Stack};
use domains::trial::{self, Column, Values, World};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use crate::args::simulate::{StackTrials, TrialFile};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// As many trials as are run at a time and written together.
const BLOCK: u64 = 20_000;

/// `caveat simulate stack`.
pub fn stack(arguments: &StackTrials, terminal: &mut Terminal) -> Result<Exit, Complaint> {
    let mut parameters: Parameters = match &arguments.world {
        None => Parameters::default(),
        Some(path) => serde_json::from_str(&files::read(path)?.text)
            .map_err(|error| Complaint::new(format!("{}: {error}", files::name(path))))?,
    };
    for (given, measure) in [
        (arguments.size, &mut parameters.edge),
        (arguments.restitution, &mut parameters.restitution),
        (arguments.friction, &mut parameters.friction),
    ] {
        if let Some(given) = given {
            *measure = given;
        }
    }
    let noises =
        [&mut parameters.offset_noise, &mut parameters.turn_noise, &mut parameters.tilt_noise];
    for noise in noises {
        *noise *= arguments.noise;
    }
    let about = json!({
        "world": "stack",
        "cubes": arguments.cubes,
        "parameters": serde_json::to_value(&parameters).expect("measures are JSON"),
    });
    let stack = Stack::new(arguments.cubes, parameters)
        .map_err(|error| Complaint::new(error.to_string()))?;
    run(&stack, about, &arguments.trials, terminal)
}

/// Runs the trials of a world.
fn run(
    world: &dyn World,
    about: Value,
    arguments: &TrialFile,
    terminal: &mut Terminal,
) -> Result<Exit, Complaint> {
    let columns = world.columns();
    let bar = progress(arguments.samples, terminal.watched);
    let mut succeeded = vec![0_u64; columns.len()];
    let is_parquet =
        arguments.output.extension().is_some_and(|end| end.eq_ignore_ascii_case("parquet"));
    files::write_with(&arguments.output, |out| {
        // A writer of Parquet asks for a file that could be sent to another thread, which `out` cannot.
        let mut whole = tempfile::tempfile()?;
        write(world, &columns, arguments, is_parquet, whole.try_clone()?, &bar, &mut succeeded)?;
        std::io::Seek::rewind(&mut whole)?;
        std::io::copy(&mut whole, out).map(|_| ())
    })?;
    bar.finish_and_clear();
    let rates: serde_json::Map<String, Value> = columns
        .iter()
        .zip(&succeeded)
        .filter(|(column, _)| column.role == Role::Outcome && is_flag(column))
        .map(|(column, &count)| (column.name.clone(), share(count, arguments.samples).into()))
        .collect();
    for (name, rate) in &rates {
        let rate = rate.as_f64().unwrap_or_default() * 100.0;
        terminal.line(format_args!("{name} in {rate:.1} % of {} trials", arguments.samples));
    }
    let sheet = sheet(&columns, about, arguments, rates);
    let path = beside(&arguments.output);
    let text = serde_json::to_string_pretty(&sheet).expect("a sheet is JSON") + "\n";
    files::write(&path, text.as_bytes())?;
    terminal.say(format_args!("what they are: {}", files::name(&path)));
    Ok(Exit::Done)
}

fn write(
    world: &dyn World,
    columns: &[Column],
    arguments: &TrialFile,
    is_parquet: bool,
    out: File,
    bar: &ProgressBar,
    succeeded: &mut [u64],
) -> std::io::Result<()> {
    let heads = columns
        .iter()
        .map(|column| Head {
            name: column.name.clone(),
            words: match &column.values {
                Values::Between(..) => None,
                Values::Words(words) => Some(words.iter().map(ToString::to_string).collect()),
            },
        })
        .collect();
    let out: BufWriter<File> = BufWriter::new(out);
    let mut writer =
        if is_parquet { Writer::parquet(heads, out)? } else { Writer::csv(heads, out)? };
    let mut from = 0;
    while from < arguments.samples {
        let to = arguments.samples.min(from + BLOCK);
        let rows = trial::trials(world, arguments.seed, from..to, &|| bar.inc(1));
        for row in &rows {
            for (count, &cell) in succeeded.iter_mut().zip(row) {
                *count += u64::from(cell > 0.5);
            }
        }
        writer.rows(&rows)?;
        from = to;
    }
    writer.end()
}

/// Whether a column says that something is so or not.
fn is_flag(column: &Column) -> bool {
    matches!(&column.values, Values::Words(words) if words.as_slice() == ["0", "1"])
}

fn share(count: u64, of: u64) -> f64 {
    count as f64 / of.max(1) as f64
}

/// What a person should know of the trials.
fn sheet(
    columns: &[Column],
    about: Value,
    arguments: &TrialFile,
    rates: serde_json::Map<String, Value>,
) -> Value {
    let columns: Vec<Value> = columns
        .iter()
        .map(|column| {
            let mut told = json!({
                "name": column.name,
                "role": if column.role == Role::Treatment { "treatment" } else { "outcome" },
                "what": column.what,
            });
            match &column.values {
                Values::Between(low, high) => told["range"] = json!([low, high]),
                Values::Words(words) => told["words"] = json!(words),
            }
            if let Some(unit) = column.unit {
                told["unit"] = unit.into();
            }
            told
        })
        .collect();
    let mut sheet = about;
    sheet["trials"] = arguments.samples.into();
    sheet["seed"] = arguments.seed.into();
    sheet["columns"] = columns.into();
    sheet["rates"] = rates.into();
    sheet
}

/// `trials.sheet.json` for `trials.csv`.
fn beside(path: &Path) -> PathBuf {
    path.with_extension("sheet.json")
}

fn progress(trials: u64, watched: bool) -> ProgressBar {
    if !watched {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} trials, {per_sec}, {eta} left");
    ProgressBar::new(trials).with_style(style.expect("the template is well formed"))
}
