//! The command line of `caveat causal` as data.

pub mod transfer;

use std::path::PathBuf;

use ::causal::{discover, independence};
use clap::builder::PossibleValue;
use clap::{Args, Subcommand, ValueEnum};

/// `caveat causal`.
#[derive(Debug, Args)]
#[command(
    arg_required_else_help = true,
    after_help = "\
Examples:
  caveat causal discover domains/one-cube/trials.csv \\
    --recipe domains/one-cube/recipe.json -o cube.cbn.json
      which variables cause which, and how probable success is
  caveat causal query cube.cbn.json onTop --do xOff=2.1
      what happens where a variable is set
  caveat causal evaluate domains/one-cube/trials.csv \\
    --recipe domains/one-cube/recipe.json --goal onTop=1
      how well success is predicted in trials that were not learned from

Exit codes: 0 done, 1 a failure has no remedy, 2 could not run."
)]
pub struct Causal {
    /// What to do.
    #[command(subcommand)]
    pub what: What,
}

/// What to do with trials and models.
#[derive(Debug, Subcommand)]
pub enum What {
    /// Learn a model from trials: which variables cause which, and how probably.
    Discover(Discover),
    /// Estimate the probabilities of a graph from trials.
    Fit(Fit),
    /// Show a model, and write it in other formats.
    Show(Show),
    /// Ask a model.
    Query(Query),
    /// Say how well the outcome of other trials is predicted.
    Evaluate(Evaluate),
    /// Explain a failure: the nearest situation that would have been a success.
    Explain(Explain),
    /// Prevent a failure: what to do instead of what is going to fail.
    Prevent(Prevent),
    /// Carry over what one model knows to another one like it.
    Transfer(transfer::Transfer),
}

/// What becomes of trials that do not fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Unfit {
    /// They are an error.
    Refuse,
    /// They are left out, and counted.
    Drop,
}

/// Trials, and how their values become states.
#[derive(Debug, Args)]
pub struct Trials {
    /// CSV with a line of names first, or Parquet; several files are one long table.
    #[arg(required = true, value_name = "TRIALS")]
    pub files: Vec<PathBuf>,
    /// What is declared of the variables (JSON): units, roles, what they come from, how they are cut. By default each column is one.
    #[arg(long, value_name = "FILE")]
    pub recipe: Option<PathBuf>,
    /// How a variable is cut: NAME=quantile:5, NAME=width:5, NAME=k-means:4, NAME=categories, NAME=search, or NAME=-1:0:1 with edges.
    #[arg(long, value_name = "NAME=CUTS", allow_hyphen_values = true)]
    pub cuts: Vec<String>,
    /// Columns that are left out.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub leave_out: Vec<String>,
    /// Trials in which a value is missing.
    #[arg(long, value_name = "HOW", default_value = "refuse")]
    pub missing: Unfit,
    /// Trials with a value that is no state.
    #[arg(long, value_name = "HOW", default_value = "refuse")]
    pub outside: Unfit,
    /// The variable and its state that are success.
    #[arg(long, value_name = "NAME=STATE")]
    pub goal: Option<String>,
}

/// What is known before.
#[derive(Debug, Args)]
pub struct Known {
    /// What was set by chance or by choice before a trial: nothing causes it.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub set: Vec<String>,
    /// Variables of one time, the earlier first, once for each time: nothing causes what was earlier.
    #[arg(long, value_name = "NAMES")]
    pub tier: Vec<String>,
    /// An arc that there is.
    #[arg(long, value_name = "CAUSE:EFFECT")]
    pub require: Vec<String>,
    /// An arc that there is not.
    #[arg(long, value_name = "CAUSE:EFFECT")]
    pub forbid: Vec<String>,
    /// All that is known, as JSON: set, tiers, required, forbidden.
    #[arg(long, value_name = "FILE")]
    pub knowledge: Option<PathBuf>,
}

/// How a graph is learned.
#[derive(Debug, Args)]
pub struct Learner {
    /// The learner.
    #[arg(long, value_name = "NAME", default_value = "auto")]
    pub method: Method,
    /// What graphs are judged by: bic, aic, k2, or bdeu:WEIGHT.
    #[arg(long, value_name = "SCORE", default_value = "bic")]
    pub score: String,
    /// What tests independence.
    #[arg(long, value_name = "TEST", default_value = "g2")]
    pub test: Test,
    /// Variables are independent where chance would make them look as dependent this often.
    #[arg(long, value_name = "P", default_value = "0.01")]
    pub alpha: f64,
    /// As many causes as a variable has at most.
    #[arg(long, value_name = "N")]
    pub max_parents: Option<usize>,
}

