//! A log of hands and objects over time goes in; a readable operator for a domain comes out.
//!
//! The rooms in the order in which data passes them:
//!
//! - [`log`]: frames of hands and objects, as they were tracked;
//! - [`truth`]: what really happened in a frame, where somebody knows it;
//! - [`trace`]: symbolic states and the actions between them, and their text;
//! - [`rule`]: what the actions of traces demand and do;
//! - [`mod@write`]: what was learned as a domain.
//!
//! ```
//! use learner::{rule, trace};
//!
//! let text = "((:state (open drawer) (held plate)) (:action (put-in plate drawer)) (:state (open drawer) (inside plate drawer)))";
//! let (domain, faults) = trace::infer("kitchen", &[text]);
//! assert!(faults[0].is_empty());
//! let (demonstration, _) = trace::read(text, &domain, &trace::Reading::default());
//! let learned = rule::learn(&domain, &[demonstration], &rule::Options::default());
//! let put_in = &learned.actions[0];
//! // It changes that the plate is held; that the drawer is open may be needed, too.
//! assert_eq!((put_in.changed.len(), put_in.required.len(), put_in.doubts.len()), (1, 2, 1));
//! assert!(learner::write::text(&learned).contains("(not (held ?plate))"));
//! ```

pub mod log;
pub mod truth;
pub mod trace;
pub mod rule;
pub mod write;
