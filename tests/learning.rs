//! `caveat simulate` and `caveat learn` from the command line to what a person reads: demonstrations in worlds go in; domains, plans that are carried out, and clear refusals come out.

mod answers;
mod lesson;
mod shown;
mod worlds;
mod wrong;

use cli::exit::Exit;

use crate::desk::Desk;

/// A folder with the log of a demonstration in it, called `demo.jsonl`.
#[track_caller]
fn demo(what: &str) -> Desk {
    let desk = Desk::new();
    desk.ends(Exit::Done, &format!("caveat simulate demo {what} -o demo.jsonl"));
    desk
}

/// Keeps what commands print.
fn keep(name: &str, commands: &str, printed: &str) {
    insta::with_settings!({ description => commands, omit_expression => true }, {
        insta::assert_snapshot!(name, printed);
    });
}
