//! What the program can end with: every exit code of every verb, once.

use std::process::ExitCode;

/// How a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Exit {
    /// A plan was found, or the verb did what it was asked to.
    Done,
    /// Any verb but `plan`: there is something to look at.
    Findings,
    /// Any verb but `plan`: it could not run.
    Failed,
    /// `plan`: the command line is wrong.
    Usage,
}

impl Exit {
    /// The number that the shell sees.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Findings => 1,
            Self::Failed => 2,
            Self::Usage => 36,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
