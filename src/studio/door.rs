//! Who is let in: the page that this server sent, and nobody else.

use hyper::header::{CONTENT_TYPE, HOST, ORIGIN};
use hyper::{HeaderMap, Method, StatusCode};

/// What a visitor must know and say.
#[derive(Debug, Clone)]
pub struct Door {
    token: String,
    hosts: [String; 2],
}

impl Door {
    /// The door of a server on a port, with 128 random bits in its address.
    ///
    /// # Errors
    /// Where the system has no random numbers.
    pub fn new(port: u16) -> Result<Self, getrandom::Error> {
        let mut bytes = [0_u8; 16];
        getrandom::fill(&mut bytes)?;
        let token = bytes.iter().map(|b| format!("{b:02x}")).collect();
        Ok(Self { token, hosts: ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}")) })
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.hosts[0], self.token)
    }

    /// What is asked for behind the token.
    ///
    /// # Errors
    /// The status of the refusal: another `Host` (a name that was made to point here), another `Origin` or site (a page from
    /// elsewhere), a wrong token, a form instead of JSON, another method.
    pub fn admit<'a>(&self, method: &Method, path: &'a str, headers: &HeaderMap) -> Result<&'a str, StatusCode> {
        let host = one(headers, HOST.as_str())?.ok_or(StatusCode::BAD_REQUEST)?;
        if !self.hosts.iter().any(|own| own == host) {
            return Err(StatusCode::FORBIDDEN);
        }
        let own = |origin: &str| origin.strip_prefix("http://").is_some_and(|o| o == host);
        if one(headers, ORIGIN.as_str())?.is_some_and(|origin| !own(origin)) {
            return Err(StatusCode::FORBIDDEN);
        }
        if one(headers, "sec-fetch-site")?.is_some_and(|site| !matches!(site, "same-origin" | "none")) {
            return Err(StatusCode::FORBIDDEN);
        }
        let (token, rest) = path.strip_prefix('/').and_then(|p| p.split_once('/')).ok_or(StatusCode::NOT_FOUND)?;
        if !same(token.as_bytes(), self.token.as_bytes()) {
            return Err(StatusCode::NOT_FOUND);
        }
        match *method {
            Method::GET => Ok(rest),
            Method::POST => {
                let json = one(headers, CONTENT_TYPE.as_str())?.is_some_and(|t| t.starts_with("application/json"));
                if json { Ok(rest) } else { Err(StatusCode::UNSUPPORTED_MEDIA_TYPE) }
            }
            _ => Err(StatusCode::METHOD_NOT_ALLOWED),
        }
    }
}

/// The value of a header that may stand there once.
fn one<'a>(headers: &'a HeaderMap, name: &str) -> Result<Option<&'a str>, StatusCode> {
    let mut all = headers.get_all(name).iter();
    let first = all.next().map(|v| v.to_str().map_err(|_| StatusCode::BAD_REQUEST)).transpose()?;
    if all.next().is_some() { Err(StatusCode::BAD_REQUEST) } else { Ok(first) }
}

/// Whether two words are equal, in a time that does not tell where they differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |all, (x, y)| all | (x ^ y)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_own_page_is_let_in() {
        let door = Door::new(4000).expect("random numbers");
        assert_ne!(door.token, Door::new(4000).expect("random numbers").token);
        let path = format!("/{}/api/draw", door.token);
        let asked = |method: Method, path: &str, list: &[(&'static str, &str)]| {
            let mut headers = HeaderMap::new();
            for (name, value) in list {
                headers.append(*name, value.parse().expect("a value"));
            }
            door.admit(&method, path, &headers).map(str::to_owned).map_err(|s| s.as_u16())
        };
        let json = ("content-type", "application/json");
        let host = ("host", "127.0.0.1:4000");
        assert_eq!(asked(Method::POST, &path, &[host, json]), Ok("api/draw".to_owned()));
        let full =
            [("host", "localhost:4000"), json, ("origin", "http://localhost:4000"), ("sec-fetch-site", "same-origin")];
        assert_eq!(asked(Method::POST, &path, &full), Ok("api/draw".to_owned()));
        for (name, value) in [
            ("origin", "http://evil.example"),
            ("origin", "null"),
            ("origin", "http://localhost:4000"),
            ("origin", "https://127.0.0.1:4000"),
            ("sec-fetch-site", "cross-site"),
            ("sec-fetch-site", "same-site"),
        ] {
            assert_eq!(asked(Method::POST, &path, &[host, json, (name, value)]), Err(403), "{name}: {value}");
            assert_eq!(asked(Method::GET, &path, &[host, (name, value)]), Err(403), "{name}: {value}");
        }
        for host in ["evil.example:4000", "127.0.0.1:4001", "127.0.0.1", "127.0.0.1:4000.evil.example"] {
            assert_eq!(asked(Method::GET, &path, &[("host", host)]), Err(403), "{host}");
        }
        assert_eq!(asked(Method::GET, &path, &[]), Err(400));
        assert_eq!(asked(Method::GET, &path, &[host, ("host", "evil.example")]), Err(400));
        for wrong in ["/", "/api/draw", "/0/api/draw", &path[..20], &path.to_uppercase().replace("API/DRAW", "x/")] {
            assert_eq!(asked(Method::GET, wrong, &[host]), Err(404), "{wrong}");
        }
        assert_eq!(asked(Method::POST, &path, &[host, ("content-type", "text/plain")]), Err(415));
        assert_eq!(asked(Method::POST, &path, &[host]), Err(415));
        assert_eq!(asked(Method::DELETE, &path, &[host]), Err(405));
    }
}
