//! The page of `web/` served to the browser of this machine alone, with the finite elements behind it.
//!
//! | request | answer |
//! |---|---|
//! | `GET /TOKEN/` | the page |
//! | `POST /TOKEN/run` | a robot and its pressure, which start a run |
//! | `GET /TOKEN/run` | how far the run is, or its shape |
//! | `POST /TOKEN/stop` | ends the run |
//!
//! It listens on 127.0.0.1, answers only under a random token, and only what names this very host: a foreign page that has its name
//! resolved to this machine gets nothing.

mod request;
mod run;

use request::{Request, Response};
use run::SharedStand;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io;
use std::net::{TcpListener, TcpStream};
use std::time::Duration;

/// A request takes at most so long, and so does each write of an answer.
const PATIENCE: Duration = Duration::from_secs(10);
/// Without a free descriptor no visitor can be let in for so long.
const FULL: Duration = Duration::from_millis(100);

/// What a page has instead of this comment where finite elements are at hand.
const MARK: &str = "<!--studio-->";

pub(crate) struct Studio {
    listener: TcpListener,
    port: u16,
    token: String,
    page: String,
    bench: SharedStand,
}

impl Studio {
    /// Of a page, on a port of this machine; 0 for a free one.
    pub(crate) fn open(page: &str, port: u16) -> io::Result<Studio> {
        let listener = TcpListener::bind(("127.0.0.1", port))?;
        let port = listener.local_addr()?.port();
        let page = page.replacen(MARK, "<meta name=\"ibr-studio\" content=\"finite elements\">", 1);
        Ok(Studio { listener, port, token: token(), page, bench: SharedStand::default() })
    }

    pub(crate) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// Answers for ever, every visitor on a separate thread.
    pub(crate) fn serve(&self) {
        std::thread::scope(|scope| {
            for stream in self.listener.incoming() {
                match stream {
                    Ok(stream) => drop(scope.spawn(move || self.visit(&stream, PATIENCE))),
                    Err(_) => std::thread::sleep(FULL),
                }
            }
        });
    }

    /// One request; who has left does not hear the answer.
    fn visit(&self, stream: &TcpStream, patience: Duration) {
        if stream.set_write_timeout(Some(patience)).is_err() {
            return;
        }
        let response = match Request::read(stream, patience) {
            Ok(request) => self.answer(&request),
            Err(refused) => refused,
        };
        let _ = response.write(stream);
    }

    fn answer(&self, request: &Request) -> Response {
        if !self.is_own(request) {
            return Response::words(403, "this page is for the browser of this machine alone");
        }
        let place = request.path.strip_prefix('/').and_then(|path| path.split_once('/'));
        let Some(place) = place.filter(|(token, _)| *token == self.token).map(|(_, place)| place) else {
            return Response::words(404, "open the address that ibr studio printed");
        };
        match (request.method.as_str(), place) {
            ("GET", "") => Response::page(&self.page),
            ("GET", "run") => Response::json(&self.bench.told()),
            ("POST", "run") => Response::json(&self.bench.start(&request.body)),
            ("POST", "stop") => Response::json(&self.bench.stop()),
            _ => Response::words(404, "this page does not exist"),
        }
    }

    /// Whether it names this host, and comes from no other one's page.
    fn is_own(&self, request: &Request) -> bool {
        let hosts = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        let is_ours = |host: &str| hosts.iter().any(|ours| ours == host);
        let origin = request.header("origin").is_none_or(|origin| origin.strip_prefix("http://").is_some_and(is_ours));
        origin && request.header("host").is_some_and(is_ours)
    }
}

/// 128 bits that cannot be guessed: the keys of a hash table come from the system's own source.
fn token() -> String {
    let word = || RandomState::new().build_hasher().finish();
    format!("{:016x}{:016x}", word(), word())
}

#[cfg(test)]
mod tests;
