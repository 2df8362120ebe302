//! Examples in the description of the API: a request that works as it stands, and answers made by the same code as real ones.

use crate::api::catalog::{LimitsView, PresetView, RobotView, SchemeView, examples};
use crate::api::jobs::{JobView, JobsView};
use crate::config::Limits;
use crate::jobs::{Job, JobKind, JobState};
use adaptarm_core::robots::ROBOTS;
use adaptarm_core::scenario::{PRESETS, Scenario, ScenarioError, Scheme};
use jiff::Timestamp;
use serde_json::{Value, json};
use uuid::Uuid;

const JOB: Uuid = Uuid::from_u128(0x01a1_fb9b_43fb_71ef_9143_3df2_1c3d_c86e);
const ACCEPTED_AT: i64 = 1_763_685_419;

/// A job that runs for a fraction of a second.
pub(super) fn request() -> Value {
    json!({
        "kind": "study",
        "label": "first try",
        "spec": { "scenarios": [{
            "format": "adaptarm.scenario/1",
            "scheme": { "kind": "proposed" },
            "integration": { "duration_s": 0.5 },
            "recording": { "samples": 100 },
        }] },
    })
}

fn job(state: JobState) -> JobView {
    let at = |seconds| Timestamp::from_second(ACCEPTED_AT + seconds).unwrap_or_default();
    let ended = state.is_final();
    JobView::from(Job {
        id: JOB,
        owner: "local".to_owned(),
        kind: JobKind::Study,
        label: Some("first try".to_owned()),
        priority: 0,
        state,
        reason: (state == JobState::Canceled).then(|| "canceled by its owner".to_owned()),
        cached: false,
        attempts: i64::from(ended),
        created_at: at(0),
        started_at: ended.then(|| at(1)),
        finished_at: ended.then(|| at(2)),
        scenarios: 1,
        scenarios_done: i64::from(state == JobState::Succeeded),
        steps_total: 500,
        steps_done: if state == JobState::Succeeded { 500 } else { 0 },
    })
}

fn result() -> Result<Value, ScenarioError> {
    let mut document = Scheme::Proposed.paper();
    (document.integration.duration_s, document.recording.samples) = (0.5, 100);
    let report = Scenario::new(document)?.run().report;
    Ok(json!({ "format": "adaptarm.study/1", "complete": true, "state": "succeeded", "reports": [report] }))
}

/// What this operation answers with this status, if it is JSON or text.
pub(super) fn answer(operation: &str, status: u16) -> Result<Option<Value>, ScenarioError> {
    Ok(Some(match (operation, status) {
        ("submit_job" | "show_job", 200) => json!(job(JobState::Succeeded)),
        ("submit_job", 202) => json!(job(JobState::Queued)),
        ("cancel_job", 200) => json!(job(JobState::Canceled)),
        ("list_jobs", 200) => json!(JobsView { jobs: vec![job(JobState::Succeeded)], next_cursor: None }),
        ("result", 200) => result()?,
        ("scenario", 200) => json!(Scheme::Proposed.paper()),
        ("presets", 200) => json!([PresetView::new(&PRESETS[0])?]),
        ("preset", 200) => json!(PresetView::new(&PRESETS[0])?),
        ("robots", 200) => json!([RobotView::from(ROBOTS[0])]),
        ("schemes", 200) => json!([SchemeView::new(Scheme::SlotineLi)?]),
        ("limits", 200) => json!(LimitsView::from(&Limits::default())),
        ("alive", 200) => json!({ "status": "alive", "version": env!("CARGO_PKG_VERSION") }),
        ("ready", 200) => json!({ "status": "ready", "unfinished_jobs": 0 }),
        ("follow_job", 200) => {
            let state = json!({ "id": JOB, "state": "running", "at": "2025-11-21T00:37:00Z" });
            json!({ "id": "2", "event": "state", "data": state.to_string() })
        }
        ("metrics", 200) => json!("# TYPE adaptarm_queue_depth gauge\nadaptarm_queue_depth{state=\"queued\"} 0\n"),
        ("experiments", 200) => json!(examples().unwrap_or_default().into_iter().take(1).collect::<Vec<_>>()),
        ("experiment_schema", 200) => json!({ "title": "ExperimentDocument", "type": "object" }),
        ("file", 200) => {
            json!("run,point,condition,base,outcome,at_s,index_e_deg\n0,0,nominal,Proposed,completed,,0.0856\n")
        }
        ("series", 200) => json!("t_s,e_deg_1\n0,0\n0.005,-0.00021\n"),
        _ => return Ok(None),
    }))
}
