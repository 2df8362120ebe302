//! A file over HTTP: entity tags, conditional requests and ranges (RFC 9110, sections 8.8.3, 13 and 14).
//!
//! A tag stands for exact bytes, so that a broken download can be continued. Compression makes other bytes of them:
//! `crate::compression` weakens the tag wherever it does, and leaves parts alone.

use crate::error::Problem;
use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::{TryStreamExt, stream};
use std::io::{self, SeekFrom};
use std::ops::Range;
use tokio::fs::File;
use tokio::io::{AsyncReadExt, AsyncSeekExt};
use tokio_util::io::ReaderStream;

/// Whether a browser shows a file or saves it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Disposition {
    /// Shows it.
    Inline,
    /// Saves it.
    Attachment,
}

/// What is known of a file before its bytes are made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Download {
    media_type: &'static str,
    disposition: Disposition,
    file_name: String,
    /// Strong entity tag, with its quotes.
    tag: String,
}

/// The part of a file that a request asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// From a byte to another, inclusive, or to the end.
    From(u64, Option<u64>),
    /// That many of the last bytes.
    Last(u64),
}

impl Download {
    /// `content` is all that the bytes depend on beside this program's version. `file_name` is for people: letters, digits
    /// and `._-` of it are kept.
    pub fn new(media_type: &'static str, disposition: Disposition, file_name: &str, content: &[&str]) -> Self {
        let mut hasher = blake3::Hasher::new();
        for text in [env!("CARGO_PKG_VERSION"), media_type].iter().chain(content) {
            hasher.update(&(text.len() as u64).to_le_bytes());
            hasher.update(text.as_bytes());
        }
        let tag = format!("\"{}\"", &hasher.finalize().to_hex()[..32]);
        let plain = |c: &char| c.is_ascii_alphanumeric() || "._-".contains(*c);
        Self { media_type, disposition, file_name: file_name.chars().filter(plain).collect(), tag }
    }

    /// 304 if the client has the file already. Asked before anything is loaded or computed.
    pub fn not_modified(&self, request: &HeaderMap) -> Option<Response> {
        let known = tags(request, header::IF_NONE_MATCH)
            .find(|tag| *tag == "*" || tag.strip_prefix("W/").unwrap_or(tag) == self.tag)?;
        let mut response = StatusCode::NOT_MODIFIED.into_response();
        // In the client's own words: it may hold compressed bytes, which have the weak tag.
        let tag = if known == "*" { self.tag.as_str() } else { known };
        insert(&mut response, header::ETAG, tag);
        describe_caching(&mut response);
        Some(response)
    }

    /// The part that is asked for; `None` if it is the whole file, also where RFC 9110 lets a range be ignored: several at a
    /// time, of another unit, malformed, or of a file that has changed since.
    pub fn part(&self, request: &HeaderMap) -> Option<Part> {
        let mut ranges = request.get_all(header::RANGE).iter();
        let part = ranges.next().filter(|_| ranges.next().is_none()).and_then(|range| parse(range.to_str().ok()?))?;
        let same = |tag: &HeaderValue| tag.as_bytes() == self.tag.as_bytes();
        request.get(header::IF_RANGE).is_none_or(same).then_some(part)
    }

    /// 200 with the whole file.
    pub fn whole(&self, body: Body) -> Response {
        self.describe(body.into_response())
    }

    /// 206 with a part of a file of this length, whose bytes `body` gives; 416 if there are no such bytes.
    pub fn partial(&self, part: Part, length: u64, body: impl FnOnce(Range<u64>) -> Body) -> Response {
        let Some(range) = part.within(length) else {
            let detail = format!("the file has {length} bytes, and none of them is in the range that is asked for");
            let mut response = Problem::status(StatusCode::RANGE_NOT_SATISFIABLE, detail).into_response();
            insert(&mut response, header::CONTENT_RANGE, &format!("bytes */{length}"));
            return response;
        };
        let content_range = format!("bytes {}-{}/{length}", range.start, range.end - 1);
        let content_length = range.end - range.start;
        let mut response = self.describe(body(range).into_response());
        *response.status_mut() = StatusCode::PARTIAL_CONTENT;
        insert(&mut response, header::CONTENT_RANGE, &content_range);
        response.headers_mut().insert(header::CONTENT_LENGTH, HeaderValue::from(content_length));
        response
    }

    /// 200, 206 or 416: as much of these bytes as is asked for.
    pub fn bytes(&self, request: &HeaderMap, bytes: Bytes) -> Response {
        match self.part(request) {
            None => self.whole(bytes.into()),
            Some(part) => self.partial(part, bytes.len() as u64, |range| {
                bytes.slice(range.start as usize..range.end as usize).into()
            }),
        }
    }

