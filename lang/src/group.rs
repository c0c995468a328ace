//! Annotations go in; the groups of atoms that they declare come out: `(:exactly-one (open ?d) (closed ?d))`, `(:at-most-one …)`.

use crate::annotation::{Annotation, Expression, ItemId};
use crate::diagnostic::{Diagnostic, malformed_annotation};
use crate::model::{Atom, Domain, ObjectId, PredicateId, Problem, Term, VariableId};
use crate::near::nearest;
use crate::source::Span;

/// Atoms of which at most one, or exactly one, holds in every state.
///
/// Variables that all atoms share are parameters: there is a group for each binding of them. All others are counted: whatever stands there is in the same group.
/// Of a single atom the last variable is counted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// The atoms; their variables are numbered alike.
    pub atoms: Vec<Atom>,
    /// Whether one of them holds in every state.
    pub exactly: bool,
    /// Where it is declared.
    pub span: Span,
}

impl Group {
    /// The variables that are parameters.
    pub fn parameters(&self) -> Vec<VariableId> {
        let of = |atom: &Atom| -> Vec<VariableId> {
            let variable = |term: &Term| match term {
                Term::Variable(variable) => Some(*variable),
                Term::Object(_) => None,
            };
            atom.arguments.iter().filter_map(variable).collect()
        };
        let Some(first) = self.atoms.first() else { return Vec::new() };
        let mut shared = of(first);
        if self.atoms.len() == 1 {
            shared.pop();
        }
        shared.retain(|variable| self.atoms.iter().all(|atom| of(atom).contains(variable)));
        shared.sort_unstable();
        shared.dedup();
        shared
    }

    /// The values of the parameters where an atom of the group has these arguments; none where it cannot have them.
    pub fn key(&self, atom: &Atom, arguments: &[ObjectId]) -> Option<Vec<ObjectId>> {
        let mut bound: Vec<(VariableId, ObjectId)> = Vec::new();
        for (&term, &object) in atom.arguments.iter().zip(arguments) {
            match term {
                Term::Object(constant) if constant == object => {}
                Term::Object(_) => return None,
                Term::Variable(variable) => match bound.iter().find(|(one, _)| *one == variable) {
                    Some(&(_, other)) if other == object => {}
                    Some(_) => return None,
                    None => bound.push((variable, object)),
                },
            }
        }
        let value = |parameter: &VariableId| {
            bound.iter().find(|(one, _)| one == parameter).map(|&(_, object)| object)
        };
        self.parameters().iter().map(value).collect()
    }
}

/// The groups that `annotations` declare. Objects may be named where there is a problem, constants of the domain anywhere; what is wrong is left out
/// ([`wrong`] says what it is).
pub fn groups(
    annotations: &[Annotation],
    domain: &Domain,
    problem: Option<&Problem>,
) -> Vec<Group> {
    let declared = annotations.iter().filter_map(|annotation| {
        let exactly = match annotation.kind?.name {
            ":exactly-one" => true,
            ":at-most-one" => false,
            _ => return None,
        };
        let mut names = Vec::new();
        let expression = &annotation.expression;
        let atoms = expression
            .children(Expression::ROOT)
            .skip(1)
            .map(|part| atom(expression, part, domain, problem, &mut names).ok())
            .collect::<Option<Vec<Atom>>>()?;
        Some(Group { atoms, exactly, span: expression.span(Expression::ROOT) })
    });
    declared.collect()
}

/// What is wrong with the atoms of an annotation that declares a group.
pub(crate) fn wrong(
    annotation: &Annotation,
    domain: &Domain,
    problem: Option<&Problem>,
) -> Vec<Diagnostic> {
    let expression = &annotation.expression;
    let parts = expression.children(Expression::ROOT).skip(1);
    let mut names = Vec::new();
    let wrong = |part| atom(expression, part, domain, problem, &mut names).err();
    parts.filter_map(wrong).map(|diagnostic| *diagnostic).collect()
}

/// Resolves an atom; `names` are the variables met so far.
fn atom(
    expression: &Expression,
    part: ItemId,
    domain: &Domain,
    problem: Option<&Problem>,
    names: &mut Vec<String>,
) -> Result<Atom, Box<Diagnostic>> {
    let mut items = expression.children(part);
    let head = items
        .next()
        .ok_or_else(|| Box::new(malformed_annotation::nameless(expression.span(part))))?;
    let name = expression.word(head).unwrap_or_default();
    let known = domain
        .predicates
        .iter()
        .position(|predicate| predicate.name.text.eq_ignore_ascii_case(name));
    let Some(number) = known else {
        let candidates = domain.predicates.iter().map(|predicate| predicate.name.text.as_str());
        let span = expression.span(head);
        let near = nearest(name, candidates);
        return Err(Box::new(malformed_annotation::unknown("predicate", name, span, near)));
    };
    let mut arguments = Vec::new();
    for item in items {
        let word = expression.word(item).unwrap_or_default();
        if word.starts_with('?') {
            let at = names.iter().position(|one| one.eq_ignore_ascii_case(word));
            let at = at.unwrap_or_else(|| {
                names.push(word.to_owned());
                names.len() - 1
            });
            arguments.push(Term::Variable(VariableId(at as u32)));
            continue;
        }
        let objects = problem.map_or(&domain.constants, |problem| &problem.objects);
        let object = objects.iter().position(|object| object.name.text.eq_ignore_ascii_case(word));
        let Some(number) = object else {
            let candidates = objects.iter().map(|object| object.name.text.as_str());
            let (span, near) = (expression.span(item), nearest(word, candidates));
            return Err(Box::new(malformed_annotation::unknown("object", word, span, near)));
        };
        arguments.push(Term::Object(ObjectId(number as u32)));
    }
    let wanted = domain.predicates[number].parameters.len();
    if arguments.len() != wanted {
        let span = expression.span(part);
        let found = arguments.len();
        return Err(Box::new(malformed_annotation::arity(name, wanted, found, span)));
    }
    Ok(Atom { predicate: PredicateId(number as u32), arguments })
}
