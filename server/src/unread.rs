//! What a refusal leaves of a request's body. An answer to a body that still arrives ends the connection, and who is still
//! writing then may never come to read why; so what nobody wanted is read and thrown away first, for a while.

use axum::body::{Body, Bytes, HttpBody};
use axum::extract::Request;
use axum::http::header;
use axum::middleware::Next;
use axum::response::Response;
use http_body_util::BodyExt;
use hyper::body::{Frame, SizeHint};
use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;
use tokio::sync::oneshot::{self, Sender};
use tokio::time::timeout;

/// How long what is left of a body is read.
const DISCARD_TIME: Duration = Duration::from_secs(5);

/// Answers once the request's body has been read, by whoever answers or else here.
pub async fn discard(request: Request, next: Next) -> Response {
    // Whoever waits for a go-ahead has sent nothing yet, and will not where it is refused.
    if request.body().is_end_stream() || request.headers().contains_key(header::EXPECT) {
        return next.run(request).await;
    }
    let (back, mut returned) = oneshot::channel();
    let response = next.run(request.map(|body| Body::new(Lent { body, back: Some(back) }))).await;
    if let Ok(mut rest) = returned.try_recv() {
        let discard = async { while let Some(Ok(_)) = rest.frame().await {} };
        // In time or not, the answer is the same.
        let _ = timeout(DISCARD_TIME, discard).await;
    }
    response
}

/// A body that comes back when its borrower has done with it.
#[derive(Debug)]
struct Lent {
    body: Body,
    back: Option<Sender<Body>>,
}

impl HttpBody for Lent {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(mut self: Pin<&mut Self>, cx: &mut Context<'_>) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        Pin::new(&mut self.body).poll_frame(cx)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        if let Some(back) = self.back.take() {
            // Nobody waits for it where the request itself was given up.
            let _ = back.send(std::mem::take(&mut self.body));
        }
    }
}
