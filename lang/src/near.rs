//! A misspelt word and the words that exist go in; the one that was probably meant comes out.

/// How many single letters may differ, be missing, be too many or have changed places.
const DISTANCE: usize = 2;

/// The candidate that is nearest to `word` without case, the first of several.
///
/// A candidate of which more than half would have to change is no likely meaning of a short word.
pub fn nearest<'s>(word: &str, candidates: impl IntoIterator<Item = &'s str>) -> Option<&'s str> {
    let lower = word.to_ascii_lowercase();
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        if candidate.len().abs_diff(word.len()) > DISTANCE {
            continue;
        }
        let distance = strsim::osa_distance(&lower, &candidate.to_ascii_lowercase());
        let close = distance <= DISTANCE && distance * 2 <= candidate.len().max(word.len());
        if close && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}
