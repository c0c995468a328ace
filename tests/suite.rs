//! The one test binary: every module is a family of end-to-end tests.

mod agents;
mod bad;
mod causal;
mod transfer;
mod compiled;
mod costs;
mod desk;
mod domains;
mod excuses;
mod joint;
mod learning;
mod listings;
mod multiagent_page;
mod replay;
mod tidy;
mod trials;
mod unsolvable;