    /// The same of a file on disk, of which a piece is held at a time.
    pub fn file(&self, request: &HeaderMap, file: File, length: u64) -> Response {
        match self.part(request) {
            None => {
                let mut response = self.whole(pieces(file, 0..length));
                response.headers_mut().insert(header::CONTENT_LENGTH, HeaderValue::from(length));
                response
            }
            Some(part) => self.partial(part, length, |range| pieces(file, range)),
        }
    }

    fn describe(&self, mut response: Response) -> Response {
        insert(&mut response, header::CONTENT_TYPE, self.media_type);
        let disposition = match self.disposition {
            Disposition::Inline => "inline",
            Disposition::Attachment => "attachment",
        };
        let disposition = format!("{disposition}; filename=\"{}\"", self.file_name);
        insert(&mut response, header::CONTENT_DISPOSITION, &disposition);
        insert(&mut response, header::ACCEPT_RANGES, "bytes");
        insert(&mut response, header::ETAG, &self.tag);
        describe_caching(&mut response);
        response
    }
}

/// A part of a file as a body.
fn pieces(mut file: File, range: Range<u64>) -> Body {
    let opened = async move {
        file.seek(SeekFrom::Start(range.start)).await?;
        Ok::<_, io::Error>(ReaderStream::new(file.take(range.end - range.start)))
    };
    Body::from_stream(stream::once(opened).try_flatten())
}

/// Results belong to their owner, and jobs can be deleted: a copy may be kept, but not used without asking.
fn describe_caching(response: &mut Response) {
    insert(response, header::CACHE_CONTROL, "private, no-cache");
}

impl Part {
    /// The bytes of it that a file of this length has; `None` if it has none of them.
    pub fn within(self, length: u64) -> Option<Range<u64>> {
        let range = match self {
            Self::From(first, last) => first..last.map_or(length, |last| last.saturating_add(1).min(length)),
            Self::Last(count) => length.saturating_sub(count)..length,
        };
        (!range.is_empty()).then_some(range)
    }
}

/// The one part that the value of `Range` asks for.
fn parse(value: &str) -> Option<Part> {
    let (unit, range) = value.split_once('=')?;
    let (first, last) = range.trim().split_once('-')?;
    if !unit.trim().eq_ignore_ascii_case("bytes") {
        return None;
    }
    // Numbers beyond counting mean the same as the largest one.
    let number = |text: &str| {
        let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        digits.then(|| text.parse().unwrap_or(u64::MAX))
    };
    match (first, last) {
        ("", last) => Some(Part::Last(number(last)?)),
        (first, "") => Some(Part::From(number(first)?, None)),
        (first, last) => {
            let (first, last) = (number(first)?, number(last)?);
            (first <= last).then_some(Part::From(first, Some(last)))
        }
    }
}

/// Entity tags in a header. Ours contain no commas, so that cutting there finds each of them.
fn tags(request: &HeaderMap, name: HeaderName) -> impl Iterator<Item = &str> {
    let values = request.get_all(name).into_iter().filter_map(|value| value.to_str().ok());
    values.flat_map(|value| value.split(',').map(str::trim))
}

