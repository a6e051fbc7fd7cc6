//! `secant studio` over HTTP: who is let in, that its answers are those of the library, limits, cancellation, and many requests.
#![cfg(feature = "studio")]

use secant::budget::Budget;
use secant::case::Question;
use secant::prelude::prove;
use secant::report::claims;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A server of the program, ended with the test.
struct Server {
    process: Child,
    port: u16,
    token: String,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|e| panic!("{}: {e}: {}", self.status, self.body))
    }

    fn code(&self) -> String {
        self.json()["error"]["code"].as_str().unwrap_or_default().to_owned()
    }
}

/// A connection that is used again.
struct Line(BufReader<TcpStream>);

impl Line {
    fn ask(&mut self, request: &[u8]) -> Answer {
        self.0.get_mut().write_all(request).unwrap();
        self.read()
    }

    fn read(&mut self) -> Answer {
        let mut head = String::new();
        while !head.ends_with("\r\n\r\n") {
            assert!(self.0.read_line(&mut head).unwrap() > 0, "the connection ended: {head}");
        }
        let length = head.lines().find_map(|l| l.to_lowercase().strip_prefix("content-length: ").map(str::to_owned));
        let mut body = vec![0; length.map_or(0, |l| l.trim().parse().unwrap())];
        self.0.read_exact(&mut body).unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        Answer { status, head, body: String::from_utf8(body).unwrap() }
    }
}

impl Server {
    fn start() -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_secant"))
            .args(["studio", "--no-open"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut address = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut address).unwrap();
        let (host, token) = address.trim().strip_prefix("http://").unwrap().split_once('/').unwrap();
        let port = host.strip_prefix("127.0.0.1:").unwrap().parse().unwrap();
        Self { process, port, token: token.trim_end_matches('/').to_owned() }
    }

    fn line(&self) -> Line {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
        Line(BufReader::new(stream))
    }

    fn head(&self, method: &str, path: &str, length: usize) -> String {
        let (port, token) = (self.port, &self.token);
        format!(
            "{method} /{token}/{path} HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\ncontent-type: application/json\r\ncontent-length: {length}\r\n\r\n"
        )
    }

    fn get(&self, path: &str) -> Answer {
        self.line().ask(self.head("GET", path, 0).as_bytes())
    }

    fn post(&self, path: &str, body: &Value) -> Answer {
        self.line().ask(&self.posted(path, &body.to_string()))
    }

    fn posted(&self, path: &str, body: &str) -> Vec<u8> {
        (self.head("POST", path, body.len()) + body).into_bytes()
    }

    /// Memory in use, in bytes.
    fn memory(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.process.id())).unwrap();
        let line = status.lines().find(|l| l.starts_with("VmRSS:")).unwrap();
        line.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap() << 10
    }

    fn threads(&self) -> usize {
        std::fs::read_dir(format!("/proc/{}/task", self.process.id())).unwrap().count()
    }
}

fn scheme(name: &str, parameters: Value) -> Value {
    json!({"kind": "scheme", "name": name, "parameters": parameters})
}

fn quick(page: &str, input: Value) -> Value {
    json!({"page": page, "input": input, "effort": "quick"})
}

#[test]
fn the_page_is_served_whole_with_a_policy() {
    let server = Server::start();
    let page = server.get("");
    assert_eq!(page.status, 200);
    for header in ["content-security-policy: default-src 'none'", "nosniff", "no-referrer", "no-store"] {
        assert!(page.head.contains(header), "{header}: {}", page.head);
    }
    let parts = page.body.split(['"']).filter(|s| s.ends_with(".js") || s.ends_with(".css"));
    let mut named: Vec<String> = parts.map(str::to_owned).collect();
    assert!(named.len() >= 2, "{named:?}");
    let main = server.get("main.js").body;
    named.extend(main.split('"').filter_map(|s| s.strip_prefix("./")).map(str::to_owned));
    for name in named {
        let part = server.get(&name);
        assert!(part.status == 200 && part.body.len() > 200, "{name}");
        // No part of the page comes from anywhere else, and nothing is read as HTML.
        let far = part.body.replace("http://www.w3.org/2000/svg", "");
        assert!(!far.contains("http://") && !far.contains("https://") && !far.contains("innerHTML"), "{name}");
    }
    let catalogue = server.get("api/catalogue").json();
    assert_eq!(catalogue["schemes"].as_array().unwrap().len(), secant::scheme::list().len());
}

