//! Where text goes: data to the output, talk to the error stream, and neither ends the program when nobody reads any more.

use std::fmt;
use std::io::{self, ErrorKind, Write};

/// The two streams of a run, and what they can show.
pub struct Terminal<'a> {
    out: &'a mut (dyn Write + Send),
    err: &'a mut (dyn Write + Send),
    /// Whether messages may have colours.
    pub colour: bool,
    /// Whether a person watches the error stream, so that progress may be shown.
    pub watched: bool,
    /// The reader of the output has gone: what would be written is dropped.
    closed: bool,
    /// The output could not be written for another reason.
    failure: Option<io::Error>,
}

impl<'a> Terminal<'a> {
    /// Both streams, without colours and progress.
    pub fn new(out: &'a mut (dyn Write + Send), err: &'a mut (dyn Write + Send)) -> Self {
        Self { out, err, colour: false, watched: false, closed: false, failure: None }
    }

    /// Writes data as it is.
    pub fn data(&mut self, text: impl fmt::Display) {
        if self.closed {
            return;
        }
        if let Err(error) = write!(self.out, "{text}") {
            self.closed = true;
            if error.kind() != ErrorKind::BrokenPipe {
                self.failure = Some(error);
            }
        }
    }

    /// Writes a line of data.
    pub fn line(&mut self, text: impl fmt::Display) {
        self.data(format_args!("{text}\n"));
    }

    /// Writes a line of talk. Nothing can be said about a failure here, and nothing depends on it.
    pub fn say(&mut self, text: impl fmt::Display) {
        let _ = writeln!(self.err, "{text}");
    }

    /// Whether nobody reads the output any more.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Hands over what is still held back; an output that could not be written, other than for lack of a reader, is an error.
    pub fn finish(&mut self) -> io::Result<()> {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        let _ = self.err.flush();
        match self.out.flush() {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Terminal;
    use std::io::{self, ErrorKind, Write};

    /// Fails every time it is written to.
    struct Broken(ErrorKind);

    impl Write for Broken {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_reader_that_has_gone_is_no_failure() {
        let (mut out, mut err) = (Broken(ErrorKind::BrokenPipe), Vec::new());
        let mut terminal = Terminal::new(&mut out, &mut err);
        terminal.line("data");
        assert!(terminal.is_closed());
        assert!(terminal.finish().is_ok());
    }

    #[test]
    fn a_full_disk_is_a_failure() {
        let (mut out, mut err) = (Broken(ErrorKind::StorageFull), Vec::new());
        let mut terminal = Terminal::new(&mut out, &mut err);
        terminal.line("data");
        assert_eq!(terminal.finish().map_err(|error| error.kind()), Err(ErrorKind::StorageFull));
    }
}
