//! From a checked document to an imperfect loop: any velocity source, feedback and adaptation, and what the arm suffers.

use super::document::{
    AdaptationDocument, AdaptationKind, EffectsDocument, EncodersDocument, VelocityDocument, VelocityKind,
};
use crate::adaptation::{
    AnyAdaptation, CompositeAdaptation, CompositeLaw, ConcurrentLearning, FilteredRegressor, LeastSquaresAdaptation, Mixing,
    Modification, PredictionMemory,
};
use crate::control::{AnyFeedback, LinearFeedback, LinearModel};
use crate::dynamics::Plant;
use crate::effects::{Actuator, Disturbance, Elasticity, EncoderSide, Load, Payload, SampledControl, Sensing, Stribeck};
use crate::robots::{Robot, payload_parameters};
use crate::scenario::build::{self, Lanes};
use crate::scenario::build_trajectory::trajectory;
use crate::scenario::document::{InitialVelocityDocument, ScenarioDocument, SchemeDocument};
use crate::scenario::gains::ModelParameters;
use crate::simulation::{Controller, ImperfectLoop, InitialVelocity, StateSpace};
use crate::trajectories::Remembered;
use crate::velocity::{AnySource, FilteredDifference, HighGainObserver, ModelFreeObserver};
use nalgebra::SVector;
use std::cell::RefCell;

/// The loop that a resolved document describes, for robot `R`.
pub(in crate::scenario) fn closed_loop<R: Robot<N, P>, const N: usize, const P: usize>(
    document: &ScenarioDocument,
) -> Box<dyn StateSpace<f64>> {
    Box::new(imperfect_loop::<R, N, P>(document))
}

/// The same with all its parts in sight; also of a document that asks for nothing beyond the paper.
pub(in crate::scenario) fn imperfect_loop<R: Robot<N, P>, const N: usize, const P: usize>(
    document: &ScenarioDocument,
) -> ImperfectLoop<R, N, P> {
    let none = EffectsDocument::default();
    let effects = document.effects.as_ref().unwrap_or(&none);
    let theta = SVector::from_column_slice(&build::theta(document, R::DATA));
    let plant = Plant::new(theta, build::friction_sign(&[document]));
    ImperfectLoop::<R, N, P> {
        controller: controller(document, effects, &plant),
        plant,
        trajectory: Remembered::new(trajectory::<R, f64, N, P>(&[document])),
        initial_velocity: match document.initial.velocity {
            InitialVelocityDocument::Desired => InitialVelocity::Desired,
            InitialVelocityDocument::Rest => InitialVelocity::Rest,
        },
        sampling: sampling(effects, document.integration.step_s),
        sensing: Sensing {
            encoder_step: effects.encoder_step_rad.unwrap_or(0.0),
            position_noise: effects.position_noise_rad.unwrap_or(0.0),
            velocity_noise: effects.velocity_noise_rad_s.unwrap_or(0.0),
            seed: document.seed,
        },
        actuator: actuator::<R, N, P>(effects),
        load: load::<R, N, P>(effects),
        elasticity: elasticity(effects),
        record_steps: record_steps(document),
        work: RefCell::new(Vec::new()),
    }
}

