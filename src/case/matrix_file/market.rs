use super::{Format, Mistake, Rows, Tally, check_size, number};
use crate::algebraic::field::FieldBuilder;
use crate::arith::Rational;

/// How the entries below the diagonal determine the others.
#[derive(Clone, Copy, PartialEq)]
enum Symmetry {
    General,
    Symmetric,
    Skew,
}

/// Reads a `MatrixMarket` file.
pub(super) fn read(text: &str) -> Result<Rows, Mistake> {
    let base = text.as_ptr() as usize;
    let mut denominator = None;
    let mut lines = text.lines();
    let header = lines.by_ref().find(|l| !l.trim().is_empty()).unwrap_or_default().to_ascii_lowercase();
    let fields: Vec<&str> = header.split_ascii_whitespace().skip(1).collect();
    let [object, layout, kind, symmetry] = fields[..] else {
        return Err(Mistake::new("market", 0, "the first line of a MatrixMarket file has four words after the banner"));
    };
    if object != "matrix" || !matches!(kind, "integer" | "real") {
        let message = format!("MatrixMarket `{object}` with `{kind}` entries is not read");
        return Err(Mistake::new("market", 0, message).help("`matrix` with `integer` or `real` entries is"));
    }
    let symmetry = match symmetry {
        "general" => Symmetry::General,
        "symmetric" => Symmetry::Symmetric,
        "skew-symmetric" => Symmetry::Skew,
        other => return Err(Mistake::new("market", 0, format!("MatrixMarket symmetry `{other}` is not read"))),
    };
    let mut words = Vec::new();
    let mut tally = Tally::default();
    for line in lines {
        let at = line.as_ptr() as usize - base;
        if let Some(comment) = line.trim_start().strip_prefix('%') {
            if let Some(value) = comment_value(comment) {
                denominator = Some(number(value, at, &mut tally)?);
            }
        } else {
            words.extend(line.split_ascii_whitespace().map(|w| (w.as_ptr() as usize - base, w)));
        }
    }
    let mut rows = match layout {
        "array" => array(&words, symmetry, &mut tally)?,
        "coordinate" => coordinates(&words, symmetry, &mut tally)?,
        other => return Err(Mistake::new("market", 0, format!("MatrixMarket layout `{other}` is not read"))),
    };
    if let Some(d) = denominator {
        if d == 0 {
            return Err(Mistake::new("market", 0, "the common denominator is 0"));
        }
        rows.iter_mut().flatten().for_each(|x| *x /= &d);
    }
    let builder = FieldBuilder::new();
    let rows = rows.iter().map(|row| row.iter().map(|x| builder.rational(x)).collect()).collect();
    Ok(Rows { rows, builder, format: Format::MatrixMarket, decimals: tally.decimals })
}

/// The value in `denominator: 64`, `common denominator = 64` or `denominator 64`.
fn comment_value(comment: &str) -> Option<&str> {
    let (words, value) = comment.trim().rsplit_once([' ', ':', '='])?;
    words.to_ascii_lowercase().contains("denominator").then_some(value.trim())
}

type Words<'a> = [(usize, &'a str)];

fn index(words: &Words, position: usize) -> Result<usize, Mistake> {
    let (at, word) = words.get(position).ok_or_else(|| Mistake::new("short", 0, "the file ends early"))?;
    word.parse().map_err(|_| Mistake::new("market", *at, format!("`{word}` is not a whole number")))
}

fn sizes(words: &Words) -> Result<(usize, usize), Mistake> {
    let (rows, cols) = (index(words, 0)?, index(words, 1)?);
    check_size(rows.max(cols), words[0].0)?;
    Ok((rows, cols))
}

fn zeros(rows: usize, cols: usize) -> Vec<Vec<Rational>> {
    vec![vec![Rational::from(0); cols]; rows]
}

fn put(m: &mut [Vec<Rational>], i: usize, j: usize, x: Rational, symmetry: Symmetry) {
    if symmetry != Symmetry::General && i != j && j < m.len() && i < m[j].len() {
        m[j][i] = if symmetry == Symmetry::Skew { -&x } else { x.clone() };
    }
    m[i][j] = x;
}

/// Entries column by column; for symmetric matrices the lower triangle, for skew ones without the diagonal.
fn array(words: &Words, symmetry: Symmetry, tally: &mut Tally) -> Result<Vec<Vec<Rational>>, Mistake> {
    let (rows, cols) = sizes(words)?;
    let mut m = zeros(rows, cols);
    let mut entries = words[2..].iter();
    for j in 0..cols {
        let first = match symmetry {
            Symmetry::General => 0,
            Symmetry::Symmetric => j,
            Symmetry::Skew => j + 1,
        };
        for i in first..rows {
            let (at, word) = entries.next().ok_or_else(|| Mistake::new("short", 0, "the file has too few entries"))?;
            put(&mut m, i, j, number(word, *at, tally)?, symmetry);
        }
    }
    match entries.next() {
        Some((at, _)) => Err(Mistake::new("long", *at, "the file has more entries than its size allows")),
        None => Ok(m),
    }
}

fn coordinates(words: &Words, symmetry: Symmetry, tally: &mut Tally) -> Result<Vec<Vec<Rational>>, Mistake> {
    let (rows, cols) = sizes(words)?;
    let count = index(words, 2)?;
    let entries = &words[3..];
    if entries.len() != count.saturating_mul(3) {
        let message = format!("{count} entries are announced, but {} numbers follow", entries.len());
        return Err(Mistake::new("market", words[2].0, message).help("every line has a row, a column and a value"));
    }
    let mut m = zeros(rows, cols);
    for entry in entries.chunks_exact(3) {
        let (i, j) = (index(entry, 0)?, index(entry, 1)?);
        if i == 0 || j == 0 || i > rows || j > cols {
            return Err(Mistake::new(
                "market",
                entry[0].0,
                format!("({i}, {j}) is outside the {rows} x {cols} matrix"),
            ));
        }
        put(&mut m, i - 1, j - 1, number(entry[2].1, entry[2].0, tally)?, symmetry);
    }
    Ok(m)
}
