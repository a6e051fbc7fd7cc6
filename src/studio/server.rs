//! The server: addresses, limits, headers.

use super::answer::{File, Kept, Spend};
use super::catalogue::catalogue;
use super::door::Door;
use super::drawing::drawing;
use super::input::Input;
use super::region::region;
use super::work::{Stop, Weight, Work};
use crate::budget::Effort;
use crate::diagnostic::Problem;
use http_body_util::{BodyExt, Full, LengthLimitError, Limited};
use hyper::body::{Bytes, Incoming};
use hyper::header::{self, HeaderValue};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Method, Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use serde::Deserialize;
use serde_json::{Value, json};
use std::convert::Infallible;
use std::net::{Ipv4Addr, TcpListener};
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::TcpStream;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::{sleep, timeout};

/// Largest body of a request: a case of the largest size, with what JSON adds to it.
const MAX_BODY: usize = 6 << 20;
/// Connections at once.
const CONNECTIONS: usize = 64;
/// For the head of a request to come, and for its body.
const ARRIVAL: Duration = Duration::from_secs(15);
/// For a drawing, and for a file.
const LIGHT: Duration = Duration::from_secs(60);
/// After this time a connection ends with the request that it serves.
const LIFE: Duration = Duration::from_secs(900);

/// The parts of the page: path, type, content.
const ASSETS: [(&str, &str, &str); 7] = [
    ("", "text/html; charset=utf-8", include_str!("assets/index.html")),
    ("studio.css", "text/css; charset=utf-8", include_str!("assets/studio.css")),
    ("main.js", JS, include_str!("assets/main.js")),
    ("api.js", JS, include_str!("assets/api.js")),
    ("input.js", JS, include_str!("assets/input.js")),
    ("view.js", JS, include_str!("assets/view.js")),
    ("results.js", JS, include_str!("assets/results.js")),
];
const JS: &str = "text/javascript; charset=utf-8";

/// What the page may do: nothing but what this server sends.
const PAGE: &str = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:; \
                    frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// A report or a picture has styles of its own, and runs nothing.
const FILE: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'; \
                    frame-ancestors 'self'; sandbox allow-same-origin";

/// A server on this machine, bound and not yet started.
pub struct Studio {
    listener: TcpListener,
    door: Door,
}

struct State {
    door: Door,
    work: Arc<Work>,
    catalogue: String,
}

