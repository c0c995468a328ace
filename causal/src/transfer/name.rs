//! Names of variables go in; their words come out, and how alike two names are.
//!
//! `xOff_2` is the words `x` and `off` and the number 2. A word that many variables share says little about each of them: it weighs as
//! much less as it is common.

use std::collections::BTreeMap;

/// As much alike as two words must be to count as one that is spelled in two ways.
const SPELLING: f64 = 0.75;

/// What the beginning of a longer word counts: `cont` for `container`.
const BEGINNING: f64 = 0.85;

/// A name in its parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Name {
    /// Its words in lower case.
    pub words: Vec<String>,
    /// The number at its end.
    pub number: Option<u32>,
}

impl Name {
    /// Takes a name to pieces: at `_`, `-`, spaces and other signs, before capitals, and between letters and digits.
    pub fn of(name: &str) -> Self {
        let mut words: Vec<String> = Vec::new();
        let mut before: Option<char> = None;
        for letter in name.chars() {
            if letter.is_alphanumeric() {
                let begins = before.is_none_or(|before| {
                    !before.is_alphanumeric()
                        || (letter.is_uppercase() && !before.is_uppercase())
                        || letter.is_numeric() != before.is_numeric()
                });
                if begins {
                    words.push(String::new());
                }
                words.last_mut().expect("a word has begun").extend(letter.to_lowercase());
            }
            before = Some(letter);
        }
        let number = words.last().and_then(|last| last.parse().ok());
        if number.is_some() && words.len() > 1 {
            words.pop();
            return Self { words, number };
        }
        Self { words, number: None }
    }

    /// The words of one letter, in the order of the alphabet.
    fn letters(&self) -> Vec<&str> {
        let mut letters: Vec<&str> = self
            .words
            .iter()
            .map(String::as_str)
            .filter(|word| word.chars().count() == 1)
            .collect();
        letters.sort_unstable();
        letters
    }
}

/// What each word of the names of two networks weighs.
#[derive(Debug, Clone, Default)]
pub(super) struct Weights(BTreeMap<String, f64>);

impl Weights {
    /// Weighs the words of two lists of names: one over the number of names of a list that have it, numbers at their ends aside.
    pub fn of(lists: [&[Name]; 2]) -> Self {
        let mut most: BTreeMap<String, usize> = BTreeMap::new();
        for list in lists {
            let mut bases: Vec<&[String]> = list.iter().map(|name| &name.words[..]).collect();
            bases.sort_unstable();
            bases.dedup();
            let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
            for base in bases {
                let mut words: Vec<&str> = base.iter().map(String::as_str).collect();
                words.sort_unstable();
                words.dedup();
                for word in words {
                    *counts.entry(word).or_default() += 1;
                }
            }
            for (word, count) in counts {
                let known = most.entry(word.to_owned()).or_default();
                *known = (*known).max(count);
            }
        }
        Self(most.into_iter().map(|(word, count)| (word, 1.0 / count as f64)).collect())
    }

    fn weight(&self, word: &str) -> f64 {
        self.0.get(word).copied().unwrap_or(1.0)
    }

    /// How alike two names are, numbers at their ends aside, from 0 to 1: the weight of the words that have one like them in the other
    /// name, of that of all words (Dice's coefficient). A single letter names an axis: names with different ones are not alike at all.
    pub fn alike(&self, one: &Name, other: &Name) -> f64 {
        let (axes, other_axes) = (one.letters(), other.letters());
        if !axes.is_empty() && !other_axes.is_empty() && axes != other_axes {
            return 0.0;
        }
        let found = |from: &Name, to: &Name| -> f64 {
            from.words
                .iter()
                .map(|word| {
                    let best = to.words.iter().map(|other| spelled(word, other));
                    self.weight(word) * best.fold(0.0, f64::max)
                })
                .sum()
        };
        let all = |name: &Name| name.words.iter().map(|word| self.weight(word)).sum::<f64>();
        let whole = all(one) + all(other);
        if whole > 0.0 { (found(one, other) + found(other, one)) / whole } else { 0.0 }
    }
}

/// How alike two words are. Single letters and numbers are alike only where they are one: `x` is not `y`.
fn spelled(one: &str, other: &str) -> f64 {
    if one == other {
        return 1.0;
    }
    let short = one.chars().count().min(other.chars().count());
    if short < 2 || one.parse::<u32>().is_ok() {
        return 0.0;
    }
    if short >= 3 && (one.starts_with(other) || other.starts_with(one)) {
        return BEGINNING;
    }
    let alike = strsim::normalized_damerau_levenshtein(one, other);
    if alike >= SPELLING { alike } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_words_and_a_number() {
        let name = |words: &[&str], number| Name {
            words: words.iter().map(|word| (*word).to_owned()).collect(),
            number,
        };
        for same in ["xOff_2", "x_off2", "X-Off 2", "xOff2"] {
            assert_eq!(Name::of(same), name(&["x", "off"], Some(2)), "{same}");
        }
        assert_eq!(Name::of("containerHeight"), name(&["container", "height"], None));
        assert_eq!(Name::of("pos3D"), name(&["pos", "3", "d"], None));
        assert_eq!(Name::of("7"), name(&["7"], None));
    }

    #[test]
    fn common_words_say_little() {
        let names = ["xOff", "yOff", "dropOff", "container"].map(Name::of);
        let others = ["xOff_1", "xOff_2", "offset_x", "dropHeight", "contSize"].map(Name::of);
        let weights = Weights::of([&names, &others]);
        let alike = |one: usize, other: usize| weights.alike(&names[one], &others[other]);
        assert!((alike(0, 1) - 1.0).abs() < 1e-12, "the number does not count");
        assert!(alike(0, 2) > 0.9, "another order, and `off` for `offset`");
        assert!(alike(1, 1).abs() < 1e-12, "`y` is not `x`");
        assert!(alike(2, 1) < 0.35, "`off` is common");
        assert!(alike(2, 3) > 0.5 && alike(2, 3) < 0.7, "`drop` is not common");
        assert!(alike(3, 4) > 0.5);
    }
}