/// Who counts, where that is not this program.
#[cfg(feature = "datafusion")]
#[derive(Debug, Args)]
pub struct Engine {
    /// Count by SQL, with `DataFusion` in this process; the trials are one file, or a folder of Parquet.
    #[arg(long, conflicts_with = "stream")]
    pub sql: bool,
    /// Count by SQL on the Ballista cluster of this scheduler, such as `df://localhost:50050`.
    #[cfg(feature = "ballista")]
    #[arg(long, value_name = "URL", conflicts_with_all = ["stream", "sql"])]
    pub scheduler: Option<String>,
}

/// Who learns a graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// A learner of graphs over states.
    Of(discover::Method),
    /// The learner of linear graphs over the quantities themselves.
    Notears,
}

impl ValueEnum for Method {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [Method; discover::Method::ALL.len() + 1] = {
            let mut all = [Method::Notears; discover::Method::ALL.len() + 1];
            let mut at = 0;
            while at < discover::Method::ALL.len() {
                all[at] = Method::Of(discover::Method::ALL[at]);
                at += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, about) = match self {
            Self::Of(method) => (method.name(), method.about()),
            Self::Notears => ("notears", "A linear graph of the quantities themselves (NOTEARS)"),
        };
        Some(PossibleValue::new(name).help(about))
    }
}

/// What tests independence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Test(pub independence::Test);

impl ValueEnum for Test {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [Test; 3] = [
            Test(independence::Test::ALL[0]),
            Test(independence::Test::ALL[1]),
            Test(independence::Test::ALL[2]),
        ];
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()).help(self.0.about()))
    }
}

/// How an answer looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For reading.
    Full,
    /// One JSON document.
    Json,
}

/// `caveat causal discover`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat causal discover domains/one-cube/trials.csv --set xOff,yOff,dropOff \\
    --goal onTop=1 -o cube.cbn.json
      what was set has no causes
  caveat causal discover domains/one-cube/trials.csv --bootstrap 100 --svg cube.svg
      how sure each arc is, and a picture
  caveat causal discover domains/one-cube/trials.csv --method pc --cuts xOff=search \\
    --goal onTop=1
      by tests of independence, with as many intervals as predict success best")]
pub struct Discover {
    /// The trials.
    #[command(flatten)]
    pub trials: Trials,
    /// What is known.
    #[command(flatten)]
    pub known: Known,
    /// How to learn.
    #[command(flatten)]
    pub learner: Learner,
    /// Who counts.
    #[cfg(feature = "datafusion")]
    #[command(flatten)]
    pub engine: Engine,
    /// Learn from so many resampled tables, too, and say how often each arc is found.
    #[arg(long, value_name = "N")]
    pub bootstrap: Option<u64>,
    /// What chance does when tables are resampled.
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    /// How probabilities come from counts: likelihood, bdeu:WEIGHT, or dirichlet:WEIGHT.
    #[arg(long, value_name = "HOW", default_value = "bdeu:1")]
    pub estimate: String,
    /// Read the trials anew for each question instead of holding them: for more trials than memory.
    #[arg(long)]
    pub stream: bool,
    /// Write the model: by its ending JSON, BIF (.bif) or XMLBIF (.xml, .bifxml).
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Draw the model.
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// How the answer looks.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: Format,
}

/// `caveat causal fit`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat causal fit domains/one-cube/trials.csv \\
    --arcs xOff:onTop,yOff:onTop,dropOff:onTop -o cube.cbn.json
      a graph by hand
  caveat causal fit domains/one-cube/trials.csv \\
    --model domains/one-cube/cube.cbn.json -o again.cbn.json
      the graph and the states of a model, with the probabilities of other trials
  caveat causal fit domains/one-cube/trials.csv \\
    --model domains/one-cube/cube.cbn.json --prior domains/one-cube/cube.cbn.json \\
    --weight 50 -o both.cbn.json
      a model as prior knowledge, worth 50 trials in each row")]
