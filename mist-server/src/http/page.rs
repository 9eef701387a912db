//! The page: everything it needs is embedded, so that it works without a network.

use axum::{
    Router,
    extract::Path,
    http::{HeaderName, StatusCode, header},
    response::{IntoResponse, Response},
    routing::get,
};

/// Name, kind and text of a file of the page.
type Embedded = (&'static str, &'static str, &'static str);

const SCRIPT: &str = "text/javascript; charset=utf-8";

macro_rules! scripts {
    ($($name:literal)*) => {
        &[$(($name, SCRIPT, include_str!(concat!("../../page/", $name)))),*]
    };
}

const INDEX: Embedded =
    ("index.html", "text/html; charset=utf-8", include_str!("../../page/index.html"));
const STYLE: Embedded =
    ("style.css", "text/css; charset=utf-8", include_str!("../../page/style.css"));
/// The optical constants of the material that the page shows first.
const GOLD: Embedded = ("gold.nk", "text/plain; charset=utf-8", include_str!("../../page/gold.nk"));
const SCRIPTS: &[Embedded] = scripts!(
    "api.js" "ball.js" "chart.js" "dom.js" "editor.js" "files.js" "form.js" "graph.js"
    "hemisphere.js" "lobe.js" "main.js" "pixels.js" "program.js" "runner.js" "samples.js"
    "spectrum.js" "state.js" "vector.js"
);

/// Nothing comes from elsewhere, and nothing frames the page.
pub(super) const POLICY: &str = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; \
    frame-ancestors 'none'";

/// `/` and `/page/…`
pub(super) fn routes<S: Clone + Send + Sync + 'static>() -> Router<S> {
    Router::new().route("/", get(async || answer(&INDEX))).route("/page/{file}", get(file))
}

async fn file(Path(name): Path<String>) -> Response {
    let all = SCRIPTS.iter().chain([&STYLE, &GOLD]);
    all.into_iter()
        .find(|(known, ..)| *known == name)
        .map_or_else(|| StatusCode::NOT_FOUND.into_response(), answer)
}

fn answer((_, kind, text): &Embedded) -> Response {
    let policy = HeaderName::from_static("content-security-policy");
    ([(header::CONTENT_TYPE, *kind), (policy, POLICY), (header::CACHE_CONTROL, "no-cache")], *text)
        .into_response()
}
