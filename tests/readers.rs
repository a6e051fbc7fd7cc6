//! The two readers of cases, secant's and its checker's, which share no code: the same text is the same system to both, or none.

use crate::entries::readers::{checkers, differ, secants};
use secant::case::{Valences, VertexCase};
use secant::scheme;
use secant_check::reader;
use std::path::{Path, PathBuf};

/// All cases of the repository, without what a test expects of them.
fn corpus() -> Vec<(PathBuf, String)> {
    let (mut open, mut found) = (vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("cases")], Vec::new());
    while let Some(dir) = open.pop() {
        for entry in std::fs::read_dir(dir).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "toml") {
                let text = std::fs::read_to_string(&path).unwrap();
                let kept = text.find("\n[expect").or_else(|| text.find("\n[[expect")).map_or(text.len(), |k| k + 1);
                found.push((path, text[..kept].to_owned()));
            }
        }
    }
    found.sort();
    found
}

#[test]
fn every_case_is_read_alike() {
    let (mut both, mut wrong) = (0, Vec::new());
    for (path, text) in corpus() {
        both += usize::from(secants(&text).is_ok() && checkers(&text).is_ok());
        wrong.extend(differ(&text).map(|why| format!("{}: {why:.600}", path.display())));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(both > 150, "{both}");
}

#[test]
fn every_scheme_is_built_alike() {
    let mut tables: Vec<String> = Vec::new();
    for info in scheme::list() {
        let given: Vec<String> =
            info.parameters.iter().map(|p| format!("{} = \"{}\"", p.name, p.default.unwrap_or("1/5"))).collect();
        tables.push(format!("name = \"{}\"", info.name));
        tables.push(format!("name = \"{}\"\n{}", info.name, given.join("\n")));
        tables.push(format!("name = \"{}\"\nvertices = true\n{}", info.name, given.join("\n")));
        let inline = [vec![format!("name = \"{}\"", info.name)], given].concat().join(", ");
        tables.push(format!("tensor = [{{ {inline} }}, {{ name = \"bspline\", degree = 2 }}]"));
        tables.push(format!("tensor = [{{ name = \"bspline\", degree = 1, arity = 3 }}, {{ {inline} }}]"));
    }
    for (degree, arity) in [(0, 2), (1, 2), (2, 3), (4, 2), (5, 4), (48, 2), (49, 2), (3, 65)] {
        tables.push(format!("name = \"bspline\"\ndegree = {degree}\narity = {arity}"));
        tables.push(format!("name = \"bspline\"\ndegree = {degree}\narity = {arity}\nvertices = true"));
    }
    for k in 0..9 {
        tables.push(format!("name = \"dubuc-deslauriers\"\npoints = {k}"));
        tables.push(format!("name = \"hormann-sabin\"\nk = {k}"));
        tables.push(format!("name = \"bezier\"\ndegree = {k}\nsplit = \"1/3\""));
        tables.push(format!("name = \"koch\"\npieces = \"{k}\""));
    }
    for value in ["0", "1", "-1", "1/2", "0.3", "\" 2/3 \"", "0x10", "1e-1", "true", "\"-1/2\""] {
        for (name, key) in
            [("takagi", "alpha"), ("okamoto", "a"), ("lebesgue", "a"), ("four-point", "w"), ("de-rham", "a")]
        {
            tables.push(format!("name = \"{name}\"\n{key} = {value}"));
        }
    }
    let symbols = [
        "(1+z)^3/4",
        "(1+z)^4/8",
        "(1+z)^3/4 (1 - 3/8 (1-z)^2/z)",
        "-z^-3/16 + 9/16 z^-1 + 1 + 9/16 z - z^{3}/16",
        "2(1-z^2)/(1-z)(1+z)/4",
        "(1+z)^2 0.5",
        "(1+z)^(2)/2",
        "-(-1-z)^2/-2",
        "1+z",
        "(1+z",
        "z/0",
        "1/(1+z)",
        "(1+z)^3/4 x",
        "",
        "+(1+z)^2*1/2",
        "((1+z^3)/(1+z))",
        "z^2000",
        "(1+z)^-2",
    ];
    for symbol in symbols {
        tables.push(format!("symbol = \"{symbol}\""));
        tables.push(format!("symbol = \"{symbol}\"\nvertices = true"));
    }
    tables.push("symbol = \"(1+z+z^2)^3/9\"\narity = 3".to_owned());
    for mask in [
        "1/4,3/4,3/4,1/4",
        "0,0,1/2,1,1/2,0",
        "1,1",
        "1,0,0,1",
        "1/2,1/2,1/2,1/2",
        "-1/8,3/8,5/4,3/8,-1/8",
        "1/4,0,3/4,3/4,0,1/4",
    ] {
        let quoted: Vec<String> = mask.split(',').map(|x| format!("\"{x}\"")).collect();
        tables.push(format!("mask = [{}]", quoted.join(", ")));
        tables.push(format!("mask = [{}]\nvertices = true\narity = 0x2", quoted.join(", ")));
        for scale in ["arity", "one", "root", "two"] {
            tables.push(format!("filter = [{}]\nnormalisation = \"{scale}\"", quoted.join(", ")));
        }
    }
    tables.push("filter = [\"1/8\", \"3/8\", \"3/8\", \"1/8\"]\nnormalisation = \"root\"".to_owned());
    tables.push("filter = [\"1/8\", \"3/8\", \"3/8\", \"1/8\"]\nnormalisation = \"one\"".to_owned());
    let (mut both, mut wrong) = (0, Vec::new());
    for table in &tables {
        let text = format!("name = \"s\"\n[scheme]\n{table}\n");
        both += usize::from(secants(&text).is_ok() && checkers(&text).is_ok());
        wrong.extend(differ(&text).map(|why| format!("{table}\n{why:.600}")));
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), tables.len(), wrong.join("\n"));
    assert!(both > 100, "{both}");
}

