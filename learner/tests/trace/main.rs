//! Texts of traces go in; what is read of them, and what is said about mistakes, is compared with what is wanted.

mod corpus;
mod reading;
mod words;
