//! The clock of a run: a thread that watches CPU time, resident memory and signals, and sets the flag that grounding and search poll.
//!
//! A run that does not come to rest soon after the flag is set is ended from here, with the same exit code and with whole files.

use std::fs;
use std::io::{self, Write};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use nix::sys::resource::{UsageWho, getrusage};
use nix::unistd::{SysconfVar, sysconf};
use planner::limits::{Limits, Stop};
use signal_hook::consts::{SIGINT, SIGTERM};

use crate::exit::Exit;

/// How often the watchdog looks.
const INTERVAL: Duration = Duration::from_millis(10);

/// CPU time that a run may take to come to rest after it was told to stop.
const GRACE: Duration = Duration::from_millis(500);

/// The same on the clock, for a machine with too much to do.
const WALL_GRACE: Duration = Duration::from_secs(10);

/// What a run may use.
#[derive(Debug, Clone, Copy, Default)]
pub struct Allowance {
    /// CPU time of the process, user and system.
    pub time: Option<Duration>,
    /// Resident memory in bytes.
    pub memory: Option<u64>,
}

/// What the run and its watchdog both know.
#[derive(Debug, Default)]
struct Shared {
    searching: AtomicBool,
    found: AtomicBool,
    /// Held while a file is written.
    files: Mutex<()>,
}

/// A run under limits. Dropping it ends the watch.
#[derive(Debug)]
pub struct Watch {
    /// The flag for grounding and search.
    pub limits: Limits,
    shared: Arc<Shared>,
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Watch {
    /// Starts to watch this process. With `guard`, a run that ignores the flag is ended.
    pub fn start(allowance: Allowance, guard: bool) -> Self {
        let limits = Limits::default();
        let shared = Arc::new(Shared::default());
        let (stop, stopped) = mpsc::channel();
        let signal = Arc::new(AtomicBool::new(false));
        let signals: Vec<_> = [SIGTERM, SIGINT]
            .into_iter()
            .filter_map(|number| signal_hook::flag::register(number, Arc::clone(&signal)).ok())
            .collect();
        let (flag, known) = (limits.clone(), Arc::clone(&shared));
        let watch = move || {
            let mut since = None;
            while stopped.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
                match (flag.stopped(), since) {
                    (None, _) => {
                        if let Some(reason) = reason(allowance, &signal) {
                            flag.stop(reason);
                        }
                    }
                    (Some(_), None) => since = Some((cpu_time(), Instant::now())),
                    (Some(reason), Some((cpu, wall))) => {
                        let patience = cpu_time() < cpu + GRACE && wall.elapsed() < WALL_GRACE;
                        if guard && !patience {
                            end(&known, reason);
                        }
                    }
                }
            }
            for id in signals {
                signal_hook::low_level::unregister(id);
            }
        };
        let thread = thread::Builder::new().name("watchdog".to_string()).spawn(watch);
        Self { limits, shared, stop: Some(stop), thread: thread.ok() }
    }

    /// Says that grounding is over.
    pub fn searching(&self) {
        self.shared.searching.store(true, Ordering::Relaxed);
    }

    /// Says that there is a plan on disk.
    pub fn found(&self) {
        self.shared.found.store(true, Ordering::Relaxed);
    }

