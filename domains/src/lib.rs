//! The name of a reference domain goes in; the folder with its domain, problems and known optimal costs comes out.
//!
//! The domains are plain files, each in its own folder beside this crate's `src`, and README.md there says what each teaches.
//! [`kitchen`] makes kitchens of any size in which something is missing.
//! [`trial`] has worlds in which things go wrong, for trials by the thousand.
//! [`world`] has physical worlds in which demonstrations are shown and plans are carried out.
//!
//! ```
//! let stacking = domains::folder().join("stacking");
//! assert!(stacking.join("domain.pddl").is_file());
//! assert!(domains::NAMES.contains(&"stacking"));
//! ```

mod chance;
pub mod kitchen;
pub mod world;
pub mod trial;

use std::path::PathBuf;

/// The names of the reference domains, in the order in which they are best read; each is a folder in [`folder`].
pub const NAMES: [&str; 8] =
    ["stacking", "hanoi", "keys", "delivery", "kitchen", "drawers", "circuits", "museum"];

/// The names of the domains for several agents, in the order in which they are best read; they lie beside the others.
pub const MULTI_AGENT: [&str; 5] = ["bottle", "moves", "table", "hanoi-arms", "warehouse"];

/// The names of the domains whose problems have no plan, in the order in which they are best read; they lie beside the others.
pub const UNSOLVABLE: [&str; 5] = ["closed-drawer", "blocked-drawer", "vials", "cranes", "rovers"];

/// The folder that holds one folder for each of [`NAMES`], [`MULTI_AGENT`] and [`UNSOLVABLE`], on the machine where this crate was built.
pub fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}