/// Values are made here, of plain characters only; one that is not would be left out.
fn insert(response: &mut Response, name: HeaderName, value: &str) {
    if let Ok(value) = HeaderValue::from_str(value) {
        response.headers_mut().insert(name, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use http_body_util::BodyExt;
    use proptest::prelude::*;

    fn file() -> Download {
        Download::new("text/plain", Disposition::Attachment, "a b\"\r\n-1.txt", &["content"])
    }

    fn request(headers: &[(HeaderName, &str)]) -> HeaderMap {
        headers.iter().map(|(name, value)| (name.clone(), HeaderValue::from_str(value).unwrap())).collect()
    }

    async fn answer(headers: &[(HeaderName, &str)]) -> (u16, String, String) {
        let response = file().bytes(&request(headers), Bytes::from_static(b"0123456789"));
        let range =
            response.headers().get(header::CONTENT_RANGE).map_or("", |range| range.to_str().unwrap()).to_owned();
        let status = response.status().as_u16();
        let body = response.into_body().collect().await.unwrap().to_bytes();
        (status, range, String::from_utf8(body.to_vec()).unwrap())
    }

    #[tokio::test]
    async fn a_file_on_disk_is_sent_as_its_bytes_are() {
        for range in ["bytes=0-0", "bytes=2-4", "bytes=7-99", "bytes=-3", "bytes=12-", "lines=1-2"] {
            let (request, content) = (request(&[(header::RANGE, range)]), b"0123456789");
            let mut file = tempfile::tempfile().unwrap();
            io::Write::write_all(&mut file, content).unwrap();
            let answers = [
                self::file().file(&request, File::from_std(file), 10),
                self::file().bytes(&request, content[..].into()),
            ];
            let [from_disk, from_memory] = answers.map(|answer| async {
                let (mut head, body) = answer.into_parts();
                head.headers.remove(header::CONTENT_LENGTH);
                (head.status, head.headers, body.collect().await.unwrap().to_bytes())
            });
            assert_eq!(from_disk.await, from_memory.await, "{range}");
        }
    }

    #[tokio::test]
    async fn sends_the_part_that_is_asked_for() {
        for (range, content_range, body) in [
            ("bytes=0-0", "bytes 0-0/10", "0"),
            ("bytes=2-4", "bytes 2-4/10", "234"),
            ("bytes=7-", "bytes 7-9/10", "789"),
            ("bytes=7-99", "bytes 7-9/10", "789"),
            ("bytes=7-99999999999999999999999999", "bytes 7-9/10", "789"),
            ("bytes=-3", "bytes 7-9/10", "789"),
            ("Bytes = -99", "bytes 0-9/10", "0123456789"),
        ] {
            let expected = (206, content_range.to_owned(), body.to_owned());
            assert_eq!(answer(&[(header::RANGE, range)]).await, expected, "{range}");
        }
    }

    #[tokio::test]
    async fn refuses_parts_behind_the_end_and_ignores_what_is_no_single_range() {
        for range in ["bytes=10-", "bytes=10-12", "bytes=-0", "bytes=99999999999999999999999999-"] {
            let (status, content_range, body) = answer(&[(header::RANGE, range)]).await;
            assert_eq!((status, content_range.as_str(), body.as_str()), (416, "bytes */10", ""), "{range}");
        }
        for range in ["bytes=", "bytes=-", "bytes=4-2", "bytes=a-b", "bytes=+1-2", "rows=1-2", "bytes=0-1,3-4", "1-2"] {
            assert_eq!(answer(&[(header::RANGE, range)]).await.0, 200, "{range}");
        }
        let mut headers = request(&[(header::RANGE, "bytes=0-1")]);
        headers.append(header::RANGE, HeaderValue::from_static("bytes=3-4"));
        assert_eq!(file().part(&headers), None);
    }

    #[tokio::test]
    async fn continues_only_what_has_not_changed() {
        let (range, tag) = ((header::RANGE, "bytes=2-4"), file().tag);
        assert_eq!(answer(&[range.clone(), (header::IF_RANGE, &tag)]).await.0, 206);
        for other in ["\"other\"", &format!("W/{tag}"), "Sat, 29 Oct 1994 19:43:31 GMT"] {
            assert_eq!(answer(&[range.clone(), (header::IF_RANGE, other)]).await.0, 200, "{other}");
        }
    }

    #[test]
    fn says_that_nothing_has_changed_in_the_client_s_own_words() {
        let tag = file().tag;
        let answered = |value: &str| {
            let response = file().not_modified(&request(&[(header::IF_NONE_MATCH, value)]))?;
            assert_eq!(response.status(), StatusCode::NOT_MODIFIED);
            Some(response.headers()[header::ETAG].to_str().unwrap().to_owned())
        };
        assert_eq!(answered(&tag).as_ref(), Some(&tag));
        assert_eq!(answered("*").as_ref(), Some(&tag));
        assert_eq!(answered(&format!("\"x\", W/{tag}")), Some(format!("W/{tag}")));
        assert_eq!(answered("\"x\""), None);
        assert!(file().not_modified(&HeaderMap::new()).is_none());
    }

    #[test]
    fn tags_tell_all_that_matters_apart() {
        let tag = |media_type, content: &[&str]| Download::new(media_type, Disposition::Inline, "x", content).tag;
        let tags = [tag("a", &["b", "c"]), tag("a", &["bc", ""]), tag("ab", &["c"]), tag("a", &["b"]), tag("a", &[])];
        for (n, one) in tags.iter().enumerate() {
            assert!(tags[..n].iter().all(|other| other != one));
        }
    }

    #[test]
    fn file_names_stay_in_their_quotes() {
        let response = file().whole(Body::empty());
        assert_eq!(response.headers()[header::CONTENT_DISPOSITION], "attachment; filename=\"ab-1.txt\"");
    }

    proptest! {
        #[test]
        fn takes_any_range(value in "(bytes=)?[0-9a-z, =-]{0,40}", length in 0..50_u64) {
            if let Some(range) = parse(&value).and_then(|part| part.within(length)) {
                prop_assert!(range.start < range.end && range.end <= length);
            }
        }
    }
}
