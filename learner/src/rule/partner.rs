//! Effects that always came while another agent acted on the same things go in; the actions that must be taken together come out.

use std::collections::BTreeMap;

use lang::model::{ActionId, Atom, Term};

use super::evidence::{Claim, Clause, Evidence, LiteralId, Record};
use super::settle::{Settled, Status};
use super::{Company, Partner};

/// The partners of an action, and for each of its atoms whether it is an effect together with them.
///
/// A partner is demanded for an effect, sure or possible, that never came without another part that could have had it.
/// Of several such parts the one that was there most often is demanded; in that company the effect always came.
pub(super) fn partners(
    evidence: &Evidence,
    settled: &Settled,
    record: &Record,
    company: Company,
) -> (Vec<Partner>, Vec<bool>) {
    let mut partners: Vec<Partner> = Vec::new();
    let mut shared = vec![false; record.atoms.len()];
    for (at, own) in record.atoms.iter().enumerate() {
        let literal = LiteralId(record.first + at as u32);
        // Where no other part can have had the effect, it is enough that another was about the same things.
        let near = company == Company::Together && record.counts[at].apart == 0;
        let ties = evidence.company.get(&literal).filter(|_| record.counts[at].alone == 0);
        let ties = ties.or_else(|| evidence.contact.get(&literal).filter(|_| near));
        let Some(ties) = ties else { continue };
        let (adds, deletes) = (settled.adds[literal.index()], settled.deletes[literal.index()]);
        if adds == Status::No && deletes == Status::No {
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
        let sure = adds == Status::Yes || deletes == Status::Yes;
        if !sure && !explained(evidence, settled, (literal, own), (action, &arguments)) {
            continue;
        }
        shared[at] = true;
        let agrees = |partner: &&mut Partner| {
            let mut pairs = partner.arguments.iter().zip(&arguments);
            partner.action == action
                && pairs.all(|(one, other)| one.is_none() || other.is_none() || one == other)
        };
        match partners.iter_mut().find(agrees) {
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

/// Whether a change is sure to come in company of a partner: nothing but the literal and the partner can be the cause, and both mean the same fact.
fn explained(
    evidence: &Evidence,
    settled: &Settled,
    (literal, own): (LiteralId, &Atom),
    (action, arguments): (ActionId, &[Option<Term>]),
) -> bool {
    let cause = |clause: &Clause, other: LiteralId| {
        let list = if clause.claim == Claim::Adds { &settled.adds } else { &settled.deletes };
        if other == literal || list[other.index()] == Status::No {
            return true;
        }
        let (of, at) = evidence.literal(other);
        let image =
            evidence.records[of.index()].atoms[at].arguments.iter().map(|term| match term {
                Term::Variable(id) => arguments[id.index()],
                Term::Object(_) => Some(*term),
            });
        let predicate = evidence.records[of.index()].atoms[at].predicate;
        of == action
            && evidence.literal(literal).0 != action
            && predicate == own.predicate
            && image.collect::<Option<Vec<Term>>>().as_ref() == Some(&own.arguments)
    };
    settled.open.iter().any(|clause| {
        clause.claim != Claim::Keeps
            && clause.literals.contains(&literal)
            && clause.literals.iter().all(|other| cause(clause, *other))
    })
}
