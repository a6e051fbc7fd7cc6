//! Other control points in the text of a case.

use crate::arith::Rational;
use toml::de::DeTable;

/// The text of a case with other control points, or with none: the value of `control` is replaced where it stands, and everything
/// else, comments too, stays as it is. `None` where the text is no TOML.
///
/// ```
/// use secant::{arith::ratio, case::with_control};
/// let text = "name = \"a\"\ncontrol = [[0, 0], [1, 1]] # two\n";
/// let other = with_control(text, Some(&[vec![ratio(1, 2)], vec![ratio(3, 1)]]));
/// assert_eq!(other.as_deref(), Some("name = \"a\"\ncontrol = [[\"1/2\"], [\"3\"]] # two\n"));
/// assert_eq!(with_control(text, None).as_deref(), Some("name = \"a\"\n # two\n"));
/// ```
#[must_use]
pub fn with_control(text: &str, control: Option<&[Vec<Rational>]>) -> Option<String> {
    let table = DeTable::parse(text).ok()?;
    let line = control.map(|points| {
        let point = |p: &Vec<Rational>| {
            let numbers: Vec<String> = p.iter().map(|x| format!("\"{x}\"")).collect();
            format!("[{}]", numbers.join(", "))
        };
        format!("control = [{}]", points.iter().map(point).collect::<Vec<_>>().join(", "))
    });
    Some(match (table.get_ref().get_key_value("control"), line) {
        (Some((key, value)), line) => {
            let (from, to) = (key.span().start, value.span().end);
            format!("{}{}{}", text.get(..from)?, line.unwrap_or_default(), text.get(to..)?)
        }
        // Before everything else, so that it belongs to no table.
        (None, Some(line)) => format!("{line}\n{text}"),
        (None, None) => text.to_owned(),
    })
}
