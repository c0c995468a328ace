//! `caveat explain`: the code or the name of a diagnostic goes in, its page comes out.

use lang::diagnostic;

use crate::args::Explain;
use crate::exit::Exit;
use crate::files::Complaint;
use crate::terminal::Terminal;

/// Prints the page, or all codes with their names where none is asked for.
pub fn run(arguments: &Explain, terminal: &mut Terminal) -> Exit {
    let Some(code) = &arguments.code else {
        for rule in diagnostic::RULES {
            terminal.line(format_args!("{}  {}", rule.code, rule.name));
        }
        return Exit::Done;
    };
    if let Some(page) = diagnostic::explain(code) {
        terminal.line(page.trim_end());
        return Exit::Done;
    }
    let distance =
        |name: &str| strsim::damerau_levenshtein(&code.to_lowercase(), &name.to_lowercase());
    let names = diagnostic::RULES.iter().flat_map(|rule| [rule.code, rule.name]);
    let help = match names.min_by_key(|name| distance(name)).filter(|name| distance(name) <= 2) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "`caveat explain` alone lists all codes".to_string(),
    };
    terminal.say(Complaint::with_help(format!("there is no diagnostic `{code}`"), help));
    Exit::Failed
}
