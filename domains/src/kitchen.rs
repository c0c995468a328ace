//! A size and what the robot has not learned go in; a kitchen comes out in which it cannot store the plates, as a domain and a problem.
//!
//! The two scenarios are those of the folders `closed-drawer` and `blocked-drawer`, after the thesis, figure 3.2.
//!
//! ```
//! use domains::kitchen::{Kitchen, Scenario};
//!
//! let kitchen = Kitchen::new(3, Scenario::Blocked, 2).expect("two plates are no more than three");
//! assert!(kitchen.problem().contains("(blocks chair2 drawer2)"));
//! ```

use std::fmt::Write;

/// The longest a line of objects may grow, without what it is indented by.
const WIDTH: usize = 76;

/// What the robot has not learned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenario {
    /// Scenario I: to open a drawer. All drawers are closed, and no chair is in the way.
    Closed,
    /// Scenario II: to move a chair. All drawers are closed, and a chair blocks each that is needed.
    Blocked,
}

impl Scenario {
    /// The scenario that the thesis counts as `numeral`, I or II.
    pub fn of(numeral: &str) -> Option<Self> {
        match numeral {
            "I" => Some(Self::Closed),
            "II" => Some(Self::Blocked),
            _ => None,
        }
    }

    /// The name of its domain, which is that of its folder as well.
    pub fn name(self) -> &'static str {
        match self {
            Self::Closed => "closed-drawer",
            Self::Blocked => "blocked-drawer",
        }
    }

    /// What the robot knows, as PDDL text.
    pub fn domain(self) -> &'static str {
        match self {
            Self::Closed => include_str!("../closed-drawer/domain.pddl"),
            Self::Blocked => include_str!("../blocked-drawer/domain.pddl"),
        }
    }
}

/// A kitchen in which a robot shall store plates.
///
/// The smallest excuses have one edit for each plate that is to be stored: its drawer is open, or, in scenario II, its drawer is clear or open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kitchen {
    size: u32,
    scenario: Scenario,
    goals: u32,
}

impl Kitchen {
    /// A kitchen with `size` plates, drawers, tables and chairs, of which the first `goals` plates are to be stored, each in its own drawer.
    ///
    /// There is none where no plate is to be stored, or more than there are.
    pub fn new(size: u32, scenario: Scenario, goals: u32) -> Option<Self> {
        (1..=size).contains(&goals).then_some(Self { size, scenario, goals })
    }

    /// The problem as PDDL text, laid out as `caveat fmt` does.
    pub fn problem(&self) -> String {
        let name = self.scenario.name();
        let mut text = match self.scenario {
            Scenario::Closed => format!(
                ";; {} of {} plates go into drawers, and all drawers are closed.\n",
                self.goals, self.size
            ),
            Scenario::Blocked => format!(
                ";; {} of {} plates go into drawers that are closed, each with a chair before it.\n",
                self.goals, self.size
            ),
        };
        let mut line = |indent: usize, line: &str| {
            writeln!(text, "{:indent$}{line}", "").expect("a string takes any text");
        };
        line(0, &format!("(define (problem {name}-{}-{})", self.size, self.goals));
        line(2, &format!("(:domain {name})"));
        line(2, "(:objects");
        for (kind, kept) in [
            ("plate", "- item"),
            ("drawer", "- drawer"),
            ("table", "- table"),
            ("chair", "- chair)"),
        ] {
            for names in self.objects(kind, kept) {
                line(4, &names);
            }
        }
        line(2, "(:init");
        line(4, "(hand-clear)");
        for number in 1..=self.size {
            line(4, &format!("(on plate{number} table{number})"));
        }
        for number in 1..=self.size {
            let end = if number == self.size { ")" } else { "" };
            let blocked = self.scenario == Scenario::Blocked && number <= self.goals;
            let way = if blocked {
                format!("(blocks chair{number} drawer{number})")
            } else {
                format!("(clear drawer{number})")
            };
            line(4, &format!("(closed drawer{number}) {way}{end}"));
        }
        if self.goals == 1 {
            line(2, "(:goal (inside plate1 drawer1)))");
            return text;
        }
        line(2, "(:goal");
        line(4, "(and");
        for number in 1..=self.goals {
            let end = if number == self.goals { ")))" } else { "" };
            line(6, &format!("(inside plate{number} drawer{number}){end}"));
        }
        text
    }

    /// The names of all objects of a kind and their type, in lines that are no longer than need be.
    fn objects(&self, kind: &str, of: &str) -> Vec<String> {
        let mut lines = vec![String::new()];
        let names = (1..=self.size).map(|number| format!("{kind}{number}"));
        let last = format!("{kind}{} {of}", self.size);
        for word in names.take(self.size as usize - 1).chain([last]) {
            let line = lines.last_mut().expect("there is always one");
            if line.is_empty() {
                *line = word;
            } else if line.len() + 1 + word.len() <= WIDTH {
                line.push(' ');
                line.push_str(&word);
            } else {
                lines.push(word);
            }
        }
        lines
    }
}
