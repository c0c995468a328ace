//! What is known before any data goes in; which arcs a graph may and must have comes out.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::set::Set;
use crate::variable::{Role, Variable, VariableId, named, unknown};

/// What is known of the causes among variables, by their names.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default, deny_unknown_fields)]
pub struct Knowledge {
    /// Variables in the order of time: nothing causes what is in an earlier tier.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tiers: Vec<Vec<String>>,
    /// Arcs that there are, each from cause to effect.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub required: Vec<(String, String)>,
    /// Arcs that there are not.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub forbidden: Vec<(String, String)>,
    /// Variables that were set at random or by intervention: nothing causes them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<String>,
}

/// Why knowledge cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum KnowledgeError {
    /// A name that no variable has.
    #[error("{0}")]
    Unknown(String),
    /// A variable in two tiers.
    #[error("`{0}` is in two tiers")]
    TwoTiers(String),
    /// An arc that must be and must not be.
    #[error("the arc from `{from}` to `{to}` is required, and {why}")]
    Contradiction {
        /// The cause.
        from: String,
        /// The effect.
        to: String,
        /// What is against it.
        why: String,
    },
    /// Required arcs that come round.
    #[error("the required arcs make a cycle: {0}")]
    Cycle(String),
}

/// Which arcs a graph over variables may and must have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rules {
    allowed: Vec<Set>,
    required: Vec<Set>,
}

impl Knowledge {
    /// What the roles of variables say: [treatments](Role::Treatment) are set, and come before everything else.
    #[must_use]
    pub fn with_roles(mut self, variables: &[Variable]) -> Self {
        for variable in variables.iter().filter(|one| one.role == Some(Role::Treatment)) {
            if !self.set.contains(&variable.name) {
                self.set.push(variable.name.clone());
            }
        }
        self
    }

    /// What this means for some variables.
    pub fn rules(&self, variables: &[Variable]) -> Result<Rules, KnowledgeError> {
        let find = |name: &String| find(variables, name);
        let all = Set::first(variables.len());
        let mut rules = Rules::free(variables.len());
        let mut tiers: Vec<Option<usize>> = vec![None; variables.len()];
        for (tier, names) in self.tiers.iter().enumerate() {
            for name in names {
                let id = find(name)?;
                if tiers[id.index()].replace(tier).is_some() {
                    return Err(KnowledgeError::TwoTiers(name.clone()));
                }
            }
        }
        let mut set = Set::EMPTY;
        for name in &self.set {
            set = set.with(find(name)?);
        }
        let mut forbidden: Vec<(VariableId, VariableId)> = Vec::new();
        for (from, to) in &self.forbidden {
            forbidden.push((find(from)?, find(to)?));
        }
        let later = |from: VariableId, to: VariableId| matches!((tiers[from.index()], tiers[to.index()]), (Some(from), Some(to)) if from > to);
        for to in all.iter() {
            let barred = |from: &VariableId| {
                set.contains(to) || later(*from, to) || forbidden.contains(&(*from, to))
            };
            let barred: Set = all.iter().filter(barred).collect();
            rules.allowed[to.index()] = all.without(to).minus(barred);
        }
        for (from_name, to_name) in &self.required {
            let (from, to) = (find(from_name)?, find(to_name)?);
            let why = if from == to {
                "nothing causes itself".to_owned()
            } else if set.contains(to) {
                format!("`{to_name}` was set by chance or choice, so that nothing causes it")
            } else if later(from, to) {
                format!("`{from_name}` is in a later tier")
            } else if forbidden.contains(&(from, to)) {
                "it is forbidden".to_owned()
            } else {
                rules.required[to.index()] = rules.required[to.index()].with(from);
                rules.allowed[from.index()] = rules.allowed[from.index()].without(to);
                continue;
            };
            return Err(KnowledgeError::Contradiction {
                from: from_name.clone(),
                to: to_name.clone(),
                why,
            });
        }
        let parents = rules.required.iter().map(|set| set.list()).collect();
        if let Err(cycle) = crate::graph::Dag::new(parents) {
            let mut names: Vec<&str> =
                cycle.0.iter().map(|id| variables[id.index()].name.as_str()).collect();
            names.push(names[0]);
            return Err(KnowledgeError::Cycle(names.join(" -> ")));
        }
        Ok(rules)
    }
}

