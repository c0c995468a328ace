//! A panic is a bug of this program: here it becomes a message and an exit code, and never a wall of text.

use std::any::Any;
use std::cell::Cell;
use std::fmt;
use std::panic;
use std::sync::Once;
use std::thread;

thread_local! {
    /// Where this thread panicked, if a [`contain`] is to report it.
    static PLACE: Cell<Option<String>> = const { Cell::new(None) };
    /// Whether a [`contain`] waits for this thread.
    static CONTAINED: Cell<bool> = const { Cell::new(false) };
}

/// A panic that was caught.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// What the panic said.
    pub message: String,
    /// The file, line and column that it came from.
    pub place: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            formatter,
            "error: this is a bug in caveat: {} ({})\n  = help: please report it with the command line and the files, at {}/issues",
            self.message,
            self.place,
            env!("CARGO_PKG_REPOSITORY")
        )
    }
}

/// Runs `work` on a thread with `stack` bytes of stack, and catches its panic.
pub fn contain<T: Send>(stack: usize, work: impl FnOnce() -> T + Send) -> Result<T, Fault> {
    install();
    let caught = || {
        CONTAINED.set(true);
        panic::catch_unwind(panic::AssertUnwindSafe(work)).map_err(|payload| Fault {
            message: message(payload.as_ref()),
            place: PLACE.take().unwrap_or_else(|| "at an unknown place".to_string()),
        })
    };
    thread::scope(|scope| {
        let spawned = thread::Builder::new()
            .name("caveat".to_string())
            .stack_size(stack)
            .spawn_scoped(scope, caught);
        match spawned {
            Ok(thread) => thread.join().expect("the thread catches all panics of its work"),
            Err(error) => Err(Fault {
                message: format!("no thread could be made: {error}"),
                place: "at the start".to_string(),
            }),
        }
    })
}

/// Panics of threads that [`contain`] waits for are kept for its report; all others are reported as before.
fn install() {
    static INSTALLED: Once = Once::new();
    INSTALLED.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |information| {
            if CONTAINED.get() {
                PLACE.set(information.location().map(ToString::to_string));
            } else {
                usual(information);
            }
        }));
    });
}

/// What a panic said.
fn message(payload: &(dyn Any + Send)) -> String {
    match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
        (Some(text), _) => (*text).to_string(),
        (_, Some(text)) => text.clone(),
        _ => "a panic without a message".to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::contain;

    #[test]
    fn a_panic_becomes_a_message_with_its_place() {
        let fault = contain(1 << 20, || -> u32 { panic!("the {} is on fire", "house") })
            .expect_err("it panics");
        assert_eq!(fault.message, "the house is on fire");
        assert!(fault.place.contains("fault.rs:"), "{}", fault.place);
        assert!(fault.to_string().contains("please report it"), "{fault}");
    }

    #[test]
    fn a_result_comes_through() {
        assert_eq!(contain(1 << 20, || 7), Ok(7));
    }
}
