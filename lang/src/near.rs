//! A misspelt word and the words that exist go in; the one that was probably meant comes out.

/// How many single letters may differ, be missing, be too many or have changed places.
const DISTANCE: usize = 2;

/// The candidate that is nearest to `word` without case; of several one with the same digits, and of those the first.
///
/// A candidate of which more than half would have to change is no likely meaning of a short word.
/// Digits count among names: `room12` and `room13` are two rooms, and neither is a slip of the other.
pub fn nearest<'s>(word: &str, candidates: impl IntoIterator<Item = &'s str>) -> Option<&'s str> {
    let lower = word.to_ascii_lowercase();
    let mut best: Option<((usize, bool), &str)> = None;
    for candidate in candidates {
        if candidate.len().abs_diff(word.len()) > DISTANCE {
            continue;
        }
        let distance = strsim::osa_distance(&lower, &candidate.to_ascii_lowercase());
        if distance > DISTANCE || distance * 2 > candidate.len().max(word.len()) {
            continue;
        }
        let rank = (distance, !digits(word).eq(digits(candidate)));
        if best.is_none_or(|(least, _)| rank < least) {
            best = Some((rank, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// How a message about `word` ends: with the candidate that is nearest to it, as `; did you mean `clean`?`, or with nothing.
pub fn did_you_mean<'s>(word: &str, candidates: impl IntoIterator<Item = &'s str>) -> String {
    nearest(word, candidates).map_or_else(String::new, |near| format!("; did you mean `{near}`?"))
}

fn digits(word: &str) -> impl Iterator<Item = u8> + '_ {
    word.bytes().filter(u8::is_ascii_digit)
}

#[cfg(test)]
mod tests {
    use super::{did_you_mean, nearest};

    #[test]
    fn a_slip_of_a_letter_or_two() {
        for slip in ["claen", "clen", "cleean", "cleam", "CLEN", "cln"] {
            assert_eq!(nearest(slip, ["dirty", "clean", "in"]), Some("clean"), "{slip}");
        }
    }

    #[test]
    fn a_message_ends_with_it_or_as_it_is() {
        assert_eq!(did_you_mean("claen", ["clean"]), "; did you mean `clean`?");
        assert_eq!(did_you_mean("claen", ["dirty"]), "");
    }

    #[test]
    fn nothing_of_what_is_too_far() {
        assert_eq!(nearest("washed", ["dirty", "clean"]), None);
        assert_eq!(nearest("x", ["y", "z"]), None);
        assert_eq!(nearest("clean", []), None);
    }

    #[test]
    fn of_equals_the_one_with_the_same_digits() {
        assert_eq!(nearest("rom2", ["room", "room1", "room2"]), Some("room2"));
        assert_eq!(nearest("hear2", ["heart", "heart2"]), Some("heart2"));
        assert_eq!(nearest("room", ["room1", "room2"]), Some("room1"));
    }
}
