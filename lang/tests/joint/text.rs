//! The text of a PDDL file goes in; nested lists of lower-case words come out.

use std::collections::BTreeMap;

/// A word or a list.
#[derive(Debug, Clone)]
pub enum Tree {
    Word(String),
    List(Vec<Tree>),
}

/// Names with the types that each may have.
pub type Typed = Vec<(String, Vec<String>)>;

impl Tree {
    /// Reads a text with balanced parentheses that is one list.
    pub fn read(text: &str) -> Self {
        let lines = text.lines().map(|line| line.split(';').next().unwrap_or_default());
        let plain = lines.collect::<Vec<_>>().join("\n").to_lowercase();
        let spaced = plain.replace('(', " ( ").replace(')', " ) ");
        let mut open = vec![Vec::new()];
        for word in spaced.split_whitespace() {
            let closed = match word {
                "(" => {
                    open.push(Vec::new());
                    continue;
                }
                ")" => Self::List(open.pop().expect("something is open")),
                word => Self::Word(word.to_owned()),
            };
            open.last_mut().expect("parentheses are balanced").push(closed);
        }
        open.remove(0).remove(0)
    }

    /// The word; nothing if it is a list.
    pub fn word(&self) -> &str {
        match self {
            Self::Word(word) => word,
            Self::List(_) => "",
        }
    }

    /// The children; none if it is a word.
    pub fn list(&self) -> &[Self] {
        match self {
            Self::Word(_) => &[],
            Self::List(children) => children,
        }
    }

    /// The word that a list opens with; nothing if there is none.
    pub fn head(&self) -> &str {
        self.list().first().map_or("", Self::word)
    }

    /// What follows that word.
    pub fn tail(&self) -> &[Self] {
        self.list().get(1..).unwrap_or_default()
    }
}

/// `a b - t c - (either u v) d`; what has no type is an `object`.
pub fn typed(list: &[Tree]) -> Typed {
    let (mut names, mut done) = (Typed::new(), 0);
    let mut rest = list.iter();
    while let Some(tree) = rest.next() {
        if tree.word() != "-" {
            names.push((tree.word().to_owned(), vec!["object".to_owned()]));
            continue;
        }
        let types = rest.next().expect("a type follows");
        let alternatives = types.tail().iter().map(|tree| tree.word().to_owned()).collect();
        let types = match types {
            Tree::Word(word) => vec![word.clone()],
            Tree::List(_) => alternatives,
        };
        names[done..].iter_mut().for_each(|name| name.1.clone_from(&types));
        done = names.len();
    }
    names
}

/// `:agent ?a - t :parameters (…)` by keyword.
pub fn fields(list: &[Tree]) -> BTreeMap<&str, &[Tree]> {
    let starts: Vec<usize> =
        (0..list.len()).filter(|&at| list[at].word().starts_with(':')).collect();
    let ends = starts.iter().skip(1).copied().chain([list.len()]);
    starts.iter().zip(ends).map(|(&at, end)| (list[at].word(), &list[at + 1..end])).collect()
}