fn controller<R: Robot<N, P>, const N: usize, const P: usize>(
    document: &ScenarioDocument,
    effects: &EffectsDocument,
    plant: &Plant<R, f64, N, P>,
) -> Controller<R, f64, N, P> {
    let nominal = SVector::<f64, P>::from_column_slice(&R::DATA.theta());
    let parameters = |which: &ModelParameters| match which {
        ModelParameters::True => plant.theta,
        ModelParameters::Nominal => nominal,
    };
    let (velocity_source, mut feedback, adaptation, mut theta_hat_start) = match &document.scheme {
        SchemeDocument::SlotineLi(gains) => {
            let parts = build::slotine_li::<f64, N, P>(&Lanes(&[gains.clone().unwrap_or_default()]));
            let law = AnyAdaptation::Gradient(parts.1);
            (measured::<R, N, P>(document), AnyFeedback::Sliding(parts.0), law, SVector::zeros())
        }
        SchemeDocument::TangArteaga(gains) => {
            let parts = build::tang_arteaga::<R, f64, N, P>(&Lanes(&[gains.clone().unwrap_or_default()]));
            let law = AnyAdaptation::Composite(parts.1);
            (measured::<R, N, P>(document), AnyFeedback::Sliding(parts.0), law, SVector::zeros())
        }
        SchemeDocument::Proposed(gains) => {
            let parts = build::proposed::<R, f64, N, P>(&Lanes(&[gains.clone().unwrap_or_default()]));
            let law = AnyAdaptation::Composite(parts.2);
            (AnySource::Observer(parts.0), AnyFeedback::Sliding(parts.1), law, SVector::zeros())
        }
        SchemeDocument::Pd(gains) => {
            let gains = gains.clone().unwrap_or_default();
            (
                measured::<R, N, P>(document),
                linear(&gains.k_p, &gains.k_d, LinearModel::Gravity),
                AnyAdaptation::None,
                SVector::zeros(),
            )
        }
        SchemeDocument::PdGravity(gains) => {
            let gains = gains.clone().unwrap_or_default();
            let law = linear(&gains.k_p, &gains.k_d, LinearModel::Gravity);
            (measured::<R, N, P>(document), law, AnyAdaptation::None, parameters(&gains.parameters))
        }
        SchemeDocument::ComputedTorque(gains) => {
            let gains = gains.clone().unwrap_or_default();
            let law = linear(&gains.k_p, &gains.k_d, LinearModel::Inverse);
            (measured::<R, N, P>(document), law, AnyAdaptation::None, parameters(&gains.parameters))
        }
    };
    if let Some(scale) = &effects.theta_hat_scale {
        theta_hat_start = nominal.component_mul(&SVector::from_column_slice(scale));
    }
    let signs = document.signs.clone().unwrap_or_default();
    if let AnyFeedback::Sliding(law) = &mut feedback {
        law.gain *= signs.feedback.unwrap_or(1.0);
        law.lambda *= signs.reference.unwrap_or(1.0);
    }
    let asked = document.adaptation.as_ref();
    Controller {
        velocity_source: document
            .velocity
            .as_ref()
            .map_or(velocity_source, |velocity| source::<R, N, P>(velocity, document)),
        feedback,
        adaptation: match asked {
            Some(asked) => match asked.kind {
                AdaptationKind::Scheme => adaptation,
                AdaptationKind::LeastSquares => least_squares(asked, &document.scheme),
                AdaptationKind::Concurrent => concurrent(asked, &document.scheme),
                AdaptationKind::Drem => drem(asked),
            },
            None => adaptation,
        },
        modification: asked.map(|asked| {
            let on = |strength: Option<f64>| strength.filter(|strength| *strength != 0.0);
            Modification {
                sigma: on(asked.sigma),
                e_modification: on(asked.e_modification),
                dead_zone: on(asked.dead_zone_rad_s),
                normalisation: on(asked.normalisation),
            }
        }),
        friction_sign: plant.friction_sign,
        theta_hat_start,
        integral: document
            .integral
            .as_ref()
            .filter(|own| own.k_i.iter().any(|k| *k != 0.0))
            .map(|own| joints(Some(&own.k_i))),
        model_sign: signs.model.unwrap_or(1.0),
        adaptation_sign: signs.adaptation.unwrap_or(1.0),
    }
}

fn measured<R: Robot<N, P>, const N: usize, const P: usize>(document: &ScenarioDocument) -> AnySource<f64, N> {
    AnySource::Measured(build::measured::<R, f64, N, P>(&[document]))
}

fn source<R: Robot<N, P>, const N: usize, const P: usize>(
    velocity: &VelocityDocument,
    document: &ScenarioDocument,
) -> AnySource<f64, N> {
    let bandwidth = velocity.bandwidth_rad_s.unwrap_or_default();
    match velocity.kind {
        VelocityKind::Measured => measured::<R, N, P>(document),
        VelocityKind::FilteredDifference => AnySource::FilteredDifference(FilteredDifference { bandwidth }),
        VelocityKind::HighGain => AnySource::HighGain(HighGainObserver { bandwidth }),
        VelocityKind::Observer => AnySource::Observer(ModelFreeObserver {
            lambda_z: joints(velocity.lambda_z.as_deref()),
            lambda_x: joints(velocity.lambda_x.as_deref()),
            k_d: joints(velocity.k_d.as_deref()),
        }),
    }
}

fn linear<const N: usize>(k_p: &[f64], k_d: &[f64], model: LinearModel) -> AnyFeedback<f64, N> {
    AnyFeedback::Linear(LinearFeedback { k_p: joints(Some(k_p)), k_d: joints(Some(k_d)), model })
}

fn least_squares<R: Robot<N, P>, const N: usize, const P: usize>(
    asked: &AdaptationDocument,
    scheme: &SchemeDocument,
) -> AnyAdaptation<R, f64, N, P> {
    let gain = adaptation_gain::<P>(scheme);
    let trace: f64 = gain.iter().sum();
    AnyAdaptation::LeastSquares(LeastSquaresAdaptation {
        filter: FilteredRegressor::new(asked.filter_rad_s.unwrap_or_default()),
        initial_gain: gain,
        weight: asked.weight.unwrap_or_default(),
        forgetting: asked.forgetting.unwrap_or_default(),
        // Gains that are all zero stay so; only their quotient by the limit must be a number.
        gain_limit: (asked.gain_limit.unwrap_or_default() * trace).max(f64::MIN_POSITIVE),
    })
}

/// The scheme's own Γ.
fn adaptation_gain<const P: usize>(scheme: &SchemeDocument) -> SVector<f64, P> {
    match scheme {
        SchemeDocument::SlotineLi(Some(gains)) => SVector::from_column_slice(&gains.gamma_adapt),
        SchemeDocument::TangArteaga(Some(gains)) => SVector::from_column_slice(&gains.gamma_adapt),
        SchemeDocument::Proposed(Some(gains)) => SVector::from_column_slice(&gains.gamma_adapt),
        // A resolved document has its gains filled in, and only schemes that adapt have another adaptation.
        _ => SVector::zeros(),
    }
}

