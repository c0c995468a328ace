//! What was said about a domain and a problem of it go in; by how much an unused parameter multiplies the ground actions is said as well.

use hashbrown::HashMap;

use super::task::extents;
use crate::diagnostic::{Diagnostics, unused_parameter};
use crate::model::{Domain, Problem, Variable};
use crate::source::Span;

/// Completes the help of each `unused-parameter` with the number of objects that may stand for it in `problem`.
pub fn tell(found: &mut Diagnostics, domain: &Domain, problem: &Problem) {
    let mut parameters: HashMap<Span, &Variable> = HashMap::new();
    for action in &domain.actions {
        for parameter in &action.scope.variables[..action.scope.parameters as usize] {
            parameters.insert(parameter.name.span, parameter);
        }
    }
    let extents = extents(domain, problem);
    for one in &mut found.list {
        let unused = one.code == unused_parameter::RULE.code;
        let Some(parameter) = parameters.get(&one.primary.span).filter(|_| unused) else {
            continue;
        };
        let count = match parameter.types.as_slice() {
            [only] => extents[only.index()],
            types => {
                let fit = problem.objects.iter().filter(|object| domain.has_type(object, types));
                fit.count() as u64
            }
        };
        unused_parameter::tell_factor(one, count, &problem.name.text);
    }
}

#[cfg(test)]
mod tests {
    use super::tell;
    use crate::source::Sources;

    #[test]
    fn as_many_as_there_are_objects() {
        let mut sources = Sources::default();
        let domain = sources.add(
            "domain.pddl",
            "(define (domain d) (:requirements :typing) (:types cup plate - dish box - object)
  (:constants mug - cup) (:predicates (lit))
  (:action a :parameters (?x - dish ?y - (either cup box) ?z) :effect (lit)))",
        );
        let problem = sources.add(
            "problem.pddl",
            "(define (problem p) (:domain d) (:objects a b - plate c - box) (:init) (:goal (lit)))",
        );
        let (domain, mut found) = crate::read_domain(&sources, domain);
        let (problem, _) = crate::read_problem(&sources, problem, &domain);
        tell(&mut found, &domain, &problem);
        let told: Vec<&str> = found
            .list
            .iter()
            .map(|one| one.help.as_deref().expect("there is help for each"))
            .map(|help| help.split("(here ").nth(1).expect("the number of objects is told"))
            .collect();
        let in_problem = |count| format!("{count}, in problem `p`)");
        assert_eq!(told, [in_problem(3), in_problem(2), in_problem(4)]);
    }
}
