//! Samples, figures and results as files: tags, parts, formats, compression.

use crate::support::{Answer, App, short};
use adaptarm::series::parquet::decode;

async fn ready() -> (App, String) {
    let app = App::new().await;
    let job = app.submit(&[short("proposed")]).await;
    app.wait(&job, &["succeeded"]).await;
    (app, job)
}

/// Compression once asked for more after the last piece, which the pieces answered with a panic.
#[tokio::test]
async fn compressed_samples_come_to_their_end() {
    let (app, job) = ready().await;
    let path = format!("{job}/result/series");
    let plain = app.get(&path).await;
    let compressed = app.ask("GET", &path, &[("accept-encoding", "gzip")]).await;
    assert_eq!(compressed.header("content-encoding"), "gzip");
    // RFC 1952: the last four bytes are the length of what was compressed.
    let length = compressed.body.last_chunk::<4>().map(|bytes| u32::from_le_bytes(*bytes) as usize);
    assert_eq!(length, Some(plain.body.len()));
}

#[tokio::test]
async fn what_a_client_has_is_not_sent_again_and_what_broke_off_goes_on() {
    let (app, job) = ready().await;
    for path in
        ["series", "series?format=npz&every=10", "series?format=parquet&columns=t_s,e_deg_1", "figures/torques.png"]
    {
        let path = format!("{job}/result/{path}");
        let whole = app.get(&path).await;
        let tag = whole.header("etag").to_owned();
        assert_eq!((whole.status.as_u16(), tag.starts_with('"')), (200, true), "{path}");
        let known = app.ask("GET", &path, &[("if-none-match", &tag)]).await;
        assert_eq!((known.status.as_u16(), known.body.len()), (304, 0), "{path}");
        let rest = app.ask("GET", &path, &[("range", "bytes=100-"), ("if-range", &tag)]).await;
        assert_eq!((rest.status.as_u16(), &rest.body[..]), (206, &whole.body[100..]), "{path}");
        let behind = app.ask("GET", &path, &[("range", "bytes=99999999-")]).await;
        behind.problem(416, "/problems/http");
    }
    let path = format!("{job}/result");
    let tag = app.get(&path).await.header("etag").to_owned();
    assert_eq!(app.ask("GET", &path, &[("if-none-match", &tag)]).await.status, 304);
}

#[tokio::test]
async fn selections_that_make_no_sense_are_refused() {
    let (app, job) = ready().await;
    let ask = async |rest: &str| -> Answer { app.get(&format!("{job}/result/{rest}")).await };
    ask("series?scenario=3").await.problem(404, "/problems/http");
    ask("series?scenario=x").await.problem(400, "/problems/http");
    ask("series?colour=red").await.problem(400, "/problems/http");
    for (query, kind) in [
        ("columns=q", "/problems/unknown"),
        ("format=xlsx", "/problems/unknown"),
        ("every=0", "/problems/out-of-range"),
        ("columns=t_s,t_s", "/problems/conflict"),
    ] {
        let problem = ask(&format!("series?{query}")).await.problem(422, kind);
        assert_eq!(problem["parameter"], query.split('=').next().unwrap());
    }
    let problem = ask("figures/nothing.svg").await.problem(404, "/problems/http");
    assert!(problem["allowed"].as_str().unwrap().contains("torques.svg"));
}

#[tokio::test]
async fn figures_are_pictures() {
    let (app, job) = ready().await;
    for (name, media_type, magic) in
        [("torques.svg", "image/svg+xml", &b"<svg "[..]), ("torques.png", "image/png", b"\x89PNG\r\n")]
    {
        let picture = app.get(&format!("{job}/result/figures/{name}")).await;
        assert_eq!(picture.header("content-type"), media_type);
        assert!(picture.body.starts_with(magic), "{name}");
    }
}

#[tokio::test]
async fn diagnostics_tell_what_the_samples_do() {
    let (app, job) = ready().await;
    let address = format!("{job}/result/diagnostics?scenario=0");
    let found = app.get(&address).await;
    assert_eq!((found.status.as_u16(), found.header("content-type")), (200, "application/json"));
    let again = app.ask("GET", &address, &[("if-none-match", found.header("etag"))]).await;
    assert_eq!(again.status.as_u16(), 304);
    let found = found.json();
    assert_eq!(found["format"], "adaptarm.diagnostics/1");
    assert_eq!(found["desired_excitation"]["eigenvalues_n2m2"].as_array().unwrap().len(), 18);
    assert!(found["energy"]["largest_gap_j"].as_f64().unwrap() < 0.1);
    app.get(&format!("{job}/result/diagnostics?scenario=7")).await.problem(404, "/problems/http");
}

#[tokio::test]
async fn the_stored_samples_are_those_that_were_computed() {
    let (app, job) = ready().await;
    let report = app.get(&format!("{job}/result")).await.json()["reports"][0].take();
    let parquet = app.get(&format!("{job}/result/series?format=parquet")).await;
    assert_eq!(parquet.header("content-type"), "application/vnd.apache.parquet");
    let stored =
        app.state.store.scenario(job.rsplit('/').next().unwrap().parse().unwrap(), 0).await.unwrap().unwrap().0;
    let version = stored.core_version.unwrap();
    let recording = app.state.results.get(&stored.hash, &version, &stored.checksum.unwrap()).await.unwrap();
    assert_eq!(report["trajectory_hash"], recording.hash());
    // What is sent is a table for people; what is stored can also be read back.
    assert!(decode(parquet.body.into()).is_err());
}
