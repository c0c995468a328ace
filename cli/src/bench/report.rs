//! What the rows say, as Markdown: coverage, discordant tasks, costs against the reference, times of tasks that both finish.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

use super::judge::{self, Judgement};
use super::row::{self, Row, Verdict};
use super::tasks::Task;
use crate::args::{Bench, List};

/// Reference costs, and where they come from.
type Costs = BTreeMap<String, (Option<f64>, Option<f64>)>;

/// One task with what is known of it.
struct Pair {
    domain: String,
    problem: String,
    ours: Option<Row>,
    peer: Option<Row>,
}

/// Writes the report on `tasks`.
pub(super) fn report(
    arguments: &Bench,
    tasks: &[Task],
    shared: &Path,
    seconds: f64,
) -> io::Result<String> {
    let costs = reference(&shared.join("benchmarks/reference.tsv"))?;
    let ours = latest(arguments, "ours", seconds)?;
    let peer = latest(arguments, "peer", seconds)?;
    let find = |rows: &[Row], task: &Task| {
        rows.iter().rev().find(|row| row.key.problem == task.problem).cloned()
    };
    let pairs: Vec<Pair> = tasks
        .iter()
        .map(|task| Pair {
            domain: task.domain.split('/').next().unwrap_or("").to_string(),
            problem: task.problem.clone(),
            ours: find(&ours, task),
            peer: find(&peer, task),
        })
        .collect();
    let mut text = String::new();
    head(&mut text, arguments, &pairs, seconds);
    coverage(&mut text, &pairs);
    ratios(&mut text, &pairs);
    if arguments.list == List::Ground {
        counts(&mut text, &pairs);
    } else {
        plans(&mut text, arguments, &pairs, &shared.join("benchmarks/ipc"));
        quality(&mut text, arguments.list, &pairs, &costs);
        discordant(&mut text, &pairs);
        domains(&mut text, &pairs);
    }
    Ok(text)
}

/// The rows of the program measured last on this machine under these limits.
fn latest(arguments: &Bench, side: &str, seconds: f64) -> io::Result<Vec<Row>> {
    let machine = row::machine();
    let mut rows =
        row::read(&arguments.out.join(format!("{}-{side}.tsv", row::name(arguments.list))))?;
    rows.retain(|row| {
        let key = &row.key;
        key.machine == machine
            && (key.seconds - seconds).abs() < 1e-6
            && key.mebibytes == arguments.memory_limit >> 20
            && row.verdict != Verdict::Wall
    });
    if let Some(program) = rows.last().map(|row| row.key.program.clone()) {
        rows.retain(|row| row.key.program == program);
    }
    Ok(rows)
}

/// Optimal and best known costs by problem.
fn reference(file: &Path) -> io::Result<Costs> {
    let text = fs::read_to_string(file)?;
    let lines = text.lines().skip(1).map(|line| line.split('\t').collect::<Vec<_>>());
    Ok(lines
        .filter(|fields| fields.len() > 3)
        .map(|fields| (fields[1].to_string(), (fields[2].parse().ok(), fields[3].parse().ok())))
        .collect())
}

/// Whether a row says that the task is solved.
fn solved(row: Option<&Row>) -> bool {
    row.is_some_and(|row| row.verdict == Verdict::Solved)
}

/// Whether a program takes the task at all.
fn accepted(row: Option<&Row>) -> bool {
    row.is_some_and(|row| !matches!(row.verdict, Verdict::Unsupported | Verdict::Input))
}

/// What was measured, and with what.
fn head(text: &mut String, arguments: &Bench, pairs: &[Pair], seconds: f64) {
    let name = row::name(arguments.list);
    let memory = arguments.memory_limit >> 20;
    let _ = writeln!(
        text,
        "### `{name}`, {} tasks, {seconds} s of CPU time and {memory} MiB each\n",
        pairs.len()
    );
    let _ = writeln!(text, "Machine: {}.", row::machine());
    if let Some(row) = pairs.iter().find_map(|pair| pair.ours.as_ref()) {
        let _ =
            writeln!(text, "Ours: commit {}, program {}.", row.cells["commit"], row.key.program);
    }
    if let Some(row) = pairs.iter().find_map(|pair| pair.peer.as_ref()) {
        let _ = writeln!(text, "Peer: program {}.", row.key.program);
    }
    let busy = |side: fn(&Pair) -> Option<&Row>| {
        pairs.iter().filter_map(side).filter(|row| !row.is_quiet()).count()
    };
    let (ours, peer) = (busy(|pair| pair.ours.as_ref()), busy(|pair| pair.peer.as_ref()));
    if ours + peer > 0 {
        let _ = writeln!(
            text,
            "Measured beside other work on the machine: {ours} rows of ours, {peer} of the peer."
        );
    }
    text.push('\n');
}