/// Sizes of a robot's parameters: nominal values, or 1 where those are zero.
fn sizes<R: Robot<N, P>, const N: usize, const P: usize>() -> SVector<f64, P> {
    SVector::from_column_slice(&R::DATA.parameter_sizes())
}

fn concurrent<R: Robot<N, P>, const N: usize, const P: usize>(
    asked: &AdaptationDocument,
    scheme: &SchemeDocument,
) -> AnyAdaptation<R, f64, N, P> {
    AnyAdaptation::Concurrent(ConcurrentLearning {
        filter: FilteredRegressor::new(asked.filter_rad_s.unwrap_or_default()),
        gain: adaptation_gain(scheme),
        weight: asked.weight.unwrap_or_default(),
        capacity: asked.stack.unwrap_or_default(),
        scale: sizes::<R, N, P>(),
    })
}

fn drem<R: Robot<N, P>, const N: usize, const P: usize>(asked: &AdaptationDocument) -> AnyAdaptation<R, f64, N, P> {
    let (rate, floor) = (asked.rate_per_s.unwrap_or_default(), asked.excitation_floor.unwrap_or_default());
    AnyAdaptation::Composite(CompositeAdaptation {
        filter: FilteredRegressor::new(asked.filter_rad_s.unwrap_or_default()),
        memory: PredictionMemory::new(1.0, asked.forgetting.unwrap_or_default()),
        law: CompositeLaw::Mixed(Mixing::new(rate, floor, sizes::<R, N, P>())),
    })
}

fn record_steps(document: &ScenarioDocument) -> Option<u64> {
    let asked = document.adaptation.as_ref().filter(|asked| asked.kind == AdaptationKind::Concurrent)?;
    Some(((asked.record_every_s? / document.integration.step_s).round() as u64).max(1))
}

fn elasticity<const N: usize>(effects: &EffectsDocument) -> Option<Elasticity<N>> {
    effects.elasticity.as_ref().map(|elasticity| Elasticity {
        stiffness: joints(Some(&elasticity.stiffness_nm_rad)),
        damping: joints(elasticity.damping_nms_rad.as_deref()),
        motor_inertia: joints(Some(&elasticity.motor_inertia_kgm2)),
        encoders: match elasticity.encoders {
            EncodersDocument::Motor => EncoderSide::Motor,
            EncodersDocument::Link => EncoderSide::Link,
        },
    })
}

fn sampling(effects: &EffectsDocument, step_s: f64) -> Option<(SampledControl, f64)> {
    let sampling = effects.sampling.as_ref().filter(|sampling| sampling.period_s != 0.0)?;
    let steps = |time_s: f64| (time_s / step_s).round() as u64;
    let clock =
        SampledControl { steps_per_period: steps(sampling.period_s).max(1), delay_steps: steps(sampling.delay_s) };
    Some((clock, sampling.period_s))
}

fn actuator<R: Robot<N, P>, const N: usize, const P: usize>(effects: &EffectsDocument) -> Option<Actuator<f64, N>> {
    if effects.torque_limit_nm.is_none() && effects.voltage_limit_v.is_none() {
        return None;
    }
    let by_voltage = effects.voltage_limit_v.map_or(f64::INFINITY, |volt| volt * R::DATA.torque_per_volt_nm);
    let by_torque = |joint: usize| effects.torque_limit_nm.as_ref().map_or(f64::INFINITY, |limits| limits[joint]);
    Some(Actuator { limit: SVector::from_fn(|joint, _| by_voltage.min(by_torque(joint))) })
}

fn load<R: Robot<N, P>, const N: usize, const P: usize>(effects: &EffectsDocument) -> Load<N, P> {
    let payloads = effects.payloads.iter().flatten().map(|payload| Payload {
        mass_kg: payload.mass_kg,
        from_s: payload.from_s.unwrap_or(0.0),
        to_s: payload.to_s.unwrap_or(f64::INFINITY),
    });
    Load {
        payloads: payloads.collect(),
        parameters_per_kg: payload_parameters(R::DATA).map(|change| SVector::from_column_slice(&change)),
        disturbance: effects.disturbance.as_ref().map(|disturbance| Disturbance {
            constant: joints(disturbance.constant_nm.as_deref()),
            sine: joints(disturbance.sine_nm.as_deref()),
            frequency_rad_s: disturbance.frequency_rad_s.unwrap_or(1.0),
            from_s: disturbance.from_s.unwrap_or(0.0),
            to_s: disturbance.to_s.unwrap_or(f64::INFINITY),
        }),
        stribeck: effects.stribeck.as_ref().map(|stribeck| Stribeck {
            excess: joints(Some(&stribeck.excess_nm)),
            velocity_rad_s: stribeck.velocity_rad_s,
        }),
    }
}

/// One number per joint; zeros where none are given.
fn joints<const N: usize>(numbers: Option<&[f64]>) -> SVector<f64, N> {
    numbers.map_or_else(SVector::zeros, SVector::from_column_slice)
}
