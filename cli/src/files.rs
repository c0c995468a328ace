//! Paths go in, texts come out; what cannot be read is said in a sentence with the way out.

use std::fmt;
use std::fs;
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

/// Why a run cannot go on, for a person to read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// What is wrong, as a sentence without a full stop.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl Complaint {
    /// Without a way out.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), help: None }
    }

    /// With a way out.
    pub fn with_help(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()) }
    }

    /// Of a word that is none of those that are known, with the one that was probably meant.
    pub fn misspelt<'k>(
        message: impl Into<String>,
        word: &str,
        known: impl IntoIterator<Item = &'k str>,
    ) -> Self {
        let near = lang::nearest(word, known).map(|near| format!("did you mean `{near}`?"));
        Self { message: message.into(), help: near }
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "error: {}", self.message)?;
        match &self.help {
            Some(help) => write!(formatter, "\n  = help: {help}"),
            None => Ok(()),
        }
    }
}

/// Whether a path stands for the standard input.
pub fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// The name under which messages speak of a path.
pub fn name(path: &Path) -> String {
    if is_stdin(path) { "<stdin>".to_string() } else { path.display().to_string() }
}

/// A text as it was read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text {
    /// As far as it is UTF-8.
    pub text: String,
    /// The first byte that is not, if there is one.
    pub bad: Option<usize>,
}

/// The text of a file, or of the standard input.
pub fn read(path: &Path) -> Result<Text, Complaint> {
    let bytes = if is_stdin(path) {
        let mut bytes = Vec::new();
        io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        fs::read(path)
    };
    let bytes = bytes.map_err(|error| unreadable(path, &error))?;
    Ok(match String::from_utf8(bytes) {
        Ok(text) => Text { text, bad: None },
        Err(error) => {
            let bad = error.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(&error.as_bytes()[..bad]).into_owned();
            Text { text, bad: Some(bad) }
        }
    })
}

/// The first byte of a file that is no blank; none if there is no other.
pub fn first_byte(path: &Path) -> Result<Option<u8>, Complaint> {
    let file = fs::File::open(path).map_err(|error| unreadable(path, &error))?;
    for byte in io::BufReader::new(file).bytes() {
        let byte = byte.map_err(|error| unreadable(path, &error))?;
        if !byte.is_ascii_whitespace() {
            return Ok(Some(byte));
        }
    }
    Ok(None)
}

/// What to say of a file that cannot be read.
fn unreadable(path: &Path, error: &io::Error) -> Complaint {
    let name = name(path);
    match error.kind() {
        ErrorKind::NotFound => {
            let message = format!("there is no file `{name}`");
            match nearest(path) {
                Some(near) => {
                    Complaint::with_help(message, format!("did you mean `{}`?", near.display()))
                }
                None => Complaint::new(message),
            }
        }
        ErrorKind::IsADirectory => {
            Complaint::with_help(format!("`{name}` is a folder, not a file"), "name a file in it")
        }
        ErrorKind::PermissionDenied => {
            Complaint::new(format!("`{name}` may not be read by this user"))
        }
        _ => Complaint::new(format!("`{name}` cannot be read: {error}")),
    }
}

/// The file beside `path` whose name is most like its name, if any is.
fn nearest(path: &Path) -> Option<PathBuf> {
    let wanted = path.file_name()?.to_str()?.to_lowercase();
    let folder = folder(path);
    let mut names: Vec<String> = fs::read_dir(folder)
        .ok()?
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    names.sort();
    let distance = |name: &String| strsim::damerau_levenshtein(&wanted, &name.to_lowercase());
    let best = names.into_iter().min_by_key(distance)?;
    (distance(&best) <= wanted.chars().count() / 3).then(|| path.with_file_name(best))
}

/// Whether a file is called as files of PDDL and HDDL are.
pub fn is_pddl(path: &Path) -> bool {
    path.extension()
        .is_some_and(|end| end.eq_ignore_ascii_case("pddl") || end.eq_ignore_ascii_case("hddl"))
}

