//! Fast Downward's SAS+ text format (version 3) and our [`crate::task::Task`], one into the other.

pub mod read;
pub mod write;
