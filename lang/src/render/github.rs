//! Diagnostics go in; the commands come out by which a GitHub workflow marks lines of a change.

use std::fmt::Write;

use super::{Lines, word};
use crate::diagnostic::Diagnostics;
use crate::source::Sources;

/// One line for each: `::error file=…,line=…,endLine=…,col=…,endColumn=…,title=…::message`.
pub fn github(diagnostics: &Diagnostics, sources: &Sources) -> String {
    let mut lines = Lines::default();
    let mut out = String::new();
    for one in &diagnostics.list {
        let span = one.primary.span;
        let [start, end] = lines.ends(sources, span);
        let file = property(&sources.get(span.source).name);
        let title = property(&format!("{} {}", one.code, one.name));
        let mut message = one.message.clone();
        for label in &one.secondary {
            let [(line, column), _] = lines.ends(sources, label.span);
            let name = &sources.get(label.span.source).name;
            write!(message, "\n{name}:{line}:{column}: {}", label.text)
                .expect("writing to a string cannot fail");
        }
        if let Some(help) = &one.help {
            write!(message, "\nhelp: {help}").expect("writing to a string cannot fail");
        }
        // The last column is part of what is marked there, and columns count within one line only.
        let last = if start.0 == end.0 { end.1.max(start.1 + 1) - 1 } else { start.1 };
        writeln!(
            out,
            "::{} file={file},line={},endLine={},col={},endColumn={last},title={title}::{}",
            word(one.severity),
            start.0,
            end.0,
            start.1,
            data(&message)
        )
        .expect("writing to a string cannot fail");
    }
    out
}

/// A message, in which only these characters have a meaning.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a property, which ends at a comma.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