/// How often each verdict was given, and who solves more.
fn coverage(text: &mut String, pairs: &[Pair]) {
    let verdicts = [
        Verdict::Solved,
        Verdict::Time,
        Verdict::Memory,
        Verdict::Unsupported,
        Verdict::Input,
        Verdict::Unsolvable,
        Verdict::Incomplete,
        Verdict::Fault,
    ];
    let words: Vec<&str> = verdicts.iter().map(|verdict| verdict.word()).collect();
    let _ = writeln!(
        text,
        "| program | measured | {} |\n|---|--:|{}",
        words.join(" | "),
        "--:|".repeat(words.len())
    );
    let ours: Vec<&Row> = pairs.iter().filter_map(|pair| pair.ours.as_ref()).collect();
    let peer: Vec<&Row> = pairs.iter().filter_map(|pair| pair.peer.as_ref()).collect();
    for (name, rows) in [("ours", ours), ("peer", peer)] {
        let _ = write!(text, "| {name} | {} |", rows.len());
        for verdict in verdicts {
            let _ = write!(text, " {} |", rows.iter().filter(|row| row.verdict == verdict).count());
        }
        text.push('\n');
    }
    let both: Vec<&Pair> = pairs
        .iter()
        .filter(|pair| accepted(pair.ours.as_ref()) && accepted(pair.peer.as_ref()))
        .collect();
    let ours = both.iter().filter(|pair| solved(pair.ours.as_ref())).count();
    let peer = both.iter().filter(|pair| solved(pair.peer.as_ref())).count();
    let common =
        both.iter().filter(|pair| solved(pair.ours.as_ref()) && solved(pair.peer.as_ref())).count();
    let _ = writeln!(
        text,
        "\nOf the {} tasks that both were run on and accept, ours solves {ours}, the peer {peer}, both {common}.",
        both.len()
    );
    if peer > 0 {
        let share = 100.0 * ours as f64 / peer as f64;
        let _ = writeln!(text, "Ours solves {share:.1} % of the peer's number.");
    }
    let (wins, losses) = (ours - common, peer - common);
    let _ = writeln!(
        text,
        "Solved by ours alone: {wins}, by the peer alone: {losses} (sign test, two-sided: p = {:.3}).\n",
        sign_test(wins, losses)
    );
}

/// The probability of a split at least as uneven if both were equally good.
fn sign_test(wins: usize, losses: usize) -> f64 {
    let count = wins + losses;
    let mut probability = 0.5_f64.powi(count as i32);
    let mut tail = probability;
    for chosen in 1..=wins.min(losses) {
        probability *= (count - chosen + 1) as f64 / chosen as f64;
        tail += probability;
    }
    (2.0 * tail).min(1.0)
}

/// How much more CPU time the peer takes, as geometric means over tasks that both finish.
fn ratios(text: &mut String, pairs: &[Pair]) {
    let both: Vec<(f64, f64)> = pairs
        .iter()
        .filter(|pair| solved(pair.ours.as_ref()) && solved(pair.peer.as_ref()))
        .filter_map(|pair| Some((pair.ours.as_ref()?.cpu, pair.peer.as_ref()?.cpu)))
        .collect();
    let slow: Vec<(f64, f64)> =
        both.iter().copied().filter(|(ours, peer)| ours.max(*peer) > 0.5).collect();
    let sum =
        |pick: fn(&(f64, f64)) -> f64| both.iter().map(pick).fold(0.0, |sum, time| sum + time);
    let (ours, peer) = (sum(|pair| pair.0), sum(|pair| pair.1));
    let _ = writeln!(text, "CPU time of the whole process, tasks that both finish, peer : ours:");
    let _ = writeln!(
        text,
        "- geometric mean over all {}: {}",
        both.len(),
        ratio(geometric_mean(&both))
    );
    let _ = writeln!(
        text,
        "- geometric mean over the {} where one took more than 0.5 s: {}",
        slow.len(),
        ratio(geometric_mean(&slow))
    );
    let _ = writeln!(text, "- sum: {peer:.1} s to {ours:.1} s\n");
}

