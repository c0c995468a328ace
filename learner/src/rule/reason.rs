//! Why an action is not learned, as data and in words.

use lang::model::{ActionId, Atom, Domain, Term};

/// An action of which too little is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Which action of the domain.
    pub action: ActionId,
    /// Why.
    pub reason: Reason,
}

/// Why an action is not learned.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reason {
    /// It was never taken.
    Unseen,
    /// Whenever it was taken, something else was done that could not be read.
    Obscured,
    /// It is not clear whether it has an effect, or one of these others has.
    Unclear {
        /// What may be an effect, in the action's parameters.
        atom: Atom,
        /// Whether it would be added; deleted otherwise.
        positive: bool,
        /// Actions, and atoms in their parameters, that may have been the cause instead.
        others: Vec<(ActionId, Atom)>,
    },
    /// It demands another action that is not learned.
    Partner {
        /// The other one.
        partner: ActionId,
    },
    /// An effect came sometimes, and sometimes it did not.
    Contradicted {
        /// What is an effect sometimes, in the action's parameters.
        atom: Atom,
        /// Whether it is added; deleted otherwise.
        positive: bool,
        /// In how many examples it came.
        happened: u32,
        /// In how many it did not.
        failed: u32,
    },
}

impl Refusal {
    /// A sentence about it, in the words of its domain.
    pub fn describe(&self, domain: &Domain) -> String {
        let name = &domain.actions[self.action.index()].name.text;
        let verb = |positive: bool| if positive { "adds" } else { "deletes" };
        match &self.reason {
            Reason::Unseen => format!("`{name}` was never seen"),
            Reason::Obscured => {
                format!(
                    "whenever `{name}` was seen, something else was done that could not be read"
                )
            }
            Reason::Unclear { atom, positive, others } => {
                let what = describe(domain, self.action, atom);
                let verb = verb(*positive);
                if others.is_empty() {
                    return format!("it is not clear whether `{name}` {verb} `{what}`");
                }
                let others: Vec<String> = others
                    .iter()
                    .map(|(action, atom)| {
                        let name = &domain.actions[action.index()].name.text;
                        format!("`{name}` {verb} `{}`", describe(domain, *action, atom))
                    })
                    .collect();
                let others = others.join(" or ");
                format!("it is not clear whether `{name}` {verb} `{what}`, or {others}")
            }
            Reason::Partner { partner } => {
                let partner = &domain.actions[partner.index()].name.text;
                format!("`{name}` was only seen together with `{partner}`, which is left out")
            }
            Reason::Contradicted { atom, positive, happened, failed } => {
                let what = describe(domain, self.action, atom);
                let verb = if *positive { "added" } else { "deleted" };
                format!("`{name}` {verb} `{what}` in {happened} examples and did not in {failed}")
            }
        }
    }
}

/// An atom in the parameters of an action as text.
pub fn describe(domain: &Domain, action: ActionId, atom: &Atom) -> String {
    let mut text = format!("({}", domain.predicates[atom.predicate.index()].name.text);
    for term in &atom.arguments {
        text.push(' ');
        text.push_str(match term {
            Term::Variable(id) => {
                &domain.actions[action.index()].scope.variables[id.index()].name.text
            }
            Term::Object(id) => &domain.constants[id.index()].name.text,
        });
    }
    text.push(')');
    text
}
