//! Calls to real receivers on this machine.

use super::*;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::mpsc;
use uuid::Uuid;

const BODY: &str = r#"{"state":"succeeded","label":"é"}"#;

/// A receiver that answers every call with the same bytes.
struct Receiver {
    address: SocketAddr,
    connections: Arc<AtomicUsize>,
    requests: mpsc::UnboundedReceiver<String>,
}

impl Receiver {
    async fn answering(answer: impl Into<String>) -> Self {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
        let (address, answer) = (listener.local_addr().unwrap(), Arc::new(answer.into()));
        let connections = Arc::new(AtomicUsize::new(0));
        let (sender, requests) = mpsc::unbounded_channel();
        let counter = Arc::clone(&connections);
        tokio::spawn(async move {
            while let Ok((stream, _)) = listener.accept().await {
                counter.fetch_add(1, Ordering::SeqCst);
                tokio::spawn(serve(stream, Arc::clone(&answer), sender.clone()));
            }
        });
        Self { address, connections, requests }
    }

    async fn with_status(status: &str) -> Self {
        Self::answering(format!("HTTP/1.1 {status}\r\ncontent-length: 0\r\n\r\n")).await
    }

    fn connections(&self) -> usize {
        self.connections.load(Ordering::SeqCst)
    }
}

/// Reads one request whole, answers, and keeps the connection open until the caller closes it.
async fn serve(mut stream: TcpStream, answer: Arc<String>, requests: mpsc::UnboundedSender<String>) {
    let mut request = Vec::new();
    loop {
        let Ok(read @ 1..) = stream.read_buf(&mut request).await else { return };
        let text = String::from_utf8_lossy(&request);
        if read > 0 && text.contains("\r\n\r\n") && text.ends_with(BODY) {
            break;
        }
    }
    let _ = requests.send(String::from_utf8(request).unwrap());
    if stream.write_all(answer.as_bytes()).await.is_ok() {
        let _ = stream.read_u8().await;
    }
}

/// So patient that only a receiver that never answers runs into the limit, even on a busy machine.
fn sender(allowed: &[&str]) -> Sender {
    sender_waiting(Duration::from_secs(10), allowed)
}

fn sender_waiting(total: Duration, allowed: &[&str]) -> Sender {
    let timing = Timing { connect: total, total, first_pause: Duration::from_millis(100) };
    Sender::with_timing(Policy::allowing(allowed).unwrap(), timing)
}

fn delivery(url: String) -> Delivery {
    Delivery {
        event_id: "0190-ended".to_owned(),
        event_type: "job.succeeded".to_owned(),
        job: Uuid::nil(),
        url,
        secret: Secret::new("0123456789abcdef"),
        body: BODY.to_owned(),
        attempt: 1,
    }
}

fn retried(outcome: Outcome) -> (Duration, String) {
    let Outcome::Retry { after, why } = outcome else { panic!("{outcome:?}") };
    (after, why)
}

fn given_up(outcome: Outcome) -> String {
    let Outcome::GiveUp { why } = outcome else { panic!("{outcome:?}") };
    why
}

#[tokio::test]
async fn a_call_arrives_signed() {
    let mut receiver = Receiver::with_status("204 No Content").await;
    let call = delivery(format!("http://{}/hook?key=1", receiver.address));
    assert_eq!(sender(&["127.0.0.1"]).deliver(&call).await, Outcome::Delivered);
    let request = receiver.requests.recv().await.unwrap();
    let (head, body) = request.split_once("\r\n\r\n").unwrap();
    let mut lines = head.lines();
    assert_eq!(lines.next(), Some("POST /hook?key=1 HTTP/1.1"));
    let header = |name: &str| {
        let line = head.lines().find(|line| line.to_ascii_lowercase().starts_with(&format!("{name}:")));
        line.and_then(|line| line.split_once(": ")).map(|(_, value)| value).unwrap_or_default()
    };
    assert_eq!(header("content-type"), "application/json");
    assert_eq!(header("adaptarm-event-id"), "0190-ended");
    assert_eq!(header("adaptarm-event-type"), "job.succeeded");
    assert_eq!(header("user-agent"), concat!("adaptarm/", env!("CARGO_PKG_VERSION")));
    let (now_s, tolerance) = (jiff::Timestamp::now().as_second(), Duration::from_mins(1));
    let signature = header("adaptarm-signature");
    assert_eq!(verify(&call.secret, signature, body, now_s, tolerance), Ok(()));
    let forged = body.replace("succeeded", "failed");
    assert_eq!(verify(&call.secret, signature, &forged, now_s, tolerance), Err(SignatureError::Mismatch));
}

#[tokio::test]
async fn inner_addresses_and_names_are_not_even_connected_to() {
    let receiver = Receiver::with_status("200 OK").await;
    let port = receiver.address.port();
    for host in ["127.0.0.1", "localhost", "LOCALHOST", "0x7f.1", "[::ffff:127.0.0.1]", "0.0.0.0"] {
        let outcome = sender(&[]).deliver(&delivery(format!("http://{host}:{port}/"))).await;
        assert!(given_up(outcome).contains("has no public address"), "{host}");
    }
    assert_eq!(receiver.connections(), 0);
}

