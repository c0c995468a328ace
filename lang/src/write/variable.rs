//! The variables of a scope go in; a name for each comes out that means nothing else where it is visible.
//!
//! In the model a variable is an id, so two of one scope may have the same name, and one that no text could refer to.

use std::collections::{HashMap, HashSet};

use crate::model::{TypeId, Variable, VariableId};

/// The variables of a scope and what those that are bound at a place are called there.
pub(super) struct Variables<'s> {
    declared: &'s [Variable],
    names: Vec<String>,
    /// The names that mean something here, in lower case.
    visible: HashSet<String>,
    /// The names that the scope declares, which no other variable shall have.
    taken: HashSet<String>,
    /// The last number that was put after a name.
    numbers: HashMap<String, u32>,
}

/// What variables were called before they were bound, to be restored at the end.
pub(super) type Hidden = Vec<(VariableId, String)>;

impl<'s> Variables<'s> {
    /// None of them is bound.
    pub(super) fn new(declared: &'s [Variable]) -> Self {
        let taken = declared.iter().map(|variable| spelling(variable).to_ascii_lowercase());
        Self {
            declared,
            names: vec![String::new(); declared.len()],
            visible: HashSet::new(),
            taken: taken.collect(),
            numbers: HashMap::new(),
        }
    }

    /// All of them.
    pub(super) fn ids(&self) -> impl Iterator<Item = VariableId> + use<> {
        (0..self.declared.len() as u32).map(VariableId)
    }

    /// What a variable that is bound is called.
    pub(super) fn name(&self, id: VariableId) -> &str {
        &self.names[id.index()]
    }

    /// The types of a variable.
    pub(super) fn types(&self, id: VariableId) -> &'s [TypeId] {
        &self.declared[id.index()].types
    }

    /// Keeps a name from all that is bound from now on.
    pub(super) fn reserve(&mut self, name: &str) {
        self.visible.insert(name.to_ascii_lowercase());
    }

    /// Gives a variable a name that is reserved.
    pub(super) fn call(&mut self, id: VariableId, name: &str) {
        name.clone_into(&mut self.names[id.index()]);
    }

    /// Binds all that have no name yet.
    pub(super) fn bind_rest(&mut self) {
        let nameless: Vec<VariableId> = self.ids().filter(|&id| self.name(id).is_empty()).collect();
        self.bind(&nameless);
    }

    /// Binds variables under their own names where these are free.
    pub(super) fn bind(&mut self, ids: &[VariableId]) -> Hidden {
        let mut hidden = Vec::with_capacity(ids.len());
        for &id in ids {
            let name = self.free(&spelling(&self.declared[id.index()]));
            self.visible.insert(name.to_ascii_lowercase());
            hidden.push((id, std::mem::replace(&mut self.names[id.index()], name)));
        }
        hidden
    }

    /// Ends what [`Self::bind`] began.
    pub(super) fn release(&mut self, hidden: Hidden) {
        for (id, before) in hidden.into_iter().rev() {
            let name = std::mem::replace(&mut self.names[id.index()], before);
            self.visible.remove(&name.to_ascii_lowercase());
        }
    }

    /// The name itself, or one like it that nothing else has.
    fn free(&mut self, name: &str) -> String {
        let key = name.to_ascii_lowercase();
        if !self.visible.contains(&key) {
            return name.to_owned();
        }
        let dash = if name.ends_with(|last: char| last.is_ascii_digit()) { "-" } else { "" };
        let number = self.numbers.entry(key.clone()).or_insert(1);
        loop {
            *number += 1;
            let candidate = format!("{key}{dash}{number}");
            if !self.visible.contains(&candidate) && !self.taken.contains(&candidate) {
                return format!("{name}{dash}{number}");
            }
        }
    }
}

/// The name of a variable with its `?`, which a declaration may lack by mistake.
fn spelling(variable: &Variable) -> String {
    let bare = variable.name.text.trim_start_matches('?');
    if bare.is_empty() { "?x".to_owned() } else { format!("?{bare}") }
}
