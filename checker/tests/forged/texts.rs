//! Numbers, cases and texts that ask for much.

use super::{rule, stored};
use serde_json::{Value, json};

/// Texts that are nearly numbers, and numbers that are nearly texts.
#[test]
fn one_way_to_write_a_number() {
    let near = [
        "",
        " ",
        "-0",
        "+3",
        "03",
        "3.0",
        "3e0",
        "3/1",
        "6/2",
        "-6/-2",
        "3/-1",
        "0/3",
        "3/0",
        "\u{663}",
        "\u{ff13}",
        "³",
        "0x3",
        "3_0",
        "NaN",
        "inf",
        "-inf",
        "3 ",
        " 3",
        "3\n",
        "--3",
        "3/",
        "/3",
        "1e400",
        "1e-400",
        "0b11",
        "3\u{0}",
        "1/\u{663}",
    ];
    for text in near {
        let found = rule("trisection", &[("/contraction/0/radius", json!(text))]);
        assert_eq!(found, "format", "{text:?}");
    }
    assert_eq!(rule("trisection", &[("/contraction/0/radius", json!("9".repeat(10_001)))]), "format");
    let (case, text) = stored("trisection");
    let raw = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        secant_check::check(&case, &text.replacen(from, to, 1)).expect_err(to).rule
    };
    for number in
        ["1.0", "1e0", "-1", "-0", "01", "+1", "18446744073709551616", "1E400", "NaN", "Infinity", "0x1", "true"]
    {
        assert!(
            matches!(raw("\"version\": 1", &format!("\"version\": {number}")).as_str(), "json" | "format"),
            "{number}"
        );
    }
    assert_eq!(raw("\"version\": 1", "\"version\": 2"), "format");
    assert_eq!(raw("\"version\": 1", "\"version\": \"1\""), "format");
    // A key twice, also where it is written in another way; the same for a key deep inside.
    assert_eq!(raw("\"verdict\": \"proved\"", "\"verdict\": \"refuted\", \"verdict\": \"proved\""), "json");
    assert_eq!(raw("\"verdict\": \"proved\"", "\"verd\\u0069ct\": \"refuted\", \"verdict\": \"proved\""), "json");
    assert_eq!(raw("\"kind\":\"half-tangent\"", "\"kind\":\"half-tangent\",\"kind\":\"cusp\""), "json");
    assert_eq!(raw("\"kind\": \"certify\"", "\"kind\": \"certify \""), "format");
    assert_eq!(raw("secant certificate", "Secant certificate"), "format");
    assert_eq!(raw("\"case\": \"trisection\"", "\"case\": \"tris\u{435}ction\""), "case");
    assert_eq!(secant_check::check(&case, &format!("{text} {text}")).unwrap_err().rule, "json");
    assert_eq!(secant_check::check(&case, &format!("\u{feff}{text}")).unwrap_err().rule, "json");
}

/// The certificate of a case proves nothing about a case that differs in one number, orientation, or word.
#[test]
fn the_case_itself_is_read() {
    let (case, text) = stored("every-three-states");
    for (from, to) in [
        ("\"1/4\", \"3/4\", \"3/4\"", "\"1/4\", \"1/2\", \"3/4\""),
        ("\"7/10\"", "\"71/100\""),
        ("to = \"b\"", "to = \"c\""),
        ("to = \"b\"", "to = \"b\"\nreversed = true"),
        ("start = \"a\"", "start = \"b\""),
        ("convention = \"columns\"", "convention = \"rows\""),
        ("dimension = 3", "dimension = 4"),
        ("name = \"three-states\"", "name = \"three-states \""),
        ("name = \"three-states\"", "name = \"three-states\"\nname = \"three-states\""),
        ("start = \"a\"", "start = \"a\"\ncontrol = [[0, 0], [1, 0], [0, 0]]"),
        ("start = \"a\"", "start = \"a\"\nkind = \"surface\""),
        ("start = \"a\"", "start = \"a\"\nscheme = \"chaikin\""),
    ] {
        let changed = case.replacen(from, to, 1);
        assert_ne!(changed, case, "{from}");
        let found = secant_check::check(&changed, &text);
        assert!(found.is_err(), "{to}: {found:?}");
    }
}

