//! The listings of the thesis that Caveat follows, exactly as they are printed: what is said of each leads to the file that reads well.
//!
//! Chapter 3 prints a kitchen domain and a problem of it, two actions that need each other, and three ways to move.
//! The actions stand there without a domain: `bottle.pddl` and `moves.pddl` are just them, the others have a domain around them.

use std::ffi::OsString;
use std::path::PathBuf;

use cli::exit::Exit;
use cli::terminal::Terminal;

/// What `caveat check` says of one of the listings, with the names of files as they are in the project.
fn check(name: &str) -> (Exit, String) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("listings");
    let file = folder.join(name);
    let arguments = ["caveat", "check"].map(OsString::from).into_iter().chain([file.into()]);
    let (mut data, mut talk) = (Vec::new(), Vec::new());
    let exit = cli::call(arguments, &mut Terminal::new(&mut data, &mut talk));
    let said = String::from_utf8(data).expect("what is said is UTF-8");
    (exit, said.replace(&format!("{}/", folder.display()), ""))
}

#[test]
fn what_is_said_of_them_as_they_are_printed() {
    for name in
        ["kitchen-domain", "kitchen-problem", "bottle", "bottle-domain", "moves", "moves-domain"]
    {
        let (exit, said) = check(&format!("printed/{name}.pddl"));
        assert_eq!(exit, Exit::Findings, "{name}");
        insta::assert_snapshot!(format!("listing {name}"), said);
    }
}

#[test]
fn mended_there_is_nothing_to_say() {
    for name in ["kitchen-domain", "kitchen-problem", "bottle-domain", "moves-domain"] {
        let (exit, said) = check(&format!("mended/{name}.pddl"));
        assert_eq!(said, "", "{name}");
        assert_eq!(exit, Exit::Done, "{name}");
    }
}
