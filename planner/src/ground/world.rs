//! What never changes while grounding: objects by type, and how a static formula is decided.

use lang::model::{Domain, Problem, TypeId};

use super::relation::Relation;
use crate::normal::{Filter, Term, Variable};

/// A set of objects, as bits and as a sorted list.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Objects {
    bits: Vec<u64>,
    /// The members in ascending order.
    pub list: Vec<u32>,
}

impl Objects {
    /// The set of these members, in ascending order, out of `count` objects.
    pub fn new(list: Vec<u32>, count: usize) -> Self {
        let mut bits = vec![0; count.div_ceil(64)];
        for &object in &list {
            bits[object as usize / 64] |= 1 << (object % 64);
        }
        Self { bits, list }
    }

    /// Whether `object` is a member.
    #[inline]
    pub fn contains(&self, object: u32) -> bool {
        self.bits[object as usize / 64] >> (object % 64) & 1 == 1
    }
}

/// The objects of a problem by type.
pub struct World {
    /// How many objects there are.
    pub count: usize,
    by_type: Vec<Vec<u32>>,
}

impl World {
    /// Sorts the objects of `problem` by the types of `domain`.
    pub fn new(domain: &Domain, problem: &Problem) -> Self {
        let mut by_type = vec![Vec::new(); domain.types.len()];
        for (id, object) in problem.objects.iter().enumerate() {
            for above in
                object.types.iter().flat_map(|&TypeId(id)| &domain.types[id as usize].ancestors)
            {
                if by_type[above.index()].last() != Some(&(id as u32)) {
                    by_type[above.index()].push(id as u32);
                }
            }
        }
        Self { count: problem.objects.len(), by_type }
    }

    /// The objects that may stand for `variable`.
    pub fn objects(&self, variable: &Variable) -> Objects {
        let mut list: Vec<u32> = variable
            .types
            .iter()
            .flat_map(|&TypeId(id)| &self.by_type[id as usize])
            .copied()
            .collect();
        list.sort_unstable();
        list.dedup();
        Objects::new(list, self.count)
    }
}

/// The value of `term` under `binding`.
#[inline]
pub fn value(term: Term, binding: &[u32]) -> u32 {
    match term {
        Term::Variable(variable) => binding[variable as usize],
        Term::Object(object) => object.0,
    }
}

/// Decides a static formula whose free variables `binding` binds; `domains` gives the objects for the variables that it binds itself.
pub fn holds(
    filter: &Filter,
    relations: &[Relation],
    domains: &[Objects],
    binding: &mut [u32],
) -> bool {
    match filter {
        Filter::Atom(atom) => {
            let mut row = [0; 16];
            let relation = &relations[atom.predicate.index()];
            if atom.arguments.len() <= row.len() {
                for (slot, &term) in row.iter_mut().zip(&atom.arguments) {
                    *slot = value(term, binding);
                }
                relation.find(&row[..atom.arguments.len()]).is_some()
            } else {
                let row: Vec<u32> =
                    atom.arguments.iter().map(|&term| value(term, binding)).collect();
                relation.find(&row).is_some()
            }
        }
        Filter::Equal(left, right) => value(*left, binding) == value(*right, binding),
        Filter::Not(child) => !holds(child, relations, domains, binding),
        Filter::All(children) => {
            children.iter().all(|child| holds(child, relations, domains, binding))
        }
        Filter::Any(children) => {
            children.iter().any(|child| holds(child, relations, domains, binding))
        }
        Filter::Exists(bound, child) => some(bound, child, true, relations, domains, binding),
        Filter::Forall(bound, child) => !some(bound, child, false, relations, domains, binding),
    }
}

/// Whether for some binding of `bound` the truth of `child` is `wanted`.
fn some(
    bound: &[u32],
    child: &Filter,
    wanted: bool,
    relations: &[Relation],
    domains: &[Objects],
    binding: &mut [u32],
) -> bool {
    let Some((&first, rest)) = bound.split_first() else {
        return holds(child, relations, domains, binding) == wanted;
    };
    domains[first as usize].list.iter().any(|&object| {
        binding[first as usize] = object;
        some(rest, child, wanted, relations, domains, binding)
    })
}
