//! Where text goes: data to the output, talk to the error stream, and neither ends the program when nobody reads any more.

use std::fmt;
use std::io::{self, ErrorKind, Write};

/// The two streams of a run, and what they can show.
pub struct Terminal<'a> {
    out: &'a mut (dyn Write + Send),
    err: &'a mut (dyn Write + Send),
    /// Whether talk may have colours.
    pub colour: bool,
    /// Whether data may have colours.
    pub data_colour: bool,
    /// Whether a person watches the error stream, so that progress may be shown.
    pub watched: bool,
    state: State,
}

/// What has become of the output.
enum State {
    /// It takes what is written.
    Open,
    /// Its reader has gone: what would be written is dropped.
    Closed,
    /// It could not be written for another reason.
    Failed(io::Error),
}

impl<'a> Terminal<'a> {
    /// Both streams, without colours and progress.
    pub fn new(out: &'a mut (dyn Write + Send), err: &'a mut (dyn Write + Send)) -> Self {
        Self { out, err, colour: false, data_colour: false, watched: false, state: State::Open }
    }

    /// Writes data as it is.
    pub fn data(&mut self, text: impl fmt::Display) {
        self.attempt(|out| write!(out, "{text}"));
    }

    /// Lets `work` write data. It sees no error of the output: a failure is kept for [`Self::finish`].
    pub fn write_with(&mut self, work: impl FnOnce(&mut dyn Write) -> io::Result<()>) {
        self.attempt(|mut out| work(&mut out));
    }

    fn attempt(&mut self, work: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>) {
        if !matches!(self.state, State::Open) {
            return;
        }
        if let Err(error) = work(self.out) {
            let gone = error.kind() == ErrorKind::BrokenPipe;
            self.state = if gone { State::Closed } else { State::Failed(error) };
        }
    }

    /// Writes a line of data.
    pub fn line(&mut self, text: impl fmt::Display) {
        self.data(format_args!("{text}\n"));
    }

    /// Writes a line of talk, after the data written so far. Nothing can be said about a failure here, and nothing depends on it.
    pub fn say(&mut self, text: impl fmt::Display) {
        self.flush();
        let _ = writeln!(self.err, "{text}");
    }

    /// Writes talk as it is, after the data that came before it.
    pub fn talk(&mut self, text: impl fmt::Display) {
        self.flush();
        let _ = write!(self.err, "{text}");
    }

    /// Hands over what is held back, so that whoever reads the output sees it now.
    pub fn flush(&mut self) {
        self.attempt(|out| out.flush());
    }

    /// Whether nobody reads the output any more.
    pub fn is_closed(&self) -> bool {
        matches!(self.state, State::Closed)
    }

    /// Hands over what is still held back; an output that could not be written, other than for lack of a reader, is an error.
    pub fn finish(&mut self) -> io::Result<()> {
        self.flush();
        let _ = self.err.flush();
        match std::mem::replace(&mut self.state, State::Closed) {
            State::Failed(error) => Err(error),
            State::Open | State::Closed => Ok(()),
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