pub struct Fit {
    /// The trials.
    #[command(flatten)]
    pub trials: Trials,
    /// Who counts.
    #[cfg(feature = "datafusion")]
    #[command(flatten)]
    pub engine: Engine,
    /// A model whose graph and states are taken.
    #[arg(long, value_name = "MODEL", conflicts_with = "arcs", required_unless_present = "arcs")]
    pub model: Option<PathBuf>,
    /// The arcs of the graph.
    #[arg(long, value_name = "CAUSE:EFFECT", value_delimiter = ',')]
    pub arcs: Vec<String>,
    /// How probabilities come from counts: likelihood, bdeu:WEIGHT, or dirichlet:WEIGHT.
    #[arg(long, value_name = "HOW", default_value = "bdeu:1", conflicts_with = "prior")]
    pub estimate: String,
    /// A model of the same graph that is known before.
    #[arg(long, value_name = "MODEL", requires = "weight")]
    pub prior: Option<PathBuf>,
    /// What it is worth in each row, in trials.
    #[arg(long, value_name = "TRIALS", requires = "prior")]
    pub weight: Option<f64>,
    /// Read the trials anew instead of holding them: for more trials than memory.
    #[arg(long)]
    pub stream: bool,
    /// Write the model: by its ending JSON, BIF (.bif) or XMLBIF (.xml, .bifxml).
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

/// `caveat causal show`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat causal show domains/one-cube/cube.cbn.json
      the variables, their states and their causes
  caveat causal show domains/one-cube/cube.cbn.json --table onTop
      the probabilities of a variable, row by row
  caveat causal show domains/one-cube/cube.cbn.json --svg cube.svg --tables -o cube.bif
      a picture, and the model for other tools")]
pub struct Show {
    /// The model: JSON, BIF or XMLBIF.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// Show the table of a variable.
    #[arg(long, value_name = "NAME")]
    pub table: Option<String>,
    /// Write the model: by its ending JSON, BIF (.bif), XMLBIF (.xml, .bifxml) or DOT (.dot).
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Draw the model, with the probabilities of all states.
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    /// Draw the tables of the variables, too, below the graph.
    #[arg(long, requires = "svg")]
    pub tables: bool,
}

/// `caveat causal query`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat causal query domains/one-cube/cube.cbn.json onTop --given xOff=0.2 \\
    --given dropOff=1
      how probable is success where this is seen
  caveat causal query domains/one-cube/cube.cbn.json onTop --do xOff=2.1
      and where a variable is set
  caveat causal query domains/one-cube/cube.cbn.json --given onTop=0 --most-probable
      the most probable of all that can have happened")]
pub struct Query {
    /// The model: JSON, BIF or XMLBIF.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// The variables that are asked for, each by itself; all of them where none is named.
    #[arg(value_name = "NAME")]
    pub targets: Vec<String>,
    /// What is seen: a state, or a value within it.
    #[arg(long, value_name = "NAME=VALUE")]
    pub given: Vec<String>,
    /// What is set: it has no causes any more.
    #[arg(long = "do", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// The probabilities of the variables together.
    #[arg(long)]
    pub joint: bool,
    /// The most probable states of all variables together.
    #[arg(long, conflicts_with_all = ["joint", "targets"])]
    pub most_probable: bool,
    /// Draw so many trials, as CSV.
    #[arg(long, value_name = "N", conflicts_with_all = ["joint", "most_probable", "targets", "given"])]
    pub sample: Option<usize>,
    /// What chance does when trials are drawn.
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    /// How the answer looks.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: Format,
}

/// `caveat causal evaluate`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat causal evaluate domains/one-cube/trials.csv \\
    --recipe domains/one-cube/recipe.json --goal onTop=1
      learn from nine tenths, predict the last, ten times
  caveat causal evaluate domains/one-cube/trials.csv --goal onTop=1 \\
    --arcs xOff:onTop,dropOff:onTop --forest
      a graph by hand, and a random forest beside it
  caveat causal evaluate domains/one-cube/trials.csv --goal onTop=1 --group colorUp \\
    --set xOff,yOff,dropOff
      leave out one group after the other")]
pub struct Evaluate {
    /// The trials.
    #[command(flatten)]
    pub trials: Trials,
    /// What is known.
    #[command(flatten)]
    pub known: Known,
    /// How to learn.
    #[command(flatten)]
    pub learner: Learner,
    /// The arcs of the graph; by default it is learned anew for each fold.
    #[arg(long, value_name = "CAUSE:EFFECT", value_delimiter = ',')]
    pub arcs: Vec<String>,
    /// How probabilities come from counts: likelihood, bdeu:WEIGHT, or dirichlet:WEIGHT.
    #[arg(long, value_name = "HOW", default_value = "bdeu:1")]
    pub estimate: String,
    /// Part the trials into so many folds.
    #[arg(long, value_name = "N", default_value = "10")]
    pub folds: usize,
    /// One fold for each value of this column, which is no variable then.
    #[arg(long, value_name = "NAME", conflicts_with = "folds")]
    pub group: Option<String>,
    /// A random forest beside the model, tuned on the same features.
    #[arg(long)]
    pub forest: bool,
    /// What chance does when trials are parted.
    #[arg(long, value_name = "N", default_value = "0")]
    pub seed: u64,
    /// How the answer looks.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: Format,
}

/// To whom something is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Listener {
    /// Somebody who sees what happens.
    User,
    /// Somebody who looks inside: with names and values.
    Engineer,
}

