//! Counters of a search go in; a line that moves comes out, on a terminal only.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use planner::search;

/// How often the line changes.
const INTERVAL: Duration = Duration::from_millis(100);

/// The line. Dropping it takes it away.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
    counters: Arc<search::Progress>,
    over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Progress {
    /// Shows the line if somebody watches.
    pub fn start(watched: bool) -> Self {
        let counters = Arc::new(search::Progress::default());
        let over = Arc::new(AtomicBool::new(false));
        if !watched {
            return Self { bar: ProgressBar::hidden(), counters, over, thread: None };
        }
        let style = ProgressStyle::with_template("{spinner} {elapsed} {prefix} {msg}");
        let bar =
            ProgressBar::new_spinner().with_style(style.expect("the template is well formed"));
        let (shown, read, ended) = (bar.clone(), Arc::clone(&counters), Arc::clone(&over));
        let follow = move || {
            while !ended.load(Ordering::Relaxed) {
                thread::sleep(INTERVAL);
                let expanded = read.expanded.load(Ordering::Relaxed);
                if expanded > 0 {
                    let (evaluated, reached) = (
                        read.evaluated.load(Ordering::Relaxed),
                        read.reached.load(Ordering::Relaxed),
                    );
                    shown.set_message(format!(
                        "{expanded} expanded, {evaluated} evaluated, reached {reached}"
                    ));
                }
                shown.tick();
            }
        };
        let thread = thread::Builder::new().name("progress".to_string()).spawn(follow).ok();
        Self { bar, counters, over, thread }
    }

    /// Says what is going on.
    pub fn phase(&self, word: &'static str) {
        self.bar.set_prefix(word);
    }

    /// What the search is to count along.
    pub fn counters(&self) -> Arc<search::Progress> {
        Arc::clone(&self.counters)
    }

    /// Takes the line away while `work` prints.
    pub fn suspend<T>(&self, work: impl FnOnce() -> T) -> T {
        self.bar.suspend(work)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}
