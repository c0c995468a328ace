//! A checked problem goes in; a ground [`task::Task`], a search and a plan come out, or, where there is no plan, what would have to be different.

pub mod limits;
pub mod normal;
pub mod normalize;
pub mod grounded;
pub mod ground;
pub mod invariants;
pub mod task;
pub mod encode;
pub mod sas;
pub mod state;
pub mod successor;
pub mod axioms;
pub mod random;
pub mod segmented;
pub mod registry;
pub mod space;
pub mod open;
pub mod heuristics;
pub mod search;
pub mod solve;
pub mod excuse;
