//! The description of the API as OpenAPI 3.1: operations from the handlers, schemas from the types that they read and
//! write, and a scenario's schema from the core.

mod errors;
mod examples;
mod types;

pub use types::{
    AnyResult, Diagnostics, Experiment, ExperimentLimits, Gain, Health, Index, PresetNames, Report, Scenario,
    ScenarioLimits, ServerSentEvent, StudyResult,
};

use crate::routes;
use crate::series::Format;
use adaptarm_core::recording::Columns;
use adaptarm_core::robots::ROBOTS;
use serde_json::{Value, json};
use std::sync::LazyLock;

/// The document.
pub fn document() -> &'static Value {
    static DOCUMENT: LazyLock<Value> = LazyLock::new(build);
    &DOCUMENT
}

fn build() -> Value {
    // Handlers and types always become JSON.
    let mut document = serde_json::to_value(routes::described()).unwrap_or_default();
    document["info"] = json!({
        "title": "adaptarm",
        "version": env!("CARGO_PKG_VERSION"),
        "description": "Jobs that simulate adaptive control of robot arms. A server on a loopback address needs no token; \
                        on any other, jobs and metrics need one.",
        "license": { "name": "MIT OR Apache-2.0", "identifier": "MIT OR Apache-2.0" },
    });
    document["servers"] = json!([{ "url": "/", "description": "This server." }]);
    document["tags"] = json!([
        { "name": "jobs", "description": "Submitting, following and stopping work." },
        { "name": "results", "description": "What jobs gave: reports, samples, figures." },
        { "name": "catalog", "description": "What exists, for building a form." },
        { "name": "server", "description": "For whoever watches over the server." },
    ]);
    if let Some(components) = document["components"]["schemas"].as_object_mut() {
        types::merge(components);
        components.insert("Problem".to_owned(), errors::schema());
    }
    document["components"]["securitySchemes"] = json!({ "token": {
        "type": "http",
        "scheme": "bearer",
        "bearerFormat": "adaptarm_<id>_<secret>",
        "description": "Made by `adaptarm token create`; needed unless the server listens on a loopback address.",
    } });
    for (_, item) in document["paths"].as_object_mut().into_iter().flatten() {
        for (method, operation) in item.as_object_mut().into_iter().flatten() {
            complete(operation, method == "get");
        }
    }
    document
}

/// Adds what all operations have in common: errors, examples, who may ask.
fn complete(operation: &mut Value, safe: bool) {
    let name = operation["operationId"].as_str().unwrap_or_default().to_owned();
    for (status, response) in operation["responses"].as_object_mut().into_iter().flatten() {
        let Some(example) = status.parse().ok().and_then(|status| examples::answer(&name, status).ok()?) else {
            continue;
        };
        // The first form of an answer is the one that comes without asking for another.
        let mut forms = response["content"].as_object_mut().into_iter().flatten();
        let form = forms.find(|(media_type, _)| media_type.starts_with("text/") || media_type.ends_with("json"));
        if let Some((_, form)) = form {
            form["example"] = example;
        }
    }
    for parameter in operation.get_mut("parameters").and_then(Value::as_array_mut).into_iter().flatten() {
        refine(parameter);
    }
    if operation.get("requestBody").is_some() {
        operation["requestBody"]["content"]["application/json"]["example"] = examples::request();
    }
    for status in errors::of_operation(&name, safe) {
        operation["responses"][status.to_string()] = errors::response(status);
    }
    let guarded = operation["responses"].get("401").is_some();
    // Without a token where none is needed, or with one.
    operation["security"] = if guarded { json!([{}, { "token": [] }]) } else { json!([{}]) };
}

/// Says of a parameter what its type in the handler does not.
fn refine(parameter: &mut Value) {
    // An absent parameter is absent, not null.
    if let Some(types) = parameter.pointer_mut("/schema/type").and_then(Value::as_array_mut) {
        types.retain(|name| name != "null");
        if let [name] = &types[..] {
            parameter["schema"]["type"] = name.clone();
        }
    }
    match parameter["name"].as_str() {
        Some("scenario") => parameter["schema"]["maximum"] = json!(u32::MAX),
        Some("format") => parameter["schema"]["enum"] = json!(Format::ALL.map(Format::id)),
        Some("columns") => {
            let columns = ROBOTS
                .iter()
                .flat_map(|robot| Columns { joints: robot.joint_count(), parameters: robot.parameter_count() }.names());
            let columns: Vec<_> = columns.collect();
            parameter["schema"] = json!({ "type": "array", "items": { "type": "string", "enum": columns }, "uniqueItems": true, "minItems": 1 });
            (parameter["style"], parameter["explode"]) = (json!("form"), json!(false));
            parameter["example"] = json!(["t_s", "e_deg_1"]);
        }
        _ => {}
    }
}