#[tokio::test]
async fn a_name_can_be_allowed_by_itself_or_by_its_address() {
    for allowed in [["localhost", "LocalHost."], ["127.0.0.0/8", "::1"]] {
        let receiver = Receiver::with_status("200 OK").await;
        let call = delivery(format!("http://localhost:{}/", receiver.address.port()));
        assert_eq!(sender(&allowed).deliver(&call).await, Outcome::Delivered, "{allowed:?}");
        assert_eq!(receiver.connections(), 1);
    }
}

#[tokio::test]
async fn redirects_are_failures_and_nobody_follows_them() {
    let elsewhere = Receiver::with_status("200 OK").await;
    for status in ["301 Moved Permanently", "302 Found", "307 Temporary Redirect", "308 Permanent Redirect"] {
        let to = elsewhere.address;
        let answer = format!("HTTP/1.1 {status}\r\nlocation: http://{to}/\r\ncontent-length: 0\r\n\r\n");
        let receiver = Receiver::answering(answer).await;
        let outcome = sender(&["127.0.0.1"]).deliver(&delivery(format!("http://{}/", receiver.address))).await;
        let (_, why) = retried(outcome);
        assert_eq!(why, format!("the receiver answered {status}; redirects are not followed"));
        assert_eq!(receiver.connections(), 1);
    }
    assert_eq!(elsewhere.connections(), 0);
}

#[tokio::test]
async fn failures_are_tried_again_until_the_last_attempt() {
    let receiver = Receiver::with_status("500 Internal Server Error").await;
    let (sender, mut call) = (sender(&["127.0.0.1"]), delivery(format!("http://{}/", receiver.address)));
    let (after, why) = retried(sender.deliver(&call).await);
    assert_eq!(why, "the receiver answered 500 Internal Server Error");
    assert!((80..=120).contains(&after.as_millis()), "{after:?}");
    call.attempt = 7;
    retried(sender.deliver(&call).await);
    call.attempt = 8;
    let why = given_up(sender.deliver(&call).await);
    assert_eq!(why, "the receiver answered 500 Internal Server Error; attempt 8 was the last");
}

#[tokio::test]
async fn a_receiver_can_ask_for_patience_or_for_peace() {
    let sender = sender(&["127.0.0.1"]);
    let answer = "HTTP/1.1 429 Too Many Requests\r\nretry-after: 90\r\ncontent-length: 0\r\n\r\n";
    let receiver = Receiver::answering(answer).await;
    let (after, _) = retried(sender.deliver(&delivery(format!("http://{}/", receiver.address))).await);
    assert_eq!(after, Duration::from_secs(90));
    let receiver = Receiver::with_status("410 Gone").await;
    let why = given_up(sender.deliver(&delivery(format!("http://{}/", receiver.address))).await);
    assert_eq!(why, "the receiver answered 410 Gone");
}

#[tokio::test]
async fn slow_and_absent_receivers_do_not_hold_the_sender() {
    let sender = sender_waiting(Duration::from_millis(500), &["127.0.0.1"]);
    let receiver = Receiver::answering("").await;
    let began = Instant::now();
    let (_, why) = retried(sender.deliver(&delivery(format!("http://{}/", receiver.address))).await);
    assert_eq!(why, "the receiver took too long");
    assert!(began.elapsed() >= Duration::from_millis(500) && began.elapsed() < Duration::from_secs(5));

    let free = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap().local_addr().unwrap();
    let (_, why) = retried(sender.deliver(&delivery(format!("http://{free}/secret-path"))).await);
    assert!(why.starts_with("cannot connect: ") && !why.contains("secret-path"), "{why}");
}

#[tokio::test]
async fn https_is_spoken_and_never_falls_back_to_plain_text() {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await.unwrap();
    let call = delivery(format!("https://{}/", listener.local_addr().unwrap()));
    let hello = tokio::spawn(async move { listener.accept().await.unwrap().0.read_u8().await.unwrap() });
    let (_, why) = retried(sender(&["127.0.0.1"]).deliver(&call).await);
    assert!(why.starts_with("cannot connect: "), "{why}");
    // The first byte of a TLS handshake.
    assert_eq!(hello.await.unwrap(), 0x16);
}

#[tokio::test]
async fn an_endless_answer_is_not_read_to_its_end() {
    let answer = format!("HTTP/1.1 200 OK\r\ncontent-length: 9999999999\r\n\r\n{}", "x".repeat(1 << 20));
    let receiver = Receiver::answering(answer).await;
    let began = Instant::now();
    let outcome = sender(&["127.0.0.1"]).deliver(&delivery(format!("http://{}/", receiver.address))).await;
    assert_eq!(outcome, Outcome::Delivered);
    assert!(began.elapsed() < Duration::from_secs(10), "it waited for the time limit");
}

#[tokio::test]
async fn what_cannot_be_sent_is_given_up() {
    let sender = sender(&["127.0.0.1"]);
    let why = given_up(sender.deliver(&delivery("not an address".to_owned())).await);
    assert!(why.starts_with("the webhook's address is wrong"), "{why}");
    let mut call = delivery("http://127.0.0.1/".to_owned());
    call.event_id = "two\nlines".to_owned();
    let why = given_up(sender.deliver(&call).await);
    assert!(why.starts_with("the call cannot be written down"), "{why}");
}

#[test]
fn a_delivery_waits_in_a_queue_as_json_and_hides_its_secret_in_logs() {
    let call = delivery("https://example.org/".to_owned());
    let text = serde_json::to_string(&call).unwrap();
    assert_eq!(serde_json::from_str::<Delivery>(&text).unwrap(), call);
    assert!(!format!("{call:?}").contains("0123456789abcdef"));
}
