//! Names with their types go in; the typed lists of PDDL come out.

use crate::model::{Type, TypeId};

/// A name and its types: of a type, those above it.
pub(super) type Entry<'a> = (&'a str, &'a [TypeId]);

/// The root of all types.
const OBJECT: TypeId = TypeId(0);

/// The groups `a b - TYPE` of a typed list; without types if everything is just an object, unless they must be `explicit`.
pub(super) fn groups(table: &[Type], entries: &[Entry<'_>], explicit: bool) -> Vec<String> {
    let plain = |types: &[TypeId]| types.is_empty() || types == [OBJECT];
    let typed = explicit || entries.iter().any(|(_, types)| !plain(types));
    let group = |group: &[Entry<'_>]| {
        let names: Vec<&str> = group.iter().map(|(name, _)| *name).collect();
        let names = names.join(" ");
        if typed { format!("{names} - {}", reference(table, group[0].1)) } else { names }
    };
    entries.chunk_by(|one, other| one.1 == other.1).map(group).collect()
}

/// What stands after a `-`.
pub(super) fn reference(table: &[Type], types: &[TypeId]) -> String {
    let names: Vec<&str> = types.iter().map(|id| table[id.index()].name.text.as_str()).collect();
    match names.as_slice() {
        [] => table[OBJECT.index()].name.text.clone(),
        [one] => (*one).to_owned(),
        several => format!("(either {})", several.join(" ")),
    }
}
