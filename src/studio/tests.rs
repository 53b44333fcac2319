use super::*;
use std::io::{Read, Write};
use std::sync::Arc;

fn opened() -> Arc<Studio> {
    let studio = Arc::new(Studio::open("<head><!--studio--></head>", 0).unwrap());
    let served = Arc::clone(&studio);
    std::thread::spawn(move || served.serve());
    studio
}

/// The answer to a request with these headers and this body; `HERE` is the host.
fn asked(studio: &Studio, request: &str, headers: &str, body: &str) -> String {
    let here = format!("127.0.0.1:{}", studio.port);
    let mut stream = TcpStream::connect(&here).unwrap();
    let headers = headers.replace("HERE", &here);
    write!(stream, "{request} HTTP/1.1\r\n{headers}Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
    let mut told = String::new();
    stream.read_to_string(&mut told).unwrap();
    told
}

#[test]
fn the_page_comes_under_its_token_and_says_that_finite_elements_are_there() {
    let studio = opened();
    let told = asked(&studio, &format!("GET /{}/", studio.token), "Host: HERE\r\n", "");
    assert!(told.starts_with("HTTP/1.1 200 ") && told.contains("<meta name=\"ibr-studio\""), "{told}");
    for place in ["/", "/run", "/0123/run", &format!("/{}x/", studio.token), &format!("/{}/other", studio.token)] {
        let told = asked(&studio, &format!("GET {place}"), "Host: HERE\r\n", "");
        assert!(told.starts_with("HTTP/1.1 404 "), "{place}: {told}");
    }
}

#[test]
fn who_names_another_host_or_comes_from_another_page_is_refused() {
    let studio = opened();
    let run = format!("GET /{}/run", studio.token);
    for headers in [
        "",
        "Host: evil.example\r\n",
        "Host: HERE\r\nHost: evil.example\r\n",
        "Host: HERE\r\nOrigin: http://evil.example\r\n",
        "Host: HERE\r\nOrigin: null\r\n",
    ] {
        let told = asked(&studio, &run, headers, "");
        assert!(told.starts_with("HTTP/1.1 403 "), "{headers}: {told}");
    }
    let told = asked(&studio, &run, "Host: HERE\r\nOrigin: http://HERE\r\n", "");
    assert!(told.contains("{\"state\":\"none\"}"), "{told}");
}

#[test]
fn a_wish_that_means_nothing_is_refused_with_a_remedy() {
    let studio = opened();
    let run = format!("POST /{}/run", studio.token);
    let told = asked(&studio, &run, "Host: HERE\r\n", "{\"name\": \"mine\"}");
    assert!(told.contains("missing field `text`") && told.contains("send name, text and actuator_kpa"), "{told}");
    let told = asked(&studio, &run, "Host: HERE\r\n", r#"{"name": "mine", "text": "[body]", "actuator_kpa": 10}"#);
    assert!(told.contains("\"runs\""), "{told}");
    let ended = |_: &u32| {
        std::thread::sleep(Duration::from_millis(20));
        asked(&studio, &format!("GET /{}/run", studio.token), "Host: HERE\r\n", "").contains("mine:1: ")
    };
    assert!((0..500).find(ended).is_some(), "{}", studio.bench.told());
    let told = asked(&studio, "GET / nonsense", "", "");
    assert!(told.starts_with("HTTP/1.1 400 "), "{told}");
}

#[test]
fn a_run_whose_mesh_is_large_stops_at_once() {
    let studio = opened();
    let text = "[body]\nradius_mm = 200\nlength_mm = 10000\npressure_kpa = 2\n[actuator]\nkind = \"epam\"\nlength_mm = 60\nwidth_mm = 60\ncount = 150\n";
    let body = serde_json::json!({"name": "long", "text": text, "actuator_kpa": 10}).to_string();
    let run = |method: &str, what: &str| format!("{method} /{}/{what}", studio.token);
    let told = asked(&studio, &run("POST", "run"), "Host: HERE\r\n", &body);
    assert!(told.contains("building the mesh"), "{told}");
    let told = asked(&studio, &run("POST", "stop"), "Host: HERE\r\n", "");
    assert!(told.contains("\"stopped\""), "{told}");
    let other = r#"{"name": "mine", "text": "[body]", "actuator_kpa": 10}"#;
    let ended = |_: &u32| {
        std::thread::sleep(Duration::from_millis(20));
        !asked(&studio, &run("POST", "run"), "Host: HERE\r\n", other).contains("try again in a moment")
    };
    assert!((0..3000).find(ended).is_some(), "{}", studio.bench.told());
}

/// A byte now and then does not keep a thread for ever.
#[test]
fn a_slow_request_ends() {
    let studio = opened();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let mut slow = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
    let (visitor, _) = listener.accept().unwrap();
    let writes = std::thread::spawn(move || {
        while slow.write_all(b"x").is_ok() {
            std::thread::sleep(Duration::from_millis(10));
        }
    });
    studio.visit(&visitor, Duration::from_millis(200));
    drop(visitor);
    writes.join().unwrap();
}

#[test]
fn tokens_differ() {
    assert_eq!(token().len(), 32);
    assert_ne!(token(), token());
}
