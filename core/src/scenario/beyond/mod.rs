//! What a scenario may say beyond the paper: another velocity source, another adaptation, imperfections, yardstick schemes.
//!
//! Each is optional and absent in the paper's scenarios, whose canonical form and bits stay as they are.

pub(super) mod build;
mod document;
mod resolve;
#[cfg(feature = "schema")]
mod schema;

pub use document::{
    AdaptationDocument, AdaptationKind, DisturbanceDocument, EffectsDocument, ElasticityDocument, EncodersDocument,
    IntegralDocument, PayloadDocument, SamplingDocument, SignsDocument, StribeckDocument, VelocityDocument,
    VelocityKind,
};
pub(super) use resolve::resolve;

use super::document::{ScenarioDocument, SchemeDocument};

/// Whether a document says anything beyond the paper: then its loop is put together when the program runs, and does not run
/// side by side with others.
pub(super) fn is_beyond(document: &ScenarioDocument) -> bool {
    !matches!(
        document.scheme,
        SchemeDocument::Proposed(_) | SchemeDocument::TangArteaga(_) | SchemeDocument::SlotineLi(_)
    ) || document.velocity.is_some()
        || document.adaptation.is_some()
        || document.integral.is_some()
        || document.signs.is_some()
        || document.effects.is_some()
}

/// The velocity source that a document asks for, or that its scheme has.
pub(super) fn velocity_kind(document: &ScenarioDocument) -> VelocityKind {
    match (&document.velocity, &document.scheme) {
        (Some(velocity), _) => velocity.kind,
        (None, SchemeDocument::Proposed(_)) => VelocityKind::Observer,
        (None, _) => VelocityKind::Measured,
    }
}
