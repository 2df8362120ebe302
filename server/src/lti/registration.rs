//! A platform as a teacher or an operator registers it: four addresses, our name there, and the deployments that are let in.

use super::client::Caller;
use super::model::Platform;
use adaptarm_core::scenario::{Problem, ScenarioError};
use jiff::Timestamp;
use serde::Deserialize;
use uuid::Uuid;

/// Longest name of ours, or of a deployment; LTI allows 255.
const NAME_CHARS: usize = 255;

/// Most deployments of one platform.
const DEPLOYMENTS: usize = 100;

/// A registration.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NewPlatform {
    /// What the platform calls itself: `iss`.
    pub issuer: String,
    /// What it calls us.
    pub client_id: String,
    /// Where it answers logins.
    pub auth_url: String,
    /// Where it gives out access tokens.
    pub token_url: String,
    /// Where its public keys are.
    pub keys_url: String,
    /// Deployments from which launches are taken.
    pub deployments: Vec<String>,
}

impl NewPlatform {
    /// The platform, if all of it can be.
    pub fn check(self, teacher: Uuid, caller: &Caller) -> Result<Platform, ScenarioError> {
        let Self { issuer, client_id, auth_url, token_url, keys_url, deployments } = self;
        let urls = [("issuer", &issuer), ("auth_url", &auth_url), ("token_url", &token_url), ("keys_url", &keys_url)];
        for (name, url) in urls {
            caller.check(url).map_err(|problem| ScenarioError::new(format!("/{name}"), problem))?;
        }
        name("/client_id", &client_id)?;
        if deployments.is_empty() {
            let message =
                "is empty: launches come from a deployment, and only those that are named are let in".to_owned();
            return Err(ScenarioError::new("/deployments", Problem::Malformed { message }));
        }
        if deployments.len() > DEPLOYMENTS {
            let problem = Problem::TooMany { found: deployments.len(), most: DEPLOYMENTS, what: "deployments" };
            return Err(ScenarioError::new("/deployments", problem));
        }
        for (n, deployment) in deployments.iter().enumerate() {
            name(&format!("/deployments/{n}"), deployment)?;
        }
        let (id, created_at) = (Uuid::now_v7(), Timestamp::now());
        Ok(Platform { id, teacher, issuer, client_id, auth_url, token_url, keys_url, deployments, created_at })
    }
}

fn name(pointer: &str, text: &str) -> Result<(), ScenarioError> {
    let chars = text.chars().count();
    if !(1..=NAME_CHARS).contains(&chars) {
        let problem = Problem::OutOfRange { value: chars as f64, min: 1.0, max: NAME_CHARS as f64, unit: "characters" };
        return Err(ScenarioError::new(pointer, problem));
    }
    if text.chars().any(char::is_control) {
        let message = "has a control character; copy the text that the platform shows".to_owned();
        return Err(ScenarioError::new(pointer, Problem::Malformed { message }));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::webhooks::Policy;

    #[test]
    fn says_which_field_is_wrong() {
        let good = NewPlatform {
            issuer: "https://moodle.example.org".to_owned(),
            client_id: "abc".to_owned(),
            auth_url: "https://moodle.example.org/mod/lti/auth.php".to_owned(),
            token_url: "https://moodle.example.org/mod/lti/token.php".to_owned(),
            keys_url: "https://moodle.example.org/mod/lti/certs.php".to_owned(),
            deployments: vec!["1".to_owned()],
        };
        let caller = Caller::new(Policy::public());
        assert_eq!(good.clone().check(Uuid::nil(), &caller).unwrap().client_id, "abc");
        for (pointer, wrong) in [
            ("/issuer", NewPlatform { issuer: "moodle.example.org".to_owned(), ..good.clone() }),
            ("/auth_url", NewPlatform { auth_url: "http://moodle.example.org/auth".to_owned(), ..good.clone() }),
            ("/token_url", NewPlatform { token_url: "https://10.0.0.1/token".to_owned(), ..good.clone() }),
            ("/keys_url", NewPlatform { keys_url: "file:///etc/passwd".to_owned(), ..good.clone() }),
            ("/client_id", NewPlatform { client_id: String::new(), ..good.clone() }),
            ("/deployments", NewPlatform { deployments: Vec::new(), ..good.clone() }),
            ("/deployments", NewPlatform { deployments: vec!["1".to_owned(); 101], ..good.clone() }),
            ("/deployments/0", NewPlatform { deployments: vec!["\n".to_owned()], ..good }),
        ] {
            assert_eq!(wrong.check(Uuid::nil(), &caller).unwrap_err().pointer, pointer);
        }
    }
}