/// Long numbers in every place where arithmetic is done with them end in a refusal, not in a long wait.
#[test]
fn long_numbers_do_not_run_away() {
    // A power of 2 over an odd number.
    let power = secant_check::number::whole(2).pow(13_000).to_string();
    let long = |k: usize| format!("{power}/{}7", "3".repeat(4_001 + k));
    let begin = std::time::Instant::now();
    for (name, pointer) in [
        ("trisection", "/contraction/0/radius"),
        ("levy", "/points/0/branches/0/top/radius"),
        ("levy", "/points/0/branches/0/top/centre/0"),
        ("levy", "/answers/3/products/0/0/0"),
        ("koch-2", "/points/0/branches/0/top/polynomial/0"),
        ("koch-2", "/points/0/branches/0/top/interval/0"),
        ("spectrum-plain", "/spectra/0/classes/0/square"),
        ("spectrum-plain", "/spectra/0/factors/0/roots/0/centre/0"),
        ("every-boundary", "/answers/2/maps/0/0/0/0"),
        ("every-corner", "/answers/2/rate/cross_ratio"),
    ] {
        let (case, text) = stored(name);
        let mut forged: Value = serde_json::from_str(&text).unwrap();
        *forged.pointer_mut(&format!("/proof{pointer}")).unwrap() = json!(long(1));
        let _ = secant_check::check(&case, &forged.to_string());
    }
    // A polynomial and a scalar product with many different long denominators.
    let many: Vec<Value> = (0..40).map(|k| json!(long(k))).chain([json!("1")]).collect();
    assert_eq!(rule("koch-2", &[("/points/0/branches/0/top/polynomial", json!(many))]), "limit");
    // Millions of values.
    let (case, text) = stored("trisection");
    let zeros = format!("[{}0]", "0,".repeat(4_000_000));
    let found = secant_check::check(&case, &text.replacen("[0,1]", &zeros, 1)).unwrap_err();
    assert_eq!(found.rule, "json", "{found}");
    let keys: String = (0..1_000_000).map(|k| format!("\"{k}\":0,")).collect();
    let found = secant_check::check(&case, &text.replacen("[0,1]", &format!("{{{keys}\"x\":0}}"), 1)).unwrap_err();
    assert_eq!(found.rule, "json", "{found}");
    assert!(begin.elapsed().as_secs() < 60, "{:?}", begin.elapsed());
}

/// Much work or memory for few bytes: each is refused at once.
#[test]
fn little_texts_that_ask_for_much() {
    let many = |item: &str, count: usize| vec![item; count].join(",");
    // A hull of 20000 points of one coordinate, whose images would be a matrix of 400 million weights.
    let case = "name = \"much\"\nconvention = \"columns\"\nkind = \"set\"\npieces = [[[1]]]\n";
    let hull = format!("{{\"points\":[{}],\"images\":[[]]}}", many("[\"1\"]", 20_000));
    let envelope = |kind: &str, name: &str, proof: String| {
        format!(
            "{{\"format\":\"secant certificate\",\"version\":1,\"kind\":\"{kind}\",\"case\":\"{name}\",\"verdict\":\"proved\",\"proof\":{proof}}}"
        )
    };
    let state = format!("{{\"state\":0,\"radius\":\"0\",\"code\":{hull},\"hull\":null}}");
    let proof = format!("{{\"contraction\":[{state}],\"points\":[],\"answers\":[]}}");
    assert_eq!(secant_check::check(case, &envelope("certify", "much", proof)).unwrap_err().rule, "limit");
    // A chain of far more vectors than there are dimensions.
    let zeros = many("[[]]", 100_000);
    let chain = format!("[[[\"1\"]],{zeros}]");
    let factor = format!(
        "{{\"polynomial\":[\"0\",\"1\"],\"roots\":[{{\"centre\":[\"0\",\"0\"],\"error\":\"0\"}}],\"chains\":[{chain}]}}"
    );
    let proof = format!("{{\"spectra\":[{{\"operator\":null,\"factors\":[{factor}],\"modulus\":7,\"classes\":[]}}]}}");
    assert!(secant_check::check("1\n0\n", &envelope("spectrum", "matrix", proof)).is_err());
    // Numbers of a plain matrix that are a few letters and many digits.
    let long = "3e20000 ".repeat(10_000);
    let proof = "{\"spectra\":[{\"operator\":null,\"factors\":[],\"modulus\":7,\"classes\":[]}]}".to_owned();
    assert!(secant_check::check(&format!("100\n{long}"), &envelope("spectrum", "matrix", proof)).is_err());
}

/// Of a mesh in `[scheme]` the message says what to check instead; a `[scheme]` beside operators is no case.
#[test]
fn schemes_that_are_not_built() {
    let (_, text) = stored("scheme-chaikin");
    let refused = |table: &str| {
        let refused = secant_check::check(&format!("name = \"scheme-chaikin\"\n{table}"), &text).unwrap_err();
        assert!(refused.unreadable, "{refused}");
        refused.why
    };
    assert!(refused("[scheme]\nmesh = \"loop\"\nvalence = 6").contains("secant expand"));
    assert!(refused("[scheme]\nname = \"no-such-scheme\"").contains("no-such-scheme"));
    assert!(refused("[scheme]\nmask = [\"1/4\", \"3/4\"]\nname = \"bspline\"").contains("exactly one"));
    assert!(refused("pieces = []\n[scheme]\nname = \"bspline\"").contains("in place of the operators"));
    assert!(refused("[scheme]\nmask = []").contains("not 0"));
    assert!(refused("[scheme]\nmask = [0, 0]").contains("not 0"));
    assert!(refused("[scheme]\ntensor = []").contains("2 items"));
}

/// A certificate of one mask is none of another one.
#[test]
fn the_mask_is_that_of_the_case() {
    let (case, text) = stored("scheme-chaikin");
    secant_check::check(&case, &text).unwrap();
    for (from, to) in
        [("\"1/4\", \"3/4\"", "\"1/3\", \"2/3\""), ("[\"1/4\"", "[0, \"1/4\""), ("\"3/4\", \"1/4\"]", "1, 0]")]
    {
        let other = case.replacen(from, to, 1);
        assert_ne!(case, other);
        // Zeros in front only move the parameter.
        assert_eq!(secant_check::check(&other, &text).is_ok(), to.starts_with("[0"), "{to}");
    }
}
