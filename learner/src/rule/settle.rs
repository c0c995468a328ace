//! Evidence goes in; for each literal whether it is an effect, is none, or remains open, comes out.
//!
//! Clauses are resolved by unit propagation: what is not an effect drops out of them, and what is left alone is one.

use super::evidence::{Claim, Clause, Count, Evidence, LiteralId};

/// What is known of a possible effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    Open,
    Yes,
    No,
}

/// An effect that was seen, and seen not to come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Contradiction {
    pub(super) literal: LiteralId,
    pub(super) positive: bool,
    /// In how many examples it came.
    pub(super) happened: u32,
    /// In how many it would have had to come and did not.
    pub(super) failed: u32,
}

/// What is known of all literals.
#[derive(Debug, Clone)]
pub(super) struct Settled {
    pub(super) adds: Vec<Status>,
    pub(super) deletes: Vec<Status>,
    pub(super) contradictions: Vec<Contradiction>,
    /// The clauses that are not resolved: two at least of their literals are open, and none is an effect.
    pub(super) open: Vec<Clause>,
}

/// Settles what can be settled. In each contradiction the majority counts; it is none if the minority is within the tolerance.
pub(super) fn settle(evidence: &Evidence, tolerance: f64) -> Settled {
    let mut settled = Settled {
        adds: Vec::new(),
        deletes: Vec::new(),
        contradictions: Vec::new(),
        open: Vec::new(),
    };
    for record in &evidence.records {
        for (at, count) in record.counts.iter().enumerate() {
            let literal = LiteralId(record.first + at as u32);
            let Count { added, deleted, unadded, undeleted, .. } = *count;
            let adds = settled.vote(literal, true, [added, unadded], tolerance);
            settled.adds.push(adds);
            let deletes = settled.vote(literal, false, [deleted, undeleted], tolerance);
            settled.deletes.push(deletes);
        }
    }
    for at in 0..settled.adds.len() {
        settled.exclude(LiteralId(at as u32));
    }
    let mut waiting: Vec<(Clause, u32)> = evidence
        .clauses
        .iter()
        .map(|(clause, weight)| (sharpened(evidence, clause), *weight))
        .collect();
    loop {
        let before = waiting.len();
        waiting.retain_mut(|(clause, weight)| !settled.resolve(clause, *weight));
        if waiting.len() == before {
            break;
        }
    }
    settled.open = waiting.into_iter().map(|(clause, _)| clause).collect();
    settled
}

/// The clause; where something of what is kept is surely deleted, it says that something is added.
fn sharpened(evidence: &Evidence, clause: &Clause) -> Clause {
    let within = |other: &Clause| other.literals.iter().all(|one| clause.literals.contains(one));
    let mut deleting = evidence.clauses.keys().filter(|other| other.claim == Claim::Deletes);
    let added = clause.claim == Claim::Keeps && deleting.any(within);
    Clause { claim: if added { Claim::Adds } else { clause.claim }, ..clause.clone() }
}

impl Settled {
    fn vote(
        &mut self,
        literal: LiteralId,
        positive: bool,
        [happened, failed]: [u32; 2],
        tolerance: f64,
    ) -> Status {
        match (happened, failed) {
            (0, 0) => Status::Open,
            (_, 0) => Status::Yes,
            (0, _) => Status::No,
            _ => {
                let share = f64::from(happened.min(failed)) / f64::from(happened + failed);
                if share > tolerance {
                    self.contradictions.push(Contradiction { literal, positive, happened, failed });
                }
                if happened > failed { Status::Yes } else { Status::No }
            }
        }
    }

    /// What is added is not deleted, or it makes no difference; and the other way round.
    fn exclude(&mut self, literal: LiteralId) {
        let at = literal.index();
        if self.adds[at] == Status::Yes {
            self.deletes[at] = Status::No;
        } else if self.deletes[at] == Status::Yes {
            self.adds[at] = Status::No;
        }
    }

    fn set(&mut self, claim: Claim, literal: LiteralId, status: Status) {
        let list = if claim == Claim::Adds { &mut self.adds } else { &mut self.deletes };
        list[literal.index()] = status;
        self.exclude(literal);
    }

    /// Draws what follows from a clause; says whether nothing more can.
    fn resolve(&mut self, clause: &mut Clause, weight: u32) -> bool {
        let gone = |literal: &LiteralId| self.deletes[literal.index()] == Status::Yes;
        if clause.claim == Claim::Keeps && clause.literals.iter().any(gone) {
            clause.claim = Claim::Adds;
        }
        if clause.claim == Claim::Keeps {
            return self.keep(clause);
        }
        let list = if clause.claim == Claim::Adds { &self.adds } else { &self.deletes };
        let status = |literal: &LiteralId| list[literal.index()];
        if clause.literals.iter().any(|literal| status(literal) == Status::Yes) {
            return true;
        }
        let mut open = clause.literals.iter().filter(|literal| status(literal) == Status::Open);
        match (open.next(), open.next()) {
            (None, _) => {
                let positive = clause.claim == Claim::Adds;
                let wrong = clause.literals.iter().map(|&literal| {
                    let failed = weight;
                    Contradiction { literal, positive, happened: weight, failed }
                });
                self.contradictions.extend(wrong);
                true
            }
            (Some(&only), None) => {
                self.set(clause.claim, only, Status::Yes);
                true
            }
            _ => false,
        }
    }

    /// One is added, or none is deleted; none of them is known to be deleted.
    fn keep(&mut self, clause: &Clause) -> bool {
        let literals = &clause.literals;
        let any = |list: &[Status], wanted: Status| {
            literals.iter().any(|literal| list[literal.index()] == wanted)
        };
        if any(&self.adds, Status::Yes) {
            return true;
        }
        if !any(&self.adds, Status::Open) {
            for &literal in literals {
                if self.deletes[literal.index()] == Status::Open {
                    self.set(Claim::Deletes, literal, Status::No);
                }
            }
            return true;
        }
        !any(&self.deletes, Status::Open)
    }
}
