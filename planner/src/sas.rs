//! Fast Downward's SAS+ text format and our [`crate::task::Task`], one into the other.

pub mod read;
