//! The command line of `caveat causal transfer` as data.

use std::path::PathBuf;

use ::causal::transfer;
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};

use super::{Format, Unfit};

/// Which values of the target are put into the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Strategy(pub transfer::Strategy);

impl ValueEnum for Strategy {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [Strategy; 3] = [
            Strategy(transfer::Strategy::ALL[0]),
            Strategy(transfer::Strategy::ALL[1]),
            Strategy(transfer::Strategy::ALL[2]),
        ];
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()).help(self.0.about()))
    }
}

/// `caveat causal transfer`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat simulate stack --cubes 2 --samples 400 --seed 5 -o two.csv && \\
    caveat causal transfer domains/one-cube/cube.cbn.json --trials two.csv \\
    --arcs xOff_1:onTop_2,yOff_1:onTop_2,xOff_2:onTop_2,yOff_2:onTop_2 --goal onTop_2=1 \\
    --weight 20 -o two.cbn.json
      one cube teaches two: its model is worth 20 trials in each row
  caveat causal transfer domains/one-cube/cube.cbn.json two.cbn.json --relations-only
      which variable stands for which, to be corrected and handed in by --relate
  caveat simulate stack --cubes 2 --samples 2000 --seed 6 -o test.csv && \\
    caveat causal transfer domains/one-cube/cube.cbn.json two.cbn.json --trials two.csv \\
    --test test.csv --outside drop --learning-curve 0,10,30,100,300 --plot curve.svg
      what all of it is worth, with no trial of two cubes and with ever more")]
pub struct Transfer {
    /// The model that knows something: JSON, BIF or XMLBIF.
    #[arg(value_name = "SOURCE")]
    pub source: PathBuf,
    /// The model that is to know it.
    #[arg(value_name = "TARGET", required_unless_present = "trials")]
    pub target: Option<PathBuf>,
    /// The trials of the target; by default those that its model has counted.
    #[arg(long, value_name = "TRIALS", num_args = 1..)]
    pub trials: Vec<PathBuf>,
    /// What is declared of the variables of the trials (JSON), where there is no model of the target.
    #[arg(long, value_name = "FILE", conflicts_with = "target", requires = "trials")]
    pub recipe: Option<PathBuf>,
    /// How a variable is cut, where there is no model of the target: NAME=quantile:5, or NAME=-1:0:1 with edges.
    #[arg(long, value_name = "NAME=CUTS", allow_hyphen_values = true, conflicts_with = "target")]
    pub cuts: Vec<String>,
    /// The arcs of the target's graph, where there is no model of it.
    #[arg(long, value_name = "CAUSE:EFFECT", value_delimiter = ',', conflicts_with = "target")]
    pub arcs: Vec<String>,
    /// Trials in which a value is missing.
    #[arg(long, value_name = "HOW", default_value = "refuse")]
    pub missing: Unfit,
    /// Trials with a value that is no state.
    #[arg(long, value_name = "HOW", default_value = "refuse")]
    pub outside: Unfit,
    /// The variable of the target and its state that are success.
    #[arg(long, value_name = "NAME=STATE")]
    pub goal: Option<String>,
    /// The same of the source.
    #[arg(long, value_name = "NAME=STATE")]
    pub source_goal: Option<String>,
    /// Whose values are put into the source; by default minimal, and in a comparison all three.
    #[arg(long, value_name = "NAME")]
    pub strategy: Option<Strategy>,
    /// What the prior is worth in each row, in trials.
    #[arg(long, value_name = "TRIALS", default_value = "20", allow_negative_numbers = true)]
    pub weight: f64,
    /// Which variable stands for which (JSON); by default it is found from names, units, values and roles.
    #[arg(long, value_name = "FILE")]
    pub relate: Option<PathBuf>,
    /// Print which variable stands for which, as JSON to correct, and do no more.
    #[arg(long, conflicts_with_all = ["output", "sweep", "learning_curve", "plot"])]
    pub relations_only: bool,
    /// Take the target to have no trials at all.
    #[arg(long)]
    pub zero_shot: bool,
    /// Compare priors of these weights.
    #[arg(long, value_name = "WEIGHTS", value_delimiter = ',', requires = "test")]
    pub sweep: Vec<f64>,
    /// Compare with so many trials of the target.
    #[arg(long, value_name = "TRIALS", value_delimiter = ',', requires = "test")]
    pub learning_curve: Vec<usize>,
    /// The trials that are predicted in a comparison.
    #[arg(long, value_name = "TRIALS", num_args = 1..)]
    pub test: Vec<PathBuf>,
    /// How often the trials of a learning curve are drawn; all numbers are means.
    #[arg(long, value_name = "N", default_value = "20")]
    pub repeats: usize,
    /// What chance does when they are drawn.
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    /// Draw the comparison.
    #[arg(long, value_name = "FILE", requires = "test")]
    pub plot: Option<PathBuf>,
    /// Write the target's model with what was carried over: by its ending JSON, BIF (.bif) or XMLBIF (.xml, .bifxml).
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// How a comparison looks.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: Format,
}
