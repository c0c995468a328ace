//! The lists around a run go in; the [`Place`] where it stands comes out.

use std::fmt;

use super::run::Run;
use crate::tree::{NodeId, Tree};

/// What encloses an annotation. Keywords are in lower case, names as they are written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// No definition: it stands before or after it.
    File,
    /// The definition of a domain, between its sections.
    Domain,
    /// The definition of a problem, between its sections.
    Problem,
    /// A section without a name, such as `:init`.
    Section {
        /// Its keyword.
        keyword: String,
    },
    /// A section with a name, such as an action, between its fields.
    Action {
        /// `:action`, or that of another section with a name.
        keyword: String,
        /// Its name.
        name: String,
    },
    /// A field of a section with a name, such as the precondition of an action.
    Field {
        /// `:action`, or that of another section with a name.
        keyword: String,
        /// Its name.
        name: String,
        /// The keyword of the field.
        field: String,
    },
}

/// The sections that have a name and fields.
const NAMED: [&str; 6] = [":action", ":durative-action", ":process", ":event", ":method", ":task"];

impl Place {
    /// Where a run stands.
    pub(super) fn of(tree: &Tree<'_>, run: &Run) -> Self {
        let lower = |id: NodeId| tree.slice(id).to_ascii_lowercase();
        let word = |id: &NodeId| !tree.is_list(*id);
        let head = |list: NodeId| tree.children(list).next().filter(word).map(lower);
        let [definition, inner @ ..] = run.around.as_slice() else { return Self::File };
        let mut parts = tree.children(*definition);
        if parts.next().filter(word).map(lower).is_none_or(|head| head != "define") {
            return Self::File;
        }
        let title = parts.next().filter(|&title| tree.is_list(title)).and_then(head);
        let (section, inner) = match inner {
            [] if title.as_deref() == Some("problem") => return Self::Problem,
            [] => return Self::Domain,
            [section, inner @ ..] => (*section, inner),
        };
        let keyword = head(section).unwrap_or_default();
        if !NAMED.contains(&keyword.as_str()) {
            return Self::Section { keyword };
        }
        let name = tree.children(section).nth(1).filter(word);
        let name = name.map_or_else(String::new, |name| tree.slice(name).to_owned());
        // What stands between the keyword of a field and its value belongs to the field already.
        let end = inner.first().map_or(run.lines[0], |&value| value);
        let before = tree.children(section).take_while(|&child| child < end).last();
        let field = before.filter(word).map(lower).filter(|field| field.starts_with(':'));
        match field {
            Some(field) if before != tree.children(section).next() => {
                Self::Field { keyword, name, field }
            }
            _ => Self::Action { keyword, name },
        }
    }
}

/// In words, to stand after "in" or "of".
impl fmt::Display for Place {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => out.write_str("no definition"),
            Self::Domain => out.write_str("the domain"),
            Self::Problem => out.write_str("the problem"),
            Self::Section { keyword } if keyword.is_empty() => out.write_str("no section"),
            Self::Section { keyword } => write!(out, "`{keyword}`"),
            Self::Action { keyword, name } => write!(out, "{} `{name}`", plain(keyword)),
            Self::Field { keyword, name, field } => {
                write!(out, "the {} of {} `{name}`", plain(field), plain(keyword))
            }
        }
    }
}

/// A keyword as a word of English: `:durative-action` becomes `durative action`.
fn plain(keyword: &str) -> String {
    keyword.trim_start_matches(':').replace('-', " ")
}