/// Changes of a text that leave it nearly a case.
fn mutant(text: &str, random: &mut oorandom::Rand32) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    if lines.is_empty() {
        return String::new();
    }
    let at = random.rand_range(0..lines.len() as u32) as usize;
    let swaps = [
        ("1/2", "0x10"),
        ("\"1/2\"", "0.5"),
        ("\"1/2\"", "5e-1"),
        ("1/4", "+1/4"),
        ("1/4", " 1 / 4 "),
        ("1/2", "2/4"),
        ("0", "1"),
        ("1", "0"),
        ("true", "false"),
        ("columns", "rows"),
        ("[", "[["),
        ("]", "]]"),
        ("0", "-0"),
        ("0", "0.0"),
        ("1", "1_0"),
        ("2", "02"),
        ("curve", "set"),
        ("edge", "set"),
        ("edge", "vertex"),
        ("start", "begin"),
        ("0,", "\"0\","),
        ("1", "\"?\""),
        ("(", "(0"),
        (")", "1)"),
        ("(0)", "(00)"),
        ("\"3..32\"", "5"),
        ("loop", "loop-warren"),
        ("/", "//"),
        ("1", "inf"),
    ];
    let (from, to) = swaps[random.rand_range(0..swaps.len() as u32) as usize];
    match random.rand_range(0..4) {
        0 => drop(lines.remove(at)),
        1 => lines.insert(at, lines[at].clone()),
        2 if at > 0 => lines.swap(at - 1, at),
        _ => {
            let with: Vec<usize> = (0..lines.len()).filter(|k| lines[*k].contains(from)).collect();
            if let Some(k) = with.get(random.rand_range(0..with.len().max(1) as u32) as usize) {
                lines[*k] = lines[*k].replacen(from, to, 1);
            }
        }
    }
    lines.join("\n")
}

#[test]
fn changed_cases_are_read_alike() {
    let mut random = oorandom::Rand32::new(20);
    let (mut tried, mut wrong) = (0, Vec::new());
    for (path, text) in corpus() {
        // The name stays: which names there are is a matter of their own.
        if text.len() > 4_000 || text.contains("[vertex]") || text.contains("sqrt") {
            continue;
        }
        for _ in 0..24 {
            let changed = mutant(&text, &mut random);
            if changed.lines().filter(|l| l.starts_with("name =")).eq(text.lines().filter(|l| l.starts_with("name =")))
            {
                tried += 1;
                wrong.extend(differ(&changed).map(|why| format!("{}: {why:.400}\n{changed}", path.display())));
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {tried}:\n{:.6000}", wrong.len(), wrong.join("\n\n"));
    assert!(tried > 2_000, "{tried}");
}

#[test]
fn valences_are_read_alike() {
    let valences = [
        "5",
        "\"5\"",
        "0x10",
        "0b101",
        "\"3..6\"",
        "\"3..=6\"",
        "\" 3 , 5..7 \"",
        "\"all\"",
        "\" all \"",
        "2",
        "1",
        "1024",
        "1025",
        "\"2..4\"",
        "\"6..3\"",
        "\"\"",
        "\"3,\"",
        "\"3..\"",
        "\"+5\"",
        "5.0",
        "[5]",
        "true",
        "\"3,3,3\"",
        "-5",
        "\"1e1\"",
        "\"5..6..7\"",
        "\"=5\"",
    ];
    let rules = [
        "mesh = \"catmull-clark\"",
        "mesh = \"loop-variant\"\nbeta = \"1/10\"",
        "mesh = \"loop-variant\"",
        "mesh = \"loop-variant\"\nbeta = 0x10",
        "mesh = \"doo-sabin-frequency\"",
        "mesh = \"doo-sabin-frequency\"\nfrequency = 2",
        "mesh = \"doo-sabin-frequency\"\nfrequency = \"2\"",
        "mesh = \"doo-sabin-frequency\"\nfrequency = 0x2",
        "mesh = \"doo-sabin-frequency\"\nfrequency = \"3/2\"",
        "mesh = \"doo-sabin-frequency\"\nfrequency = 0",
        "mesh = \"doo-sabin-frequency\"\nfrequency = 1025",
        "mesh = \"doo-sabin-frequency\"\nfrequency = 2.0",
        "mesh = \"doo-sabin\"\nweights = [\"1/2\", 0.25, 0, \"1/4\"]",
        "mesh = \"catmull-clark-variant\"\nalpha = \"1/2\"\nbeta = \"1/4\"",
        "mesh = \"catmull-clark-variant\"\nalpha = \"1/2\"\nbeta = \"1/4\"\ngamma = \"1/4\"",
        "mesh = \"catmull-clark-variant\"\nalpha = \"1/2\"\nbeta = \"1/4\"\ngamma = \"1/3\"",
        "mesh = \"midedge\"\nalpha = 1",
    ];
    let mut both = 0;
    for rule in rules {
        for valence in valences {
            let text = format!("name = \"v\"\n[vertex]\n{rule}\nvalence = {valence}\n");
            let own = VertexCase::parse("v", &text).ok().map(|case| match case.valences {
                Some(Valences::All) => None,
                Some(Valences::List(list)) => Some(list),
                None => Some(Vec::new()),
            });
            let theirs = reader::valences(&text).ok().map(|(_, list)| list);
            assert_eq!(own, theirs, "{text}");
            both += usize::from(own.is_some());
        }
    }
    assert!(both > 50, "{both}");
}