/// The geometric mean of second to first; a run shorter than a millisecond counts as one.
fn geometric_mean(pairs: &[(f64, f64)]) -> Option<f64> {
    let logarithms = pairs.iter().map(|(ours, peer)| (peer.max(0.001) / ours.max(0.001)).ln());
    (!pairs.is_empty()).then(|| (logarithms.sum::<f64>() / pairs.len() as f64).exp())
}

/// A ratio, or a dash.
fn ratio(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_string(), |value| format!("{value:.2}"))
}

/// Whether a cost is that of the reference, which keeps six digits of large numbers.
fn same(cost: f64, reference: f64) -> bool {
    if reference < 1e6 {
        (cost - reference).abs() < 1e-9
    } else {
        (cost / reference - 1.0).abs() < 1e-5
    }
}

/// What the validator says of all plans that were kept.
fn plans(text: &mut String, arguments: &Bench, pairs: &[Pair], ipc: &Path) {
    let mut faults = Vec::new();
    let mut judged = 0;
    for pair in pairs {
        for (side, row) in [("ours", &pair.ours), ("peer", &pair.peer)] {
            let Some(row) = row.as_ref().filter(|row| row.verdict == Verdict::Solved) else {
                continue;
            };
            let plan = row::plan_file(&arguments.out, arguments.list, side, &pair.problem);
            judged += 1;
            match judge::judge(&ipc.join(&row.key.domain), &ipc.join(&pair.problem), &plan) {
                Judgement::Valid(cost) if Some(&cost) == row.cells.get("cost") => {}
                Judgement::Valid(cost) => faults.push(format!(
                    "- {}: {side} says that its plan costs {}, but it costs {cost}",
                    pair.problem, row.cells["cost"]
                )),
                Judgement::Invalid(reason) => {
                    faults.push(format!("- {}: {side}: {reason}", pair.problem));
                }
            }
        }
    }
    let _ = writeln!(
        text,
        "Plans that are not valid or cost something else than was said: {} of {judged}.",
        faults.len()
    );
    for fault in &faults {
        let _ = writeln!(text, "{fault}");
    }
    text.push('\n');
}

/// Costs against the reference, and the sum of relative costs.
fn quality(text: &mut String, list: List, pairs: &[Pair], costs: &Costs) {
    let mut conflicts = Vec::new();
    let (mut compared, mut scores) = (0, [0.0, 0.0]);
    for pair in pairs {
        let (optimal, best) = costs.get(&pair.problem).copied().unwrap_or((None, None));
        for (number, (side, row)) in
            [("ours", &pair.ours), ("peer", &pair.peer)].into_iter().enumerate()
        {
            let Some(row) = row.as_ref().filter(|row| row.verdict == Verdict::Solved) else {
                continue;
            };
            let Some(cost) = row.number("cost") else { continue };
            if let Some(best) = best.or(optimal) {
                scores[number] += if cost > 0.0 { (best / cost).min(1.0) } else { 1.0 };
            }
            let Some(optimal) = optimal else { continue };
            compared += 1;
            let wrong = if list == List::Opt {
                !same(cost, optimal)
            } else {
                cost < optimal && !same(cost, optimal)
            };
            if wrong {
                conflicts.push(format!(
                    "- {}: {side} has {cost}, the reference has {optimal}",
                    pair.problem
                ));
            }
        }
    }
    let what = if list == List::Opt { "different from" } else { "below" };
    let _ = writeln!(
        text,
        "Costs {what} the optimal cost of the reference: {} of {compared} compared.",
        conflicts.len()
    );
    for conflict in &conflicts {
        let _ = writeln!(text, "{conflict}");
    }
    if list == List::Sat {
        let _ = writeln!(
            text,
            "Sum of best known cost to cost: ours {:.2}, peer {:.2}.",
            scores[0], scores[1]
        );
    }
    text.push('\n');
}

