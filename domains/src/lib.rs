//! The reference domains of this folder, and the physical worlds that will generate their data.
