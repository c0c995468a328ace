//! Which variable of a source stands for which of a target, as JSON: it is found, shown, corrected by a person and handed in.

use serde::{Deserialize, Serialize};

use super::{Ends, TransferError};
use crate::variable::VariableId;

/// The version of the format that is read and written.
pub const VERSION: u32 = 1;

/// Which variable of the source stands for which of the target: `rel()` of equation 2.14, and the intersection of equation 2.13.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Relation {
    /// The version of the format: 1.
    #[serde(rename = "caveat-relation")]
    pub version: u32,
    /// Variables that are the same in both, each source at most once.
    #[serde(default)]
    pub direct: Vec<Pair>,
    /// Variables that are related and not the same: ways to put the target's values into the source, each of which names a source at
    /// most once. Several ways let one variable of the source stand for several of the target.
    #[serde(default)]
    pub cross: Vec<Vec<Pair>>,
}

/// A variable of the source and the one of the target whose values it is asked about.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Pair {
    /// The variable of the source.
    pub source: String,
    /// The variable of the target.
    pub target: String,
    /// How sure that is, from 0 to 1, where it was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub score: Option<f64>,
    /// Why, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// The same with the numbers of the variables: one way to put values of the target into the source.
pub(super) type View = Vec<(VariableId, VariableId)>;

impl Relation {
    /// Reads JSON; what is wrong with it is said with its line.
    pub fn read(text: &str) -> Result<Self, String> {
        let relation: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if relation.version != VERSION {
            return Err(format!(
                "this is version {} of the format; version {VERSION} can be read",
                relation.version
            ));
        }
        Ok(relation)
    }

    /// Writes JSON that a person can correct.
    pub fn write(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("a relation is JSON");
        text.push('\n');
        text
    }

    /// The ways to put values of the target into the source: that of direct replacement, and those of cross replacement.
    pub(super) fn views(&self, ends: &Ends) -> Result<(View, Vec<View>), TransferError> {
        let view = |pairs: &Vec<Pair>| -> Result<View, TransferError> {
            let mut view: View = Vec::new();
            for pair in pairs {
                let found = (cause(ends, &pair.source, true)?, cause(ends, &pair.target, false)?);
                if view.iter().any(|&(source, _)| source == found.0) {
                    return Err(TransferError::Twice(pair.source.clone()));
                }
                view.push(found);
            }
            view.sort_unstable();
            Ok(view)
        };
        let direct = view(&self.direct)?;
        let cross = self.cross.iter().map(view).collect::<Result<Vec<View>, _>>()?;
        Ok((direct, cross.into_iter().filter(|view| !view.is_empty()).collect()))
    }
}

/// The cause of the goal with this name.
fn cause(ends: &Ends, name: &str, source: bool) -> Result<VariableId, TransferError> {
    let (network, goal, side) = if source {
        (ends.source, ends.source_goal.0, "source")
    } else {
        (ends.target, ends.target_goal.0, "target")
    };
    let Some(id) = network.named(name) else {
        return Err(TransferError::Unknown(format!("in the {side} {}", network.unknown(name))));
    };
    let parents = network.graph().parents(goal);
    if parents.contains(&id) {
        return Ok(id);
    }
    let names = network.causes(goal);
    Err(TransferError::NoCause {
        side,
        name: name.to_owned(),
        goal: network.variable(goal).name.clone(),
        causes: if names.is_empty() {
            "nothing does".to_owned()
        } else {
            format!("its causes are {}", names.join(", "))
        },
    })
}
