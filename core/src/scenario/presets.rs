//! Scenarios with a name: the paper's three schemes and the variations that the reference data cover.

use super::document::{InitialVelocityDocument, ScenarioDocument, SchemeDocument};

/// A named scenario.
#[derive(Debug, Clone, Copy, serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Preset {
    /// Identifier.
    pub id: &'static str,
    /// Title.
    pub title: &'static str,
    /// What it shows.
    pub description: &'static str,
    #[serde(skip)]
    document: fn() -> ScenarioDocument,
}

impl Preset {
    /// The scenario.
    pub fn document(&self) -> ScenarioDocument {
        (self.document)()
    }
}

/// Every preset; the first three are the study.
pub const PRESETS: &[Preset] = &[
    Preset {
        id: "proposed",
        title: "Proposed scheme with observer",
        description: "The paper's own controller: no velocity sensor, composite adaptation with projection.",
        document: || ScenarioDocument::paper(SchemeDocument::Proposed(None)),
    },
    Preset {
        id: "tang_arteaga",
        title: "Tang and Arteaga (1994)",
        description: "Measured velocity, composite adaptation from tracking and prediction errors.",
        document: || ScenarioDocument::paper(SchemeDocument::TangArteaga(None)),
    },
    Preset {
        id: "slotine_li",
        title: "Slotine and Li (1987)",
        description: "Measured velocity, adaptation along the gradient of the tracking error.",
        document: || ScenarioDocument::paper(SchemeDocument::SlotineLi(None)),
    },
    Preset {
        id: "proposed_from_rest",
        title: "Proposed scheme, from rest",
        description: "As proposed, but the arm starts standing still.",
        document: || from_rest(SchemeDocument::Proposed(None)),
    },
    Preset {
        id: "tang_arteaga_from_rest",
        title: "Tang and Arteaga, from rest",
        description: "As Tang and Arteaga, but the arm starts standing still.",
        document: || from_rest(SchemeDocument::TangArteaga(None)),
    },
    Preset {
        id: "slotine_li_from_rest",
        title: "Slotine and Li, from rest",
        description: "As Slotine and Li, but the arm starts standing still.",
        document: || from_rest(SchemeDocument::SlotineLi(None)),
    },
    Preset {
        id: "proposed_heavier_arm",
        title: "Proposed scheme, heavier arm",
        description: "The controller is not told that inertia is 30 % and gravity 50 % above nominal.",
        document: || {
            let mut document = ScenarioDocument::paper(SchemeDocument::Proposed(None));
            let mut scale = vec![1.0; 18];
            scale[7..10].fill(1.3);
            scale[16..18].fill(1.5);
            document.plant.theta_scale = Some(scale);
            document
        },
    },
];

fn from_rest(scheme: SchemeDocument) -> ScenarioDocument {
    let mut document = ScenarioDocument::paper(scheme);
    document.initial.velocity = InitialVelocityDocument::Rest;
    document
}

/// The preset called `id`.
pub fn preset(id: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.id == id)
}
