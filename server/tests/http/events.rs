//! Streams of events: from the beginning, from the middle, live, and to the end.

use crate::support::{App, long, short};
use serde_json::{Value, json};
use std::time::Duration;

/// Events of a stream that has ended.
fn read(body: &[u8]) -> Vec<(Option<u64>, String, Value)> {
    let text = std::str::from_utf8(body).unwrap();
    let blocks = text.split("\n\n").filter(|block| !block.is_empty() && !block.starts_with(':'));
    let field = |block: &str, name: &str| block.lines().find_map(|line| Some(line.strip_prefix(name)?.to_owned()));
    let event = |block: &str| {
        let data = serde_json::from_str(&field(block, "data: ").unwrap()).unwrap();
        (field(block, "id: ").map(|id| id.parse().unwrap()), field(block, "event: ").unwrap(), data)
    };
    blocks.map(event).collect()
}

#[tokio::test]
async fn an_ended_job_is_told_again_and_from_the_middle() {
    let app = App::new().await;
    let job = app.submit(&[short("proposed"), short("slotine_li")]).await;
    app.wait(&job, &["succeeded"]).await;
    let path = format!("{job}/events");
    let stream = app.ask("GET", &path, &[("accept-encoding", "gzip")]).await;
    assert_eq!((stream.header("content-type"), stream.header("content-encoding")), ("text/event-stream", ""));
    let events = read(&stream.body);
    let ids: Vec<_> = events.iter().filter_map(|event| event.0).collect();
    assert_eq!(ids, [1, 2, 3, 4, 5]);
    let told: Vec<_> = events.iter().map(|(_, kind, data)| (kind.as_str(), data["state"].as_str())).collect();
    assert_eq!((told[0], told[1]), (("state", Some("queued")), ("state", Some("running"))));
    assert_eq!((told[2], told[3]), (("summary", None), ("summary", None)));
    assert_eq!(told[4], ("state", Some("succeeded")));
    let report = app.get(&format!("{job}/result")).await.json()["reports"][0].take();
    let summary = events.iter().find(|event| event.2["scenario"] == 0).unwrap();
    assert_eq!(summary.2["report"]["trajectory_hash"], report["trajectory_hash"]);

    let rest = read(&app.ask("GET", &path, &[("last-event-id", "3")]).await.body);
    assert_eq!(rest, events[3..]);
    assert_eq!(read(&app.get(&format!("{path}?last_event_id=3")).await.body), events[3..]);
    assert_eq!(app.ask("GET", &path, &[("last-event-id", "5")]).await.status, 204);
    app.ask("GET", &path, &[("last-event-id", "6")]).await.problem(404, "/problems/http");
    for wrong in ["x", "-1", "1.5", "99999999999999999999"] {
        let problem = app.ask("GET", &path, &[("last-event-id", wrong)]).await;
        assert_eq!(problem.problem(400, "/problems/malformed-header")["header"], "Last-Event-ID");
    }
}

#[tokio::test]
async fn everyone_who_follows_a_running_job_hears_the_same() {
    let app = App::with(|config| config.queue.heartbeat_ms = 10).await;
    let mut slow = short("proposed");
    slow["integration"]["duration_s"] = json!(60.0);
    let scenarios: Vec<_> = (0..10)
        .map(|seed| {
            let mut scenario = slow.clone();
            scenario["seed"] = json!(seed);
            scenario
        })
        .collect();
    let job = app.submit(&scenarios).await;
    let path = format!("{job}/events");
    let streams = futures_util::future::join_all((0..20).map(|_| app.get(&path))).await;
    let numbered = |body: &[u8]| read(body).into_iter().filter(|event| event.0.is_some()).collect::<Vec<_>>();
    let first = numbered(&streams[0].body);
    assert_eq!(first.iter().filter(|event| event.1 == "summary").count(), 10);
    assert_eq!(first.last().unwrap().2["state"], "succeeded");
    assert!(streams.iter().all(|stream| numbered(&stream.body) == first));
    let progress: Vec<_> = read(&streams[0].body)
        .into_iter()
        .filter_map(|event| (event.1 == "progress").then(|| event.2["progress"].as_f64().unwrap()))
        .collect();
    assert!(progress.is_sorted() && progress.iter().all(|share| (0.0..1.0).contains(share)), "{progress:?}");
}

#[tokio::test]
async fn streams_end_with_the_job_with_its_deletion_and_with_the_server() {
    let app = App::new().await;
    let job = app.submit(&[long()]).await;
    app.wait(&job, &["running"]).await;
    let path = format!("{job}/events");
    let cancel = async {
        tokio::time::sleep(Duration::from_millis(300)).await;
        app.ask("POST", &format!("{job}/cancel"), &[]).await
    };
    let (stream, _) = tokio::join!(app.get(&path), cancel);
    assert_eq!(read(&stream.body).last().unwrap().2["state"], "canceled");

    let job = app.submit(&[long()]).await;
    app.wait(&job, &["running"]).await;
    let path = format!("{job}/events");
    let delete = async {
        tokio::time::sleep(Duration::from_millis(300)).await;
        app.ask("DELETE", &job, &[]).await
    };
    let (stream, _) = tokio::join!(app.get(&path), delete);
    assert_eq!(read(&stream.body).last().unwrap().2["state"], "canceled");

    let job = app.submit(&[long()]).await;
    app.wait(&job, &["running"]).await;
    let path = format!("{job}/events");
    let drain = async {
        tokio::time::sleep(Duration::from_millis(300)).await;
        app.state.drain();
    };
    let (stream, ()) = tokio::join!(app.get(&path), drain);
    assert!(read(&stream.body).iter().all(|event| event.2["state"] != "canceled"));
    app.get(&path).await.problem(503, "/problems/http");
}
