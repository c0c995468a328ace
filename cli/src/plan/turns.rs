//! Several ways to search go in; what the first of them finds that finds anything comes out.
//!
//! They take turns, each in a thread of its own that waits while it is not its turn. A turn is measured in work that is counted, never in seconds,
//! so which one is first is the same on every machine and in every run. Turns grow, so that none of them costs much more than the others.

use std::panic;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use planner::search::{Status, Strategy};
use planner::solve::Obstacle;

use super::joint::Failure;
use crate::pipeline::End;

/// A way to search.
pub(super) struct Way {
    /// Names the task: ways with the same name search the same.
    pub(super) task: usize,
    /// How it is searched.
    pub(super) strategy: Strategy,
    /// What its first turn is longer than its share.
    pub(super) head_start: u64,
    /// How long its turns are, in comparison with the others.
    pub(super) share: u64,
}

/// How a way ended: with a plan if it found one, or because there was nothing to search.
pub(super) type Outcome<P> = Result<(End, Option<P>), Failure>;

/// What happens in a thread.
enum Event<P> {
    /// A turn is over.
    Spent,
    /// The way is over.
    Over(Outcome<P>),
    /// The thread has failed, which is told when it is joined.
    Failed,
}

/// Says so when its thread fails, since nothing else would.
struct Alarm<'a, P>(&'a Sender<Event<P>>);

impl<P> Drop for Alarm<'_, P> {
    fn drop(&mut self) {
        if thread::panicking() {
            let _ = self.0.send(Event::Failed);
        }
    }
}

/// What a way is given: its turn, and how to ask for the next.
pub(super) struct Turn<'a> {
    /// The work of the first turn.
    pub(super) work: u64,
    /// Says that a turn is over and waits for the work of the next; none if there will be no other.
    pub(super) next: &'a mut dyn FnMut() -> Option<u64>,
}

/// The stack of each thread, as large as that of the thread that works: only what is touched becomes memory.
const STACK: usize = 512 << 20;

/// The work of a turn of share 1 in the first round; each round has twice as much.
const FIRST: u64 = 2_000_000;

/// Lets `ways` take turns in `search` until one of them finds a plan, or `conclusive` says of one that it proves that there is none, or all are over.
/// Those with the same task as one that has proved that its task has no plan are over too.
pub(super) fn take<P: Send>(
    ways: &[Way],
    search: impl Fn(&Way, &mut Turn<'_>) -> Outcome<P> + Sync,
    conclusive: impl Fn(&Way) -> bool,
) -> Option<Outcome<P>> {
    let search = &search;
    thread::scope(|scope| {
        let (events, happened) = mpsc::channel();
        let mut threads = Vec::new();
        let start = |way| {
            let (grant, granted) = mpsc::channel::<u64>();
            let events = events.clone();
            let work = move || run(way, search, &granted, &events);
            let builder = thread::Builder::new().name("search".to_owned()).stack_size(STACK);
            threads.push(builder.spawn_scoped(scope, work).expect("a thread can be started"));
            grant
        };
        let found = lead(ways, start, &happened, conclusive);
        for thread in threads {
            if let Err(fault) = thread.join() {
                panic::resume_unwind(fault);
            }
        }
        found
    })
}

/// One thread: waits for its first turn, then searches.
fn run<P>(
    way: &Way,
    search: impl Fn(&Way, &mut Turn<'_>) -> Outcome<P>,
    granted: &Receiver<u64>,
    events: &Sender<Event<P>>,
) {
    let Ok(work) = granted.recv() else { return };
    let _alarm = Alarm(events);
    let mut next = || {
        // Nobody listens any longer when another way has won.
        events.send(Event::Spent).ok()?;
        granted.recv().ok()
    };
    let outcome = search(way, &mut Turn { work, next: &mut next });
    let _ = events.send(Event::Over(outcome));
}

/// How far a way is.
enum State {
    /// It has had no turn.
    Waiting,
    /// This gives it a turn.
    Going(Sender<u64>),
    /// It has no more turns.
    Over,
}

/// Gives turns; `start` makes the thread of a way that has its first one. All threads come to their ends when this returns.
fn lead<'w, P>(
    ways: &'w [Way],
    mut start: impl FnMut(&'w Way) -> Sender<u64>,
    happened: &Receiver<Event<P>>,
    conclusive: impl Fn(&Way) -> bool,
) -> Option<Outcome<P>> {
    let mut states: Vec<State> = ways.iter().map(|_| State::Waiting).collect();
    let mut last = None;
    let mut work = FIRST;
    while states.iter().any(|state| !matches!(state, State::Over)) {
        for (at, way) in ways.iter().enumerate() {
            if matches!(states[at], State::Waiting) {
                states[at] = State::Going(start(way));
            }
            let State::Going(grant) = &states[at] else { continue };
            let head_start = if work == FIRST { way.head_start } else { 0 };
            let share = work.saturating_mul(way.share).saturating_add(head_start);
            // One that has ended has said so, and is over.
            grant.send(share).expect("it waits for its turn");
            match happened.recv().expect("one sender is kept here") {
                Event::Spent => {}
                Event::Over(outcome) => {
                    let proved = match &outcome {
                        Ok((_, Some(_))) => return Some(outcome),
                        Ok((end, None)) => end.status == Status::Unsolvable,
                        Err(failure) => matches!(failure, Failure::Obstacle(Obstacle::Unreachable)),
                    };
                    if !proved || conclusive(way) {
                        return Some(outcome);
                    }
                    for (other, state) in ways.iter().zip(&mut states) {
                        if other.task == way.task {
                            *state = State::Over;
                        }
                    }
                    last = Some(outcome);
                }
                // It is told when the thread is joined.
                Event::Failed => return last,
            }
        }
        work = work.saturating_mul(2);
    }
    last
}
