//! A relay between browser and server that can give some of the page's files another content (a later version of the page, or
//! a server in the middle of an update), keep them back, or hang up instead.

use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// What happens to a request instead of being passed on.
#[derive(Debug, Clone)]
enum Instead {
    /// This content is the answer's.
    Content(Vec<u8>),
    /// No answer, until it is no longer so.
    Silence,
    /// The connection is closed without an answer, this many times.
    HangUp(u32),
}

/// Path to what happens there.
type Replacements = BTreeMap<String, Instead>;

/// How often a request that is kept back looks whether it may go on.
const EVERY: Duration = Duration::from_millis(50);

/// A relay; it listens until the process ends.
#[derive(Debug)]
pub struct Relay {
    /// Address, such as `http://127.0.0.1:41234`.
    pub url: String,
    replaced: Arc<Mutex<Replacements>>,
}

impl Relay {
    /// Starts a relay to the server at `url`.
    pub fn start(url: &str) -> Result<Self> {
        let target = url.strip_prefix("http://").context("not an address of a server")?.to_owned();
        let listener = TcpListener::bind("127.0.0.1:0")?;
        let url = format!("http://{}", listener.local_addr()?);
        let replaced = Arc::new(Mutex::new(Replacements::new()));
        let shared = Arc::clone(&replaced);
        std::thread::spawn(move || {
            for connection in listener.incoming().flatten() {
                let (target, replaced) = (target.clone(), Arc::clone(&shared));
                // A browser that hangs up is no failure of the trial.
                std::thread::spawn(move || serve(connection, &target, &replaced).ok());
            }
        });
        Ok(Self { url, replaced })
    }

    /// Answers with these contents from now on, by path; everything else is the server's.
    pub fn replace(&self, contents: impl IntoIterator<Item = (&'static str, String)>) {
        self.set(contents.into_iter().map(|(path, text)| (path, Instead::Content(text.into_bytes()))));
    }

    /// Answers nothing for this path from now on, until `replace` says otherwise.
    pub fn withhold(&self, path: &'static str) {
        self.set([(path, Instead::Silence)]);
    }

    /// Closes the next so many connections that ask for this path, unless `replace` says otherwise before.
    pub fn hang_up(&self, path: &'static str, times: u32) {
        self.set([(path, Instead::HangUp(times))]);
    }

    /// Whether every request is passed on again.
    pub fn is_honest(&self) -> bool {
        self.replaced.lock().unwrap_or_else(PoisonError::into_inner).is_empty()
    }

    fn set(&self, replacements: impl IntoIterator<Item = (&'static str, Instead)>) {
        let mut replaced = self.replaced.lock().unwrap_or_else(PoisonError::into_inner);
        *replaced = replacements.into_iter().map(|(path, instead)| (format!("/{path}"), instead)).collect();
    }
}

/// What happens to a request for `path` instead of being passed on; a connection that is closed is counted.
fn next(replaced: &mut Replacements, path: &str) -> Option<Instead> {
    let instead = replaced.get(path).cloned();
    match instead {
        Some(Instead::HangUp(1)) => drop(replaced.remove(path)),
        Some(Instead::HangUp(times)) => drop(replaced.insert(path.to_owned(), Instead::HangUp(times - 1))),
        _ => {}
    }
    instead
}

/// Answers one request; the connection then closes, so that no second one hides behind it.
fn serve(mut browser: TcpStream, target: &str, replaced: &Mutex<Replacements>) -> Result<()> {
    let mut head = Vec::new();
    let mut byte = [0];
    while !head.ends_with(b"\r\n\r\n") && browser.read(&mut byte)? > 0 {
        head.push(byte[0]);
    }
    let head = String::from_utf8(head)?;
    let path = head.split(' ').nth(1).unwrap_or_default().split('?').next().unwrap_or_default();
    let replacement = loop {
        match next(&mut replaced.lock().unwrap_or_else(PoisonError::into_inner), path) {
            None => break None,
            Some(Instead::Content(content)) => break Some(content),
            Some(Instead::HangUp(_)) => return Ok(()),
            Some(Instead::Silence) => {}
        }
        std::thread::sleep(EVERY);
    };
    // Tags and encodings would belong to the content that is replaced.
    let dropped: &[&str] = match replacement {
        Some(_) => &["connection", "if-none-match", "accept-encoding"],
        None => &["connection"],
    };
    let is_dropped =
        |line: &&str| dropped.contains(&line.split(':').next().unwrap_or_default().to_lowercase().as_str());
    let lines: Vec<&str> = head.trim_end().split("\r\n").filter(|line| !is_dropped(line)).collect();
    let mut server = TcpStream::connect(target)?;
    server.write_all(format!("{}\r\nConnection: close\r\n\r\n", lines.join("\r\n")).as_bytes())?;
    let mut answer = Vec::new();
    server.read_to_end(&mut answer)?;
    if let Some(content) = replacement {
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n").context("an answer without a body")?;
        let head = String::from_utf8(answer[..end].to_vec())?;
        let own = |line: &&str| {
            let name = line.split(':').next().unwrap_or_default().to_lowercase();
            !["content-length", "etag", "transfer-encoding"].contains(&name.as_str())
        };
        let lines: Vec<&str> = head.split("\r\n").filter(own).collect();
        answer = format!("{}\r\nContent-Length: {}\r\n\r\n", lines.join("\r\n"), content.len()).into_bytes();
        answer.extend(content);
    }
    Ok(browser.write_all(&answer)?)
}
