//! Launches that are not what they say: each is refused, for its own reason, and makes nobody.

use super::{Setting, reason};
use adaptarm_tests::classroom::Visitor;
use adaptarm_tests::platform::{CLAIM, Key, Signed, User};
use anyhow::{Context, Result, ensure};
use serde_json::{Value, json};

/// A change of a launch's claims, and why it is refused then.
type Forgery = (&'static str, Value, &'static str);

fn forgeries() -> Vec<Forgery> {
    let now = jiff::Timestamp::now().as_second();
    let lti = |name: &str, value: Value| json!({ format!("{CLAIM}/{name}"): value });
    vec![
        ("expired", json!({ "iat": now - 600, "exp": now - 300 }), "time"),
        ("from the future", json!({ "iat": now + 600, "exp": now + 1200 }), "time"),
        ("not yet valid", json!({ "nbf": now + 600 }), "time"),
        ("without expiry", json!({ "exp": null }), "claim"),
        ("old, with an expiry far away", json!({ "iat": now - 100_000, "exp": now + 100_000 }), "time"),
        ("of no time", json!({ "iat": null }), "claim"),
        ("for another tool", json!({ "aud": "another-client" }), "audience"),
        ("for several, of which none is authorized", json!({ "aud": ["adaptarm-client", "b"] }), "audience"),
        (
            "for several, of which another is authorized",
            json!({ "aud": ["adaptarm-client", "b"], "azp": "b" }),
            "audience",
        ),
        ("authorized for another", json!({ "azp": "b" }), "audience"),
        ("of another issuer", json!({ "iss": "https://elsewhere.example.org" }), "issuer"),
        ("with another nonce", json!({ "nonce": "0".repeat(64) }), "nonce"),
        ("without nonce", json!({ "nonce": null }), "nonce"),
        ("of another deployment", lti("deployment_id", json!("deployment-2")), "deployment"),
        ("of no deployment", lti("deployment_id", Value::Null), "claim"),
        ("to another tool's link", lti("target_link_uri", json!("https://elsewhere.example.org/lti/launch")), "target"),
        ("of another version", lti("version", json!("1.1")), "version"),
        ("of another kind", lti("message_type", json!("LtiSubmissionReviewRequest")), "message_type"),
        ("of nobody", json!({ "sub": null }), "claim"),
        ("from no course", lti("context", Value::Null), "context"),
        (
            "of a teacher elsewhere in the institution",
            lti("roles", json!(["http://purl.imsglobal.org/vocab/lis/v2/institution/person#Instructor"])),
            "role",
        ),
        ("with a subject that is too long", json!({ "sub": "x".repeat(256) }), "claim"),
    ]
}

/// Forgeries of every kind.
pub fn forged_launches() -> Result<()> {
    let mut setting = Setting::new()?;
    let eve = User::new("eve", "Instructor");
    let platform = &setting.platform;
    for (what, change, expected) in forgeries() {
        let mut browser = setting.browser();
        let answer = browser.launch(platform, |nonce| {
            let mut claims = platform.claims(&eve, "link", nonce);
            for (name, value) in change.as_object().into_iter().flatten() {
                if value.is_null() {
                    if let Some(claims) = claims.as_object_mut() {
                        claims.remove(name);
                    }
                } else {
                    claims[name] = value.clone();
                }
            }
            claims
        })?;
        let given = reason(&answer).context(what)?;
        ensure!(given == expected, "a launch {what}: {given} instead of {expected}");
        ensure!(!browser.cookies.contains_key("adaptarm"), "a launch {what} has a session");
    }
    signatures(&setting, &eve)?;
    nobody(&setting, &eve)?;
    replays(&mut setting, &eve)?;
    logins(&setting)
}

/// Nobody came in, and nothing was made on the way: who then comes rightly is the first, in a class without students.
fn nobody(setting: &Setting, eve: &User) -> Result<()> {
    let before = jiff::Timestamp::now().as_second();
    let teacher = setting.enter(eve, "link", None)?;
    let classes = teacher.get("/classes")?.expect(200)?;
    let only = &classes["classes"][0];
    let made = only["created_at"].as_str().and_then(|at| at.parse::<jiff::Timestamp>().ok()).context("no class")?;
    ensure!(made.as_second() >= before, "the class was made by a forged launch: {classes}");
    ensure!(only["student_count"] == 0 && classes["classes"][1].is_null(), "{classes}");
    let own = setting.teacher.get("/classes")?.expect(200)?;
    ensure!(own["classes"] == json!([]), "{own}");
    Ok(())
}

