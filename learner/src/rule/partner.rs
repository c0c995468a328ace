//! Effects that always came while another agent acted on the same things go in; the actions that must be taken together come out.

use std::collections::BTreeMap;

use lang::model::{ActionId, Term};

use super::evidence::{Evidence, LiteralId, Record};
use super::settle::{Settled, Status};
use super::{Company, Partner};

/// The partners of an action, and for each of its atoms whether it is an effect together with them.
///
/// A partner is demanded for an effect, sure or possible, that never came without another part that could have had it.
/// Of several such parts the one that was there most often is demanded; in that company the effect always came.
pub(super) fn partners(
    evidence: &Evidence,
    settled: &Settled<'_>,
    record: &Record,
    company: Company,
) -> (Vec<Partner>, Vec<bool>) {
    let mut partners: Vec<Partner> = Vec::new();
    let mut shared = vec![false; record.atoms.len()];
    for at in 0..record.atoms.len() {
        let literal = LiteralId(record.first + at as u32);
        // Where no other part can have had the effect, it is enough that another was about the same things.
        let near = company == Company::Together && record.counts[at].apart == 0;
        let ties = evidence.company.get(&literal).filter(|_| record.counts[at].alone == 0);
        let ties = ties.or_else(|| evidence.contact.get(&literal).filter(|_| near));
        let Some(ties) = ties else { continue };
        let is_effect = |list: &[Status]| match list[literal.index()] {
            Status::Yes => true,
            Status::Open => in_open_clause(settled, literal),
            Status::No => false,
        };
        let effect = is_effect(&settled.adds) || is_effect(&settled.deletes);
        if !effect {
            continue;
        }
        let mut others: BTreeMap<ActionId, (u32, Vec<Option<Term>>)> = BTreeMap::new();
        for ((action, arguments), weight) in ties {
            let entry = others.entry(*action).or_insert_with(|| (0, arguments.clone()));
            entry.0 += weight;
            // What was the same object only sometimes is no part of what is demanded.
            for (common, argument) in entry.1.iter_mut().zip(arguments) {
                if common != argument {
                    *common = None;
                }
            }
        }
        let most = others.into_iter().rev().max_by_key(|(_, (weight, _))| *weight);
        let Some((action, (_, arguments))) = most else { continue };
        shared[at] = true;
        match partners.iter_mut().find(|partner| partner.action == action) {
            Some(partner) => {
                for (common, argument) in partner.arguments.iter_mut().zip(arguments) {
                    *common = common.or(argument);
                }
            }
            None => partners.push(Partner { action, arguments }),
        }
    }
    (partners, shared)
}

fn in_open_clause(settled: &Settled<'_>, literal: LiteralId) -> bool {
    settled.open.iter().any(|clause| clause.literals.contains(&literal))
}
