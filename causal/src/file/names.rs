//! Names go in; names that every reader of BIF takes come out: letters, digits and underscores, a letter first, none twice.

/// Names for all of some, in their order.
pub fn plain<'a>(names: impl IntoIterator<Item = &'a str>, first: char) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    for name in names {
        let mut plain: String =
            name.chars().map(|one| if one.is_ascii_alphanumeric() { one } else { '_' }).collect();
        if !plain.starts_with(|one: char| one.is_ascii_alphabetic()) {
            plain.insert(0, first);
        }
        let mut unique = plain.clone();
        let mut number = 2;
        while taken.contains(&unique) {
            unique = format!("{plain}_{number}");
            number += 1;
        }
        taken.push(unique);
    }
    taken
}

#[cfg(test)]
mod tests {
    #[test]
    fn names_are_plain_and_differ() {
        assert_eq!(
            super::plain(["a-b", "a b", "<5", "5", "ok"], 's'),
            ["a_b", "a_b_2", "s_5", "s5", "ok"]
        );
    }
}
