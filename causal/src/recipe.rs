//! What a person declares of the variables of trials, as JSON: their units, their roles, what they come from and how they are cut.

use serde::{Deserialize, Serialize};

use crate::derive::Derivation;
use crate::variable::Role;

/// The version of the format that is read and written.
pub const VERSION: u32 = 1;

/// The variables of a model, as a person declares them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Recipe {
    /// The version of the format: 1.
    #[serde(rename = "caveat-recipe")]
    pub version: u32,
    /// The variables.
    pub variables: Vec<Declared>,
}

/// One variable, as a person declares it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Declared {
    /// Its name.
    pub name: String,
    /// The unit of its values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// What it is in a trial.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub role: Option<Role>,
    /// What it comes from; by default the column or series of its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Derivation>,
    /// How its values become states; by default as the data suggest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cuts: Option<Cuts>,
}

/// How values become states.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cuts {
    /// The values themselves.
    Categories,
    /// So many intervals, with about as many trials in each (thesis algorithm 1, line 8).
    Quantile(usize),
    /// So many intervals of one width.
    Width(usize),
    /// The intervals between these edges.
    Edges(Vec<f64>),
    /// So many typical courses of a series (algorithm 1, line 6).
    KMeans(usize),
    /// As many quantile intervals as predict the outcome best.
    Search,
}

impl Declared {
    /// A variable of which only the name is known.
    pub fn named(name: impl Into<String>) -> Self {
        Self { name: name.into(), unit: None, role: None, from: None, cuts: None }
    }
}

impl Recipe {
    /// Reads JSON; what is wrong with it is said with its line.
    pub fn read(text: &str) -> Result<Self, String> {
        let recipe: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if recipe.version != VERSION {
            return Err(format!(
                "this is version {} of the format; version {VERSION} can be read",
                recipe.version
            ));
        }
        for (at, variable) in recipe.variables.iter().enumerate() {
            if recipe.variables[..at].iter().any(|one| one.name == variable.name) {
                return Err(format!("`{}` is declared twice", variable.name));
            }
            if let Some(cuts) = &variable.cuts {
                cuts.check().map_err(|what| format!("`{}`: {what}", variable.name))?;
            }
        }
        Ok(recipe)
    }
}

impl Cuts {
    /// Reads how it is written on a command line: `categories`, `search`, `quantile:5`, `width:5`, `k-means:4`, or the edges
    /// themselves: `-1.8:-0.6:0.6:1.8`.
    pub fn parse(text: &str) -> Result<Self, String> {
        let number = |rest: &str| {
            rest.parse::<usize>().map_err(|_| format!("`{rest}` is no number of states"))
        };
        let cuts = match text.split_once(':') {
            None if text == "categories" => Self::Categories,
            None if text == "search" => Self::Search,
            Some(("quantile", rest)) => Self::Quantile(number(rest)?),
            Some(("width", rest)) => Self::Width(number(rest)?),
            Some(("k-means", rest)) => Self::KMeans(number(rest)?),
            _ => Self::Edges(
                text.split(':')
                    .map(|edge| {
                        edge.parse().map_err(|_| format!("`{edge}` is no edge of an interval"))
                    })
                    .collect::<Result<_, _>>()?,
            ),
        };
        cuts.check()?;
        Ok(cuts)
    }

    /// Says what cannot be meant.
    fn check(&self) -> Result<(), String> {
        match self {
            Self::Quantile(states) | Self::Width(states) | Self::KMeans(states)
                if !(1..=crate::variable::MOST_STATES).contains(states) =>
            {
                Err(format!("{states} states; there can be 1 to {}", crate::variable::MOST_STATES))
            }
            Self::Edges(edges) if edges.len() < 2 => {
                Err("an interval lies between two edges".to_owned())
            }
            Self::Edges(edges) if edges.len() > crate::variable::MOST_STATES + 1 => Err(format!(
                "{} edges; there can be {}",
                edges.len(),
                crate::variable::MOST_STATES + 1
            )),
            Self::Edges(edges) if edges.iter().any(|edge| !edge.is_finite()) => {
                Err("the edges of intervals are finite numbers".to_owned())
            }
            Self::Edges(edges) => match edges.windows(2).find(|pair| pair[0] >= pair[1]) {
                None => Ok(()),
                Some(pair) => {
                    Err(format!("the edges should rise, and {} follows {}", pair[1], pair[0]))
                }
            },
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cuts_are_read_as_they_are_written() {
        assert_eq!(Cuts::parse("quantile:5"), Ok(Cuts::Quantile(5)));
        assert_eq!(Cuts::parse("-1.8:-0.6:0.6"), Ok(Cuts::Edges(vec![-1.8, -0.6, 0.6])));
        assert_eq!(Cuts::parse("1:0").unwrap_err(), "the edges should rise, and 0 follows 1");
        assert_eq!(Cuts::parse("quantile:0").unwrap_err(), "0 states; there can be 1 to 256");
        assert_eq!(Cuts::parse("five").unwrap_err(), "`five` is no edge of an interval");
    }

    #[test]
    fn a_recipe_is_checked_when_it_is_read() {
        let good = r#"{"caveat-recipe": 1, "variables": [
            {"name": "xOff", "unit": "cm", "role": "treatment", "cuts": {"quantile": 5}},
            {"name": "far", "from": {"norm": ["x", "y"]}, "cuts": {"edges": [0, 1, 2]}}]}"#;
        assert_eq!(Recipe::read(good).unwrap().variables.len(), 2);
        let twice = r#"{"caveat-recipe": 1, "variables": [{"name": "a"}, {"name": "a"}]}"#;
        assert_eq!(Recipe::read(twice).unwrap_err(), "`a` is declared twice");
        let typo = r#"{"caveat-recipe": 1, "variables": [{"name": "a", "rôle": "outcome"}]}"#;
        assert!(Recipe::read(typo).unwrap_err().starts_with("unknown field `rôle`"));
    }
}
