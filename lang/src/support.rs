//! Nothing goes in; what Caveat does with each requirement comes out, as a table.

/// How far a part of the language is supported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Support {
    /// It is checked, plans are validated, and plans are found.
    Planned,
    /// Names, arities, types and places are checked; what runs it refuses it by name and place.
    Checked,
    /// It is read and kept as it is.
    Read,
}

/// One row: requirements that are supported alike.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// The flags, as they are written.
    pub flags: &'static str,
    /// The version or dialect that brought them.
    pub since: &'static str,
    /// How far they are supported.
    pub support: Support,
    /// Planners that plan them.
    pub others: &'static str,
}

const fn row(
    flags: &'static str,
    since: &'static str,
    support: Support,
    others: &'static str,
) -> Row {
    Row { flags, since, support, others }
}

/// All rows, in the order of the versions.
pub const ROWS: [Row; 17] = [
    row(":strips :typing :equality", "PDDL 1.2", Support::Planned, "nearly all"),
    row(
        ":adl :negative-preconditions :disjunctive-preconditions :quantified-preconditions :conditional-effects",
        "PDDL 1.2",
        Support::Planned,
        "Fast Downward",
    ),
    row(":action-costs", "PDDL 3.1", Support::Planned, "Fast Downward"),
    row(":derived-predicates", "PDDL 2.2", Support::Planned, "Fast Downward"),
    row(":domain-axioms :action-expansions", "PDDL 1.2", Support::Checked, ""),
    row(":fluents :numeric-fluents", "PDDL 2.1", Support::Checked, "ENHSP, Metric-FF"),
    row(":object-fluents", "PDDL 3.1", Support::Checked, ""),
    row(
        ":durative-actions :duration-inequalities",
        "PDDL 2.1",
        Support::Checked,
        "OPTIC, POPF, Tamer",
    ),
    row(":continuous-effects", "PDDL 2.1", Support::Checked, "OPTIC"),
    row(":timed-initial-literals", "PDDL 2.2", Support::Checked, "OPTIC, POPF"),
    row(":preferences :constraints", "PDDL 3.0", Support::Checked, "OPTIC"),
    row(":goal-utilities", "PDDL 3.1", Support::Checked, ""),
    row(":time (processes and events)", "PDDL+", Support::Checked, "ENHSP"),
    row(":multi-agent", "MA-PDDL", Support::Planned, ""),
    row(
        ":unfactored-privacy :factored-privacy :concurrency-network",
        "MA-PDDL",
        Support::Planned,
        "",
    ),
    row(":hierarchy :method-preconditions", "HDDL", Support::Checked, "PANDA"),
    row(":non-deterministic :probabilistic-effects :contingent", "FOND, PPDDL", Support::Read, ""),
];

/// The table in Markdown, as it stands in the README.
pub fn table() -> String {
    let mut text = String::from(
        "| requirement | since | checked | validated | planned | planned by others |\n|---|---|---|---|---|---|\n",
    );
    for row in ROWS {
        let mark = |yes: bool| if yes { "yes" } else { "" };
        let checked = if row.support == Support::Read { "read" } else { "yes" };
        let runs = mark(row.support == Support::Planned);
        text.push_str("| ");
        let flags: Vec<String> = match row.flags.split_once(" (") {
            Some((flag, note)) => vec![format!("`{flag}` ({note}")],
            None => row.flags.split(' ').map(|flag| format!("`{flag}`")).collect(),
        };
        let cells = [&flags.join(" "), row.since, checked, runs, runs, row.others];
        text.push_str(&cells.join(" | "));
        text.push_str(" |\n");
    }
    text
}