/// What is asked of a situation.
#[derive(Debug, Args)]
pub struct Ask {
    /// The model: JSON, BIF or XMLBIF.
    #[arg(value_name = "MODEL")]
    pub model: PathBuf,
    /// Success; by default that of the model.
    #[arg(long, value_name = "NAME=STATE")]
    pub goal: Option<String>,
    /// Values of the situation.
    #[arg(long, value_name = "NAME=VALUE", value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<String>,
    /// A file of trials.
    #[arg(long, value_name = "FILE")]
    pub trials: Option<PathBuf>,
    /// What may be changed; by default what is set before a trial.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub free: Vec<String>,
    /// What may not be changed, such as what has been done already.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub fixed: Vec<String>,
    /// What a step of a variable costs: one interval, or another word. By default 1.
    #[arg(long, value_name = "NAME=COST", value_delimiter = ',')]
    pub weight: Vec<String>,
    /// Success is likely where its probability is greater.
    #[arg(long, value_name = "P", default_value = "0.8")]
    pub threshold: f64,
    /// A probability that comes from fewer trials is not believed.
    #[arg(long, value_name = "N", default_value = "5")]
    pub least_trials: u64,
    /// The words of variables (JSON); by default those of cube.words.json beside cube.cbn.json.
    #[arg(long, value_name = "FILE")]
    pub words: Option<PathBuf>,
    /// To whom it is told.
    #[arg(long, value_name = "WHO", default_value = "user")]
    pub audience: Listener,
    /// How the answer looks.
    #[arg(long, value_name = "FORMAT", default_value = "full")]
    pub output_format: Format,
}

/// `caveat causal explain`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat causal explain domains/one-cube/cube.cbn.json --at xOff=0.3,yOff=2.1,dropOff=1.5
      what was wrong when the cube fell
  caveat causal explain domains/one-cube/cube.cbn.json \\
    --trials domains/one-cube/trials.csv --row 1 --audience engineer --probabilities
      a trial of a file, with names and values
  caveat causal explain domains/one-cube/cube.cbn.json --at xOff=2.4,yOff=2.1,dropOff=1.5 \\
    --weight xOff=3 --trace --picture fall.svg
      what is hard to change is dear; how the search went, and a picture

Exit codes: 0 explained, 1 no success is within reach or the model expected one, 2 could not run.")]
pub struct Explain {
    /// What is asked.
    #[command(flatten)]
    pub ask: Ask,
    /// The trial of the file, from 1.
    #[arg(long, value_name = "N", requires = "trials")]
    pub row: Option<usize>,
    /// Tell the probabilities of success before and after.
    #[arg(long)]
    pub probabilities: bool,
    /// Show the situations that were looked at, in their order.
    #[arg(long)]
    pub trace: bool,
    /// Draw the failure and the nearest success side by side (SVG).
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,
}

/// `caveat causal prevent`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  caveat causal prevent domains/one-cube/cube.cbn.json --at xOff=0.3,yOff=2.1,dropOff=1.5
      what to do instead
  caveat causal prevent domains/one-cube/cube.cbn.json --at xOff=0.3,yOff=2.1,dropOff=1.5 \\
    --fixed xOff,dropOff --act-below 0.7 --threshold 0.85
      some of it is done already; act only below 0.7, and then reach more than 0.85
  caveat causal prevent domains/one-cube/cube.cbn.json \\
    --trials domains/one-cube/trials.csv -o corrected.csv
      all trials of a file, each corrected where it needs to be

Exit codes: 0 done, 1 something is beyond help, 2 could not run.")]
pub struct Prevent {
    /// What is asked.
    #[command(flatten)]
    pub ask: Ask,
    /// The trial of the file, from 1.
    #[arg(long, value_name = "N", requires = "trials")]
    pub row: Option<usize>,
    /// Change something only where success is less likely; by default the threshold.
    #[arg(long, value_name = "P")]
    pub act_below: Option<f64>,
    /// Write all trials of the file, each corrected where it needs to be (CSV).
    #[arg(short, long, value_name = "FILE", requires = "trials", conflicts_with = "row")]
    pub output: Option<PathBuf>,
}
