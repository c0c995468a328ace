//! A source and variables go in; a table in memory comes out, or counts of trials that no memory holds.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::count::{CountError, Counter, Counts, cells, tally};
use crate::place::{Placed, Placer, Policy};
use crate::source::{Fault, Source};
use crate::table::Table;
use crate::variable::{State, Variable, VariableId};

/// Reads all trials into a table. Beside it stands how many were left out.
pub fn table(
    source: &dyn Source,
    variables: &[Variable],
    policy: Policy,
) -> Result<(Table, u64), Fault> {
    let placer = Placer::new(source, variables, policy)?;
    let shards: Vec<(Vec<Vec<State>>, u64)> = (0..source.shards())
        .into_par_iter()
        .map(|shard| {
            let mut columns = vec![Vec::new(); variables.len()];
            let mut dropped = 0;
            source.read(shard, placer.columns(), &mut |block| {
                let placed = placer.place(shard, block)?;
                dropped += placed.dropped;
                for (column, more) in columns.iter_mut().zip(placed.columns) {
                    column.extend(more);
                }
                Ok(())
            })?;
            Ok((columns, dropped))
        })
        .collect::<Result<_, Fault>>()?;
    let mut columns: Vec<Vec<State>> = vec![Vec::new(); variables.len()];
    let mut dropped = 0;
    for (shard, left_out) in shards {
        dropped += left_out;
        for (column, more) in columns.iter_mut().zip(shard) {
            column.extend(more);
        }
    }
    let table = Table::new(variables.to_vec(), columns)
        .map_err(|error| Fault::new("the trials", error.to_string()))?;
    Ok((table, dropped))
}

/// Counts the trials of a source, which is read anew for each batch of questions and never held.
pub struct Stream<'a> {
    source: &'a dyn Source,
    variables: &'a [Variable],
    placer: Placer<'a>,
    rows: AtomicU64,
    dropped: AtomicU64,
    /// How often the source was read.
    readings: AtomicU64,
}

impl<'a> Stream<'a> {
    /// Counts the rows of a source that have a state for each variable: the first reading.
    pub fn new(
        source: &'a dyn Source,
        variables: &'a [Variable],
        policy: Policy,
    ) -> Result<Self, Fault> {
        let this = Self::unread(source, variables, policy)?;
        this.fold(|| (), |(), _| ())?;
        Ok(this)
    }

    /// The same without a reading: how many rows there are is known after the first question.
    pub fn unread(
        source: &'a dyn Source,
        variables: &'a [Variable],
        policy: Policy,
    ) -> Result<Self, Fault> {
        let placer = Placer::new(source, variables, policy)?;
        let (rows, dropped, readings) = (AtomicU64::new(0), AtomicU64::new(0), AtomicU64::new(0));
        Ok(Self { source, variables, placer, rows, dropped, readings })
    }

    /// How many trials are left out.
    pub fn dropped(&self) -> u64 {
        self.dropped.load(Ordering::Relaxed)
    }

    /// How often the source was read.
    pub fn readings(&self) -> u64 {
        self.readings.load(Ordering::Relaxed)
    }

    /// Reads all shards, some at a time, and folds what each says into one of a few results.
    fn fold<T: Send>(
        &self,
        start: impl Fn() -> T + Sync,
        take: impl Fn(&mut T, Placed) + Sync,
    ) -> Result<Vec<T>, Fault> {
        self.readings.fetch_add(1, Ordering::Relaxed);
        let next = AtomicU64::new(0);
        let workers = rayon::current_num_threads().min(self.source.shards()).max(1);
        let (rows, dropped) = (AtomicU64::new(0), AtomicU64::new(0));
        let results = (0..workers)
            .into_par_iter()
            .map(|_| {
                let mut result = start();
                loop {
                    let shard = next.fetch_add(1, Ordering::Relaxed) as usize;
                    if shard >= self.source.shards() {
                        return Ok(result);
                    }
                    self.source.read(shard, self.placer.columns(), &mut |block| {
                        let placed = self.placer.place(shard, block)?;
                        rows.fetch_add(block.rows.len() as u64 - placed.dropped, Ordering::Relaxed);
                        dropped.fetch_add(placed.dropped, Ordering::Relaxed);
                        take(&mut result, placed);
                        Ok(())
                    })?;
                }
            })
            .collect::<Result<Vec<T>, Fault>>()?;
        self.rows.store(rows.into_inner(), Ordering::Relaxed);
        self.dropped.store(dropped.into_inner(), Ordering::Relaxed);
        Ok(results)
    }
}

impl Counter for Stream<'_> {
    fn variables(&self) -> &[Variable] {
        self.variables
    }

    fn rows(&self) -> u64 {
        self.rows.load(Ordering::Relaxed)
    }

    fn count(&self, sets: &[Vec<VariableId>]) -> Result<Vec<Counts>, CountError> {
        let sizes: Vec<usize> =
            sets.iter().map(|set| cells(self.variables, set)).collect::<Result<_, _>>()?;
        let start = || sizes.iter().map(|&size| vec![0; size]).collect::<Vec<Counts>>();
        let results = self
            .fold(start, |counts: &mut Vec<Counts>, placed| {
                for (set, counts) in sets.iter().zip(counts) {
                    let columns: Vec<(&[State], usize)> = set
                        .iter()
                        .map(|id| {
                            (
                                placed.columns[id.index()].as_slice(),
                                self.variables[id.index()].arity(),
                            )
                        })
                        .collect();
                    let rows = placed.columns.first().map_or(0, Vec::len);
                    tally(&columns, rows, counts);
                }
            })
            .map_err(|fault| CountError::Source(fault.to_string()))?;
        let mut total = start();
        for counts in results {
            for (sum, more) in total.iter_mut().flatten().zip(counts.into_iter().flatten()) {
                *sum += more;
            }
        }
        Ok(total)
    }
}
