//! What the causal crate could not do goes in; a complaint for a person comes out.

use crate::files::Complaint;

/// Lets `?` turn these errors, whose words are made for people, into complaints.
macro_rules! complain {
    ($($error:ty),* $(,)?) => {
        $(impl From<$error> for Complaint {
            fn from(error: $error) -> Self {
                Self::new(error.to_string())
            }
        })*
    };
}

complain!(
    causal::contrast::ContrastError,
    causal::count::CountError,
    causal::discover::DiscoverError,
    causal::estimate::EstimateError,
    causal::evaluate::EvaluateError,
    causal::infer::InferError,
    causal::network::NetworkError,
    causal::notears::LinearError,
    causal::source::Fault,
    causal::transfer::TransferError,
    causal::transfer::curve::CurveError,
);
