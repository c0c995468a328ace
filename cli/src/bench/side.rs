//! The two programs that are measured: how each is called, and by what it is known in the rows.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs, io};

use super::meter::Allowance;
use crate::args::List;

/// A program to measure.
#[derive(Debug)]
pub(super) enum Side {
    /// This planner.
    Ours {
        /// The binary.
        program: PathBuf,
        /// Of its content.
        hash: String,
        /// Of the repository that the harness is started in.
        commit: String,
    },
    /// Fast Downward.
    Peer {
        /// Its driver script.
        script: PathBuf,
        /// What runs the script.
        python: PathBuf,
        /// Of all files beside and below the script.
        hash: String,
    },
}

impl Side {
    /// This planner: `program`, or the running binary.
    pub(super) fn ours(program: Option<&Path>) -> io::Result<Self> {
        let program = match program {
            Some(program) => program.canonicalize()?,
            None => env::current_exe()?,
        };
        let hash = hash(std::slice::from_ref(&program))?;
        Ok(Self::Ours { program, hash, commit: commit() })
    }

    /// The peer behind `script`.
    pub(super) fn peer(script: &Path, python: &Path) -> io::Result<Self> {
        let script = script.canonicalize().map_err(|error| {
            io::Error::new(error.kind(), format!("the peer {}: {error}", script.display()))
        })?;
        let mut files = Vec::new();
        collect(script.parent().expect("a file lies in a folder"), &mut files)?;
        files.sort();
        let hash = hash(&files)?;
        Ok(Self::Peer { script, python: python.to_path_buf(), hash })
    }

    /// The word for it in file names and tables.
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Ours { .. } => "ours",
            Self::Peer { .. } => "peer",
        }
    }

    /// What tells one version of it from another.
    pub(super) fn hash(&self) -> &str {
        match self {
            Self::Ours { hash, .. } | Self::Peer { hash, .. } => hash,
        }
    }

    /// The commit it was made from, where that is known.
    pub(super) fn commit(&self) -> &str {
        match self {
            Self::Ours { commit, .. } => commit,
            Self::Peer { .. } => "-",
        }
    }

    /// The code that Fast Downward would have ended with.
    pub(super) fn code(&self, list: List, code: i32) -> i32 {
        match (self, list, code) {
            // `ground` has findings and failures where Fast Downward has unsolvable tasks and wrong input.
            (Self::Ours { .. }, List::Ground, 1) => 10,
            (Self::Ours { .. }, List::Ground, 2) => 31,
            _ => code,
        }
    }

    /// What to run for a task of `list`.
    pub(super) fn command(
        &self,
        list: List,
        domain: &Path,
        problem: &Path,
        allowance: &Allowance,
    ) -> Command {
        match self {
            Self::Ours { program, .. } => {
                let mut command = Command::new(program);
                match list {
                    List::Opt => command.args(["plan", "--optimal"]),
                    List::Sat => command.arg("plan"),
                    List::Ground => command.args(["ground", "--format", "sas", "-o", "output.sas"]),
                };
                if list != List::Ground {
                    command.arg(format!("--time-limit={}s", allowance.cpu.as_secs_f64()));
                    command.arg(format!("--memory-limit={}M", allowance.memory >> 20));
                }
                command.args([domain, problem]);
                command
            }
            Self::Peer { script, python, .. } => {
                let mut command = Command::new(python);
                command.arg(script);
                match list {
                    List::Opt => {
                        command.args([domain, problem]).args(["--search", "astar(lmcut())"])
                    }
                    List::Sat => command.args(["--alias", "lama-first"]).args([domain, problem]),
                    List::Ground => command.arg("--translate").args([domain, problem]),
                };
                // Bytecode written beside the peer's sources would change its hash and favour every run but the first.
                command.env("PYTHONDONTWRITEBYTECODE", "1");
                command
            }
        }
    }
}

/// All files below `folder` but what Python caches there.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            if entry.file_name() != "__pycache__" {
                collect(&entry.path(), files)?;
            }
        } else {
            files.push(entry.path());
        }
    }
    Ok(())
}

/// FNV-1a over the contents of `files`, eight bytes at a time.
fn hash(files: &[PathBuf]) -> io::Result<String> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for file in files {
        for chunk in fs::read(file)?.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            hash = (hash ^ u64::from_le_bytes(word)).wrapping_mul(0x0100_0000_01b3);
            hash ^= hash >> 32;
        }
    }
    Ok(format!("{hash:016x}"))
}

/// The commit that is checked out where the harness runs.
fn commit() -> String {
    let output = Command::new("git").args(["rev-parse", "--short", "HEAD"]).output();
    match output {
        Ok(output) if output.status.success() => {
            String::from_utf8_lossy(&output.stdout).trim().to_string()
        }
        _ => "-".to_string(),
    }
}
