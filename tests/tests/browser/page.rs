//! A page in a browser of its own, with a fresh profile: opened, asked, acted upon, closed with its value.

use crate::bench::Bench;
use anyhow::{Context, Result, bail};
use fantoccini::wd::{Capabilities, WebDriverCompatibleCommand, WindowHandle};
use fantoccini::{Client, ClientBuilder};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Computing on the server is polite: whatever else the machine does comes first, another browser too.
const PATIENCE: Duration = Duration::from_mins(2);
/// Asking more often would take the time that the page needs to get there.
const EVERY: Duration = Duration::from_millis(40);

/// Size and kind of the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Screen {
    /// 1440 px wide, a mouse.
    Desktop,
    /// 390 px wide, fingers, two device pixels a pixel.
    Phone,
}

/// What the browser has for 3-D graphics.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Graphics {
    /// No WebGL: quiet, and nothing competes for the processor.
    Off,
    /// WebGL, drawn by the processor.
    Software,
}

/// An open page.
#[derive(Debug)]
pub struct Page<'a> {
    bench: &'a Bench,
    client: Client,
    /// Removed after the browser is closed.
    _profile: TempDir,
}

/// A driver's command that fantoccini does not know.
#[derive(Debug)]
struct Command {
    path: &'static str,
    body: Value,
}

impl WebDriverCompatibleCommand for Command {
    fn endpoint(&self, base: &url::Url, session: Option<&str>) -> Result<url::Url, url::ParseError> {
        base.join(&format!("session/{}/{}", session.unwrap_or_default(), self.path))
    }

    fn method_and_body(&self, _: &url::Url) -> (http::Method, Option<String>) {
        (http::Method::POST, Some(self.body.to_string()))
    }
}

impl<'a> Page<'a> {
    /// Opens a browser and the page in it, and waits until its first results are drawn.
    pub fn open(bench: &'a Bench, screen: Screen) -> Result<Self> {
        Self::open_with(bench, screen, Graphics::Off)
    }

    /// The same with 3-D graphics, or without.
    pub fn open_with(bench: &'a Bench, screen: Screen, graphics: Graphics) -> Result<Self> {
        let page = Self::begin(bench, screen, graphics, "normal")?;
        page.visit()?;
        page.ready()?;
        Ok(page)
    }

    /// Opens a browser with nothing in it.
    pub fn blank(bench: &'a Bench, screen: Screen) -> Result<Self> {
        Self::begin(bench, screen, Graphics::Off, "normal")
    }

    /// The same, for pages that are looked at before all of their files are there.
    pub fn impatient(bench: &'a Bench, screen: Screen) -> Result<Self> {
        Self::begin(bench, screen, Graphics::Off, "none")
    }

    /// `load` is WebDriver's page load strategy.
    fn begin(bench: &'a Bench, screen: Screen, graphics: Graphics, load: &str) -> Result<Self> {
        let profile = tempfile::tempdir()?;
        let mut wanted = capabilities(&profile, screen, graphics);
        wanted.insert("pageLoadStrategy".to_owned(), json!(load));
        let mut builder = ClientBuilder::new(HttpConnector::new());
        builder.capabilities(wanted);
        let client = bench.runtime.block_on(builder.connect(&bench.driver.url)).context("cannot open a browser")?;
        let page = Self { bench, client, _profile: profile };
        page.take_focus()?;
        page.leave_start_page()?;
        Ok(page)
    }

    /// Leaves the page that the browser begins on, and forgets what that one asked for and said: it is not ours.
    fn leave_start_page(&self) -> Result<()> {
        self.go("about:blank")?;
        self.log("performance")?;
        self.log("browser")?;
        Ok(())
    }

    /// Makes the tab behave as one that has the focus. Chromium 148 begins on its new-tab page with the focus in the
    /// address bar and leaves it there: fields would not be selected by a script, and no focus ring would be drawn.
    fn take_focus(&self) -> Result<()> {
        self.devtools("Emulation.setFocusEmulationEnabled", &json!({ "enabled": true }))?;
        Ok(())
    }

    /// Goes to the page.
    pub fn visit(&self) -> Result<()> {
        self.go(&self.bench.server.url)
    }

    /// Goes to an address.
    pub fn go(&self, url: &str) -> Result<()> {
        Ok(self.bench.runtime.block_on(self.client.goto(url))?)
    }

    /// The tab that everything here means.
    pub fn tab(&self) -> Result<WindowHandle> {
        Ok(self.bench.runtime.block_on(self.client.window())?)
    }

    /// Opens another tab at an address; from now on everything here means that one.
    pub fn open_tab(&self, url: &str) -> Result<()> {
        let tab = self.bench.runtime.block_on(self.client.new_window(true))?.handle;
        self.switch_to(&tab)?;
        self.go(url)
    }

    /// From now on everything here means this tab.
    pub fn switch_to(&self, tab: &WindowHandle) -> Result<()> {
        self.bench.runtime.block_on(self.client.switch_to_window(tab.clone()))?;
        self.take_focus()
    }

