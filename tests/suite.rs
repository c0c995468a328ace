//! The one test binary: every module is a family of end-to-end tests.

mod agents;
mod bad;
mod costs;
mod domains;
mod listings;
mod replay;
mod tidy;