/// The body of a request for a proof.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Prove {
    page: String,
    input: Input,
    effort: String,
    #[serde(default)]
    check: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Draw {
    input: Input,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Page {
    page: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Slider {
    page: String,
    name: String,
    parameter: String,
}

impl Studio {
    /// Binds to a port of the loopback address; 0 is any free one.
    ///
    /// # Errors
    /// A [`Problem`] where the port is taken.
    pub fn bind(port: u16) -> Result<Self, Problem> {
        let failed = |error: &dyn std::fmt::Display| {
            Problem::new("secant::studio::port", format!("the studio cannot listen on port {port}: {error}"))
                .with_help("leave out --port to take any free one")
        };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(|e| failed(&e))?;
        let port = listener.local_addr().map_err(|e| failed(&e))?.port();
        listener.set_nonblocking(true).map_err(|e| failed(&e))?;
        Ok(Self { listener, door: Door::new(port).map_err(|e| failed(&e))? })
    }

    /// The address of the page, with the token.
    #[must_use]
    pub fn address(&self) -> String {
        self.door.address()
    }

    /// Serves until the process ends.
    ///
    /// # Errors
    /// A [`Problem`] where the system gives no means to wait for connections.
    pub fn serve(self) -> Result<Infallible, Problem> {
        let failed = |error: std::io::Error| Problem::new("secant::studio::port", format!("the studio fails: {error}"));
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(failed)?;
        let state =
            Arc::new(State { door: self.door, work: Arc::new(Work::new()), catalogue: catalogue().to_string() });
        runtime.block_on(async move {
            let listener = tokio::net::TcpListener::from_std(self.listener).map_err(failed)?;
            let places = Arc::new(Semaphore::new(CONNECTIONS));
            loop {
                let place = Arc::clone(&places).acquire_owned().await.expect("the places are never closed");
                match listener.accept().await {
                    Ok((stream, _)) => drop(tokio::spawn(connection(Arc::clone(&state), stream, place))),
                    // Too many open files, or a visitor who went away.
                    Err(_) => sleep(Duration::from_millis(20)).await,
                }
            }
        })
    }
}

async fn connection(state: Arc<State>, stream: TcpStream, _place: OwnedSemaphorePermit) {
    let service = service_fn(move |request| {
        let state = Arc::clone(&state);
        async move { Ok::<_, Infallible>(answer(state, request).await) }
    });
    let mut builder = http1::Builder::new();
    builder.timer(TokioTimer::new()).header_read_timeout(ARRIVAL).max_buf_size(64 << 10).max_headers(64);
    let mut served = pin!(builder.serve_connection(TokioIo::new(stream), service));
    if timeout(LIFE, served.as_mut()).await.is_err() {
        served.as_mut().graceful_shutdown();
        // A visitor that takes nothing more is left alone after that.
        let _ = timeout(LIFE, served).await;
    }
}

type Answer = Response<Full<Bytes>>;

fn response(status: StatusCode, mime: &'static str, policy: &'static str, content: String) -> Answer {
    let mut response = Response::new(Full::new(Bytes::from(content)));
    *response.status_mut() = status;
    let headers = response.headers_mut();
    let mut set = |name, value: &'static str| drop(headers.insert(name, HeaderValue::from_static(value)));
    set(header::CONTENT_TYPE, mime);
    set(header::CONTENT_SECURITY_POLICY, policy);
    set(header::CACHE_CONTROL, "no-store");
    set(header::REFERRER_POLICY, "no-referrer");
    set(header::X_CONTENT_TYPE_OPTIONS, "nosniff");
    set(header::HeaderName::from_static("cross-origin-resource-policy"), "same-origin");
    set(header::HeaderName::from_static("cross-origin-opener-policy"), "same-origin");
    response
}

fn data(value: &Value) -> Answer {
    response(StatusCode::OK, "application/json", PAGE, value.to_string())
}

fn refused(status: StatusCode) -> Answer {
    let said = match status {
        StatusCode::NOT_FOUND => {
            "There is nothing here. The address of the studio has a token: open it as it was printed.\n"
        }
        StatusCode::PAYLOAD_TOO_LARGE => "The request is too large.\n",
        _ => "This request is not answered.\n",
    };
    response(status, "text/plain; charset=utf-8", PAGE, said.to_owned())
}

fn trouble(problem: &Problem) -> Answer {
    let status = match problem.id() {
        Problem::STOPPED => StatusCode::CONFLICT,
        Problem::INTERNAL => StatusCode::INTERNAL_SERVER_ERROR,
        "secant::studio::busy" => StatusCode::SERVICE_UNAVAILABLE,
        "secant::studio::time" => StatusCode::GATEWAY_TIMEOUT,
        _ => StatusCode::UNPROCESSABLE_ENTITY,
    };
    let (line, column) = problem.position().unzip();
    let error = json!({
        "code": problem.id(),
        "message": problem.message(),
        "help": problem.remedy(),
        "line": line,
        "column": column,
    });
    response(status, "application/json", PAGE, json!({ "error": error }).to_string())
}

async fn answer(state: Arc<State>, request: Request<Incoming>) -> Answer {
    let (head, body) = request.into_parts();
    let path = match state.door.admit(&head.method, head.uri.path(), &head.headers) {
        Ok(path) => path,
        Err(status) => return refused(status),
    };
    if head.method == Method::GET {
        return get(&state, path, head.uri.query()).await;
    }
    let body = match timeout(ARRIVAL, Limited::new(body, MAX_BODY).collect()).await {
        Ok(Ok(body)) => body.to_bytes(),
        Ok(Err(error)) if error.is::<LengthLimitError>() => return refused(StatusCode::PAYLOAD_TOO_LARGE),
        Ok(Err(_)) => return refused(StatusCode::BAD_REQUEST),
        Err(_) => return refused(StatusCode::REQUEST_TIMEOUT),
    };
    let answered = match path {
        "api/draw" => draw(&state, &body).await,
        "api/prove" => prove(&state, &body).await,
        "api/region" => colours(&state, &body).await,
        "api/stop" => read::<Page>(&body).map(|asked| data(&json!({ "stopped": state.work.stop(&asked.page) }))),
        _ => return refused(StatusCode::NOT_FOUND),
    };
    answered.unwrap_or_else(|problem| trouble(&problem))
}

fn read<'a, T: Deserialize<'a>>(body: &'a [u8]) -> Result<T, Problem> {
    serde_json::from_slice(body).map_err(|error| {
        Problem::new("secant::studio::request", format!("the request is not understood: {error}"))
            .with_help("reload the page")
    })
}

async fn get(state: &State, path: &str, query: Option<&str>) -> Answer {
    if let Some((_, mime, content)) = ASSETS.iter().find(|(name, _, _)| *name == path) {
        return response(StatusCode::OK, mime, PAGE, (*content).to_owned());
    }
    if path == "api/catalogue" {
        return response(StatusCode::OK, "application/json", PAGE, state.catalogue.clone());
    }
    let named = path.strip_prefix("answer/").and_then(|rest| rest.split_once('/'));
    let Some((number, name)) = named.and_then(|(number, name)| Some((number.parse::<u64>().ok()?, name))) else {
        return refused(StatusCode::NOT_FOUND);
    };
    let Some(kept) = state.work.kept(number) else { return refused(StatusCode::GONE) };
    let (stop, name) = (Stop::unnamed(), name.to_owned());
    match state.work.run(Weight::Light, LIGHT, &stop, move || kept.file(&name)).await {
        Ok(Some(File { mime, name, content })) => {
            let mut response = response(StatusCode::OK, mime, FILE, content);
            if query == Some("save") {
                // Names have letters, digits and hyphens only.
                let value = HeaderValue::from_str(&format!("attachment; filename=\"{name}\""));
                response.headers_mut().extend(value.ok().map(|v| (header::CONTENT_DISPOSITION, v)));
            }
            response
        }
        Ok(None) => refused(StatusCode::NOT_FOUND),
        Err(problem) => trouble(&problem),
    }
}

async fn draw(state: &State, body: &[u8]) -> Result<Answer, Problem> {
    let asked: Draw = read(body)?;
    let work = move || {
        let drawn = drawing(&asked.input.asked()?);
        serde_json::to_string(&drawn).map_err(|e| Problem::new(Problem::INTERNAL, e.to_string()))
    };
    let text = state.work.run(Weight::Light, LIGHT, &Stop::unnamed(), work).await?;
    Ok(response(StatusCode::OK, "application/json", PAGE, text))
}

/// The coloured parts of a slider; of each page one search at a time.
async fn colours(state: &State, body: &[u8]) -> Result<Answer, Problem> {
    let asked: Slider = read(body)?;
    let stop = state.work.newer(&format!("{}/region", asked.page))?;
    let work = move || region(&asked.name, &asked.parameter);
    Ok(data(&state.work.run(Weight::Search, LIGHT, &stop, work).await?))
}

async fn prove(state: &State, body: &[u8]) -> Result<Answer, Problem> {
    let asked: Prove = read(body)?;
    let spend = Spend::named(&asked.effort).ok_or_else(|| {
        Problem::new("secant::studio::request", "this effort is not known")
            .with_help("an effort is first, quick, normal or hard")
    })?;
    let limit = match spend {
        Spend::First | Spend::Quick => 20,
        Spend::Whole(Effort::Hard) => 600,
        Spend::Whole(_) => 120,
    };
    let stop = state.work.newer(&asked.page)?;
    let work = move || {
        let kept = Kept::prove(asked.input.asked()?, spend, asked.check)?;
        let value = kept.value();
        Ok((Arc::new(kept), value))
    };
    let (kept, mut value) = state.work.run(Weight::Proof, Duration::from_secs(limit), &stop, work).await?;
    // It names the answer in the addresses of its files.
    value["id"] = state.work.keep(kept).into();
    Ok(data(&value))
}