#[test]
fn nobody_else_is_let_in() {
    let server = Server::start();
    let (port, token) = (server.port, &server.token);
    let status = |request: String| server.line().ask(request.as_bytes()).status;
    let end = "content-length: 0\r\n\r\n";
    assert_eq!(status(format!("GET /{token}/ HTTP/1.1\r\nhost: localhost:{port}\r\n{end}")), 200);
    for (want, request) in [
        (404, format!("GET / HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\n{end}")),
        (404, format!("GET /{}/ HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\n{end}", "0".repeat(32))),
        (404, format!("GET /{token}/../Cargo.toml HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\n{end}")),
        (404, format!("GET /{token}/%2e%2e/Cargo.toml HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\n{end}")),
        (404, format!("GET /{token}//etc/passwd HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\n{end}")),
        (403, format!("GET /{token}/ HTTP/1.1\r\nhost: evil.example\r\n{end}")),
        (403, format!("GET /{token}/ HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\norigin: https://evil.example\r\n{end}")),
        (403, format!("GET /{token}/ HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\nsec-fetch-site: cross-site\r\n{end}")),
        (405, format!("PUT /{token}/api/draw HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\n{end}")),
        (415, format!("POST /{token}/api/draw HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\n{end}")),
        (400, format!("GET /{token}/ HTTP/1.1\r\n{end}")),
    ] {
        assert_eq!(status(request.clone()), want, "{request}");
    }
    // Bound to the loopback address alone.
    let sockets = std::fs::read_to_string("/proc/net/tcp").unwrap();
    let bound = sockets.lines().filter(|l| l.contains(&format!(":{port:04X} 00000000:0000 0A")));
    let bound: Vec<&str> = bound.collect();
    assert!(bound.len() == 1 && bound[0].contains(&format!("0100007F:{port:04X}")), "{bound:?}");
}

