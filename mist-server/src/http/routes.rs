//! Every route of the service, and its description in OpenAPI.

use axum::{
    Router,
    extract::DefaultBodyLimit,
    http::{HeaderValue, header},
    middleware::{self, map_response},
    response::Response,
    routing::get,
};
use tower::util::option_layer;
use tower_http::compression::CompressionLayer;
use utoipa::OpenApi;
use utoipa_axum::{router::OpenApiRouter, routes};

use super::{
    color, error::ApiError, evaluate, guard, health, integrate, jobs, materials, metrics, models,
    page, problem::Problem, run, state::App, table,
};

/// The description of the API besides its routes.
#[derive(OpenApi)]
#[openapi(
    info(
        title = "mist",
        description = "Polarized scattering of materials, and their colours for renderers.",
        license(name = "MIT OR Apache-2.0", identifier = "MIT OR Apache-2.0"),
    ),
    components(schemas(Problem)),
    security((), ("key" = [])),
    modifiers(&KeyScheme),
)]
struct Api;

/// The scheme of the keys.
struct KeyScheme;

impl utoipa::Modify for KeyScheme {
    fn modify(&self, api: &mut utoipa::openapi::OpenApi) {
        use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityScheme};
        let components = api.components.get_or_insert_default();
        components
            .add_security_scheme("key", SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer)));
    }
}

/// Every route with its description.
fn routes() -> OpenApiRouter<App> {
    OpenApiRouter::with_openapi(Api::openapi())
        .routes(routes!(health::healthz))
        .routes(routes!(health::readyz))
        .routes(routes!(metrics::metrics))
        .routes(routes!(models::list))
        .routes(routes!(models::get))
        .routes(routes!(color::color))
        .routes(routes!(evaluate::angles))
        .routes(routes!(materials::list))
        .routes(routes!(materials::put, materials::get, materials::delete))
        .routes(routes!(integrate::integrate))
        .routes(routes!(evaluate::vectors))
        .routes(routes!(table::table))
        .routes(routes!(run::run))
        .routes(routes!(run::check))
        .routes(routes!(jobs::submit, jobs::list))
        .routes(routes!(jobs::get, jobs::cancel))
        .routes(routes!(jobs::events))
        .routes(routes!(jobs::results))
        .routes(routes!(jobs::listing))
        .routes(routes!(jobs::samples))
        .routes(routes!(jobs::table))
}

/// Makes the tag of a compressed answer a weak one: its bytes are not those of the plain answer.
async fn weaken_tag(mut response: Response) -> Response {
    let headers = response.headers_mut();
    if headers.contains_key(header::CONTENT_ENCODING)
        && let Some(tag) = headers.get(header::ETAG).and_then(|tag| tag.to_str().ok())
        && !tag.starts_with("W/")
        && let Ok(tag) = HeaderValue::from_str(&format!("W/{tag}"))
    {
        headers.insert(header::ETAG, tag);
    }
    response
}

/// The OpenAPI document, as it is served.
pub fn openapi() -> String {
    let (_, api) = routes().split_for_parts();
    api.to_pretty_json().expect("a document of texts has a JSON form") + "\n"
}

/// The service, without a socket.
pub fn router(app: App) -> Router {
    let (router, _) = routes().split_for_parts();
    let router = router.merge(page::routes());
    let document = axum::body::Bytes::from(openapi());
    let json = [(axum::http::header::CONTENT_TYPE, "application/json")];
    #[cfg(feature = "swagger")]
    let router = router.merge(
        utoipa_swagger_ui::SwaggerUi::new("/docs")
            .config(utoipa_swagger_ui::Config::new(["/openapi.json"])),
    );
    router
        .route("/openapi.json", get(async move || (json, document)))
        .fallback(async |uri: axum::http::Uri| ApiError::NotFound(format!("{} here", uri.path())))
        .method_not_allowed_fallback(async || ApiError::Method)
        .layer(DefaultBodyLimit::max(app.limits.max_body))
        .layer(middleware::from_fn_with_state(app.clone(), guard::guard))
        .layer(CompressionLayer::new())
        .layer(map_response(weaken_tag))
        .layer(option_layer(app.origins.cors()))
        .with_state(app)
}
