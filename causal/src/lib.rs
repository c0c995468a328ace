//! Trials go in; a causal Bayesian network that predicts, explains and prevents failures comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`source`]: files of trials, in blocks;
//! - [`derive`](mod@derive): a variable that is made of the columns of a trial;
//! - [`variable`]: what is set or measured in a trial, and the states that it is in;
//! - [`recipe`]: what a person declares of variables;
//! - [`survey`](mod@survey): what kind of values they have;
//! - [`sample`]: some of the values;
//! - [`discretize`](mod@discretize): the states that values become;
//! - [`place`]: values as states;
//! - [`table`]: trials as states, column by column;
//! - [`count`](mod@count): how often states go together, whoever counts them;
//! - [`stream`]: tables and counts out of files of any length;
//! - [`sql`](mod@sql): the same counts where trials lie in a database;
//! - [`graph`]: which variables cause which;
//! - [`set`]: variables as bits;
//! - [`pattern`]: graphs that fit data equally well;
//! - [`chance`](mod@chance): seeded numbers that no thread changes;
//! - [`knowledge`]: what is known before any data;
//! - [`score`]: how well a graph fits;
//! - [`independence`]: what does not depend on what;
//! - [`discover`](mod@discover): the graph that fits best;
//! - [`notears`]: a linear graph of quantities that are not cut;
//! - [`network`]: a graph with probabilities;
//! - [`bootstrap`]: how sure its arcs are;
//! - [`estimate`](mod@estimate): the probabilities that fit best;
//! - [`infer`](mod@infer): what follows from what is seen or set;
//! - [`situation`]: the values of one trial, and the states that they are;
//! - [`contrast`](mod@contrast): the nearest situation that would have been a success;
//! - [`prevent`](mod@prevent): what to do instead of what is going to fail;
//! - [`words`]: what was wrong, as a sentence;
//! - [`transfer`]: what one network knows as a prior for another;
//! - [`evaluate`]: how well outcomes are predicted;
//! - [`file`](mod@file): networks as text and as pictures.

pub mod source;
pub mod derive;
pub mod variable;
pub mod recipe;
pub mod survey;
pub mod sample;
pub mod discretize;
pub mod place;
pub mod table;
pub mod count;
pub mod stream;
pub mod sql;
#[cfg(feature = "datafusion")]
pub mod cluster;
pub mod graph;
pub mod set;
pub mod pattern;
pub mod chance;
pub mod knowledge;
pub mod score;
pub mod independence;
pub mod discover;
pub mod notears;
pub mod network;
pub mod bootstrap;
pub mod estimate;
pub mod infer;
pub mod situation;
pub mod contrast;
pub mod prevent;
pub mod words;
pub mod transfer;
pub mod evaluate;
pub mod file;
