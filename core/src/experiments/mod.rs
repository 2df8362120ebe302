//! Experiments: questions put to several runs at once.
//!
//! `document` is what people write, `resolve` checks it into an [`Experiment`], whose runs can be planned and made anywhere
//! (`layout`, `fields`); [`Results`] folds their rows in any order and [`Summary`] says what they say. A [`Tuning`] asks for
//! its runs step by step. Nothing here knows threads or files.

mod cmaes;
mod distribution;
mod document;
mod experiment;
mod fields;
mod latin;
mod layout;
mod limits;
mod normal;
mod nsga2;
mod objective;
mod paired;
pub mod replication;
mod resolve;
mod results;
mod row;
mod sobol;
mod statistics;
mod stream;
mod summary;
mod tuning;

// Exercises draw, change and name the same things.
pub(crate) use distribution::Distribution;
pub(crate) use fields::{Change, Tree};
pub(crate) use limits::{check_count, check_range, conflict, unknown};
pub(crate) use resolve::{changes, check_fields, random_fields};
pub(crate) use statistics::quantile;
pub(crate) use stream::{Purpose, Stream};

pub use distribution::{DistributionDocument, DistributionKind};
pub use document::{
    Aggregate, AxisDocument, BaseDocument, CompareDocument, ConditionDocument, ConstraintDocument, EXPERIMENT_FORMAT,
    ExperimentDocument, ExperimentKind, GoalDocument, MonteCarloDocument, ObjectiveDocument, PlantsDocument, RandomFieldDocument,
    SettingDocument, SweepDesign, SweepDocument, TuningDocument, VariableDocument,
};
pub use experiment::{Experiment, PlannedRun};
pub use layout::Place;
pub use limits::{EXPERIMENT_LIMITS, ExperimentLimits};
pub use paired::{PairSummary, Ranked, Ranking};
pub use results::{FoldError, Results};
pub use row::{ResultColumns, Row, RowOutcome};
pub use statistics::{Share, Statistics};
pub use summary::{GroupSummary, MetricSummary, Refusal, Sensitivity, Summary};
pub use tuning::{Candidate, Front, FrontCandidate, Generation, Tuning, TuningError, TuningSummary, Validation};