    /// Runs a script's body in every page that is opened from now on, before any of its own scripts.
    pub fn before_each_page(&self, script: &str) -> Result<()> {
        self.devtools("Page.addScriptToEvaluateOnNewDocument", &json!({ "source": script }))?;
        Ok(())
    }

    /// Goes to a path of the page's server, such as `#1.…`, and waits until its results are drawn.
    pub fn visit_path(&self, path: &str) -> Result<()> {
        let url = format!("{}/{path}", self.bench.server.url.trim_end_matches('/'));
        self.bench.runtime.block_on(self.client.goto(&url))?;
        self.ready()
    }

    /// Reloads the page and waits until its results are drawn.
    pub fn reload(&self) -> Result<()> {
        self.bench.runtime.block_on(self.client.refresh())?;
        self.ready()
    }

    /// Runs a script's body with `arguments` and returns what it returns.
    pub fn run(&self, script: &str, arguments: &[Value]) -> Result<Value> {
        Ok(self.bench.runtime.block_on(self.client.execute(script, arguments.to_vec()))?)
    }

    /// Runs a script's body, whose last argument is a function to call with the answer.
    pub fn run_async(&self, script: &str, arguments: &[Value]) -> Result<Value> {
        Ok(self.bench.runtime.block_on(self.client.execute_async(script, arguments.to_vec()))?)
    }

    /// Presses keys, such as text or one of [`fantoccini::key::Key`], wherever the focus is.
    pub fn press(&self, keys: &str) -> Result<()> {
        self.bench.runtime.block_on(async {
            let focused = self.client.active_element().await?;
            Ok(focused.send_keys(keys).await?)
        })
    }

    /// Clicks the first element that a selector finds.
    pub fn click(&self, selector: &str) -> Result<()> {
        self.run("document.querySelector(arguments[0]).click()", &[json!(selector)])?;
        Ok(())
    }

    /// Types `text` over what a field holds, as a user would: keystroke by keystroke.
    pub fn type_into(&self, selector: &str, text: &str) -> Result<()> {
        self.run(
            "const field = document.querySelector(arguments[0]); field.focus(); field.select()",
            &[json!(selector)],
        )?;
        self.press(text)
    }

    /// Waits until a script's body returns true.
    pub fn wait_for(&self, condition: &str) -> Result<()> {
        let start = Instant::now();
        while self.run(condition, &[])? != json!(true) {
            if start.elapsed() > PATIENCE {
                let state = self.run("return JSON.stringify(document.documentElement.dataset)", &[])?;
                let logged = self.log("browser")?;
                bail!("waited {PATIENCE:?} in vain for: {condition}; the page's state is {state}, its log {logged:?}");
            }
            std::thread::sleep(EVERY);
        }
        Ok(())
    }

    /// Waits until the newest results are drawn.
    pub fn ready(&self) -> Result<()> {
        self.wait_for("return document.documentElement.dataset.state === 'ready'")
    }

    /// Gives a phone's screen another size: held sideways, say.
    pub fn resize(&self, width: u32, height: u32) -> Result<()> {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 2, "mobile": true });
        self.devtools("Emulation.setDeviceMetricsOverride", &metrics)?;
        self.wait_for(&format!("return innerWidth === {width} && innerHeight === {height}"))
    }

    /// A command of the browser's own protocol.
    pub fn devtools(&self, command: &str, parameters: &Value) -> Result<Value> {
        self.command("goog/cdp/execute", json!({ "cmd": command, "params": parameters }))
    }

    /// Entries of the browser's log of a kind since the last call.
    pub fn log(&self, kind: &str) -> Result<Vec<Value>> {
        let entries = self.command("se/log", json!({ "type": kind }))?;
        Ok(entries.as_array().cloned().unwrap_or_default())
    }

    fn command(&self, path: &'static str, body: Value) -> Result<Value> {
        Ok(self.bench.runtime.block_on(self.client.issue_cmd(Command { path, body }))?)
    }
}

impl Drop for Page<'_> {
    fn drop(&mut self) {
        // The driver may have gone before; then so has the browser.
        let _ = self.bench.runtime.block_on(self.client.clone().close());
    }
}

fn capabilities(profile: &TempDir, screen: Screen, graphics: Graphics) -> Capabilities {
    let mut arguments: Vec<String> = [
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--window-size=1440,1000",
        "--force-prefers-color-scheme=light",
    ]
    .map(str::to_owned)
    .into();
    let graphics = match graphics {
        Graphics::Off => "--disable-3d-apis",
        Graphics::Software => "--enable-unsafe-swiftshader",
    };
    arguments.push(graphics.to_owned());
    arguments.push(format!("--user-data-dir={}", profile.path().display()));
    let mut options = json!({ "args": arguments });
    if screen == Screen::Phone {
        let metrics = json!({ "width": 390, "height": 844, "pixelRatio": 2, "touch": true });
        options["mobileEmulation"] = json!({ "deviceMetrics": metrics });
    }
    let mut capabilities = Capabilities::new();
    capabilities.insert("goog:chromeOptions".to_owned(), options);
    capabilities.insert("goog:loggingPrefs".to_owned(), json!({ "browser": "ALL", "performance": "ALL" }));
    capabilities
}
