use super::entry::Scanner;
use super::{Format, MAX_SIZE, Mistake, Rows};
use crate::algebraic::field::Number;

/// Reads a matrix literal of a computer algebra system.
pub(super) fn read(text: &str) -> Result<Rows, Mistake> {
    let help = "write `n` and the rows, a MatrixMarket file, or a literal such as `[[1/2, 0], [0, 1]]`";
    let Some(open) = text.find(['[', '{']) else {
        return Err(Mistake::new("format", 0, "this is no matrix in a known notation").help(help));
    };
    let (prefix, body) = (&text[..open], &text[open..]);
    let mut scanner = Scanner::new(text, open);
    let brace = body.starts_with('{');
    let nested = body[1..].trim_start().starts_with(['[', '{']);
    let rows = match (brace, nested) {
        (true, true) => nested_rows(&mut scanner, '{', '}').map(|rows| (rows, Format::NestedBraces))?,
        (false, true) => nested_rows(&mut scanner, '[', ']').map(|rows| (rows, Format::NestedBrackets))?,
        (true, false) => return Err(Mistake::new("format", open, "a list of rows is expected in the braces")),
        (false, false) => match flat_sizes(prefix) {
            Some(sizes) => flat(&mut scanner, sizes, open)?,
            None => (semicolon_rows(&mut scanner)?, Format::Semicolons),
        },
    };
    scanner.finish()?;
    let (rows, format) = rows;
    Ok(Rows { rows, builder: scanner.builder, format, decimals: scanner.tally.decimals })
}

/// The sizes in `matrix(QQ, 2, 3, ` or `Matrix(2, 2, `.
fn flat_sizes(prefix: &str) -> Option<(usize, usize)> {
    let numbers: Vec<usize> = prefix.rsplit_once('(')?.1.split(',').filter_map(|t| t.trim().parse().ok()).collect();
    match numbers[..] {
        [n] => Some((n, n)),
        [rows, cols] => Some((rows, cols)),
        _ => None,
    }
}

fn flat(scanner: &mut Scanner, (rows, cols): (usize, usize), at: usize) -> Result<(Vec<Vec<Number>>, Format), Mistake> {
    let entries = list(scanner, '[', ']', MAX_SIZE * MAX_SIZE)?;
    if rows.checked_mul(cols) != Some(entries.len()) || cols == 0 {
        let message = format!("{rows} x {cols} entries are announced, but {} are listed", entries.len());
        return Err(Mistake::new("size", at, message));
    }
    Ok((entries.chunks(cols).map(<[Number]>::to_vec).collect(), Format::Flat))
}

/// `[a, b, c]`.
fn list(scanner: &mut Scanner, open: char, close: char, limit: usize) -> Result<Vec<Number>, Mistake> {
    scanner.expect(open)?;
    let mut out = Vec::new();
    if scanner.accept(close) {
        return Ok(out);
    }
    loop {
        out.push(scanner.expression()?);
        if out.len() > limit {
            return Err(Mistake::new("limit", scanner.position(), format!("more than {limit} entries in a list")));
        }
        if scanner.accept(close) {
            return Ok(out);
        }
        scanner.expect(',')?;
        if scanner.accept(close) {
            return Ok(out);
        }
    }
}

/// `[[a, b], [c, d]]`.
fn nested_rows(scanner: &mut Scanner, open: char, close: char) -> Result<Vec<Vec<Number>>, Mistake> {
    scanner.expect(open)?;
    let mut rows = Vec::new();
    loop {
        if rows.len() > MAX_SIZE {
            return Err(Mistake::new("limit", scanner.position(), format!("more than {MAX_SIZE} rows")));
        }
        rows.push(list(scanner, open, close, MAX_SIZE)?);
        if scanner.accept(close) {
            return Ok(rows);
        }
        scanner.expect(',')?;
        if scanner.accept(close) {
            return Ok(rows);
        }
    }
}

/// `[a b; c d]`, with commas, blanks or both between the entries, and semicolons or line ends between the rows.
fn semicolon_rows(scanner: &mut Scanner) -> Result<Vec<Vec<Number>>, Mistake> {
    scanner.expect('[')?;
    let mut rows: Vec<Vec<Number>> = vec![Vec::new()];
    loop {
        let new_line = scanner.skip_blanks();
        if scanner.accept(']') {
            break;
        }
        let last = rows.len() - 1;
        if (scanner.accept(';') || new_line) && !rows[last].is_empty() {
            rows.push(Vec::new());
            continue;
        }
        if rows.len() > MAX_SIZE || rows[last].len() > MAX_SIZE {
            return Err(Mistake::new("limit", scanner.position(), format!("more than {MAX_SIZE} rows or columns")));
        }
        scanner.accept(',');
        let value = scanner.tight_entry()?;
        let last = rows.len() - 1;
        rows[last].push(value);
    }
    rows.retain(|r| !r.is_empty());
    Ok(rows)
}
