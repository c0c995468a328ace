//! A reference domain's `costs.tsv` goes in; what is known of each of its problems comes out.

use std::collections::BTreeMap;

/// What is known of the cheapest plan of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// This is its cost, proven.
    Cost(u64),
    /// There is a plan; the cheapest is not proven.
    Open,
    /// There is no plan, proven.
    Unsolvable,
}

/// What `costs.tsv` says of each problem of the domain `name`, by the problem's file name without its ending.
pub fn read(name: &str) -> BTreeMap<String, Known> {
    let path = domains::folder().join(name).join("costs.tsv");
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines()
        .map(|line| {
            let (problem, known) = line
                .split_once('\t')
                .unwrap_or_else(|| panic!("{}: no tab in `{line}`", path.display()));
            let known = match known {
                "-" => Known::Open,
                "unsolvable" => Known::Unsolvable,
                cost => Known::Cost(
                    cost.parse()
                        .unwrap_or_else(|_| panic!("{}: `{cost}` is no cost", path.display())),
                ),
            };
            (problem.to_string(), known)
        })
        .collect()
}
