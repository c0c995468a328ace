//! A command goes in; its output, how it ended, and what it took in CPU time, wall time and resident memory come out.
//!
//! Limits hold for all processes of the command's process group together. They are polled from `/proc`; the CPU time that is reported
//! is the kernel's own account of all children waited for, unless the polls saw more.

use std::fs::{self, File};
use std::io;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::signal::{Signal, killpg};
use nix::unistd::{Pid, SysconfVar, sysconf};

/// A program that has used up its time gets this much more to say so and end by itself; the extra time does not count as solved.
const GRACE: Duration = Duration::from_secs(1);

/// What a task may use.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowance {
    /// CPU time, user and system.
    pub cpu: Duration,
    /// Resident memory in bytes.
    pub memory: u64,
}

/// Runs commands, one at a time.
#[derive(Debug)]
pub(super) struct Meter {
    /// What each command may use.
    pub allowance: Allowance,
    /// After how long on the clock it is ended, whatever it has used.
    pub wall: Duration,
    /// The CPU to keep it on.
    pub pin: Option<usize>,
    /// Set from outside to stop the running command.
    pub interrupted: Arc<AtomicBool>,
}

/// Which limit ended a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stopped {
    /// CPU time.
    Time,
    /// The guard on wall time: the machine was too busy, or the command sleeps.
    Wall,
    /// Resident memory.
    Memory,
    /// A signal to the harness.
    Interrupted,
}

/// What came out.
#[derive(Debug)]
pub(super) struct Measured {
    /// The exit code, or the negative number of the signal that ended it.
    pub code: i32,
    /// Whether the meter ended it.
    pub stopped: Option<Stopped>,
    /// User and system time of all processes, in seconds.
    pub cpu: f64,
    /// Wall time in seconds.
    pub wall: f64,
    /// The highest sum of resident memory seen, in KiB.
    pub rss: u64,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// What one look at the processes shows.
#[derive(Debug, Clone, Copy, Default)]
struct Sample {
    cpu: f64,
    rss: u64,
}

impl Meter {
    /// Runs `command` in `folder`, which must be empty.
    pub(super) fn run(&self, mut command: Command, folder: &Path) -> io::Result<Measured> {
        let (stdout, stderr) = (folder.join("stdout.log"), folder.join("stderr.log"));
        command.current_dir(folder).process_group(0).stdin(Stdio::null());
        command.stdout(File::create(&stdout)?).stderr(File::create(&stderr)?);
        let before = children_cpu()?;
        let start = Instant::now();
        let mut child = self.pinned(|| command.spawn())?;
        let (status, stopped, peak) = self.watch(&mut child, start)?;
        let wall = start.elapsed().as_secs_f64();
        let cpu = (children_cpu()? - before).max(peak.cpu);
        Ok(Measured {
            code: status.code().unwrap_or_else(|| -status.signal().unwrap_or(0)),
            stopped,
            cpu,
            wall,
            rss: peak.rss,
            stdout: lossy(&stdout)?,
            stderr: lossy(&stderr)?,
        })
    }

    /// Waits for the end of `child`, or brings it about.
    fn watch(
        &self,
        child: &mut Child,
        start: Instant,
    ) -> io::Result<(ExitStatus, Option<Stopped>, Sample)> {
        let group = Pid::from_raw(child.id() as i32);
        let mut stopped = None;
        let mut peak = Sample::default();
        let mut sampled = start;
        loop {
            if let Some(status) = child.try_wait()? {
                // Whatever it left running has lost its parent and would disturb the next task.
                let _ = killpg(group, Signal::SIGKILL);
                return Ok((status, stopped, peak));
            }
            if sampled.elapsed() >= interval(start.elapsed()) {
                sampled = Instant::now();
                let sample = sample(group);
                peak = Sample { cpu: peak.cpu.max(sample.cpu), rss: peak.rss.max(sample.rss) };
                stopped = stopped.or(self.verdict(peak, start.elapsed()));
            }
            if stopped.is_some() {
                let _ = killpg(group, Signal::SIGKILL);
            }
            let pause = if start.elapsed() < Duration::from_millis(100) { 1 } else { 5 };
            thread::sleep(Duration::from_millis(pause));
        }
    }

    /// Whether the command has to end now.
    fn verdict(&self, peak: Sample, wall: Duration) -> Option<Stopped> {
        let cpu = (self.allowance.cpu + GRACE).as_secs_f64();
        if self.interrupted.load(Ordering::Relaxed) {
            Some(Stopped::Interrupted)
        } else if peak.rss > self.allowance.memory >> 10 {
            Some(Stopped::Memory)
        } else if peak.cpu > cpu {
            Some(Stopped::Time)
        } else if wall > self.wall {
            Some(Stopped::Wall)
        } else {
            None
        }
    }