/// The other files of PDDL and HDDL in the folder of `path`, in the order of their names.
pub fn beside(path: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder(path)).into_iter().flatten().flatten();
    let mut beside: Vec<PathBuf> = entries
        .map(|entry| path.with_file_name(entry.file_name()))
        .filter(|file| file != path && is_pddl(file))
        .collect();
    beside.sort();
    beside
}

/// The folder that a file lies in.
pub fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Writes a file so that it is there as a whole or not at all: to a temporary file beside it, which is then renamed. What is no file, such as `/dev/stdout`,
/// is written to as it is.
pub fn write(path: &Path, text: &[u8]) -> Result<(), Complaint> {
    write_with(path, |out| out.write_all(text))
}

/// As [`write()`], for text that is made while it is written.
pub fn write_with(
    path: &Path,
    work: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Complaint> {
    let whole = || -> io::Result<()> {
        // A device or a pipe is written to; only a file is replaced.
        if fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir()) {
            return work(&mut fs::OpenOptions::new().write(true).open(path)?);
        }
        let mut file = tempfile::Builder::new().prefix(".caveat-").tempfile_in(folder(path))?;
        work(file.as_file_mut())?;
        // Temporary files are private; what is left is a file like any other of this user.
        let permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666 & !umask());
        file.as_file().set_permissions(permissions)?;
        file.persist(path)?;
        Ok(())
    };
    whole().map_err(|error| {
        let name = name(path);
        match error.kind() {
            ErrorKind::NotFound => Complaint::with_help(
                format!(
                    "`{name}` cannot be written: there is no folder `{}`",
                    folder(path).display()
                ),
                "make the folder first, or name another file",
            ),
            ErrorKind::IsADirectory => {
                Complaint::new(format!("`{name}` cannot be written: it is a folder"))
            }
            _ => Complaint::new(format!("`{name}` cannot be written: {error}")),
        }
    })
}

/// The permissions that this user takes from new files.
fn umask() -> u32 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("Umask:"));
    mask.and_then(|mask| u32::from_str_radix(mask.trim(), 8).ok()).unwrap_or(0o022)
}

#[cfg(test)]
mod tests {
    use super::{read, write};
    use std::fs;

    #[test]
    fn a_misspelt_name_gets_the_right_one() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        fs::write(folder.path().join("problem.pddl"), "").expect("a file can be written");
        let complaint =
            read(&folder.path().join("probelm.pddl")).expect_err("there is no such file");
        let right = folder.path().join("problem.pddl");
        assert_eq!(complaint.help, Some(format!("did you mean `{}`?", right.display())));
        let complaint =
            read(&folder.path().join("quite-different")).expect_err("there is no such file");
        assert_eq!(complaint.help, None);
    }

    #[test]
    fn text_that_is_not_utf8_is_placed() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let file = folder.path().join("latin.pddl");
        fs::write(&file, b"(define\n; caf\xe9\n").expect("a file can be written");
        let text = read(&file).expect("the file is there");
        assert_eq!((text.text.as_str(), text.bad), ("(define\n; caf", Some(13)));
    }

    #[test]
    fn a_folder_is_no_file() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let complaint = read(folder.path()).expect_err("a folder cannot be read");
        assert!(complaint.message.ends_with("is a folder, not a file"), "{}", complaint.message);
    }

    #[test]
    fn writing_leaves_nothing_else_behind() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let file = folder.path().join("sas_plan");
        write(&file, b"old").expect("the file can be written");
        write(&file, b"new").expect("the file can be written again");
        assert_eq!(fs::read(&file).expect("it is there"), b"new");
        assert_eq!(fs::read_dir(folder.path()).expect("it is a folder").count(), 1);
        assert!(write(&folder.path().join("none/sas_plan"), b"").is_err());
    }
}
