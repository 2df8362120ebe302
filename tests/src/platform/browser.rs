//! The browser of someone who comes from a platform: keeps cookies, follows nothing by itself, reads forms.

use super::{CLIENT, Platform, Signed};
use crate::classroom::Visitor;
use crate::client::{Answer, Client};
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::collections::BTreeMap;
use url::Url;
use url::form_urlencoded::Serializer;

/// A browser.
#[derive(Debug, Clone)]
pub struct Browser {
    client: Client,
    tool: String,
    /// By name.
    pub cookies: BTreeMap<String, String>,
}

/// A login that the tool has begun: what it asks of the platform.
#[derive(Debug, Clone)]
pub struct Begun {
    /// Comes back with the launch.
    pub state: String,
    /// Comes back in it.
    pub nonce: String,
}

impl Browser {
    /// A new one, before this tool.
    pub fn new(tool: &str) -> Self {
        Self { client: Client::without_redirects(tool), tool: tool.to_owned(), cookies: BTreeMap::new() }
    }

    /// Sends a form as a page would.
    pub fn post_form(&mut self, path: &str, fields: &[(&str, &str)], more: &[(&str, &str)]) -> Result<Answer> {
        let body = Serializer::new(String::new()).extend_pairs(fields).finish();
        let cookies: Vec<_> = self.cookies.iter().map(|(name, value)| format!("{name}={value}")).collect();
        let cookies = cookies.join("; ");
        let mut headers = vec![("content-type", "application/x-www-form-urlencoded")];
        if !cookies.is_empty() {
            headers.push(("cookie", &cookies));
        }
        headers.extend(more);
        let answer = self.client.send("POST", path, &headers, body.as_bytes())?;
        for set in answer.headers.get_all("set-cookie") {
            let (name, value) =
                set.to_str()?.split(';').next().and_then(|pair| pair.split_once('=')).context("no cookie")?;
            self.cookies.insert(name.to_owned(), value.to_owned());
        }
        Ok(answer)
    }

    /// Begins a login as the platform's page does, from another site.
    pub fn begin(&mut self, platform: &Platform, target: &str) -> Result<Answer> {
        let (issuer, origin) = (platform.url(), [("origin", platform.url()), ("sec-fetch-site", "cross-site")]);
        let fields = [
            ("iss", issuer),
            ("login_hint", "someone"),
            ("lti_message_hint", "something"),
            ("target_link_uri", target),
            ("client_id", CLIENT),
        ];
        self.post_form("/lti/login", &fields, &origin)
    }

    /// The same, which must lead to the platform with a proper request.
    pub fn login(&mut self, platform: &Platform) -> Result<Begun> {
        let answer = self.begin(platform, &format!("{}/lti/launch", self.tool))?;
        ensure!(answer.status == 302, "{answer}");
        let asked = Url::parse(answer.header("location"))?;
        ensure!(asked.as_str().starts_with(&format!("{}/auth?", platform.url())), "{asked}");
        let asked: BTreeMap<_, _> = asked.query_pairs().into_owned().collect();
        let redirect = format!("{}/lti/launch", self.tool);
        for (name, value) in [
            ("scope", "openid"),
            ("response_type", "id_token"),
            ("response_mode", "form_post"),
            ("prompt", "none"),
            ("client_id", CLIENT),
            ("redirect_uri", redirect.as_str()),
            ("login_hint", "someone"),
            ("lti_message_hint", "something"),
        ] {
            ensure!(asked.get(name).map(String::as_str) == Some(value), "{name}: {asked:?}");
        }
        let text = |name: &str| asked.get(name).cloned().with_context(|| format!("no {name}"));
        Ok(Begun { state: text("state")?, nonce: text("nonce")? })
    }

    /// Brings a token to the tool, as the platform's page does.
    pub fn bring(&mut self, state: &str, token: &str, more: &[(&str, &str)]) -> Result<Answer> {
        let headers: Vec<_> =
            [("origin", "null"), ("sec-fetch-site", "cross-site")].into_iter().chain(more.iter().copied()).collect();
        self.post_form("/lti/launch", &[("state", state), ("id_token", token)], &headers)
    }

    /// Logs in and launches with the claims that `claims` makes of the nonce.
    pub fn launch(&mut self, platform: &Platform, claims: impl FnOnce(&str) -> Value) -> Result<Answer> {
        let begun = self.login(platform)?;
        let token = Signed::By(platform.key()).token(&claims(&begun.nonce))?;
        self.bring(&begun.state, &token, &[])
    }

    /// Who this browser is now, in the classroom.
    pub fn visitor(&self) -> Result<Visitor> {
        let mut visitor = Visitor::new(&self.tool);
        let session = self.cookies.get("adaptarm").context("no session")?;
        visitor.cookie = Some(format!("adaptarm={session}"));
        visitor.session = visitor.get("/session")?.expect(200)?;
        visitor.csrf = visitor.text("csrf")?;
        Ok(visitor)
    }
}

/// The value of a form's hidden field.
pub fn hidden(page: &Answer, name: &str) -> Result<String> {
    let text = std::str::from_utf8(&page.body)?;
    let field = format!("name=\"{name}\" value=\"");
    let value = text
        .split_once(&field)
        .and_then(|(_, rest)| rest.split_once('"'))
        .with_context(|| format!("no {name}: {page}"))?
        .0;
    Ok(value.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))
}
