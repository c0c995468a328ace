//! The one way in which a run is told to stop: a shared flag that carries its reason.
//!
//! Grounding and search poll it and never read a clock. Who sets it (a watchdog on time and memory, a signal) is not their concern.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// Why a run has to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The time limit is reached.
    Time,
    /// The memory limit is reached.
    Memory,
    /// Someone asked the program to end.
    Signal,
}

/// A shared stop flag.
#[derive(Debug, Clone, Default)]
pub struct Limits {
    flag: Arc<AtomicU8>,
}

impl Limits {
    /// Asks every holder to stop; the first reason stays.
    pub fn stop(&self, reason: Stop) {
        let value = match reason {
            Stop::Time => 1,
            Stop::Memory => 2,
            Stop::Signal => 3,
        };
        let _ = self.flag.compare_exchange(0, value, Ordering::Relaxed, Ordering::Relaxed);
    }

    /// Why to stop, if so.
    #[inline]
    pub fn stopped(&self) -> Option<Stop> {
        match self.flag.load(Ordering::Relaxed) {
            0 => None,
            1 => Some(Stop::Time),
            2 => Some(Stop::Memory),
            _ => Some(Stop::Signal),
        }
    }
}
