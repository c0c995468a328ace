//! README.md and pages of `docs/` go in: their commands run in a folder with the reference domains, and must print what the pages show.
//!
//! With `INSTA_UPDATE=always` the pages are written anew instead, with what is printed now.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn the_session_prints_what_the_page_shows() {
    holds("README.md", 4);
}

#[test]
fn the_page_on_excuses_shows_what_is_printed() {
    holds("docs/excuses.md", 6);
}

#[test]
fn the_page_on_learning_shows_what_is_printed() {
    holds("docs/learning.md", 20);
}

#[test]
fn the_page_on_causal_networks_shows_what_is_printed() {
    holds("docs/causal.md", 17);
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
    assert_eq!(masked("\"seconds\": 0.0007,\n\"cost\": 0.5,"), "\"seconds\": *,\n\"cost\": 0.5,\n");
}

#[test]
fn a_page_is_compared_and_written_anew_command_by_command() {
    let page = "$ no command\n```console\n$ echo one\none\n$ echo two\nthree\n```\nText.\n";
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let seen = run_through(page, folder.path());
    assert_eq!((seen.commands, seen.wrong.len()), (2, 1));
    assert!(seen.wrong[0].contains("line 5: `echo two`"), "{}", seen.wrong[0]);
    assert_eq!(seen.page, page.replace("three", "two"));
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

/// What came of the commands of a page.
struct Seen {
    /// The page with what is printed now.
    page: String,
    /// How many commands ran.
    commands: usize,
    /// Those that print something else than the page shows.
    wrong: Vec<String>,
}

/// Runs the commands of a page in a folder of their own, and says which of them print something else; there are at least so many.
#[track_caller]
fn holds(name: &str, least: usize) {
    let path = root().join(name);
    let page = fs::read_to_string(&path).expect("the page is there");
    let folder = tempfile::tempdir().expect("there is room for a few domains");
    copy(&root().join("domains"), &folder.path().join("domains"));
    fs::create_dir(folder.path().join("target")).expect("the folder is new");
    let seen = run_through(&page, folder.path());
    assert!(
        seen.commands >= least,
        "{name} shows {} commands: has its form changed?",
        seen.commands
    );
    if std::env::var_os("INSTA_UPDATE").is_some_and(|how| how == "always") {
        fs::write(&path, &seen.page).expect("the page can be written");
        return;
    }
    assert!(seen.wrong.is_empty(), "{name}, {}", seen.wrong.join("\n"));
}

/// Runs the commands of the `console` blocks of a page, which begin with `$ `; what each prints stands in the lines below it.
fn run_through(page: &str, folder: &Path) -> Seen {
    let mut seen = Seen { page: String::new(), commands: 0, wrong: Vec::new() };
    let mut inside = false;
    let mut lines = page.lines().enumerate().peekable();
    while let Some((number, line)) = lines.next() {
        seen.page.push_str(line);
        seen.page.push('\n');
        if line.starts_with("```") {
            inside = line == "```console";
        }
        let Some(command) = line.strip_prefix("$ ").filter(|_| inside) else { continue };
        let mut shown = String::new();
        while let Some((_, line)) =
            lines.next_if(|(_, line)| !line.starts_with("$ ") && !line.starts_with("```"))
        {
            shown.push_str(line);
            shown.push('\n');
        }
        let mut printed = shell(command, folder);
        if !printed.is_empty() && !printed.ends_with('\n') {
            printed.push('\n');
        }
        seen.commands += 1;
        if masked(&printed) == masked(&shown) {
            seen.page.push_str(&shown);
            continue;
        }
        seen.page.push_str(&printed);
        let mut wrong = String::new();
        let _ = write!(wrong, "line {}: `{command}` prints\n{printed}", number + 1);
        seen.wrong.push(wrong);
    }
    seen
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
            let time =
                number.contains('.') && after.starts_with('s') || masked.ends_with("\"seconds\": ");
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
