//! Settings that are texts with a meaning: addresses, and where things are kept.
//!
//! Each is read once, where its mistakes can still be told with their place; after that it is a type that cannot be wrong.

use super::setting::Shown;
use crate::webhooks::Policy;
use serde::Deserialize;
use std::fmt;
use std::net::{SocketAddr, ToSocketAddrs};
use std::path::PathBuf;
use std::str::FromStr;
use url::Url;

/// Address and port to listen on; a name is looked up.
pub(super) fn check_address(text: &str) -> Result<String, String> {
    let mut addresses = text
        .to_socket_addrs()
        .map_err(|error| format!("not an address with a port, such as 127.0.0.1:8080 or [::1]:8080 ({error})"))?;
    addresses.next().map(|address| address.to_string()).ok_or_else(|| "this name has no address".to_owned())
}

/// The name of a folder.
pub(super) fn check_folder(text: &str) -> Result<String, String> {
    if text.is_empty() || text.contains('\0') {
        Err("not the name of a folder".to_owned())
    } else {
        Ok(text.to_owned())
    }
}

/// What the log shows.
pub(super) fn check_filter(text: &str) -> Result<String, String> {
    let parsed = text.parse::<tracing_subscriber::EnvFilter>();
    parsed
        .map(|_| text.to_owned())
        .map_err(|error| format!("not a filter such as info or warn,adaptarm=debug ({error})"))
}

/// A receiver that webhooks may reach.
pub(super) fn check_receiver(text: &str) -> Result<String, String> {
    let allowed = "an address, a network such as 10.0.0.0/8, or a host name without port";
    // Its whole message would repeat the text.
    Policy::allowing([text]).map(|_| text.to_owned()).map_err(|error| format!("{}; allowed: {allowed}", error.why))
}

/// A check that keeps the text as the type writes it.
pub(super) fn check<T: FromStr<Err = String>>(text: &str) -> Result<String, String> {
    text.parse::<T>().map(|_| text.to_owned())
}

/// A text as TOML.
pub(super) fn toml_text(text: &str) -> String {
    let escaped = text.chars().map(|character| match character {
        '"' | '\\' => format!("\\{character}"),
        _ if character.is_control() => format!("\\U{:08X}", u32::from(character)),
        _ => character.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}

/// Types that a section reads from a text and shows as one.
macro_rules! from_text {
    ($($type:ty)+) => { $(
        impl TryFrom<String> for $type {
            type Error = String;

            fn try_from(text: String) -> Result<Self, String> {
                text.parse()
            }
        }

        impl Shown for $type {
            fn shown(&self) -> Option<String> {
                Some(toml_text(&self.to_string()))
            }
        }
    )+ };
}
from_text!(DatabaseUrl ResultsPlace LogFormat);

impl Shown for SocketAddr {
    fn shown(&self) -> Option<String> {
        Some(toml_text(&self.to_string()))
    }
}

/// Where a PostgreSQL database is, and how to log in. Shown without its password, everywhere.
#[derive(Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct DatabaseUrl(Url);

impl DatabaseUrl {
    /// The whole of it, password included: only for connecting.
    pub fn expose(&self) -> &str {
        self.0.as_str()
    }
}

impl FromStr for DatabaseUrl {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // The text itself is never repeated: it may hold a password.
        let url = Url::parse(text).map_err(|error| {
            format!("not a database's address such as postgres://user@host/name ({error}; in a password, write % as %25, / as %2F)")
        })?;
        if !matches!(url.scheme(), "postgres" | "postgresql") {
            return Err(format!(
                "a database is reached by postgres://, not {}://; without one, the data folder holds an SQLite file",
                url.scheme()
            ));
        }
        Ok(Self(url))
    }
}

impl fmt::Display for DatabaseUrl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut url = self.0.clone();
        let masked = url.password().is_none() || url.set_password(Some("***")).is_ok();
        if !masked {
            return write!(f, "{}://***", url.scheme());
        }
        if url.query().is_some() {
            let mask = |(name, value): (std::borrow::Cow<str>, std::borrow::Cow<str>)| {
                let value = if name.contains("password") { "***".to_owned() } else { value.into_owned() };
                (name.into_owned(), value)
            };
            let pairs: Vec<_> = url.query_pairs().map(mask).collect();
            url.query_pairs_mut().clear().extend_pairs(pairs);
        }
        f.write_str(url.as_str())
    }
}

impl fmt::Debug for DatabaseUrl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "DatabaseUrl({self})")
    }
}

/// Where recordings are kept.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub enum ResultsPlace {
    /// A folder, shared by all machines where there are several.
    Folder(PathBuf),
    /// An S3 bucket; endpoint, region and keys come from the usual `AWS_` variables.
    S3 {
        /// Its name.
        bucket: String,
        /// What all names in it begin with; may be empty.
        prefix: String,
    },
}

impl FromStr for ResultsPlace {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((scheme, rest)) = text.split_once("://") else {
            return check_folder(text).map(|folder| Self::Folder(folder.into()));
        };
        if scheme != "s3" {
            return Err(format!("{scheme}:// is not supported: name a folder or s3://bucket/prefix"));
        }
        let (bucket, prefix) = rest.split_once('/').unwrap_or((rest, ""));
        let prefix = prefix.trim_end_matches('/');
        let letter = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || matches!(byte, b'-' | b'.');
        if !(3..=63).contains(&bucket.len()) || !bucket.bytes().all(letter) {
            return Err(format!("{bucket:?} is no bucket's name: 3 to 63 of a-z, 0-9, - and ."));
        }
        if !prefix.is_empty() && prefix.split('/').any(|part| matches!(part, "" | "." | "..")) {
            return Err(format!("the prefix {prefix:?} has a part that is empty, . or .."));
        }
        Ok(Self::S3 { bucket: bucket.to_owned(), prefix: prefix.to_owned() })
    }
}

impl fmt::Display for ResultsPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Folder(folder) => write!(f, "{}", folder.display()),
            Self::S3 { bucket, prefix } if prefix.is_empty() => write!(f, "s3://{bucket}"),
            Self::S3 { bucket, prefix } => write!(f, "s3://{bucket}/{prefix}"),
        }
    }
}

/// Where people reach a server: a scheme and a host, without a path.
pub(super) fn check_public_url(text: &str) -> Result<String, String> {
    let url = Url::parse(text).map_err(|error| format!("not an address such as https://lab.example.org: {error}"))?;
    let whole = matches!(url.scheme(), "http" | "https") && url.has_host() && url.path() == "/";
    if whole && url.query().is_none() && url.fragment().is_none() && url.username().is_empty() {
        return Ok(text.trim_end_matches('/').to_owned());
    }
    Err("not an address such as https://lab.example.org: http or https, a host, and no path".to_owned())
}

/// How a line of the log is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub enum LogFormat {
    /// For people.
    Text,
    /// One JSON object per line, for machines.
    Json,
}

impl FromStr for LogFormat {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "text" => Ok(Self::Text),
            "json" => Ok(Self::Json),
            _ => Err("there are text and json".to_owned()),
        }
    }
}

impl fmt::Display for LogFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Text => "text",
            Self::Json => "json",
        })
    }
}
