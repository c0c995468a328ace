//! Demonstrations as scripts go in; the deeds, operators, invariants and texts that come of them are compared with what is wanted.

mod script;
mod words;
mod credit;
mod deeds;
mod together;
mod learned;
mod letter;
mod groups;
mod extend;
mod moves;
mod problem;
mod routine;
