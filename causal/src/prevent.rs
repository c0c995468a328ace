//! What is going to be done goes in; whether it will do, and if not what to do instead, comes out (thesis algorithm 3).
//!
//! What has been done already is known and not free, whether its effects show now or later (timely shifted failures): a question whose
//! goal is the last outcome of a chain is asked before each of its actions, with ever fewer variables that are free.

use crate::contrast::{Answer, Contrast, ContrastError, Question, contrast, corrected};
use crate::situation::Situation;

/// What to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Prevention {
    /// What was meant: success is likely enough. Its probability.
    Keep(f64),
    /// Something else, with the situation in which it is done.
    Correct {
        /// The probability of success of what was meant; none where it is not known.
        before: Option<f64>,
        /// What is changed.
        answer: Answer,
        /// All values, with the middle of the new interval for what is changed, or the whole centroid of a series.
        situation: Situation,
    },
    /// Nothing that may be changed makes success likely.
    Hopeless(Contrast),
}

/// Says what to do. What is meant is kept where the probability of success is not below `enough`; a correction must exceed the threshold
/// of the question. In algorithm 3 both are one number. A greater threshold leads further away from what is doubtful than just beyond
/// its border. Among the nearest corrections the one with the most probable success is taken.
pub fn prevent(question: &Question, enough: f64) -> Result<Prevention, ContrastError> {
    if let Some(probability) = crate::contrast::probability(question)?
        && probability >= enough
    {
        return Ok(Prevention::Keep(probability));
    }
    let found = contrast(question)?;
    let Some(answer) = found.answers.first().cloned() else {
        return Ok(Prevention::Hopeless(found));
    };
    let situation = corrected(question.network, question.situation, &answer.changes);
    Ok(Prevention::Correct { before: found.before, answer, situation })
}
