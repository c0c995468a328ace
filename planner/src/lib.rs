//! A checked problem goes in; a ground [`task::Task`], a search and a plan come out.

pub mod limits;
pub mod normal;
pub mod normalize;
pub mod grounded;
pub mod ground;
pub mod task;
pub mod encode;
