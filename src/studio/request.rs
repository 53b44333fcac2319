//! As much of HTTP as one page needs: a request is read whole, answered, and the connection closed.

use serde_json::Value;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Bytes of a request line and its headers, and of a body.
const MOST_HEAD: u64 = 16 << 10;
const MOST_BODY: u64 = 1 << 20;

/// A visitor who has to be done by a certain time, however slowly the bytes come.
struct Until<'a> {
    stream: &'a TcpStream,
    end: Instant,
}

impl Read for Until<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let left = self.end.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(io::ErrorKind::TimedOut.into());
        }
        self.stream.set_read_timeout(Some(left))?;
        self.stream.read(buffer)
    }
}

pub(super) struct Request {
    pub method: String,
    pub path: String,
    headers: Vec<(String, String)>,
    pub body: Vec<u8>,
}

impl Request {
    /// A request that is whole within `patience`.
    pub(super) fn read(stream: &TcpStream, patience: Duration) -> Result<Request, Response> {
        let broken = |_: io::Error| Response::words(400, "the request broke off");
        let mut reader = BufReader::new(Until { stream, end: Instant::now() + patience });
        let mut head = String::new();
        let mut lines = (&mut reader).take(MOST_HEAD);
        while !head.ends_with("\r\n\r\n") {
            if lines.read_line(&mut head).map_err(broken)? == 0 {
                return Err(Response::words(400, "this is not a request, or a very long one"));
            }
        }
        let mut request = Request::of(&head).ok_or_else(|| Response::words(400, "this is not a request"))?;
        let length = request.header("content-length").map_or(Ok(0), str::parse::<u64>);
        let length = length.map_err(|_| Response::words(400, "this is not a length"))?;
        if length > MOST_BODY {
            return Err(Response::words(413, "a robot of more than a megabyte is none"));
        }
        reader.take(length).read_to_end(&mut request.body).map_err(broken)?;
        Ok(request)
    }

    /// Of its head; `None` if that is none.
    fn of(head: &str) -> Option<Request> {
        let mut lines = head.lines();
        let mut words = lines.next()?.split(' ');
        let (method, path) = (words.next()?.to_string(), words.next()?.to_string());
        words.next().filter(|version| version.starts_with("HTTP/1."))?;
        let header = |line: &str| {
            line.split_once(':').map(|(name, value)| (name.to_ascii_lowercase(), value.trim().to_string()))
        };
        let headers = lines.take_while(|line| !line.is_empty()).map(header).collect::<Option<Vec<_>>>()?;
        Some(Request { method, path, headers, body: Vec::new() })
    }

    /// A header by its name in small letters; nothing where it comes twice, which may mean two things.
    pub(super) fn header(&self, name: &str) -> Option<&str> {
        let mut found = self.headers.iter().filter(|(own, _)| own == name);
        let first = found.next()?;
        found.next().is_none().then_some(first.1.as_str())
    }
}

pub(super) struct Response {
    code: u16,
    kind: &'static str,
    body: Vec<u8>,
}

impl Response {
    pub(super) fn words(code: u16, words: &str) -> Response {
        Response { code, kind: "text/plain; charset=utf-8", body: format!("{words}\n").into_bytes() }
    }

    pub(super) fn page(page: &str) -> Response {
        Response { code: 200, kind: "text/html; charset=utf-8", body: page.as_bytes().to_vec() }
    }

    pub(super) fn json(value: &Value) -> Response {
        Response { code: 200, kind: "application/json", body: value.to_string().into_bytes() }
    }

    pub(super) fn write(&self, mut stream: &TcpStream) -> io::Result<()> {
        let Response { code, kind, body } = self;
        let head = format!(
            "HTTP/1.1 {code} {}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n\
             X-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY\r\nReferrer-Policy: no-referrer\r\n\
             Cross-Origin-Resource-Policy: same-origin\r\nConnection: close\r\n\r\n",
            if *code == 200 { "OK" } else { "Refused" },
            body.len()
        );
        stream.write_all(head.as_bytes())?;
        stream.write_all(body)?;
        stream.flush()
    }
}
