//! The text of a plan goes in; a whole file, numbered where several plans come, comes out.

use std::fs;
use std::path::PathBuf;

use crate::args;
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::limits::Watch;
use crate::terminal::Terminal;

/// Writes plans.
pub(super) struct Desk<'a> {
    arguments: &'a args::Plan,
    watch: &'a Watch,
    written: usize,
    /// The first thing that went wrong.
    pub(super) failure: Option<Exit>,
}

impl<'a> Desk<'a> {
    /// Nothing is written yet.
    pub(super) fn new(arguments: &'a args::Plan, watch: &'a Watch) -> Self {
        Self { arguments, watch, written: 0, failure: None }
    }

    /// How many plans have been written.
    pub(super) fn written(&self) -> usize {
        self.written
    }

    /// Removes plans of earlier runs, so that none of them is taken for one of this run.
    pub(super) fn clear(&self) -> Result<(), Complaint> {
        let file = &self.arguments.plan_file;
        let Some(name) = file.file_name().and_then(|name| name.to_str()) else {
            return Err(Complaint::new(format!("`{}` is no name for a plan file", file.display())));
        };
        let entries = fs::read_dir(files::folder(file)).into_iter().flatten().flatten();
        for entry in entries {
            let entry_name = entry.file_name();
            let rest = entry_name.to_str().and_then(|entry| entry.strip_prefix(name));
            let is_plan = rest.is_some_and(|rest| {
                rest.is_empty()
                    || rest.strip_prefix('.').is_some_and(|number| number.parse::<u32>().is_ok())
            });
            if is_plan && entry.path().is_file() {
                fs::remove_file(entry.path()).map_err(|error| {
                    Complaint::new(format!(
                        "the old plan `{}` cannot be removed: {error}",
                        entry.path().display()
                    ))
                })?;
            }
        }
        Ok(())
    }

    /// Where the next plan goes.
    fn path(&self) -> PathBuf {
        let file = &self.arguments.plan_file;
        if !self.arguments.anytime {
            return file.clone();
        }
        let mut name = file.clone().into_os_string();
        name.push(format!(".{}", self.written + 1));
        PathBuf::from(name)
    }

    /// Writes a plan that has been found valid.
    pub(super) fn save(&mut self, text: &str, terminal: &mut Terminal) {
        let path = self.path();
        let written = {
            let _files = self.watch.files();
            let written = files::write(&path, text.as_bytes());
            if written.is_ok() {
                self.watch.found();
            }
            written
        };
        match written {
            Ok(()) => self.written += 1,
            Err(complaint) => {
                terminal.say(complaint);
                self.failure.get_or_insert(Exit::Input);
            }
        }
    }

    /// Says that a plan was found and is not valid, and why.
    pub(super) fn refuse(&mut self, story: &str, terminal: &mut Terminal) {
        terminal.say(Complaint::with_help(
            "this is a bug in caveat: the search returned a plan that is not valid, so it was not written",
            format!(
                "please report it with the command line and the files, at {}/issues",
                env!("CARGO_PKG_REPOSITORY")
            ),
        ));
        terminal.say(story.trim_end());
        self.failure.get_or_insert(Exit::Bug);
    }
}
