//! A relay between browser and server that can give some of the page's files another content: a later version of the page,
//! or a server in the middle of an update.

use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};

/// Path to what is answered there instead.
type Replacements = BTreeMap<String, Vec<u8>>;

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
        let mut replaced = self.replaced.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        *replaced = contents.into_iter().map(|(path, text)| (format!("/{path}"), text.into_bytes())).collect();
    }
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
    let replacement = replaced.lock().unwrap_or_else(std::sync::PoisonError::into_inner).get(path).cloned();
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
