//! `adaptarm serve`: the page, a study from end to end, bad requests, signals.

use crate::bad_scenarios::{BAD, Bad, MINIMAL};
use adaptarm_tests::{Server, binary};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::Command;
use std::time::{Duration, Instant};
use ureq::http;

/// A client that takes every status as an answer, and nothing encoded unless asked.
fn client() -> ureq::Agent {
    ureq::Agent::config_builder()
        .http_status_as_error(false)
        .timeout_global(Some(Duration::from_mins(1)))
        .build()
        .into()
}

type Response = http::Response<ureq::Body>;

fn get(url: &str) -> Result<Response> {
    Ok(client().get(url).call()?)
}

fn post(url: &str, body: &[u8]) -> Result<Response> {
    Ok(client().post(url).header("content-type", "application/json").send(body)?)
}

fn header<'a>(response: &'a Response, name: &str) -> &'a str {
    response.headers().get(name).and_then(|value| value.to_str().ok()).unwrap_or_default()
}

fn body(mut response: Response) -> Result<Value> {
    Ok(serde_json::from_slice(&response.body_mut().read_to_vec()?)?)
}

fn jobs(server: &Server) -> String {
    format!("{}/api/v1/jobs", server.url)
}

/// The job once it has ended.
fn wait(server: &Server, location: &str) -> Result<Value> {
    let deadline = Instant::now() + Duration::from_mins(1);
    while Instant::now() < deadline {
        let job = body(get(&format!("{}{location}", server.url))?)?;
        if job["finished_at"].is_string() {
            return Ok(job);
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    anyhow::bail!("{location} did not end")
}

fn kill(signal: &str, id: u32) -> Result<()> {
    ensure!(Command::new("kill").args([signal, &id.to_string()]).status()?.success());
    Ok(())
}

#[test]
fn a_study_over_http_gives_the_hashes_of_the_command_line() -> Result<()> {
    let server = Server::start(&[])?;
    let names = ["proposed", "tang_arteaga", "slotine_li"];
    let scenarios: Vec<Value> =
        names.iter().map(|name| json!({"format": "adaptarm.scenario/1", "scheme": {"kind": name}})).collect();
    let request = json!({ "kind": "study", "spec": { "scenarios": scenarios } });
    let accepted = post(&jobs(&server), request.to_string().as_bytes())?;
    assert_eq!(accepted.status(), 202);
    let location = header(&accepted, "location").to_owned();
    let job = wait(&server, &location)?;
    assert_eq!((&job["state"], &job["progress"]), (&json!("succeeded"), &json!(1.0)));
    let result = body(get(&format!("{}{location}/result", server.url))?)?;
    assert_eq!(result["format"], "adaptarm.study/1");
    for (n, name) in names.iter().enumerate() {
        let output = Command::new(binary()?).args(["run", "--preset", name]).output()?;
        assert_eq!(result["reports"][n], serde_json::from_slice::<Value>(&output.stdout)?, "{name}");
    }
    Ok(())
}

#[test]
fn bad_scenarios_are_refused_and_the_server_goes_on() -> Result<()> {
    let server = Server::start(&[])?;
    for Bad { name, document, names, status } in BAD {
        let mut request = br#"{"kind":"study","spec":{"scenarios":["#.to_vec();
        request.extend(document());
        request.extend(b"]}}");
        let response = post(&jobs(&server), &request).with_context(|| *name)?;
        let answered = response.status().as_u16();
        assert_eq!(header(&response, "content-type"), "application/problem+json");
        let problem = body(response)?;
        // Nothing in the place of a scenario leaves a study without any.
        let expected = if *name == "empty" { 422 } else { *status };
        ensure!(answered == expected, "{name}: {answered} {problem}");
        assert_eq!(problem["status"], answered);
        if answered == 422 && !names.is_empty() {
            let pointer = problem["pointer"].as_str().unwrap_or_default();
            assert!(pointer.starts_with("/spec/scenarios/0") || *name == "very long name", "{name}: {problem}");
        }
    }
    for body in [vec![b' '; 100_000_000], vec![b'x'; (8 << 20) + 1]] {
        assert_eq!(post(&jobs(&server), &body)?.status(), 413);
    }
    assert_eq!(get(&format!("{}/healthz", server.url))?.status(), 200);
    let good = format!(r#"{{"kind":"study","spec":{{"scenarios":[{MINIMAL}]}}}}"#);
    assert_eq!(post(&jobs(&server), good.as_bytes())?.status(), 202);
    Ok(())
}

#[test]
fn bytes_that_are_not_http_harm_nobody() -> Result<()> {
    let server = Server::start(&[])?;
    let address = server.url.trim_start_matches("http://");
    for bytes in
        [&b"\x16\x03\x01\x02\x00"[..], b"GARBAGE\r\n\r\n", b"GET / HTTP/1.1\r\nHost: localhost\r\nX: \0\r\n\r\n"]
    {
        let mut stream = TcpStream::connect(address)?;
        stream.write_all(bytes)?;
        stream.shutdown(std::net::Shutdown::Write)?;
        // Answered or hung up on: both will do.
        let _ = stream.read_to_end(&mut Vec::new());
    }
    assert_eq!(get(&format!("{}/healthz", server.url))?.status(), 200);
    Ok(())
}

/// Who sends the body after the head, as many clients do, reads why it was refused and may go on.
#[test]
fn a_refusal_waits_for_the_body_that_it_did_not_want() -> Result<()> {
    let server = Server::start(&[])?;
    let mut stream = TcpStream::connect(server.url.trim_start_matches("http://"))?;
    stream.set_read_timeout(Some(Duration::from_mins(1)))?;
    let mut ask = |head: &str, body: &str| -> Result<String> {
        write!(stream, "{head}\r\nContent-Length: {}\r\n\r\n", body.len())?;
        // The server has made up its mind when the body comes.
        std::thread::sleep(Duration::from_millis(200));
        stream.write_all(body.as_bytes())?;
        let mut answer = Vec::new();
        let mut some = [0; 4096];
        loop {
            let text = String::from_utf8_lossy(&answer).to_ascii_lowercase();
            if let Some((head, body)) = text.split_once("\r\n\r\n") {
                let length = head.split_once("content-length: ").and_then(|(_, after)| after.lines().next());
                if body.len() >= length.context("no length")?.parse::<usize>()? {
                    return Ok(head.lines().next().unwrap_or_default().to_owned());
                }
            }
            let count = stream.read(&mut some)?;
            ensure!(count > 0, "the connection ended after {text:?}");
            answer.extend_from_slice(&some[..count]);
        }
    };
    let job = "POST /api/v1/jobs HTTP/1.1\r\nContent-Type:";
    for (head, status) in [
        (format!("{job} application/json\r\nHost: evil.example"), 421),
        (format!("{job} application/json\r\nHost: localhost\r\nOrigin: http://evil.example"), 403),
        (format!("{job} text/plain\r\nHost: localhost"), 415),
        ("PUT /nowhere HTTP/1.1\r\nHost: localhost".to_owned(), 404),
    ] {
        let answer = ask(&head, MINIMAL)?;
        ensure!(answer.starts_with(&format!("http/1.1 {status}")), "{head}: {answer}");
    }
    Ok(())
}

#[test]
fn the_page_comes_compressed_tagged_and_bound_to_itself() -> Result<()> {
    let server = Server::start(&[])?;
    let plain = get(&server.url)?;
    assert_eq!(plain.status(), 200);
    assert!(header(&plain, "content-type").starts_with("text/html"));
    assert!(
        header(&plain, "content-security-policy").starts_with("default-src 'none'; script-src 'self' 'wasm-unsafe")
    );
    assert_eq!(header(&plain, "cache-control"), "no-cache");
    let tag = header(&plain, "etag").to_owned();
    ensure!(tag.starts_with('"'), "no entity tag");
    let unchanged = client().get(&server.url).header("if-none-match", &tag).call()?;
    assert_eq!(unchanged.status(), 304);
    assert_eq!(header(&unchanged, "etag"), tag);
    assert!(header(&unchanged, "content-security-policy").contains("frame-ancestors 'none'"));
    let compressed = client().get(&server.url).header("accept-encoding", "br").call()?;
    assert_eq!(header(&compressed, "content-encoding"), "br");
    let length = |response: &Response| header(response, "content-length").parse::<usize>();
    assert!(length(&compressed)? < length(&plain)?);
    Ok(())
}

#[test]
fn the_module_is_served_as_webassembly() -> Result<()> {
    let server = Server::start(&[])?;
    let url = format!("{}/generated/adaptarm_web_bg.wasm", server.url);
    let mut module = get(&url)?;
    assert_eq!(module.status(), 200);
    assert_eq!(header(&module, "content-type"), "application/wasm");
    let bytes = module.body_mut().read_to_vec()?;
    assert_eq!(bytes[..4], *b"\0asm");
    let compressed = client().get(&url).header("accept-encoding", "br, gzip").call()?;
    assert_eq!(header(&compressed, "content-encoding"), "br");
    assert!(header(&compressed, "content-length").parse::<usize>()? < bytes.len() / 2);
    Ok(())
}

#[test]
fn sigterm_answers_what_is_under_way_and_ends_the_process() -> Result<()> {
    let mut server = Server::start(&[])?;
    let long = MINIMAL.replace("\"}}", "\"},\"integration\":{\"duration_s\":90000}}");
    let request = format!(r#"{{"kind":"study","spec":{{"scenarios":[{long}]}}}}"#);
    assert_eq!(post(&jobs(&server), request.as_bytes())?.status(), 202);
    // A request of which half has arrived when the signal comes.
    let address = server.url.trim_start_matches("http://").to_owned();
    let body = format!(r#"{{"kind":"study","spec":{{"scenarios":[{MINIMAL}]}},"label":"late"}}"#);
    let mut stream = TcpStream::connect(&address)?;
    let head = "POST /api/v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n";
    write!(stream, "{head}Content-Length: {}\r\n\r\n{}", body.len(), &body[..20])?;
    std::thread::sleep(Duration::from_millis(200));
    kill("-TERM", server.id())?;
    std::thread::sleep(Duration::from_millis(200));
    assert!(TcpStream::connect(&address).is_err(), "a server that is about to end accepts nobody");
    stream.write_all(&body.as_bytes()[20..])?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer)?;
    assert!(answer.starts_with("HTTP/1.1 503") && answer.contains("shutting down"), "{answer}");
    assert_eq!(server.wait(Duration::from_secs(5))?.code(), Some(0));
    Ok(())
}

#[test]
fn ctrl_c_ends_an_idle_server_at_once() -> Result<()> {
    let mut server = Server::start(&[])?;
    kill("-INT", server.id())?;
    assert_eq!(server.wait(Duration::from_secs(2))?.code(), Some(0));
    Ok(())
}

#[test]
fn what_cannot_be_served_is_said_in_one_line() -> Result<()> {
    let server = Server::start(&[])?;
    let elsewhere = tempfile::tempdir()?;
    let taken = server.url.trim_start_matches("http://");
    for (arguments, words) in [
        (["--bind", taken], "Address already in use"),
        (
            ["--data", server.data.path().to_str().context("a path that is no text")?],
            "another adaptarm uses the data folder",
        ),
    ] {
        let mut command = Command::new(binary()?);
        // A folder of its own, and any free port, unless that is what is tried.
        command.arg("serve").args(arguments).current_dir(&elsewhere).env("ADAPTARM_BIND", "127.0.0.1:0");
        let output = command.output()?;
        let line = String::from_utf8(output.stderr)?;
        assert_eq!(output.status.code(), Some(1), "{line}");
        assert!(line.contains(words) && line.contains(arguments[1]) && line.lines().count() == 1, "{line}");
    }
    let output = Command::new(binary()?).args(["serve", "--bind", "8080"]).output()?;
    assert_eq!(output.status.code(), Some(2));
    let blocked = server.data.path().join("file");
    std::fs::write(&blocked, "")?;
    let output = Command::new(binary()?).args(["serve", "--bind", "127.0.0.1:0", "--data"]).arg(&blocked).output()?;
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    Ok(())
}
