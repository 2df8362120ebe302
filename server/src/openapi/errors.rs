//! Errors in the description of the API: which operation can answer with which, and an example of each.

use serde_json::{Value, json};

/// Operations by name, and the statuses of errors that are their own.
const OWN: &[(&str, &[u16])] = &[
    ("preset", &[400, 404]),
    ("limits", &[]),
    ("ready", &[503]),
    ("metrics", &[401, 403, 429, 503]),
    ("submit_job", &[400, 401, 403, 413, 415, 422, 429, 503]),
    ("list_jobs", &[400, 401, 403, 404, 422, 429, 503]),
    ("show_job", &[400, 401, 403, 404, 429, 503]),
    ("delete_job", &[400, 401, 403, 404, 429, 503]),
    ("cancel_job", &[400, 401, 403, 404, 429, 503]),
    ("follow_job", &[400, 401, 403, 404, 429, 503]),
    ("result", &[400, 401, 403, 404, 409, 429, 503]),
    ("scenario", &[400, 401, 403, 404, 429, 503]),
    ("series", &[400, 401, 403, 404, 409, 410, 416, 422, 429, 503]),
    ("file", &[400, 401, 403, 404, 409, 410, 416, 429, 503]),
    ("diagnostics", &[400, 401, 403, 404, 409, 410, 429, 503]),
    ("figure", &[400, 401, 403, 404, 409, 410, 416, 422, 429, 503]),
];

/// What any operation can answer: too late, under a wrong name, by a failure of the server.
const EVERYWHERE: &[u16] = &[408, 421, 500];

/// What the form of every error is (RFC 9457).
pub(super) fn schema() -> Value {
    json!({
        "type": "object",
        "description": "An error (RFC 9457). Fields beside those named here belong to the `type`; docs/api.md lists them.",
        "properties": {
            "type": { "type": "string", "format": "uri-reference", "description": "Which kind of error; stable." },
            "title": { "type": "string", "description": "The kind in words." },
            "status": { "type": "integer", "minimum": 400, "maximum": 599, "description": "HTTP status." },
            "detail": { "type": "string", "description": "What is wrong this time." },
            "instance": { "type": "string", "format": "uri", "description": "This answer, as the server's log names it." },
            "pointer": { "type": "string", "format": "json-pointer", "description": "Place in the body." },
            "parameter": { "type": "string", "description": "Parameter of the query." },
        },
        "required": ["type", "title", "status", "detail", "instance"],
    })
}

/// Statuses of errors that this operation can answer with.
pub(super) fn of_operation(name: &str, safe: bool) -> Vec<u16> {
    let own = OWN.iter().find(|(operation, _)| *operation == name).map_or(&[][..], |(_, own)| own);
    let mut all: Vec<_> = own.iter().chain(EVERYWHERE).copied().collect();
    if !safe {
        // From pages of other sites.
        all.push(403);
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// The description of the answer with this status.
pub(super) fn response(status: u16) -> Value {
    let mut response = json!({
        "description": about(status),
        "content": { "application/problem+json": {
            "schema": { "$ref": "#/components/schemas/Problem" },
            "example": example(status),
        } },
    });
    let header = match status {
        401 | 403 => {
            Some(("WWW-Authenticate", json!({ "type": "string" }), "What kind of token is needed, if that is missing."))
        }
        429 | 503 => Some(("Retry-After", json!({ "type": "integer", "minimum": 1 }), "When to try again, s.")),
        416 => Some(("Content-Range", json!({ "type": "string" }), "How long the file is.")),
        _ => None,
    };
    if let Some((name, schema, description)) = header {
        response["headers"] = json!({ name: { "schema": schema, "description": description } });
    }
    response
}

fn about(status: u16) -> &'static str {
    match status {
        400 => "The body is not JSON, or a header, the query or the path cannot be read.",
        401 => "The server is not on a loopback address, and there is no good token.",
        403 => "The token lacks a scope, or a page of another site sent this.",
        404 => "There is no such thing, or it is another user's.",
        408 => "The request took too long.",
        409 => "There is nothing to read yet.",
        410 => "It is no longer kept.",
        413 => "The body is too large.",
        415 => "The body is not declared as JSON.",
        416 => "The file has none of these bytes.",
        421 => "`Host` names another machine.",
        422 => "The request is understood, but something in it is not allowed: `pointer` or `parameter` says what.",
        429 => "Too many requests, too many wrong tokens, or more than one user may have.",
        503 => "The database or the stored results cannot be used at the moment, or the server is shutting down.",
        _ => "The server failed.",
    }
}

fn example(status: u16) -> Value {
    let (kind, title, detail, more) = match status {
        400 => (
            "malformed-json",
            "Not JSON",
            "not JSON: EOF while parsing an object at line 1 column 1",
            json!({ "pointer": "", "line": 1, "column": 1 }),
        ),
        401 => ("token", "A token is needed", "the token is not known", json!({})),
        403 => (
            "scope",
            "The token does not allow this",
            "the token lacks the scope jobs:write, which this request needs",
            json!({ "scope": "jobs:write" }),
        ),
        404 => ("http", "Not Found", "there is no job \"01a1fb9b-43fb-71ef-9143-3df21c3dc86e\"", json!({})),
        408 => ("http", "Request Timeout", "the request did not arrive or was not answered in time", json!({})),
        409 => (
            "not-ready",
            "No result",
            "the job is running: its result can be read when it has ended",
            json!({ "state": "running" }),
        ),
        410 => (
            "gone",
            "No longer kept",
            "the samples are not kept any more; the same scenario gives the same samples again",
            json!({}),
        ),
        413 => ("too-large", "Body too large", "a body may have 8388608 bytes", json!({ "max_bytes": 8_388_608 })),
        415 => ("media-type", "Not declared as JSON", "send the header `Content-Type: application/json`", json!({})),
        416 => (
            "http",
            "Range Not Satisfiable",
            "the file has 34812 bytes, and none of them is in the range that is asked for",
            json!({}),
        ),
        421 => (
            "wrong-host",
            "Not a name of this server",
            "this server answers only as localhost, 127.0.0.1 or [::1]; check the address or the Host header",
            json!({}),
        ),
        422 => (
            "out-of-range",
            "A number is outside its allowed range",
            "spec.scenarios[0].integration.step_s: -1 is outside the allowed range 0.000001 to 0.1 s",
            json!({ "pointer": "/spec/scenarios/0/integration/step_s", "value": -1.0, "min": 1e-6, "max": 0.1, "unit": "s" }),
        ),
        429 => (
            "rate-limit",
            "Too many requests",
            "more than 600 requests per minute with this token; try again in 1 s",
            json!({ "per_minute": 600 }),
        ),
        503 => (
            "unavailable",
            "Not available",
            "the database cannot be used at the moment; try again in a while",
            json!({}),
        ),
        _ => ("http", "Internal Server Error", "the server failed; its log names this request", json!({})),
    };
    let mut problem = json!({
        "type": format!("/problems/{kind}"),
        "title": title,
        "status": status,
        "detail": detail,
        "instance": "urn:uuid:01a1fb9b-4484-7218-8d0e-06c4eac1a16c",
    });
    if let (Some(problem), Value::Object(more)) = (problem.as_object_mut(), more) {
        problem.extend(more);
    }
    problem
}
