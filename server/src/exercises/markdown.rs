//! Texts of exercises: CommonMark with tables, formulas between dollar signs in TeX, to HTML with MathML.
//!
//! Safe by construction: markup in the text shows as text, links go to the web, to places on the page or to the laboratory's own
//! pages, and there are no pictures. What cannot be shown is an error with its place, found when the exercise is checked.

use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd, html};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Storage, push_mathml};
use thiserror::Error;

/// Why a text cannot be shown.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MarkdownError {
    /// HTML.
    #[error("holds HTML ({0:?}); write Markdown, and formulas between dollar signs")]
    Html(String),
    /// A picture.
    #[error("holds a picture ({0:?}); pages load nothing from elsewhere")]
    Picture(String),
    /// A link to something that is no page.
    #[error("links to {0:?}; allowed are addresses that begin with https://, # or /")]
    Link(String),
    /// A formula.
    #[error("formula {formula:?}: {message}")]
    Formula {
        /// Its TeX.
        formula: String,
        /// What is wrong with it.
        message: String,
    },
}

/// A text as HTML.
pub fn to_html(text: &str) -> Result<String, MarkdownError> {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    let events: Vec<_> = Parser::new_ext(text, options).map(event).collect::<Result<_, _>>()?;
    let mut page = String::new();
    html::push_html(&mut page, events.into_iter());
    Ok(page)
}

fn event(event: Event<'_>) -> Result<Event<'_>, MarkdownError> {
    match event {
        Event::Html(markup) | Event::InlineHtml(markup) => Err(MarkdownError::Html(markup.trim().to_owned())),
        Event::Start(Tag::HtmlBlock) | Event::End(TagEnd::HtmlBlock) => Ok(Event::Text(CowStr::Borrowed(""))),
        Event::Start(Tag::Image { dest_url, .. }) => Err(MarkdownError::Picture(dest_url.into_string())),
        Event::Start(Tag::Link { ref dest_url, .. }) if !is_allowed(dest_url) => {
            Err(MarkdownError::Link(dest_url.to_string()))
        }
        Event::InlineMath(tex) => Ok(Event::InlineHtml(mathml(&tex, DisplayMode::Inline)?.into())),
        Event::DisplayMath(tex) => Ok(Event::InlineHtml(mathml(&tex, DisplayMode::Block)?.into())),
        event => Ok(event),
    }
}

/// Two slashes in front would name another server.
fn is_allowed(address: &str) -> bool {
    address.starts_with("https://")
        || address.starts_with('#')
        || (address.starts_with('/') && !address.starts_with("//") && !address.starts_with("/\\"))
}

fn mathml(tex: &str, display_mode: DisplayMode) -> Result<String, MarkdownError> {
    let wrong = |message: String| MarkdownError::Formula { formula: tex.to_owned(), message };
    let storage = Storage::new();
    let events = pulldown_latex::Parser::new(tex, &storage).collect::<Result<Vec<_>, _>>();
    let events = events.map_err(|error| wrong(error.to_string()))?;
    let mut markup = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let events = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    push_mathml(&mut markup, events, config).map_err(|error| wrong(error.to_string()))?;
    Ok(markup)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_mathml() {
        let page = to_html("With $K_p e$ and\n\n$$\\tau = -K_p e$$\n").unwrap();
        assert!(page.contains("<math") && page.contains("<msub>") && page.contains("display=\"block\""), "{page}");
        assert!(matches!(to_html("$\\frac{1$").unwrap_err(), MarkdownError::Formula { .. }));
    }

    #[test]
    fn nothing_in_a_text_becomes_markup_of_its_own() {
        for hostile in ["<script>alert(1)</script>", "a <img src=x onerror=alert(1)> b", "<!-- -->"] {
            assert!(matches!(to_html(hostile), Err(MarkdownError::Html(_))), "{hostile}");
        }
        assert!(matches!(to_html("![a](https://example.org/a.png)"), Err(MarkdownError::Picture(_))));
        for link in
            ["javascript:alert(1)", "JaVaScript:alert(1)", "//example.org", "data:text/html,a", "/\\example.org"]
        {
            assert!(matches!(to_html(&format!("[a](<{link}>)")), Err(MarkdownError::Link(_))), "{link}");
        }
        for text in ["$\\text{<script>}$", "`<script>`", "$a < b$", "    <script>", "\\<script>"] {
            assert!(!to_html(text).unwrap().contains("<script"), "{text}");
        }
        assert!(to_html("[docs](/api/docs) [web](https://example.org) [here](#top)").is_ok());
    }
}
