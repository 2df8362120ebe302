//! Types of the core as the description of the API names them. Their schemas come from the core itself (schemars), which
//! knows every range and length.

use adaptarm_core::{experiments, scenario as core};
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use utoipa::openapi::{ObjectBuilder, RefOr, Schema};
use utoipa::{PartialSchema, ToSchema};

/// Declares names for types of the core.
macro_rules! of_core {
    ($($(#[doc = $doc:literal])+ $name:ident = $type:ty;)+) => {
        $(
            $(#[doc = $doc])+
            #[derive(Debug)]
            pub struct $name;

            impl PartialSchema for $name {
                /// Stands in until [`merge`] puts the core's schema here.
                fn schema() -> RefOr<Schema> {
                    ObjectBuilder::new().into()
                }
            }

            impl ToSchema for $name {}
        )+

        /// Puts the core's schemas, and those that they refer to, among the components.
        pub(super) fn merge(components: &mut Map<String, Value>) {
            let settings = SchemaSettings::draft2020_12().with(|settings| {
                settings.definitions_path = "/components/schemas".into();
                settings.meta_schema = None;
            });
            let mut generator = settings.into_generator();
            $(
                let mut schema = <$type as schemars::JsonSchema>::json_schema(&mut generator);
                schema.remove("title");
                components.insert(stringify!($name).to_owned(), schema.into());
            )+
            for (name, schema) in generator.take_definitions(true) {
                components.insert(name, schema);
            }
        }
    };
}

of_core! {
    /// A scenario document.
    Scenario = core::ScenarioDocument;
    /// An experiment document.
    Experiment = experiments::ExperimentDocument;
    /// Bounds on experiments.
    ExperimentLimits = experiments::ExperimentLimits;
    /// What a sweep, a Monte Carlo study or a comparison says.
    ExperimentSummary = experiments::Summary;
    /// What a tuning found.
    TuningSummary = experiments::TuningSummary;
    /// The report on one scenario.
    Report = core::Report;
    /// What the samples of one scenario tell of excitation, stability and energy.
    Diagnostics = adaptarm_core::diagnostics::Diagnostics;
    /// Identifier, title and description of a preset.
    PresetNames = core::Preset;
    /// What is known of a gain.
    Gain = core::GainInfo;
    /// Bounds on one scenario.
    ScenarioLimits = core::Limits;
}

/// The result of a study.
#[derive(Debug, ToSchema)]
#[expect(dead_code, reason = "handlers write it down piece by piece; this is its form")]
pub struct StudyResult {
    /// `adaptarm.study/1`.
    #[schema(pattern = "^adaptarm\\.study/1$")]
    format: String,
    /// Whether there is a report on every scenario.
    complete: bool,
    /// Where the job stands.
    state: crate::jobs::JobState,
    /// One per scenario, in their order; null where a failed or canceled job has none.
    reports: Vec<Option<Report>>,
}

/// A result.
#[derive(Debug, ToSchema)]
#[serde(untagged)]
pub enum AnyResult {
    /// Of a study.
    Study(StudyResult),
    /// Of an experiment.
    Experiment(ExperimentResult),
}

/// The result of an experiment, as far as it has come.
#[derive(Debug, ToSchema)]
#[expect(dead_code, reason = "handlers write it down as it is; this is its form")]
pub struct ExperimentResult {
    /// `adaptarm.experiment_result/1`.
    #[schema(pattern = "^adaptarm\\.experiment_result/1$")]
    format: String,
    /// Whether all of it has been computed.
    complete: bool,
    /// Where the job stands.
    state: crate::jobs::JobState,
    /// What the rows say: all of them, or those that there were when they were last summed up; null before.
    summary: Option<AnySummary>,
    /// Files that can be read at `/result/files/`.
    files: Vec<String>,
    /// Figures that can be read at `/result/figures/`, as `.svg` or `.png`.
    figures: Vec<String>,
    /// Metrics that they can show.
    metrics: Vec<String>,
}

/// A summary.
#[derive(Debug, ToSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "handlers write it down as it is; this is its form")]
pub enum AnySummary {
    /// Of a sweep, a Monte Carlo study or a comparison.
    Experiment(ExperimentSummary),
    /// Of a tuning.
    Tuning(TuningSummary),
}

/// What the API offers.
#[derive(Debug, ToSchema)]
#[expect(dead_code, reason = "the handler writes it down as it is; this is its form")]
pub struct Index {
    /// `adaptarm`.
    name: String,
    /// Version of the server.
    version: String,
    /// Addresses by what they lead to.
    links: std::collections::BTreeMap<String, String>,
}

/// A sign of life.
#[derive(Debug, ToSchema)]
#[expect(dead_code, reason = "the handlers write it down as it is; this is its form")]
pub struct Health {
    /// `alive` or `ready`.
    status: String,
    /// Version of the server.
    version: Option<String>,
    /// Jobs waiting or running, of all users.
    unfinished_jobs: Option<i64>,
}

/// One of the events of a stream.
#[derive(Debug, ToSchema)]
#[expect(dead_code, reason = "the stream writes it line by line; this is its form")]
pub struct ServerSentEvent {
    /// Number of the event within its job; absent where the event need not come again.
    id: Option<String>,
    /// `state`, `summary`, `partial` or `progress`.
    #[schema(pattern = "^(state|summary|partial|progress)$")]
    event: String,
    /// JSON.
    data: String,
}