fn signatures(setting: &Setting, eve: &User) -> Result<()> {
    let platform = &setting.platform;
    let other = Key::new("key-2")?;
    for (what, how, expected) in [
        ("signed with another key under the right name", Signed::Named(&other, "key-1"), "signature"),
        ("signed with another key that it brings along", Signed::Bringing(&other, "key-1"), "signature"),
        ("signed with a key that is not published", Signed::By(&other), "key"),
        ("not signed", Signed::Nothing("key-1"), "token"),
        ("signed symmetrically with the public key", Signed::Symmetrically(platform.key()), "algorithm"),
    ] {
        let mut browser = setting.browser();
        let begun = browser.login(platform)?;
        let token = how.token(&platform.claims(eve, "link", &begun.nonce))?;
        let given = reason(&browser.bring(&begun.state, &token, &[])?).context(what)?;
        ensure!(given == expected, "a launch {what}: {given} instead of {expected}");
        ensure!(!browser.cookies.contains_key("adaptarm"), "a launch {what} has a session");
    }
    // Good claims behind a good signature of other claims.
    let mut browser = setting.browser();
    let begun = browser.login(platform)?;
    let [mut one, two] = [User::new("sam", "Learner"), eve.clone()].map(|user| {
        let token = Signed::By(platform.key()).token(&platform.claims(&user, "link", &begun.nonce));
        token.map(|token| token.split('.').map(str::to_owned).collect::<Vec<_>>())
    });
    if let (Ok(one), Ok(two)) = (&mut one, &two) {
        one[1].clone_from(&two[1]);
    }
    let given = reason(&browser.bring(&begun.state, &one?.join("."), &[])?)?;
    ensure!(given == "signature", "{given}");
    Ok(())
}

/// What was good once, or for someone else.
fn replays(setting: &mut Setting, eve: &User) -> Result<()> {
    // A student's good launch, which fails later: the link leads to nothing. Its nonce is used up all the same.
    let sam = User::new("sam", "Learner").of("elsewhere");
    let mut browser = setting.browser();
    let begun = browser.login(&setting.platform)?;
    let token = Signed::By(setting.platform.key()).token(&setting.platform.claims(&sam, "link", &begun.nonce))?;
    let expect = |answer: adaptarm_tests::client::Answer, expected: &str| -> Result<()> {
        let given = reason(&answer)?;
        ensure!(given == expected, "{given} instead of {expected}");
        Ok(())
    };
    expect(browser.bring(&begun.state, &token, &[])?, "link")?;
    expect(browser.bring(&begun.state, &token, &[])?, "replay").context("the same once more")?;
    setting.server.restart()?;
    expect(browser.bring(&begun.state, &token, &[])?, "replay").context("the same after the server was killed")?;
    let platform = &setting.platform;
    let fresh = browser.login(platform)?;
    expect(browser.bring(&fresh.state, &token, &[])?, "nonce").context("an old token with a new state")?;
    let again = Signed::By(platform.key()).token(&platform.claims(&sam, "link", &begun.nonce))?;
    expect(browser.bring(&begun.state, &again, &[])?, "replay").context("a new token with an old state")?;
    // Another browser: someone is made to follow a link that an attacker began.
    let mut victim = setting.browser();
    let begun = browser.login(platform)?;
    let token = Signed::By(platform.key()).token(&platform.claims(eve, "link", &begun.nonce))?;
    expect(victim.bring(&begun.state, &token, &[])?, "browser").context("without the login's cookie")?;
    victim.cookies = browser.cookies.keys().map(|name| (name.clone(), "0".repeat(64))).collect();
    expect(victim.bring(&begun.state, &token, &[])?, "state").context("with another cookie")?;
    let forged = begun.state.replace('.', "..");
    expect(browser.bring(&forged, &token, &[])?, "state").context("with a state that is none")?;
    let mut parts: Vec<_> = begun.state.split('.').map(str::to_owned).collect();
    "9999999999".clone_into(&mut parts[1]);
    expect(browser.bring(&parts.join("."), &token, &[])?, "state").context("with a state of a longer life")
}

/// Logins that lead nowhere.
fn logins(setting: &Setting) -> Result<()> {
    let (platform, mut browser) = (&setting.platform, setting.browser());
    // A login for another tool's link may begin; its launch is refused whatever it says then.
    let begun = browser.begin(platform, "https://elsewhere.example.org/x")?;
    ensure!(begun.status == 302, "{begun}");
    let asked = url::Url::parse(begun.header("location"))?;
    let asked = |name: &str| asked.query_pairs().find(|(own, _)| own == name).map(|(_, value)| value.into_owned());
    let (state, nonce) = (asked("state").context("no state")?, asked("nonce").context("no nonce")?);
    let token = Signed::By(platform.key()).token(&platform.claims(&User::new("sam", "Learner"), "link", &nonce))?;
    ensure!(reason(&browser.bring(&state, &token, &[])?)? == "target", "a launch for another link than its login");
    let unknown = [("iss", "https://unknown.example.org"), ("login_hint", "x"), ("target_link_uri", "x")];
    ensure!(reason(&browser.post_form("/lti/login", &unknown, &[])?)? == "platform", "an unknown platform");
    let twice = setting.teacher.post("/lti/platforms", &platform.registration())?;
    ensure!(twice.status == 409, "{twice}");
    let stranger = Visitor::new(&setting.server.url).post("/lti/platforms", &platform.registration())?;
    ensure!(stranger.status == 401, "{stranger}");
    Ok(())
}
