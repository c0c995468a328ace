//! A `DataFusion` session goes in, embedded or on a Ballista cluster; counts of the trials that it knows come out (feature `datafusion`).
//!
//! A cluster holds logs that no machine holds. What is asked of it is the same GROUP BY ([`sql`](mod@crate::sql)), and the numbers are
//! the same.

#[cfg(feature = "ballista")]
use ballista::prelude::SessionContextExt;
use datafusion::arrow::array::{Array, AsArray};
use datafusion::arrow::datatypes::Int64Type;
use datafusion::error::DataFusionError;
use datafusion::prelude::{CsvReadOptions, ParquetReadOptions, SessionContext};
use tokio::runtime::Runtime;

use crate::count::{CountError, Counter, Counts, cells};
use crate::sql;
use crate::variable::{Variable, VariableId};

/// What the trials are called in the session.
const RELATION: &str = "trials";

/// Who runs the SQL.
pub struct Engine {
    session: SessionContext,
    runtime: Runtime,
}

impl Engine {
    /// `DataFusion`, in this process.
    pub fn embedded() -> Result<Self, CountError> {
        Ok(Self { session: SessionContext::new(), runtime: runtime()? })
    }

    /// A Ballista cluster whose scheduler is at a URL: `df://localhost:50050`. Its executors must reach the trials by the same path.
    #[cfg(feature = "ballista")]
    pub fn scheduler(url: &str) -> Result<Self, CountError> {
        let runtime = runtime()?;
        let session =
            runtime.block_on(SessionContext::remote(url)).map_err(|error| fault(&error))?;
        Ok(Self { session, runtime })
    }

    /// A Ballista cluster of this process: a scheduler and an executor that talk over the loopback interface.
    #[cfg(feature = "ballista")]
    pub fn standalone() -> Result<Self, CountError> {
        let runtime = runtime()?;
        let session =
            runtime.block_on(SessionContext::standalone()).map_err(|error| fault(&error))?;
        Ok(Self { session, runtime })
    }
}

fn runtime() -> Result<Runtime, CountError> {
    tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .map_err(|error| CountError::Source(error.to_string()))
}

/// Counts by SQL.
pub struct Cluster<'a> {
    engine: &'a Engine,
    variables: &'a [Variable],
    rows: u64,
    dropped: u64,
}

impl<'a> Cluster<'a> {
    /// Makes the trials known to an engine: a file of CSV with a line of names, a file of Parquet, or a folder of Parquet (its path ends
    /// in `/`).
    pub fn new(
        engine: &'a Engine,
        path: &str,
        variables: &'a [Variable],
    ) -> Result<Self, CountError> {
        let parquet = path.ends_with(".parquet") || path.ends_with('/');
        let Engine { session, runtime } = engine;
        runtime
            .block_on(async {
                if parquet {
                    session.register_parquet(RELATION, path, ParquetReadOptions::default()).await
                } else {
                    session.register_csv(RELATION, path, CsvReadOptions::default()).await
                }
            })
            .map_err(|error| fault(&error))?;
        let mut this = Self { engine, variables, rows: 0, dropped: 0 };
        let (counts, dropped) = this.ask(&[])?;
        (this.rows, this.dropped) = (counts[0], dropped);
        Ok(this)
    }

    /// How many trials have no state for some variable.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// The counts of a set, and how many trials are in no cell.
    fn ask(&self, set: &[VariableId]) -> Result<(Counts, u64), CountError> {
        let mut counts = vec![0; cells(self.variables, set)?];
        let mut dropped = 0;
        let query = sql::count(RELATION, self.variables, set).map_err(CountError::Source)?;
        let Engine { session, runtime } = self.engine;
        let batches = runtime
            .block_on(async { session.sql(&query).await?.collect().await })
            .map_err(|error| fault(&error))?;
        for batch in batches {
            let cells = batch.column(0).as_primitive::<Int64Type>();
            let trials = batch.column(1).as_primitive::<Int64Type>();
            for row in 0..batch.num_rows() {
                let trials = trials.value(row) as u64;
                if cells.is_null(row) {
                    dropped += trials;
                } else {
                    counts[cells.value(row) as usize] += trials;
                }
            }
        }
        Ok((counts, dropped))
    }
}

fn fault(error: &DataFusionError) -> CountError {
    CountError::Source(error.to_string())
}

impl Counter for Cluster<'_> {
    fn variables(&self) -> &[Variable] {
        self.variables
    }

    fn rows(&self) -> u64 {
        self.rows
    }

    fn count(&self, sets: &[Vec<VariableId>]) -> Result<Vec<Counts>, CountError> {
        sets.iter().map(|set| self.ask(set).map(|(counts, _)| counts)).collect()
    }
}
