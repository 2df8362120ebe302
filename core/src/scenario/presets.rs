//! Scenarios with a name: the paper's three schemes, the variations that the reference data cover, and other robots.

use super::document::{InitialVelocityDocument, ScenarioDocument, SchemeDocument};
use super::gains::SlotineLiGains;

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
    Preset {
        id: "two_link_textbook",
        title: "Two-link arm of the textbook",
        description: "Slotine and Li's book, section 9.2: their arm, horizontal and without friction, their gains, from rest.",
        document: || {
            let mut gamma_adapt = vec![0.03, 0.05, 0.1, 0.3];
            gamma_adapt.resize(11, 0.0);
            let gains = SlotineLiGains { k_s: vec![100.0; 2], lambda: vec![20.0; 2], gamma_adapt };
            let mut document = ScenarioDocument::of_robot("two_link", SchemeDocument::SlotineLi(Some(gains)));
            let mut scale = vec![1.0; 4];
            scale.resize(11, 0.0);
            document.plant.theta_scale = Some(scale);
            document.integration.duration_s = 3.0;
            document
        },
    },
    Preset {
        id: "two_link_proposed",
        title: "Two-link arm, proposed scheme",
        description: "A planar arm with gravity and friction under the paper's controller, without velocity sensor.",
        document: || ScenarioDocument::of_robot("two_link", SchemeDocument::Proposed(None)),
    },
    Preset {
        id: "pendulum_slotine_li",
        title: "Pendulum, Slotine and Li",
        description: "One joint and four parameters, for first lessons.",
        document: || ScenarioDocument::of_robot("pendulum", SchemeDocument::SlotineLi(None)),
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
