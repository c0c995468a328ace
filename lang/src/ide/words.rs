//! Declared things go in; the text by which an editor shows them comes out.

use std::fmt::Write;

use crate::model::{Domain, TypeId, Variable};

/// `block`, `(either a b)`, `object`.
pub(super) fn types(domain: &Domain, types: &[TypeId]) -> String {
    let name = |id: &TypeId| domain.types[id.index()].name.text.as_str();
    match types {
        [] => "object".to_owned(),
        [one] => name(one).to_owned(),
        several => format!("(either {})", several.iter().map(name).collect::<Vec<_>>().join(" ")),
    }
}

/// `?a - block`, or `?a` where nothing is known of its type.
pub(super) fn variable(domain: &Domain, variable: &Variable) -> String {
    let untyped = variable.types.is_empty() || variable.types == [TypeId(0)];
    if untyped && domain.types.len() <= 1 {
        return variable.name.text.clone();
    }
    format!("{} - {}", variable.name.text, types(domain, &variable.types))
}

/// `(at ?t - truck ?p - place)`.
pub(super) fn head(domain: &Domain, name: &str, parameters: &[Variable]) -> String {
    let mut text = format!("({name}");
    for parameter in parameters {
        text.push(' ');
        text.push_str(&variable(domain, parameter));
    }
    text.push(')');
    text
}

/// `3 objects`.
pub(super) fn count(number: usize, one: &str) -> String {
    format!("{number} {one}{}", if number == 1 { "" } else { "s" })
}

/// `` `a`, `b` and 3 more ``.
pub(super) fn listed<'s>(names: impl IntoIterator<Item = &'s str>) -> String {
    let names: Vec<&str> = names.into_iter().collect();
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    let mut text = shown.join(", ");
    if names.len() > SHOWN {
        write!(text, " and {} more", names.len() - SHOWN).expect("a string takes all");
    }
    text
}

/// Of more names than this, so many are shown.
const SHOWN: usize = 12;