/// Tasks that one solves and the other does not.
fn discordant(text: &mut String, pairs: &[Pair]) {
    let _ = writeln!(text, "| discordant task | ours | s | peer | s |\n|---|---|--:|---|--:|");
    for pair in pairs {
        let (Some(ours), Some(peer)) = (&pair.ours, &pair.peer) else { continue };
        if (ours.verdict == Verdict::Solved) != (peer.verdict == Verdict::Solved) {
            let _ = writeln!(
                text,
                "| {} | {} | {:.1} | {} | {:.1} |",
                pair.problem,
                ours.verdict.word(),
                ours.cpu,
                peer.verdict.word(),
                peer.cpu
            );
        }
    }
    text.push('\n');
}

/// Coverage and times by domain.
fn domains(text: &mut String, pairs: &[Pair]) {
    let mut table: BTreeMap<&str, Vec<&Pair>> = BTreeMap::new();
    for pair in pairs.iter().filter(|pair| pair.ours.is_some() || pair.peer.is_some()) {
        table.entry(&pair.domain).or_default().push(pair);
    }
    let _ = writeln!(
        text,
        "| domain | tasks | ours | peer | peer : ours, time |\n|---|--:|--:|--:|--:|"
    );
    for (domain, pairs) in table {
        let ours = pairs.iter().filter(|pair| solved(pair.ours.as_ref())).count();
        let peer = pairs.iter().filter(|pair| solved(pair.peer.as_ref())).count();
        let both: Vec<(f64, f64)> = pairs
            .iter()
            .filter(|pair| solved(pair.ours.as_ref()) && solved(pair.peer.as_ref()))
            .filter_map(|pair| Some((pair.ours.as_ref()?.cpu, pair.peer.as_ref()?.cpu)))
            .collect();
        let _ = writeln!(
            text,
            "| {domain} | {} | {ours} | {peer} | {} |",
            pairs.len(),
            ratio(geometric_mean(&both))
        );
    }
    text.push('\n');
}

/// Facts and operators side by side.
fn counts(text: &mut String, pairs: &[Pair]) {
    let _ = writeln!(
        text,
        "| task | facts: ours | peer | operators: ours | peer | s: ours | peer | ratio | same |"
    );
    let _ = writeln!(text, "|---|--:|--:|--:|--:|--:|--:|--:|---|");
    let mut different = 0;
    for pair in pairs {
        let cell = |row: &Option<Row>, column: &str| match row {
            Some(row) if row.verdict == Verdict::Solved => row.cells[column].clone(),
            Some(row) => row.verdict.word().to_string(),
            None => "-".to_string(),
        };
        let facts = [cell(&pair.ours, "facts"), cell(&pair.peer, "facts")];
        let operators = [cell(&pair.ours, "operators"), cell(&pair.peer, "operators")];
        let both = solved(pair.ours.as_ref()) && solved(pair.peer.as_ref());
        let same = facts[0] == facts[1] && operators[0] == operators[1];
        different += usize::from(both && !same);
        let times = [cell(&pair.ours, "cpu_s"), cell(&pair.peer, "cpu_s")];
        let factor = match (&pair.ours, &pair.peer) {
            (Some(ours), Some(peer)) if both => ratio(geometric_mean(&[(ours.cpu, peer.cpu)])),
            _ => "-".to_string(),
        };
        let mark = if !both {
            "-"
        } else if same {
            "yes"
        } else {
            "no"
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {factor} | {mark} |",
            pair.problem, facts[0], facts[1], operators[0], operators[1], times[0], times[1]
        );
    }
    let _ = writeln!(text, "\nTasks that both finish with different counts: {different}.");
}

#[cfg(test)]
mod tests {
    use super::{geometric_mean, same, sign_test};

    #[test]
    fn the_sign_test_is_exact() {
        assert!((sign_test(0, 0) - 1.0).abs() < 1e-12);
        assert!((sign_test(5, 0) - 0.0625).abs() < 1e-12);
        assert!((sign_test(3, 1) - 0.625).abs() < 1e-12);
    }

    #[test]
    fn ratios_are_averaged_by_their_logarithms() {
        let mean = geometric_mean(&[(1.0, 4.0), (2.0, 2.0)]).expect("there are pairs");
        assert!((mean - 2.0).abs() < 1e-12);
        assert_eq!(geometric_mean(&[]), None);
    }

    #[test]
    fn large_reference_costs_are_rounded_to_six_digits() {
        assert!(same(3_160_824.0, 3.16082e6));
        assert!(!same(3_160_924.0, 3.16082e6));
        assert!(!same(87.0, 88.0));
    }
}
