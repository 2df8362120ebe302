//! Compression of answers, and what it does to entity tags.
//!
//! A strong tag stands for exact bytes, and compressed they are others: a client that continued one with a part of the
//! other would get rubbish. The layer of tower-http leaves parts alone but keeps the tag, so it is weakened here: weak tags
//! serve `If-None-Match`, and never `If-Range`.

use axum::http::{HeaderValue, header};
use axum::response::Response;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{DefaultPredicate, NotForContentType, Predicate};

/// Compresses what gains from it: neither pictures nor streams of events nor files of packed numbers.
/// Wherever it is used, [`weaken_tag`] belongs around it.
pub fn layer() -> CompressionLayer<impl Predicate> {
    let worth_it = DefaultPredicate::new()
        .and(NotForContentType::const_new("application/octet-stream"))
        .and(NotForContentType::const_new("application/vnd.apache.parquet"));
    CompressionLayer::new().compress_when(worth_it)
}

/// Makes the tag of a compressed answer weak. For `axum::middleware::map_response`, outside of [`layer`].
pub async fn weaken_tag(mut response: Response) -> Response {
    let headers = response.headers_mut();
    if headers.contains_key(header::CONTENT_ENCODING)
        && let Some(tag) = headers.get(header::ETAG).filter(|tag| tag.as_bytes().starts_with(b"\""))
        && let Ok(weak) = HeaderValue::from_bytes(&[b"W/", tag.as_bytes()].concat())
    {
        headers.insert(header::ETAG, weak);
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::download::{Disposition, Download};
    use axum::Router;
    use axum::body::Body;
    use axum::http::{HeaderMap, HeaderName, Request, StatusCode};
    use axum::middleware::map_response;
    use axum::routing::get;
    use tower::ServiceExt;

    /// The answer's status, encoding and tag where the client takes gzip.
    async fn answer(media_type: &'static str, more: &[(HeaderName, &str)]) -> (StatusCode, bool, String) {
        let file = move |headers: HeaderMap| async move {
            let file = Download::new(media_type, Disposition::Attachment, "x", &["x"]);
            file.not_modified(&headers).unwrap_or_else(|| file.bytes(&headers, vec![b'x'; 1000].into()))
        };
        let app = Router::new().route("/", get(file)).layer(layer()).layer(map_response(weaken_tag));
        let mut request = Request::get("/").header(header::ACCEPT_ENCODING, "gzip");
        for (name, value) in more {
            request = request.header(name, *value);
        }
        let answer = app.oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
        let headers = answer.headers();
        let tag = headers.get(header::ETAG).map_or("", |tag| tag.to_str().unwrap()).to_owned();
        (answer.status(), headers.contains_key(header::CONTENT_ENCODING), tag)
    }

    #[tokio::test]
    async fn compressed_bytes_have_a_weak_tag_and_parts_are_never_compressed() {
        let (status, compressed, weak) = answer("text/csv", &[]).await;
        assert!(status == StatusCode::OK && compressed && weak.starts_with("W/\""), "{weak}");
        let strong = weak.trim_start_matches("W/");

        let unchanged = answer("text/csv", &[(header::IF_NONE_MATCH, &weak)]).await;
        assert_eq!(unchanged, (StatusCode::NOT_MODIFIED, false, weak.clone()));

        let range = (header::RANGE, "bytes=10-99");
        let part = answer("text/csv", &[range.clone(), (header::IF_RANGE, strong)]).await;
        assert_eq!(part, (StatusCode::PARTIAL_CONTENT, false, strong.to_owned()));
        // Whoever holds half of the compressed bytes must start again.
        let whole = answer("text/csv", &[range, (header::IF_RANGE, &weak)]).await;
        assert_eq!(whole, (StatusCode::OK, true, weak.clone()));
    }

    #[tokio::test]
    async fn packed_numbers_and_pictures_are_sent_as_they_are() {
        for media_type in ["application/octet-stream", "application/vnd.apache.parquet", "image/png"] {
            let (status, compressed, tag) = answer(media_type, &[]).await;
            assert!(status == StatusCode::OK && !compressed && tag.starts_with('"'), "{media_type}: {tag}");
        }
    }
}
