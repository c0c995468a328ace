//! Trials go in; a causal Bayesian network that predicts, explains and prevents failures comes out.
