//! The HTML reports in a browser: `SECANT_BROWSER=1 cargo test --test browser` with Chromium (Debian: `chromium`).
//! `SECANT_BROWSER=DIR` keeps the screenshots in DIR.

use secant::case::Valences;
use secant::prelude::*;
use std::path::{Path, PathBuf};
use std::process::Command;

const CASES: [&str; 14] = [
    "thesis/half-tangent",
    "classical/levy",
    "classical/takagi",
    "counterexamples/null-witness",
    "junction/m1-5-jordan-3",
    "control/bezier-cusp",
    "irrational/regular-sqrt-2",
    "two-parameter/digits-400-corner",
    "bspline/degree-5",
    "automata/closed",
    "control/cubic-null",
    "surfaces/bicubic-space",
    "surfaces/null-refuted",
    "faces/catmull-clark-5",
];

/// Cases about vertices.
const VERTICES: [&str; 2] = ["surfaces/catmull-clark-12-12", "surfaces/doo-sabin-frequency-2"];

/// Says in the title how many formulas and pictures have a size, and whether the page is wider than the window.
const PROBE: &str = "<script>addEventListener('load', () => {
  const seen = name => [...document.querySelectorAll(name)].filter(e => {
    const box = e.getBoundingClientRect(); return e.closest('details:not([open])') || (box.width > 2 &amp;&amp; box.height > 2); }).length;
  const all = name => document.querySelectorAll(name).length;
  document.title = ['probe', seen('math') === all('math'), all('math') > 0, seen('figure svg') === all('figure svg'), all('figure svg') > 0,
    document.documentElement.scrollWidth &lt;= innerWidth].join(' ');
});</script>";

#[test]
fn reports_are_shown_without_errors() {
    let Some(kept) = std::env::var_os("SECANT_BROWSER") else {
        eprintln!("not run: set SECANT_BROWSER=1");
        return;
    };
    let scratch = tempfile::tempdir().unwrap();
    let kept = PathBuf::from(kept);
    let shots = if kept.is_dir() { kept } else { scratch.path().to_owned() };
    for name in CASES.into_iter().chain(VERTICES) {
        let page = page(name);
        let stem = name.replace('/', "--");
        let (plain, probed) = (scratch.path().join(format!("{stem}.html")), scratch.path().join("probe.html"));
        std::fs::write(&plain, &page).unwrap();
        let probe = PROBE.replace("&amp;", "&").replace("&lt;", "<");
        std::fs::write(&probed, page.replace("</main>", &format!("</main>{probe}"))).unwrap();
        let (dom, log) = chromium(scratch.path(), &["--dump-dom", &format!("file://{}", probed.display())]);
        assert!(dom.contains("<title>probe true true true true true</title>"), "{name}: {}", title(&dom));
        for (scheme, flags) in [("light", &[][..]), ("dark", &["--blink-settings=preferredColorScheme=0"][..])] {
            let png = shots.join(format!("{stem}-{scheme}.png"));
            let shot = format!("--screenshot={}", png.display());
            let url = format!("file://{}", plain.display());
            let args: Vec<&str> =
                flags.iter().copied().chain([shot.as_str(), "--window-size=900,2400", &url]).collect();
            let (_, shown) = chromium(scratch.path(), &args);
            let size = std::fs::metadata(&png).map_or(0, |m| m.len());
            assert!(size > 20_000, "{name}: the screenshot is (almost) empty: {size} bytes");
            assert!(!(log.clone() + &shown).contains("CONSOLE"), "{name}: {shown}");
        }
    }
}

fn page(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"));
    let mut question = Question::read(&path).unwrap();
    if let Question::Vertices { valences, .. } = &mut question {
        *valences = Some(Valences::List(vec![3, 5]));
    }
    html::render(&findings::proof(&prove(&question, &Budget::default()).unwrap()))
}

fn title(dom: &str) -> &str {
    dom.split("<title>").nth(1).and_then(|t| t.split("</title>").next()).unwrap_or_default()
}

fn chromium(profile: &Path, args: &[&str]) -> (String, String) {
    let out = Command::new("chromium")
        .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--enable-logging=stderr"])
        .args(["--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .arg(format!("--user-data-dir={}", profile.join("profile").display()))
        .args(args)
        .output()
        .expect("chromium is installed");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&out.stdout), text(&out.stderr))
}
