//! A cursor in a text goes in; the parameters come out of what is being applied there, and which of them is next.

use super::context::{Context, Part};
use super::{Workspace, words};
use crate::source::SourceId;

/// The parameters of a predicate, a function, an action or a task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// `(at ?t - truck ?p - place)`.
    pub label: String,
    /// The bytes of the label at which each parameter stands.
    pub parameters: Vec<(u32, u32)>,
    /// The parameter at the cursor.
    pub active: u32,
}

/// What is being applied at `offset`.
pub fn signature(workspace: &Workspace, id: SourceId, offset: u32) -> Option<Signature> {
    let context = Context::new(workspace, id, offset)?;
    let parts = context.parts();
    let level = context.levels.len().checked_sub(1)?;
    let written = context.written(level);
    let inside = context.part();
    if written == 0 || !matches!(inside, Part::Argument(_) | Part::Typed) || inside == Part::Typed {
        return None;
    }
    let (name, parameters) = context.callee(level, parts[level])?;
    let domain = context.domain();
    let mut label = format!("({name}");
    let mut places = Vec::new();
    for parameter in parameters {
        label.push(' ');
        let start = label.len() as u32;
        label.push_str(&words::variable(domain, parameter));
        places.push((start, label.len() as u32));
    }
    label.push(')');
    Some(Signature { label, parameters: places, active: written as u32 - 1 })
}

#[cfg(test)]
mod tests {
    use super::signature;
    use crate::ide::fixture::{DOMAIN, PROBLEM, workspace};

    #[track_caller]
    fn shown(texts: &[&str]) -> Option<(String, u32)> {
        let (workspace, id, offset) = workspace(texts);
        signature(&workspace, id, offset).map(|found| (found.label, found.active))
    }

    const AT: &str = "(at ?d - dish ?p - place)";

    #[test]
    fn atoms_wherever_they_stand() {
        let text = DOMAIN.replace("(at ?d ?from)\n", "(at ?d $0?from)\n");
        assert_eq!(shown(&[&text]), Some((AT.to_owned(), 1)));
        let text = DOMAIN.replace("(not (at ?d ?from))", "(not (at $0");
        assert_eq!(shown(&[&text]), Some((AT.to_owned(), 0)));
        let text = PROBLEM.replace("(at mug shelf)", "(at mug $0)");
        assert_eq!(shown(&[DOMAIN, &text]), Some((AT.to_owned(), 1)));
        let text = PROBLEM.replace("(effort mug)", "(effort $0");
        assert_eq!(shown(&[DOMAIN, &text]), Some(("(effort ?d - dish)".to_owned(), 0)));
    }

    #[test]
    fn actions_in_plans() {
        let plan = "(wash mug)\n(move mug $0)\n";
        let label = "(move ?d - dish ?from - place ?to - place)";
        assert_eq!(shown(&[DOMAIN, PROBLEM, plan]), Some((label.to_owned(), 1)));
    }

    #[test]
    fn nothing_where_nothing_is_applied() {
        for old in ["(at ?d - $0dish ?p - place)", "(at $0?d - dish ?p - place)"] {
            assert_eq!(shown(&[&DOMAIN.replace("(at ?d - dish ?p - place)", old)]), None);
        }
        assert_eq!(shown(&[&DOMAIN.replace("(and (clean", "(and $0(clean")]), None);
        assert_eq!(shown(&[&DOMAIN.replace("; Water", "; (at $0")]), None);
    }
}