    /// While the guard lives, the watchdog does not end the process.
    pub fn files(&self) -> MutexGuard<'_, ()> {
        self.shared.files.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How a run ends that was stopped for `reason`.
    pub fn exit(&self, reason: Stop) -> Exit {
        exit(&self.shared, reason)
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Why to stop now, if so.
fn reason(allowance: Allowance, signal: &AtomicBool) -> Option<Stop> {
    if signal.load(Ordering::Relaxed) {
        Some(Stop::Signal)
    } else if allowance.memory.is_some_and(|limit| resident() > limit) {
        Some(Stop::Memory)
    } else if allowance.time.is_some_and(|limit| cpu_time() >= limit) {
        Some(Stop::Time)
    } else {
        None
    }
}

/// The exit that `reason` leads to, given how far the run has come.
fn exit(shared: &Shared, reason: Stop) -> Exit {
    let found = shared.found.load(Ordering::Relaxed);
    let searching = shared.searching.load(Ordering::Relaxed);
    match (reason, found, searching) {
        (Stop::Memory, true, _) => Exit::PlanMemory,
        (Stop::Memory, false, true) => Exit::SearchMemory,
        (Stop::Memory, false, false) => Exit::GroundMemory,
        (Stop::Time | Stop::Signal, true, _) => Exit::PlanTime,
        (Stop::Time | Stop::Signal, false, true) => Exit::SearchTime,
        (Stop::Time | Stop::Signal, false, false) => Exit::GroundTime,
    }
}

/// Ends the process, once no file is half written.
fn end(shared: &Shared, reason: Stop) {
    let _files = shared.files.lock().unwrap_or_else(PoisonError::into_inner);
    let _ = writeln!(io::stderr(), "error: ended, since it did not come to rest when told to stop");
    process::exit(i32::from(exit(shared, reason).code()));
}

/// User and system time of this process so far.
pub fn cpu_time() -> Duration {
    let Ok(usage) = getrusage(UsageWho::RUSAGE_SELF) else { return Duration::ZERO };
    let time = |time: nix::sys::time::TimeVal| {
        Duration::from_secs(time.tv_sec() as u64) + Duration::from_micros(time.tv_usec() as u64)
    };
    time(usage.user_time()) + time(usage.system_time())
}

/// Resident memory of this process now, in bytes.
fn resident() -> u64 {
    let statm = fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages: u64 = statm.split(' ').nth(1).and_then(|pages| pages.parse().ok()).unwrap_or(0);
    let page = sysconf(SysconfVar::PAGE_SIZE).ok().flatten().unwrap_or(4096);
    pages * page as u64
}

/// The most memory that this process has had resident so far, in KiB.
pub fn peak_memory() -> u64 {
    // Not `ru_maxrss`, which still counts the parent from before this program was loaded.
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:")?.split_ascii_whitespace().next());
    peak.and_then(|peak| peak.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::{Allowance, Watch, cpu_time, peak_memory, resident};
    use crate::exit::Exit;
    use planner::limits::Stop;
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    fn wait(watch: &Watch) -> Option<Stop> {
        let start = Instant::now();
        while watch.limits.stopped().is_none() && start.elapsed() < Duration::from_secs(20) {
            std::hint::spin_loop();
        }
        watch.limits.stopped()
    }

    #[test]
    fn the_flag_is_set_when_cpu_time_is_used_up() {
        let allowance =
            Allowance { time: Some(cpu_time() + Duration::from_millis(30)), memory: None };
        let watch = Watch::start(allowance, false);
        assert_eq!(wait(&watch), Some(Stop::Time));
    }

    #[test]
    fn the_flag_is_set_when_memory_is_used_up() {
        let watch = Watch::start(Allowance { time: None, memory: Some(1) }, false);
        assert_eq!(wait(&watch), Some(Stop::Memory));
    }

    /// Runs itself as a process of its own, in which the flag is ignored.
    #[test]
    fn a_run_that_ignores_the_flag_is_ended() {
        if std::env::var_os("CAVEAT_TEST_IGNORES_THE_FLAG").is_some() {
            let _watch = Watch::start(Allowance { time: None, memory: Some(1) }, true);
            let start = Instant::now();
            while start.elapsed() < Duration::from_mins(1) {
                std::hint::spin_loop();
            }
            return;
        }
        let status = Command::new(std::env::current_exe().expect("a test knows its binary"))
            .args(["--exact", "limits::tests::a_run_that_ignores_the_flag_is_ended"])
            .env("CAVEAT_TEST_IGNORES_THE_FLAG", "1")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        assert_eq!(
            status.expect("it can be run").code(),
            Some(i32::from(Exit::GroundMemory.code()))
        );
    }

    #[test]
    fn the_exit_depends_on_how_far_the_run_has_come() {
        let watch = Watch::start(Allowance::default(), false);
        assert_eq!(watch.exit(Stop::Time), Exit::GroundTime);
        assert_eq!(watch.exit(Stop::Memory), Exit::GroundMemory);
        watch.searching();
        assert_eq!(watch.exit(Stop::Signal), Exit::SearchTime);
        assert_eq!(watch.exit(Stop::Memory), Exit::SearchMemory);
        watch.found();
        assert_eq!(watch.exit(Stop::Time), Exit::PlanTime);
        assert_eq!(watch.exit(Stop::Memory), Exit::PlanMemory);
    }

    #[test]
    fn memory_is_counted_in_bytes_and_kibibytes() {
        assert!(resident() > 100 << 10);
        assert!(peak_memory() >= resident() >> 11);
    }
}
