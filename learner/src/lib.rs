//! A log of hands and objects over time goes in; a readable operator for a domain comes out.
