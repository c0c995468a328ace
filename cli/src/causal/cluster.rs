//! Who counts, by the command line, goes in; a counter over the trials comes out (feature `datafusion`).

use ::causal::cluster::{Cluster, Engine};
use ::causal::count::Counter;
use ::causal::variable::Variable;

use super::trials;
use crate::args::causal::{self, Trials};
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// Does some work with a counter, where another program shall count; none where it shall not.
pub fn counted<T>(
    engine: &causal::Engine,
    arguments: &Trials,
    variables: &[Variable],
    terminal: &mut Terminal,
    work: impl FnOnce(&dyn Counter) -> Result<T, Complaint>,
) -> Result<Option<T>, Complaint> {
    #[cfg(feature = "ballista")]
    let scheduler = engine.scheduler.as_deref();
    #[cfg(not(feature = "ballista"))]
    let scheduler: Option<&str> = None;
    let engine = match scheduler {
        #[cfg(feature = "ballista")]
        Some(url) => Engine::scheduler(url)?,
        _ if engine.sql => Engine::embedded()?,
        _ => return Ok(None),
    };
    let [path] = arguments.files.as_slice() else {
        return Err(Complaint::with_help(
            "SQL counts one file, or one folder",
            "a folder of Parquet is named with `/` at its end",
        ));
    };
    let cluster = Cluster::new(&engine, &files::name(path), variables)?;
    if cluster.dropped() > 0
        && trials::policy(arguments.missing, arguments.outside) != trials::dropping()
    {
        let message = format!("{} trials have no state for some variable", cluster.dropped());
        return Err(Complaint::with_help(
            message,
            "`--missing drop --outside drop` leaves them out",
        ));
    }
    trials::tell_dropped(cluster.dropped(), terminal);
    work(&cluster).map(Some)
}