    /// Calls `spawn` while this thread is bound to the chosen CPU, which the child inherits.
    fn pinned<T>(&self, spawn: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
        let Some(cpu) = self.pin else { return spawn() };
        let this = Pid::from_raw(0);
        let usual = sched_getaffinity(this)?;
        let mut only = CpuSet::new();
        only.set(cpu)?;
        sched_setaffinity(this, &only)?;
        let result = spawn();
        sched_setaffinity(this, &usual)?;
        result
    }
}

/// How long to wait between two looks at the processes: short at first, so that short runs are seen at all.
fn interval(wall: Duration) -> Duration {
    if wall < Duration::from_millis(200) {
        Duration::from_millis(4)
    } else {
        Duration::from_millis(40)
    }
}

/// User and system time of all children waited for so far.
fn children_cpu() -> io::Result<f64> {
    let usage = getrusage(UsageWho::RUSAGE_CHILDREN)?;
    let seconds =
        |time: nix::sys::time::TimeVal| time.tv_sec() as f64 + time.tv_usec() as f64 / 1e6;
    Ok(seconds(usage.user_time()) + seconds(usage.system_time()))
}

/// Sums over the processes of `group` that are there now, and their children that have ended.
fn sample(group: Pid) -> Sample {
    let (Ok(Some(ticks)), Ok(Some(page))) =
        (sysconf(SysconfVar::CLK_TCK), sysconf(SysconfVar::PAGE_SIZE))
    else {
        return Sample::default();
    };
    let Ok(entries) = fs::read_dir("/proc") else { return Sample::default() };
    let mut sum = Sample::default();
    for entry in entries.flatten() {
        if !entry.file_name().as_encoded_bytes()[0].is_ascii_digit() {
            continue;
        }
        let Ok(stat) = fs::read_to_string(entry.path().join("stat")) else { continue };
        if let Some((time, pages)) = process(&stat, group.as_raw()) {
            sum.cpu += time as f64 / ticks as f64;
            sum.rss += (pages * page as u64) >> 10;
        }
    }
    sum
}

/// Clock ticks and resident pages from a line of `/proc/PID/stat`, if the process belongs to `group`.
fn process(stat: &str, group: i32) -> Option<(u64, u64)> {
    // The second field is the name in parentheses, which may hold anything.
    let fields: Vec<&str> = stat[stat.rfind(')')? + 1..].split_ascii_whitespace().collect();
    let number = |position: usize| fields.get(position - 3)?.parse::<u64>().ok();
    if number(5)? != group as u64 {
        return None;
    }
    Some((number(14)? + number(15)? + number(16)? + number(17)?, number(24)?))
}

/// The content of a file, whatever its encoding.
fn lossy(file: &Path) -> io::Result<String> {
    Ok(String::from_utf8_lossy(&fs::read(file)?).into_owned())
}

#[cfg(test)]
mod tests {
    use super::{Allowance, Meter, Stopped, process};
    use std::process::Command;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;
    use std::time::Duration;

    fn run(script: &str, cpu: Duration) -> super::Measured {
        let allowance = Allowance { cpu, memory: 1 << 30 };
        let meter = Meter {
            allowance,
            wall: cpu * 3,
            pin: None,
            interrupted: Arc::new(AtomicBool::new(false)),
        };
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        meter.run(command, folder.path()).expect("a shell can be run")
    }

    #[test]
    fn output_and_exit_code_are_kept() {
        let measured = run("echo out; echo err >&2; exit 12", Duration::from_secs(10));
        assert_eq!((measured.code, measured.stopped), (12, None));
        assert_eq!((measured.stdout.as_str(), measured.stderr.as_str()), ("out\n", "err\n"));
    }

    #[test]
    fn a_process_that_only_waits_is_ended_by_the_wall_guard() {
        let measured = run("sleep 20 & sleep 20", Duration::from_millis(50));
        assert_eq!(measured.stopped, Some(Stopped::Wall));
        assert!(measured.wall < 5.0, "took {} s", measured.wall);
    }

    #[test]
    fn time_of_ended_grandchildren_counts() {
        let measured = run(
            "sh -c 'i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done'; true",
            Duration::from_secs(10),
        );
        assert!(measured.cpu > 0.01, "only {} s were seen", measured.cpu);
    }

    #[test]
    fn a_process_name_may_hold_parentheses() {
        let stat = "7 (a) b) S 1 42 42 0 -1 0 0 0 0 0 10 20 3 4 20 0 1 0 5 1000 250 0";
        assert_eq!(process(stat, 42), Some((37, 250)));
        assert_eq!(process(stat, 7), None);
    }
}
