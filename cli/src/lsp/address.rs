//! The address of a document goes in, a path comes out, and the other way round.

use std::ffi::OsString;
use std::fmt::Write;
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::path::{Path, PathBuf};

use gen_lsp_types::Uri;

/// The path of a file. What is no file, such as a text that has not been saved, goes under its whole address.
pub fn path(uri: &Uri) -> PathBuf {
    let Some(rest) = uri.0.strip_prefix("file://") else { return PathBuf::from(&uri.0) };
    // Between `//` and `/` there may be the name of a host.
    let path = rest.find('/').map_or(rest, |slash| &rest[slash..]);
    PathBuf::from(OsString::from_vec(decoded(path)))
}

/// Whether a path stands for a file, and not for a text that has not been saved.
pub fn is_file(path: &Path) -> bool {
    path.is_absolute()
}

/// The address of a file.
pub fn uri(path: &Path) -> Uri {
    if !is_file(path) {
        return Uri(path.display().to_string());
    }
    let mut text = String::from("file://");
    for &byte in path.as_os_str().as_bytes() {
        if byte.is_ascii_alphanumeric() || b"/-_.~!$&'()*+,=@".contains(&byte) {
            text.push(char::from(byte));
        } else {
            let _ = write!(text, "%{byte:02X}");
        }
    }
    Uri(text)
}

/// With `%41` read as `A`.
fn decoded(text: &str) -> Vec<u8> {
    let bytes = text.as_bytes();
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut at = 0;
    while at < bytes.len() {
        let code = bytes.get(at + 1..at + 3).and_then(|digits| str::from_utf8(digits).ok());
        let code = code.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        if let Some(code) = code.filter(|_| bytes[at] == b'%') {
            decoded.push(code);
            at += 3;
        } else {
            decoded.push(bytes[at]);
            at += 1;
        }
    }
    decoded
}

#[cfg(test)]
mod tests {
    use super::{path, uri};
    use gen_lsp_types::Uri;
    use std::path::Path;

    #[test]
    fn there_and_back() {
        for name in ["/tmp/a b/ü#1%.pddl", "/x/p01.pddl"] {
            assert_eq!(path(&uri(Path::new(name))), Path::new(name));
        }
        assert_eq!(uri(Path::new("/a b")).0, "file:///a%20b");
    }

    #[test]
    fn other_spellings() {
        assert_eq!(path(&Uri("file:///c%3a/x%2Dy".to_owned())), Path::new("/c:/x-y"));
        assert_eq!(path(&Uri("file://localhost/x".to_owned())), Path::new("/x"));
        assert_eq!(path(&Uri("untitled:Untitled-1".to_owned())), Path::new("untitled:Untitled-1"));
        assert_eq!(path(&Uri("file:///100%".to_owned())), Path::new("/100%"));
    }
}
