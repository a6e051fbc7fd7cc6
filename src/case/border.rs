//! Case files about schemes with a border: a `[border]` table with two masks and weights on the border.

use super::lattice::whole_numbers;
use super::node::{File, Node, Table};
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::scheme::{BorderError, BorderScheme, BorderSide, LatticeError, NamedSide, Terms, averaged_border};

/// A case about a scheme with a border.
#[derive(Debug, Clone)]
pub struct BorderCase {
    /// The name.
    pub name: String,
    /// The scheme.
    pub scheme: BorderScheme,
}

impl BorderCase {
    /// Whether the text of a case has a `[border]` table; what is no TOML has none.
    #[must_use]
    pub fn is_meant(text: &str) -> bool {
        toml::de::DeTable::parse(text).is_ok_and(|table| table.get_ref().get("border").is_some())
    }

    /// Reads and checks the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// A [`Problem`] for everything that is wrong with it.
    ///
    /// # Examples
    /// ```
    /// let text = "name = \"stam-loop\"\n[border]\nleft = \"catmull-clark\"\nright = \"loop\"";
    /// let case = secant::case::BorderCase::parse("stam-loop.toml", text)?;
    /// assert_eq!(case.scheme.rule(0, 1).len(), 5);
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn parse(name: &str, text: &str) -> Result<Self, Problem> {
        super::read::parsed(name, &super::valued(name, text)?, File::new, Self::of_table)
    }

    fn of_table(_: &File, root: &Table<'_>) -> Result<Self, Problem> {
        root.only(&["name", "title", "source", "border"])?;
        let name = super::read::name(root)?;
        root.optional_text("title")?;
        root.optional_text("source")?;
        let node = root.need("border", "{ left = \"catmull-clark\", right = \"loop\" }")?;
        let table = node.table()?;
        table.only(&["left", "right", "stencil"])?;
        let (left, first) = side(&table.need("left", "\"catmull-clark\"")?)?;
        let (right, second) = side(&table.need("right", "\"loop\"")?)?;
        let known = first.zip(second).map_or_else(Vec::new, |(a, b)| averaged_border([a, b]));
        let own = match table.get("stencil") {
            None => Vec::new(),
            Some(list) => stencils(&list)?,
        };
        // What is given takes the place of what is known.
        let all = known.into_iter().chain(own);
        let scheme = BorderScheme::new([left, right], all).map_err(|e| wrong(&node, &e))?;
        Ok(Self { name, scheme })
    }
}

fn wrong(node: &Node<'_>, error: &BorderError) -> Problem {
    let help = match error {
        BorderError::Missing { .. } | BorderError::Across { .. } => {
            "write a [[border.stencil]] with at = [column, row modulo 2] and weights = [[column, row, \"1/2\"], …] for them"
        }
        BorderError::Sum { .. } | BorderError::Far => {
            "new points (c, 2k + s) are sums of old points (a, k + b) with weights [a, b, w] that sum to 1"
        }
        BorderError::Place => "place = [\"1\", \"0\"] for squares, [\"1\", \"-1/2\"] for triangles",
        _ => "both masks have two variables; new points a are sums of m(a − 2b) times old points b",
    };
    node.problem("border", error.to_string(), "here").with_help(help)
}

/// A side, with its name where it has one.
fn side(node: &Node<'_>) -> Result<(BorderSide, Option<NamedSide>), Problem> {
    let refused = |e: LatticeError| wrong(node, &e.into());
    if let Ok(text) = node.text() {
        let names: Vec<&str> = NamedSide::ALL.iter().map(|(name, _)| *name).collect();
        let named = NamedSide::named(text).ok_or_else(|| {
            node.problem("border", format!("no side of a border is called {text:?}"), "not a name").with_help(format!(
                "there are {}; or write {{ symbol = \"…\", place = [\"1\", \"0\"] }}",
                names.join(" and ")
            ))
        })?;
        return Ok((named.side().map_err(refused)?, Some(named)));
    }
    let table = node.table()?;
    table.only(&["symbol", "grid", "origin", "place"])?;
    let mask = super::lattice::written(&table, None)?.ok_or_else(|| {
        table
            .problem("border", "a side has one of `grid` and `symbol`", "this table")
            .with_help("write symbol = \"(1+x)^2*(1+y)^2/4/(x*y)\", or grid = [[…]] with origin = [i, j]")
    })?;
    let place = table.need("place", "[\"1\", \"0\"]")?;
    let numbers = place.array(|k| format!("coordinate {k}"))?;
    let numbers = numbers.iter().map(Node::number).collect::<Result<Vec<Rational>, _>>()?;
    let place = <[Rational; 2]>::try_from(numbers).map_err(|_| {
        place
            .problem("border", "`place` has two coordinates", "here")
            .with_help("the point (1, 0) of the lattice lies there, and (0, 1) at [0, 1]")
    })?;
    Ok((BorderSide { mask, place }, None))
}

fn stencils(list: &Node<'_>) -> Result<Vec<((i64, usize), Terms)>, Problem> {
    let mut found: Vec<((i64, usize), Terms)> = Vec::new();
    for table in list.tables(|k| format!("stencil {k}"))? {
        table.only(&["at", "weights"])?;
        let node = table.need("at", "[0, 1]")?;
        let at = match whole_numbers(&node, "coordinate")?[..] {
            [column, row @ 0..=1] => (column, usize::from(row == 1)),
            _ => {
                return Err(node
                    .problem("border", "`at` is a column and a row modulo 2", "here")
                    .with_help("at = [0, 1] stands for the new points (0, 2k + 1)"));
            }
        };
        if found.iter().any(|(known, _)| *known == at) {
            return Err(node
                .problem("border", "these new points have weights already", "here")
                .with_help("leave one of the two tables out"));
        }
        let weights = table.need("weights", "[[0, 0, \"1/2\"], [0, 1, \"1/2\"]]")?;
        let terms = weights.array(|k| format!("weight {k}"))?.iter().map(weight).collect::<Result<Vec<_>, _>>()?;
        found.push((at, Terms::new(2, terms)));
    }
    Ok(found)
}

fn weight(node: &Node<'_>) -> Result<(Vec<i64>, Rational), Problem> {
    match &node.array(|k| format!("entry {k}"))?[..] {
        [column, row, value] => {
            Ok((vec![super::lattice::whole(column)?, super::lattice::whole(row)?], value.number()?))
        }
        _ => Err(node
            .problem("border", "a weight is [column, row, number]", "here")
            .with_help("[-1, 0, \"3/32\"]: 3/32 of the old point (-1, k)")),
    }
}
