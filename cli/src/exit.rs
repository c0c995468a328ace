//! What the program can end with: every exit code of every verb, once.
//!
//! `plan` keeps Fast Downward's codes, which scripts of the field already read. All other verbs keep to 0, 1 and 2.

use std::fmt::Write as _;
use std::process::ExitCode;

/// How a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Exit {
    /// A plan was found, or the verb did what it was asked to and found nothing wrong.
    Done,
    /// Any verb but `plan`: there is something to look at.
    Findings,
    /// Any verb but `plan`: it could not run.
    Failed,
    /// `plan`: a plan was found, and the search for better ones ended for lack of memory.
    PlanMemory,
    /// `plan`: a plan was found, and the search for better ones ended for lack of time.
    PlanTime,
    /// `plan`: the goal cannot be reached even when deletes are ignored.
    Unreachable,
    /// `excuse`: the problem has a plan as it is.
    Unneeded,
    /// `plan`: every reachable state was looked at; there is no plan. `excuse`: there is no excuse.
    Exhausted,
    /// `plan`: the search ended without a plan and without a proof that there is none. `excuse`: the same of excuses.
    Incomplete,
    /// `plan`: out of memory while grounding.
    GroundMemory,
    /// `plan`: out of time while grounding.
    GroundTime,
    /// `plan`: out of memory while searching.
    SearchMemory,
    /// `plan`: out of time while searching.
    SearchTime,
    /// `plan`: a file is missing or wrong.
    Input,
    /// A bug of this program, whatever the verb.
    Bug,
    /// `plan`: the task asks for what cannot be planned.
    Unsupported,
    /// `plan`: the command line is wrong.
    Usage,
}

impl Exit {
    /// Every way to end, with its code and its meaning, in the order of the codes.
    pub const TABLE: [(Self, u8, &str); 17] = [
        (Self::Done, 0, "a plan was found; for other verbs: done, nothing wrong"),
        (Self::Findings, 1, "other verbs: something is wrong with what was checked"),
        (Self::PlanMemory, 1, "a plan was found, then memory ran out"),
        (Self::Failed, 2, "other verbs: could not run"),
        (Self::PlanTime, 2, "a plan was found, then time ran out"),
        (Self::Unreachable, 10, "no plan: the goal is out of reach even without deletes"),
        (Self::Unneeded, 10, "excuse: the problem has a plan as it is"),
        (Self::Exhausted, 11, "no plan: all reachable states were looked at"),
        (Self::Incomplete, 12, "no plan found, and no proof that there is none"),
        (Self::GroundMemory, 20, "out of memory while grounding"),
        (Self::GroundTime, 21, "out of time while grounding"),
        (Self::SearchMemory, 22, "out of memory while searching"),
        (Self::SearchTime, 23, "out of time while searching, or asked to stop"),
        (Self::Input, 31, "a file is missing or wrong"),
        (Self::Bug, 32, "a bug of this program, whatever the verb"),
        (Self::Unsupported, 34, "the task asks for what cannot be planned"),
        (Self::Usage, 36, "the command line is wrong"),
    ];

    /// The number that the shell sees.
    pub fn code(self) -> u8 {
        Self::TABLE.iter().find(|row| row.0 == self).expect("the table has every way to end").1
    }

    /// The codes of `plan`, one a line, for its help.
    pub fn plan_table() -> String {
        let mut text = String::from("Exit codes:\n");
        for (exit, code, meaning) in Self::TABLE {
            let meaning = meaning.split(';').next().unwrap_or(meaning);
            if !matches!(exit, Self::Findings | Self::Failed | Self::Unneeded) {
                let _ = writeln!(text, "  {code:<2}  {meaning}");
            }
        }
        text
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

#[cfg(test)]
mod tests {
    use super::Exit;

    #[test]
    fn codes_are_those_that_the_field_reads() {
        let plan = [
            (Exit::Done, 0),
            (Exit::PlanMemory, 1),
            (Exit::PlanTime, 2),
            (Exit::Unreachable, 10),
            (Exit::Exhausted, 11),
            (Exit::Incomplete, 12),
            (Exit::GroundMemory, 20),
            (Exit::GroundTime, 21),
            (Exit::SearchMemory, 22),
            (Exit::SearchTime, 23),
            (Exit::Input, 31),
            (Exit::Bug, 32),
            (Exit::Unsupported, 34),
            (Exit::Usage, 36),
        ];
        for (exit, code) in plan {
            assert_eq!(exit.code(), code, "{exit:?}");
        }
        assert_eq!((Exit::Findings.code(), Exit::Failed.code()), (1, 2));
    }

    #[test]
    fn the_table_is_sorted_by_code() {
        assert!(Exit::TABLE.is_sorted_by_key(|row| row.1));
    }
}
