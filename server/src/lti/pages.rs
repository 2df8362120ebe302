//! The three pages that a platform shows within its own: opening the laboratory in a window, choosing an exercise, carrying the
//! answer back. In English or Spanish, as the browser asks. They work without a script, but for the last, which then has a button.

use super::deep_link::origin;
use super::model::Platform;
use adaptarm_core::exercises::Text;
use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::{IntoResponse, Response};
use maud::{DOCTYPE, Markup, html};

/// Languages of these pages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// English.
    English,
    /// Spanish.
    Spanish,
}

impl Language {
    /// What the browser asks for first, of these two.
    pub fn of(headers: &HeaderMap) -> Self {
        let asked = headers.get(header::ACCEPT_LANGUAGE).and_then(|asked| asked.to_str().ok()).unwrap_or_default();
        let mut wanted = asked.split(',').map(|part| part.trim().to_ascii_lowercase());
        let first = wanted.find_map(|part| match part.get(..2)? {
            "es" => Some(Self::Spanish),
            "en" => Some(Self::English),
            _ => None,
        });
        first.unwrap_or(Self::English)
    }

    fn of_two(self, english: &'static str, spanish: &'static str) -> &'static str {
        match self {
            Self::English => english,
            Self::Spanish => spanish,
        }
    }

    fn of_text(self, text: &Text) -> &str {
        match self {
            Self::English => &text.en,
            Self::Spanish => &text.es,
        }
    }
}

/// A page, with the only places that may show it and to which its form goes.
fn page(language: Language, title: &str, frames: &str, forms: &str, body: &Markup) -> Response {
    let page = html! {
        (DOCTYPE)
        html lang=(language.of_two("en", "es")) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) " · adaptarm" }
                link rel="stylesheet" href="/lti/page.css";
            }
            body { main { h1 { (title) } (body) } }
        }
    };
    let policy = format!(
        "default-src 'none'; script-src 'self'; style-src 'self'; base-uri 'none'; form-action {forms}; frame-ancestors {frames}"
    );
    // Origins are plain text.
    let policy = HeaderValue::from_str(&policy).unwrap_or(HeaderValue::from_static("default-src 'none'"));
    let html = HeaderValue::from_static("text/html; charset=utf-8");
    ([(header::CONTENT_TYPE, html), (header::CONTENT_SECURITY_POLICY, policy)], page.into_string()).into_response()
}

/// The origins at which a platform's pages are, as far as it tells. Canvas has one for all schools, and one for each.
pub fn origins(platform: &Platform, more: Option<&str>) -> String {
    let urls = [Some(platform.issuer.as_str()), Some(platform.auth_url.as_str()), more];
    let mut origins: Vec<_> = urls.into_iter().flatten().filter_map(origin).collect();
    origins.dedup();
    origins.join(" ")
}

/// A button that opens the laboratory in a window of its own, where its cookies are its own, too.
pub fn open(language: Language, frames: &str, ticket: &str) -> Response {
    let title =
        language.of_two("The laboratory opens in its own window", "El laboratorio se abre en su propia ventana");
    let body = html! {
        form method="post" action="/lti/enter" target="_blank" {
            input type="hidden" name="ticket" value=(ticket);
            button type="submit" { (language.of_two("Open", "Abrir")) }
        }
        p {
            (language.of_two(
                "The button works once; open the link in your course again for another one.",
                "El botón funciona una vez; abre de nuevo el enlace de tu curso para obtener otro.",
            ))
        }
    };
    page(language, title, frames, "'self'", &body)
}

/// The exercises, one of which is to be chosen.
pub fn choose<'a>(
    language: Language,
    frames: &str,
    ticket: &str,
    exercises: impl Iterator<Item = (&'a str, &'a Text)>,
) -> Response {
    let title = language.of_two("Choose an exercise", "Elige un ejercicio");
    let body = html! {
        form method="post" action="/lti/choose" {
            input type="hidden" name="ticket" value=(ticket);
            fieldset {
                legend { (language.of_two("Exercises", "Ejercicios")) }
                @for (id, title) in exercises {
                    label { input type="radio" name="exercise" value=(id) required; " " (language.of_text(title)) }
                }
            }
            p {
                (language.of_two(
                    "Deadlines, attempts and points can be changed in the laboratory afterwards.",
                    "Plazos, intentos y puntos se pueden cambiar después en el laboratorio.",
                ))
            }
            button type="submit" { (language.of_two("Put it into the course", "Ponerlo en el curso")) }
        }
    };
    page(language, title, frames, "'self'", &body)
}

/// The answer on its way to the platform.
pub fn carry(language: Language, frames: &str, return_url: &str, answer: &str) -> Response {
    let title = language.of_two("Back to your course", "De vuelta a tu curso");
    let body = html! {
        form method="post" action=(return_url) {
            input type="hidden" name="JWT" value=(answer);
            button type="submit" { (language.of_two("Go on", "Continuar")) }
        }
        script src="/lti/submit.js" defer {}
    };
    let forms = origin(return_url).unwrap_or_else(|| "'none'".to_owned());
    page(language, title, frames, &forms, &body)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_browser_s_first_language_of_the_two_counts() {
        for (asked, language) in [
            ("es-MX,es;q=0.9,en;q=0.8", Language::Spanish),
            ("de, en;q=0.5, es;q=0.1", Language::English),
            ("de, é", Language::English),
            ("", Language::English),
        ] {
            let headers = [(header::ACCEPT_LANGUAGE, HeaderValue::from_bytes(asked.as_bytes()).unwrap())];
            assert_eq!(Language::of(&headers.into_iter().collect()), language, "{asked}");
        }
    }

    #[test]
    fn nothing_in_a_page_is_taken_for_markup() {
        let page = carry(Language::English, "https://a.org", "https://a.org/x?\"><script>", "<b>");
        let policy = page.headers()[header::CONTENT_SECURITY_POLICY].to_str().unwrap().to_owned();
        assert!(policy.contains("form-action https://a.org;"), "{policy}");
        let body = axum::body::to_bytes(page.into_body(), 1 << 16);
        let body = futures_util::FutureExt::now_or_never(body).unwrap().unwrap();
        let body = String::from_utf8(body.to_vec()).unwrap();
        assert!(!body.contains("<b>") && !body.contains("?\"><script"), "{body}");
    }
}