#[test]
fn answers_are_those_of_the_library() {
    let server = Server::start();
    for name in [
        "thesis/half-tangent",
        "control/bezier-cusp",
        "sets/sierpinski",
        "surfaces/bicubic-space",
        "classical/takagi",
        "fields/koch-sqrt3",
    ] {
        let path = format!("{}/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap();
        let found = prove(&Question::parse("case.toml", &text).unwrap(), &Budget::default()).unwrap();
        let input = json!({"kind": "text", "text": text});
        let answer = server.post("api/prove", &json!({"page": "p", "input": input, "effort": "normal", "check": true}));
        let value = answer.json();
        let all = found.claims();
        let wanted: Vec<Value> =
            all.iter().map(|c| json!([claims::label(&c.what), c.verdict().word(), claims::judged(c)])).collect();
        let got: Vec<Value> =
            value["claims"].as_array().unwrap().iter().map(|c| json!([c["about"], c["verdict"], c["text"]])).collect();
        assert_eq!(got, wanted, "{name}");
        assert_eq!(value["verdict"], found.verdict().word(), "{name}");
        assert!(["yes", "part"].contains(&value["checked"].as_str().unwrap()), "{name}: {}", value["checked"]);
        files(&server, &value, &text, name);
        let drawn = server.post("api/draw", &json!({"input": input})).json();
        let points = drawn["points"].as_array().unwrap().len() + drawn["vertices"].as_array().unwrap().len();
        assert!(points > 20 && drawn["text"] == text.as_str(), "{name}: {points} points");
    }
}

/// The first answer to a question decides less than the next ones, and nothing differently.
#[test]
fn a_first_answer_is_a_part_of_the_next() {
    let server = Server::start();
    for (name, parameters) in
        [("four-point", json!({"w": "3/40"})), ("bspline", json!({"degree": "3"})), ("takagi", json!({}))]
    {
        let mut input = scheme(name, parameters);
        input["control"] = "suggested".into();
        let [first, quick] = ["first", "quick"]
            .map(|effort| server.post("api/prove", &json!({"page": "p", "input": input, "effort": effort})).json());
        assert_eq!((&first["effort"], &quick["effort"]), (&json!("first"), &json!("quick")));
        let verdict = |answer: &Value, about: &Value| {
            let all = answer["claims"].as_array().unwrap();
            all.iter().find(|c| c["about"] == *about).map(|c| c["verdict"].clone())
        };
        for about in ["ends", "joints", "every point (G¹)"].map(|about| json!(about)) {
            let (a, b) = (verdict(&first, &about), verdict(&quick, &about));
            assert!(a == b || a == Some(json!("undetermined")), "{name}: {about}: {a:?}, {b:?}");
        }
        assert_eq!(verdict(&first, &json!("ends")), Some(json!("proved")), "{name}");
        assert_eq!(first["points"][0]["tangent"], quick["points"][0]["tangent"], "{name}");
    }
}

/// The files of an answer: the certificate is accepted, the others are what they say.
fn files(server: &Server, value: &Value, text: &str, name: &str) {
    let id = &value["id"];
    let file = |part: &str| server.get(&format!("answer/{id}/{part}"));
    let certificate = file("certificate");
    assert_eq!(certificate.status, 200, "{name}");
    let case = if value["expanded"] == true { file("expanded").body } else { text.to_owned() };
    assert!(secant_check::check(&case, &certificate.body).is_ok(), "{name}");
    assert_eq!(file("case").body, text);
    let report = file("report");
    assert!(report.body.contains("<math") && report.head.contains("sandbox"), "{name}");
    assert!(file("picture").body.starts_with("<svg") && file("data").json()["version"] == 1, "{name}");
    for (k, point) in value["points"].as_array().unwrap().iter().enumerate() {
        let proof = file(&format!("point-{k}")).body;
        assert!(proof.contains("Conclusion"), "{name}: {}", point["name"]);
    }
    assert_eq!(file(&format!("point-{}", value["points"].as_array().unwrap().len())).status, 404);
    assert_eq!(file("../../Cargo.toml").status, 404);
    let saved = server.get(&format!("answer/{id}/report?save"));
    assert!(saved.head.contains("attachment; filename=\""), "{}", saved.head);
}

#[test]
fn a_control_point_changes_the_verdict() {
    let server = Server::start();
    let bezier = |y: &str| {
        let points = json!({"points": [["0", "0"], ["1", "1"], ["0", "1"], ["1", y]]});
        let input = json!({"kind": "scheme", "name": "bezier", "control": points});
        let value = server.post("api/prove", &quick("p", input)).json();
        let g1 = value["claims"].as_array().unwrap().iter().find(|c| c["about"].as_str().unwrap().contains("G¹"));
        g1.unwrap()["verdict"].as_str().unwrap().to_owned()
    };
    assert_eq!((bezier("0").as_str(), bezier("-1").as_str()), ("refuted", "proved"));
}

#[test]
fn meshes_and_vertices_are_answered() {
    let server = Server::start();
    let text = std::fs::read_to_string(format!("{}/cases/meshes/octahedron.obj", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let input = json!({"kind": "mesh", "text": text, "scheme": "loop"});
    let value = server.post("api/prove", &quick("p", input.clone())).json();
    assert_eq!((&value["verdict"], value["points"].as_array().unwrap().len()), (&"proved".into(), 6));
    assert!(server.post("api/draw", &json!({"input": input})).json()["faces"].as_array().unwrap().len() >= 128);
    let torn = json!({"kind": "mesh", "text": format!("{text}f 1 2 99\n"), "scheme": "loop"});
    let torn = server.post("api/draw", &json!({"input": torn}));
    assert!(torn.status == 422 && torn.json()["error"]["line"].is_u64(), "{}", torn.body);
    let input = json!({"kind": "rule", "name": "catmull-clark", "valence": "5"});
    let value = server.post("api/prove", &quick("p", input)).json();
    assert_eq!(value["claims"][0]["verdict"], "proved");
    assert!(server.get(&format!("answer/{}/picture", value["id"])).body.starts_with("<svg"));
}

#[test]
fn the_parts_of_a_slider_are_those_of_the_region() {
    let server = Server::start();
    let asked = |name: &str, parameter: &str| {
        server.post("api/region", &json!({"page": "p", "name": name, "parameter": parameter}))
    };
    let value = asked("ternary-four-point", "mu").json();
    let smooth = &value["orders"][2]["parts"];
    // C² between 1/15 and 1/9, on a slider from 1/495 to 98/495.
    let proved: Vec<&Value> = smooth.as_array().unwrap().iter().filter(|p| p["verdict"] == "proved").collect();
    let place = |x: f64| (x * 495.0 - 1.0) / 97.0;
    let near = |value: &Value, x: f64| (value.as_f64().unwrap() - place(x)).abs() < 1e-9;
    assert!(proved.len() == 1 && near(&proved[0]["from"], 1.0 / 15.0) && near(&proved[0]["to"], 1.0 / 9.0), "{smooth}");
    for (name, parameter) in
        [("cases/schemes/dd4.toml", "w"), ("four-point", "x"), ("koch", "pieces"), ("bspline", "degree")]
    {
        assert_eq!(asked(name, parameter).status, 422, "{name}");
    }
}

/// Bodies that are no requests, or ask for what is refused: each with the status of the answer.
fn broken() -> Vec<(u16, String)> {
    let text = |text: &str| quick("p", json!({"kind": "text", "text": text})).to_string();
    let deep = format!("name = \"a\"\ncontrol = {}{}\n", "[".repeat(50_000), "]".repeat(50_000));
    vec![
        (422, String::new()),
        (422, "{".to_owned()),
        (422, "[".repeat(100_000)),
        (422, "null".to_owned()),
        (422, "\u{0}\u{1}\u{feff}".to_owned()),
        (422, json!({"page": "p", "input": scheme("koch", json!({})), "effort": "endless"}).to_string()),
        (422, json!({"page": "", "input": scheme("koch", json!({})), "effort": "quick"}).to_string()),
        (422, quick("p", scheme("nonsense", json!({}))).to_string()),
        (422, quick("p", scheme("four-point", json!({"w": "1/0"}))).to_string()),
        (422, quick("p", scheme("four-point", json!({"name": "koch"}))).to_string()),
        (422, quick("p", scheme("bspline", json!({"degree": "1e999999999"}))).to_string()),
        (422, quick("p", json!({"kind": "file", "path": "/etc/passwd"})).to_string()),
        (422, quick("p", json!({"kind": "mesh", "text": "f 1 2 3", "scheme": "loop"})).to_string()),
        (422, text("")),
        (422, text("Cargo.toml")),
        (422, text("/etc/passwd")),
        (422, text("-")),
        (422, text("1/4, 3/4, x")),
        (422, text(&"(".repeat(100_000))),
        (422, text(&format!("(z+{}", "(1+z)*".repeat(20_000)))),
        (422, text("name = \"a\"\n[[piece]]\n")),
        (422, text(&deep)),
        (422, text("name = \"a\"\npieces = [[[\"9e999999\"]]]\n")),
    ]
}

#[test]
fn broken_input_is_refused_and_harms_nothing() {
    let server = Server::start();
    for (status, body) in broken() {
        let answer = server.line().ask(&server.posted("api/prove", &body));
        assert_eq!(answer.status, status, "{}: {}", &body[..body.len().min(80)], answer.body);
        assert!(!answer.json()["error"]["message"].as_str().unwrap().is_empty());
    }
    // Too large: refused as soon as that is seen.
    let large = server.line().ask(&server.posted("api/draw", &" ".repeat(7 << 20)));
    assert_eq!(large.status, 413);
    assert_eq!(server.post("api/nothing", &json!({})).status, 404);
    assert_eq!(server.get("answer/77/report").status, 410);
    for junk in [&b"\x16\x03\x01 not HTTP\r\n\r\n"[..], b"GET\r\n\r\n"] {
        let mut stream = server.line();
        let _ = stream.0.get_mut().write_all(junk);
        let mut rest = Vec::new();
        let _ = stream.0.read_to_end(&mut rest);
        assert!(!rest.starts_with(b"HTTP/1.1 200"));
    }
    assert_eq!(server.post("api/prove", &quick("p", scheme("koch", json!({})))).status, 200);
}

/// Something that takes long with the largest budget.
fn long(page: &str) -> Value {
    let path = format!("{}/cases/{LONG}", env!("CARGO_MANIFEST_DIR"));
    json!({"page": page, "input": {"kind": "text", "text": std::fs::read_to_string(path).unwrap()}, "effort": "hard"})
}
const LONG: &str = "contraction/slow-corner-cutting.toml";

#[test]
fn newer_requests_a_stop_and_a_lost_connection_end_the_work() {
    let server = Server::start();
    let begun = |page: &str| {
        let mut line = server.line();
        line.0.get_mut().write_all(&server.posted("api/prove", &long(page).to_string())).unwrap();
        std::thread::sleep(Duration::from_millis(300));
        line
    };
    let mut older = begun("a");
    let newer = server.post("api/prove", &quick("a", scheme("koch", json!({}))));
    let ended = older.read();
    assert_eq!((newer.status, ended.status, ended.code().as_str()), (200, 409, "secant::stopped"));
    let mut line = begun("b");
    assert_eq!(server.post("api/stop", &json!({"page": "b"})).json(), json!({"stopped": true}));
    assert_eq!(line.read().status, 409);
    assert_eq!(server.post("api/stop", &json!({"page": "b"})).json(), json!({"stopped": false}));
    // A search for a region ends too.
    let slider = |page: &str| json!({"page": page, "name": "four-point", "parameter": "w"});
    let mut line = server.line();
    line.0.get_mut().write_all(&server.posted("api/region", &slider("e").to_string())).unwrap();
    std::thread::sleep(Duration::from_millis(50));
    let (start, mut next) = (Instant::now(), server.line());
    next.0.get_mut().write_all(&server.posted("api/region", &slider("e").to_string())).unwrap();
    let ended = line.read();
    assert_eq!((ended.status, ended.code().as_str()), (409, "secant::stopped"));
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    drop(next);
    // More than all slots: they are free again when the visitors are gone.
    let lines: Vec<Line> = (0..6).map(|k| begun(&format!("c{k}"))).collect();
    drop(lines);
    let start = Instant::now();
    assert_eq!(server.post("api/prove", &quick("d", scheme("koch", json!({})))).status, 200);
    assert!(start.elapsed() < Duration::from_secs(15), "{:?}", start.elapsed());
}

#[test]
fn ten_thousand_requests_leave_nothing_behind() {
    let server = Server::start();
    let broken: Vec<Vec<u8>> =
        broken().iter().map(|(_, body)| server.posted("api/prove", body)).filter(|r| r.len() < 5_000).collect();
    let round = |from: usize, count: usize| {
        let mut line = server.line();
        for k in from..from + count {
            let w = format!("{}/400", k % 100);
            let input = json!({"kind": "scheme", "name": "four-point", "parameters": {"w": w}, "control": "suggested"});
            let request = match k % 20 {
                0 => server.posted(
                    "api/prove",
                    &quick(&format!("p{}", k % 7), scheme("bspline", json!({"degree": "2"}))).to_string(),
                ),
                1..=4 => broken[k % broken.len()].clone(),
                5..=9 => server.posted("api/draw", &json!({"input": input}).to_string()),
                10..=13 => server.head("GET", "api/catalogue", 0).into_bytes(),
                14 => server.posted("api/stop", &json!({"page": "p"}).to_string()),
                15 => {
                    // A visitor who goes away in the middle.
                    let mut other = server.line();
                    let request = server.posted("api/draw", &json!({"input": input}).to_string());
                    other.0.get_mut().write_all(&request[..request.len() - 3]).unwrap();
                    server.head("GET", "answer/1/data", 0).into_bytes()
                }
                _ => server.head("GET", "main.js", 0).into_bytes(),
            };
            let status = line.ask(&request).status;
            assert!([200, 410, 422].contains(&status), "{status}: {}", String::from_utf8_lossy(&request));
        }
    };
    round(0, 2_000);
    let before = server.memory();
    round(2_000, 8_000);
    let after = server.memory();
    println!(
        "memory after 2000 requests: {} KiB, after 10000: {} KiB; {} threads",
        before >> 10,
        after >> 10,
        server.threads()
    );
    assert!(after < before + (24 << 20), "{before} bytes before, {after} after");
    assert!(server.threads() < 40, "{} threads", server.threads());
}

/// Nothing that the page sends can name a file: no function that takes a path is used, and standard input is not read.
#[test]
fn the_server_opens_no_file() {
    let mut seen = 0;
    for entry in std::fs::read_dir(format!("{}/src/studio", env!("CARGO_MANIFEST_DIR"))).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]").next().unwrap();
            for word in
                ["std::fs", "std::env", "stdin", "Path", "File::open", "::read(", "::ask(", "asked(text", "Command"]
            {
                assert!(!code.contains(word), "{word} in {}", path.display());
            }
            seen += 1;
        }
    }
    assert!(seen >= 7);
}
