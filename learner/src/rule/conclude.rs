//! Evidence goes in; the learned actions come out, and those that are refused.

use lang::model::{ActionId, Atom};

use super::evidence::{Claim, Evidence, LiteralId, Record};
use super::guard::{Guard, Guarding, Unclear};
use super::settle::{Settled, Status, settle};
use super::{Action, Company, Doubt, Learned, Options, Reason, Refusal, Rule, partner};

/// Draws all conclusions.
pub(super) fn conclude(evidence: &Evidence, options: &Options) -> Learned {
    let settled = settle(evidence, options.tolerance);
    let mut learned = Learned {
        domain: evidence.domain.clone(),
        rule: options.rule,
        actions: Vec::new(),
        refused: Vec::new(),
        strays: evidence.strays,
    };
    for at in 0..evidence.records.len() {
        let action = ActionId(at as u32);
        match one(evidence, &settled, action, options) {
            Ok(action) => learned.actions.push(action),
            Err(reason) => learned.refused.push(Refusal { action, reason }),
        }
    }
    while let Some(at) =
        learned.actions.iter().position(|action| lonely(&learned, action).is_some())
    {
        let action = learned.actions.remove(at);
        if let Some(partner) = lonely(&learned, &action) {
            let reason = Reason::Partner { partner };
            learned.refused.push(Refusal { action: action.action, reason });
        }
    }
    learned
}

/// A partner that an action demands and that is refused.
fn lonely(learned: &Learned, action: &Action) -> Option<ActionId> {
    let refused = |id: &ActionId| learned.refused.iter().any(|refusal| refusal.action == *id);
    action.partners.iter().map(|partner| partner.action).find(refused)
}

fn one(
    evidence: &Evidence,
    settled: &Settled,
    action: ActionId,
    options: &Options,
) -> Result<Action, Reason> {
    let record = &evidence.records[action.index()];
    if record.seen == 0 {
        return Err(Reason::Unseen);
    }
    if record.whole == 0 {
        return Err(Reason::Obscured);
    }
    let lenient = options.rule == Rule::Changed;
    if let Some(reason) = contradicted(record, settled).filter(|_| !lenient) {
        return Err(reason);
    }
    // In so many examples a precondition may have been missing, or something forbidden been there.
    let spared = (options.tolerance * f64::from(record.seen)).floor() as u32;
    let required: Vec<bool> = record
        .counts
        .iter()
        .map(|count| count.held + spared >= record.seen && count.held > 0)
        .collect();
    let absent =
        |at: &usize| options.negative && record.counts[*at].held <= spared && !required[*at];
    let none = || (Vec::new(), vec![false; record.atoms.len()]);
    let (partners, shared) = match options.joint {
        Company::Never => none(),
        company => partner::partners(evidence, settled, record, company),
    };
    let guarding = Guarding {
        evidence,
        settled,
        record,
        action: &evidence.domain.actions[action.index()],
        required: &required,
        strict: options.negative,
        shared: &shared,
    };
    let guard = match guarding.guard() {
        _ if lenient => Guard::default(),
        Ok(guard) => guard,
        Err(unclear) => return Err(reason(evidence, settled, unclear)),
    };
    let status = |list: &[Status], at: usize| list[record.first as usize + at];
    let all = 0..record.atoms.len();
    let pick = |test: &dyn Fn(&usize) -> bool| -> Vec<Atom> {
        all.clone().filter(test).map(|at| record.atoms[at].clone()).collect()
    };
    let adds =
        |at: &usize| effect(status(&settled.adds, *at), shared[*at]) || guard.adds.contains(at);
    let deletes = |at: &usize| {
        !adds(at)
            && (effect(status(&settled.deletes, *at), shared[*at]) || guard.deletes.contains(at))
    };
    let doubt = |at: usize| Doubt {
        atom: record.atoms[at].clone(),
        seen: record.counts[at].held,
        of: record.seen,
        usual: evidence.usual[record.atoms[at].predicate.index()],
    };
    let hand = |at: &usize| options.hand.contains(&record.atoms[*at].predicate);
    let lower = |at: &usize| required[*at] && (deletes(at) || hand(at));
    let doubtful = all.clone().filter(|at| required[*at] && !lower(at));
    Ok(Action {
        action,
        count: record.seen,
        sources: record.sources.clone(),
        required: pick(&|at| required[*at]),
        changed: pick(&lower),
        absent: pick(&|at| absent(at) || guard.absent.contains(at)),
        adds: pick(&adds),
        deletes: pick(&deletes),
        doubts: doubtful.map(doubt).collect(),
        same: guard.same.clone(),
        distinct: guard.distinct.clone(),
        partners,
    })
}

/// Whether something is an effect, perhaps because a partner is demanded.
fn effect(status: Status, shared: bool) -> bool {
    status == Status::Yes || (status == Status::Open && shared)
}

fn contradicted(record: &Record, settled: &Settled) -> Option<Reason> {
    let own = record.first..record.first + record.atoms.len() as u32;
    let found = settled.contradictions.iter().find(|found| own.contains(&found.literal.0))?;
    Some(Reason::Contradicted {
        atom: record.atoms[(found.literal.0 - record.first) as usize].clone(),
        positive: found.positive,
        happened: found.happened,
        failed: found.failed,
    })
}

/// What else may have been the cause of an unclear effect.
fn reason(evidence: &Evidence, settled: &Settled, unclear: Unclear) -> Reason {
    let atom = |literal: LiteralId| {
        let (action, at) = evidence.literal(literal);
        (action, evidence.records[action.index()].atoms[at].clone())
    };
    let positive = unclear.claim == Claim::Adds;
    let list = if positive { &settled.adds } else { &settled.deletes };
    let about = |literals: &[LiteralId]| literals.contains(&unclear.literal);
    let clause =
        settled.open.iter().find(|clause| clause.claim == unclear.claim && about(&clause.literals));
    let others = clause.map(|clause| {
        let others = clause
            .literals
            .iter()
            .filter(|literal| **literal != unclear.literal && list[literal.index()] != Status::No);
        others.map(|literal| atom(*literal)).collect()
    });
    let others = others.unwrap_or_default();
    Reason::Unclear { atom: atom(unclear.literal).1, positive, others }
}
