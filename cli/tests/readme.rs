//! README.md goes in: its commands run in a folder with the reference domains, and must print what the page shows.

use std::fs;
use std::path::Path;
use std::process::Command;

/// One command of the session on the page, and what is shown below it.
struct Exchange {
    command: String,
    shown: String,
}

#[test]
fn the_session_prints_what_the_page_shows() {
    let page = page();
    let session = session(&page);
    assert!(
        session.len() >= 4,
        "README.md shows {} commands: has its form changed?",
        session.len()
    );
    let folder = tempfile::tempdir().expect("there is room for a few domains");
    copy(&root().join("domains"), &folder.path().join("domains"));
    fs::create_dir(folder.path().join("target")).expect("the folder is new");
    for exchange in session {
        let printed = shell(&exchange.command, folder.path());
        assert_eq!(masked(&printed), masked(&exchange.shown), "$ {}", exchange.command);
    }
}

#[test]
fn the_first_command_plans_a_bundled_problem() {
    let page = page();
    let command = page
        .lines()
        .find_map(|line| line.strip_prefix("cargo run --release -- "))
        .expect("README.md shows the command that runs the main job");
    let folder = tempfile::tempdir().expect("there is room for a plan");
    copy(&root().join("domains"), &folder.path().join("domains"));
    let printed = shell(&format!("caveat {command} && cat sas_plan"), folder.path());
    assert!(printed.contains("; cost = "), "{printed}");
}

#[test]
fn masking_hides_times_and_nothing_else() {
    assert_eq!(
        masked("cost: 26 [0.0312s]\nSearch time: 0.2s, 1.5x 14 KB"),
        "cost: 26 [*s]\nSearch time: *s, 1.5x * KB\n"
    );
}

/// Runs a command line with the binary of this build, and gives back all it printed.
fn shell(command: &str, folder: &Path) -> String {
    let binary = Path::new(env!("CARGO_BIN_EXE_caveat"));
    let mut path = binary.parent().expect("the binary lies in a folder").as_os_str().to_owned();
    if let Some(others) = std::env::var_os("PATH") {
        path.push(":");
        path.push(others);
    }
    let output = Command::new("sh")
        .args(["-c", &format!("{{ {command}; }} 2>&1")])
        .current_dir(folder)
        .env("PATH", path)
        .output()
        .expect("there is a shell");
    String::from_utf8(output.stdout).expect("the program prints UTF-8")
}

/// The commands of the page's `console` blocks that begin with `$ `, each with the lines below it.
fn session(page: &str) -> Vec<Exchange> {
    let mut session: Vec<Exchange> = Vec::new();
    let mut inside = false;
    for line in page.lines() {
        if line.starts_with("```") {
            inside = line == "```console";
        } else if let Some(command) = line.strip_prefix("$ ").filter(|_| inside) {
            session.push(Exchange { command: command.to_string(), shown: String::new() });
        } else if let Some(exchange) = session.last_mut().filter(|_| inside) {
            exchange.shown.push_str(line);
            exchange.shown.push('\n');
        }
    }
    session
}

/// The text with every decimal time in seconds and every size in kilobytes replaced, for they differ from run to run.
fn masked(text: &str) -> String {
    let mut masked = String::new();
    for line in text.lines() {
        let mut rest = line.trim_end();
        while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
            masked.push_str(&rest[..start]);
            rest = &rest[start..];
            let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
            let (number, after) = rest.split_at(end);
            let time = number.contains('.') && after.starts_with('s');
            masked.push_str(if time || after.starts_with(" KB") { "*" } else { number });
            rest = after;
        }
        masked.push_str(rest);
        masked.push('\n');
    }
    masked
}

/// Copies the text files of a folder and the folders in it.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("there is room for a few domains");
    for entry in fs::read_dir(from).expect("the reference domains are there") {
        let entry = entry.expect("the folder stays as it is").path();
        let target = to.join(entry.file_name().expect("it came from a folder"));
        if entry.is_dir() {
            copy(&entry, &target);
        } else {
            fs::copy(&entry, &target).expect("the file can be read");
        }
    }
}

/// The page.
fn page() -> String {
    fs::read_to_string(root().join("README.md")).expect("README.md is there")
}

/// The root of the repository.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the crate lies in the workspace")
}

#[test]
fn the_table_of_what_is_supported_is_the_program_s_own() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    let readme = fs::read_to_string(readme).expect("there is a README");
    assert!(readme.contains(&lang::support::table()));
}
