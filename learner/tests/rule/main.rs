//! Traces go in; what is learned from them is compared with what is wanted, with what a naive learner finds, and with the true domain.

mod small;
mod noise;
mod renaming;
mod random;
mod promise;
mod corpus;
mod words;
