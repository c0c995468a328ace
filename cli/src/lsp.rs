//! `caveat lsp`: what an editor asks goes in, answers and diagnostics come out, in the language server protocol on the standard streams.
//!
//! One loop takes the messages in their order. What is typed changes the texts at once;
//! they are looked at when somebody asks, or when no message waits, so that only the newest text is analysed.

mod address;
mod position;
mod folder;
mod convert;
mod capabilities;
mod diagnose;
mod answer;
mod serve;

use std::collections::VecDeque;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, TryRecvError};
use std::thread;
use std::time::Duration;

use lsp_server::{Connection, ErrorCode, Message, RequestId, Response};

use crate::args::Lsp;
use crate::exit::Exit;
use crate::terminal::Terminal;

use serve::Server;

/// So long the loop waits for more to be typed before it looks at the texts.
const PAUSE: Duration = Duration::from_millis(2);

/// Serves until the editor ends it.
pub fn run(_: &Lsp, terminal: &mut Terminal) -> Exit {
    let (connection, threads) = Connection::stdio();
    let Connection { sender, receiver } = connection;
    // The streams hand over one message at a time; here they queue, so that it can be seen whether more have come.
    let (queue, messages) = mpsc::channel();
    thread::spawn(move || receiver.into_iter().try_for_each(|message| queue.send(message)));
    let mut inbox = Inbox { messages, waiting: VecDeque::new(), open: true };
    let mut server = Server::new(move |message| {
        // Whoever does not read any more has gone, which the other direction will show.
        let _ = sender.send(message);
    });
    let mut asked_to_exit = false;
    while let Some(message) = inbox.next(&mut server) {
        if matches!(&message, Message::Notification(one) if one.method == "exit") {
            asked_to_exit = true;
            break;
        }
        server.take(message);
    }
    let exit = server.exit();
    if asked_to_exit || !inbox.open {
        // Dropping the server closes the output, which ends the thread that writes it.
        drop(server);
        if let Err(error) = threads.join() {
            terminal.say(format_args!("error: {error}"));
            return Exit::Failed;
        }
    }
    exit
}

/// The messages that have come and have not been looked at.
struct Inbox {
    messages: Receiver<Message>,
    waiting: VecDeque<Message>,
    /// Whether the editor may still send something.
    open: bool,
}

impl Inbox {
    /// The next message; the server uses the time until it comes. None means that there will be no more.
    fn next(&mut self, server: &mut Server) -> Option<Message> {
        self.drain(server);
        if self.waiting.is_empty() && self.open && server.has_to_look() {
            match self.messages.recv_timeout(PAUSE) {
                Ok(message) => self.waiting.push_back(message),
                Err(RecvTimeoutError::Timeout) => server.look(),
                Err(RecvTimeoutError::Disconnected) => self.open = false,
            }
        }
        if self.waiting.is_empty() && self.open {
            match self.messages.recv() {
                Ok(message) => self.waiting.push_back(message),
                Err(_) => self.open = false,
            }
        }
        self.waiting.pop_front()
    }

    /// Takes in what has come, and drops requests that have been cancelled before anybody looked at them.
    fn drain(&mut self, server: &Server) {
        loop {
            match self.messages.try_recv() {
                Ok(message) => match cancelled(&message) {
                    Some(id) => self.cancel(&id, server),
                    None => self.waiting.push_back(message),
                },
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => {
                    self.open = false;
                    break;
                }
            }
        }
    }

    fn cancel(&mut self, id: &RequestId, server: &Server) {
        let request = self
            .waiting
            .iter()
            .position(|message| matches!(message, Message::Request(one) if one.id == *id));
        if let Some(at) = request {
            self.waiting.remove(at);
            let code = ErrorCode::RequestCanceled as i32;
            server.send(Response::new_err(id.clone(), code, "cancelled".to_owned()));
        }
    }
}

/// The request that a message takes back.
fn cancelled(message: &Message) -> Option<RequestId> {
    let Message::Notification(one) = message else { return None };
    if one.method != "$/cancelRequest" {
        return None;
    }
    let id = one.params.get("id")?;
    let number = id.as_i64().and_then(|number| i32::try_from(number).ok()).map(RequestId::from);
    number.or_else(|| id.as_str().map(|name| RequestId::from(name.to_owned())))
}