/// The variable of a name.
fn find(variables: &[Variable], name: &str) -> Result<VariableId, KnowledgeError> {
    named(variables, name).ok_or_else(|| KnowledgeError::Unknown(unknown(name, variables)))
}

impl Rules {
    /// Every arc may be, none must.
    pub fn free(variables: usize) -> Self {
        let all = Set::first(variables);
        let allowed = (0..variables as u16).map(|id| all.without(VariableId(id))).collect();
        Self { allowed, required: vec![Set::EMPTY; variables] }
    }

    /// What may cause a variable.
    pub fn allowed(&self, child: VariableId) -> Set {
        self.allowed[child.index()]
    }

    /// What must cause a variable.
    pub fn required(&self, child: VariableId) -> Set {
        self.required[child.index()]
    }

    /// Whether an arc may be.
    pub fn allows(&self, parent: VariableId, child: VariableId) -> bool {
        self.allowed(child).contains(parent)
    }

    /// Whether nothing is known.
    pub fn is_free(&self) -> bool {
        *self == Self::free(self.allowed.len())
    }

    /// The same rules, where variable `i` is what was variable `order[i]`.
    #[must_use]
    pub fn reordered(&self, order: &[VariableId]) -> Self {
        let turn = |set: Set| -> Set {
            let place = |(_, old): &(usize, &VariableId)| set.contains(**old);
            order.iter().enumerate().filter(place).map(|(new, _)| VariableId(new as u16)).collect()
        };
        Self {
            allowed: order.iter().map(|&old| turn(self.allowed(old))).collect(),
            required: order.iter().map(|&old| turn(self.required(old))).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variables() -> Vec<Variable> {
        let roles =
            [("xOff", Some(Role::Treatment)), ("dropOff", Some(Role::Treatment)), ("onTop", None)];
        let variable = |(name, role)| Variable { role, ..Variable::of_words(name, ["0", "1"]) };
        roles.into_iter().map(variable).collect()
    }

    fn pair(from: &str, to: &str) -> (String, String) {
        (from.to_owned(), to.to_owned())
    }

    #[test]
    fn what_was_set_has_no_causes() {
        let rules = Knowledge::default().with_roles(&variables()).rules(&variables()).unwrap();
        let allowed: Vec<Vec<u16>> = (0..3)
            .map(|id| rules.allowed(VariableId(id)).iter().map(|id| id.0).collect())
            .collect();
        assert_eq!(allowed, [vec![], vec![], vec![0, 1]]);
    }

    #[test]
    fn contradictions_are_said() {
        let said = |knowledge: Knowledge| {
            knowledge.with_roles(&variables()).rules(&variables()).unwrap_err().to_string()
        };
        let required = vec![pair("onTop", "xOff")];
        assert_eq!(
            said(Knowledge { required, ..Knowledge::default() }),
            "the arc from `onTop` to `xOff` is required, and `xOff` was set by chance or choice, so that nothing causes it"
        );
        let forbidden = vec![pair("xoff", "onTop")];
        assert_eq!(
            said(Knowledge { forbidden, ..Knowledge::default() }),
            "there is no variable `xoff`; did you mean `xOff`?"
        );
        let tiers = vec![vec!["onTop".to_owned()], vec!["onTop".to_owned()]];
        assert_eq!(said(Knowledge { tiers, ..Knowledge::default() }), "`onTop` is in two tiers");
        let words = ["a", "b", "c"].map(|name| Variable::of_words(name, ["0", "1"]));
        let required = vec![pair("a", "b"), pair("b", "c"), pair("c", "a")];
        let error = Knowledge { required, ..Knowledge::default() }.rules(&words).unwrap_err();
        assert!(error.to_string().starts_with("the required arcs make a cycle: "), "{error}");
    }
}
