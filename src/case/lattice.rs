//! Case files about masks on lattices: a `[mask]` table with a grid of coefficients, a symbol or a name, and a dilation.

use super::node::{File, Node, Table};
use super::{Model, Origin};
use crate::arith::Rational;
use crate::diagnostic::Problem;
use crate::scheme::{Dilation, LatticeError, LatticeMask, Terms, lattice_patch, named_mask};
use malachite_base::num::conversion::traits::IsInteger;

/// A case about a mask on a lattice.
#[derive(Debug, Clone)]
pub struct LatticeCase {
    /// The name.
    pub name: String,
    /// The mask.
    pub mask: LatticeMask,
}

impl LatticeCase {
    /// Whether the text of a case has a `[mask]` table; what is no TOML has none.
    #[must_use]
    pub fn is_meant(text: &str) -> bool {
        toml::de::DeTable::parse(text).is_ok_and(|table| table.get_ref().get("mask").is_some())
    }

    /// Reads and checks the text of a case; `name` is shown in diagnostics.
    ///
    /// # Errors
    /// A [`Problem`] for everything that is wrong with it.
    ///
    /// # Examples
    /// ```
    /// let text = "name = \"bilinear\"\n[mask]\norigin = [-1, -1]\n\
    ///             grid = [[\"1/4\", \"1/2\", \"1/4\"], [\"1/2\", 1, \"1/2\"], [\"1/4\", \"1/2\", \"1/4\"]]";
    /// let case = secant::case::LatticeCase::parse("bilinear.toml", text)?;
    /// assert_eq!(case.mask.terms().len(), 9);
    /// # Ok::<(), secant::diagnostic::Problem>(())
    /// ```
    pub fn parse(name: &str, text: &str) -> Result<Self, Problem> {
        super::read::parsed(name, &super::valued(name, text)?, File::new, Self::of_table)
    }

    fn of_table(_: &File, root: &Table<'_>) -> Result<Self, Problem> {
        root.only(&["name", "title", "source", "control", "examine", "expect", "mask"])?;
        let name = super::read::name(root)?;
        root.optional_text("title")?;
        root.optional_text("source")?;
        let node = root.need("mask", "{ symbol = \"(1+x)^2*(1+y)^2/4\" }")?;
        Ok(Self { name, mask: mask_of(&node)? })
    }
}

/// The patch over the unit square of a `[mask]`, which stands instead of `pieces`, `[[map]]`, `[[state]]` and `[scheme]`.
pub(super) fn read(case: &Table<'_>, node: &Node<'_>) -> Result<Model, Problem> {
    super::scheme::alone(
        case,
        "mask",
        &["pieces", "reversed", "map", "scheme", "state", "start", "kind", "convention"],
    )?;
    let mask = mask_of(node)?;
    let (complex, _) = lattice_patch(&mask).map_err(|e| {
        node.problem("mask", e.to_string(), "this mask").with_help("`secant regularity` says how smooth its limits are")
    })?;
    Ok(super::scheme::built(case, "mask", node, complex, Origin::Lattice))
}

fn mask_of(node: &Node<'_>) -> Result<LatticeMask, Problem> {
    let table = node.table()?;
    table.only(&["dilation", "grid", "origin", "symbol", "name", "parameters", "directions"])?;
    let dilation = table.get("dilation").map(|n| dilation(&n)).transpose()?;
    let mask = match (written(&table, dilation.clone())?, table.get("name")) {
        (Some(mask), None) => mask,
        (None, Some(named)) => of_name(&table, &named, dilation)?,
        _ => {
            return Err(table
                    .problem("mask", "a [mask] has one of `grid`, `symbol` and `name`", "this table")
                    .with_help("write grid = [[…]] with origin = [i, j], or symbol = \"(1+x)^2*(1+y)^2/4\", or name = \"butterfly\""));
        }
    };
    Ok(mask)
}

/// The mask of a table with one of `grid` and `symbol`.
pub(super) fn written(table: &Table<'_>, dilation: Option<Dilation>) -> Result<Option<LatticeMask>, Problem> {
    match (table.get("grid"), table.get("symbol")) {
        (Some(grid), None) => of_grid(table, &grid, dilation).map(Some),
        (None, Some(symbol)) => {
            LatticeMask::parse(symbol.text()?, dilation).map(Some).map_err(|e| problem(&symbol, &e))
        }
        _ => Ok(None),
    }
}

fn problem(node: &Node<'_>, error: &LatticeError) -> Problem {
    node.problem("mask", error.to_string(), "here").with_help(
        "the coefficients of p'_a = Σ_b m(a − Mb) p_b sum to 1 on every coset of M Z^s, and all eigenvalues of M have one \
         modulus above 1",
    )
}

/// A matrix of whole numbers, or a word such as `"quincunx"`.
fn dilation(node: &Node<'_>) -> Result<Dilation, Problem> {
    if let Ok(text) = node.text() {
        return Dilation::parse(text).map_err(|e| problem(node, &e));
    }
    let rows = node.array(|k| format!("row {k} of `dilation`"))?;
    let rows = rows.iter().map(|r| whole_numbers(r, "entry")).collect::<Result<Vec<_>, _>>()?;
    Dilation::new(rows).map_err(|e| problem(node, &e))
}

pub(super) fn whole_numbers(node: &Node<'_>, what: &str) -> Result<Vec<i64>, Problem> {
    let numbers = node.array(|k| format!("{what} {k}"))?;
    numbers.iter().map(whole).collect()
}

pub(super) fn whole(node: &Node<'_>) -> Result<i64, Problem> {
    let x = node.number()?;
    let small = (x.is_integer() && crate::arith::abs(&x) <= MAX_PLACE).then(|| x.to_string().parse().ok());
    small.flatten().ok_or_else(|| {
        node.problem(
            "range",
            format!("{} must be a whole number from -{MAX_PLACE} to {MAX_PLACE}", node.what),
            "not one",
        )
        .with_help("points of the lattice and dilations are whole numbers")
    })
}

/// Largest coordinate of a point of a grid.
const MAX_PLACE: i64 = 1000;

/// `grid[i][j]` is the coefficient at `origin + (i, j)`.
fn of_grid(table: &Table<'_>, grid: &Node<'_>, dilation: Option<Dilation>) -> Result<LatticeMask, Problem> {
    let origin = table.need("origin", "[0, 0]")?;
    let at = whole_numbers(&origin, "coordinate")?;
    let mut terms = Vec::new();
    read_grid(grid, &at, &mut Vec::new(), &mut terms)?;
    let dilation = dilation.map_or_else(|| Dilation::scalar(at.len(), 2), Ok).map_err(|e| problem(&origin, &e))?;
    let mask = LatticeMask::new(Terms::new(at.len(), terms), dilation).map_err(|e| problem(grid, &e))?;
    let Some(node) = table.get("directions") else { return Ok(mask) };
    let directions = node.array(|k| format!("direction {k}"))?;
    let directions = directions.iter().map(|d| whole_numbers(d, "coordinate")).collect::<Result<Vec<_>, _>>()?;
    mask.with_directions(directions).map_err(|e| problem(&node, &e))
}

fn read_grid(
    node: &Node<'_>,
    origin: &[i64],
    place: &mut Vec<i64>,
    terms: &mut Vec<(Vec<i64>, Rational)>,
) -> Result<(), Problem> {
    if place.len() == origin.len() {
        terms.push((place.clone(), node.number()?));
        return Ok(());
    }
    let depth = place.len();
    for (item, k) in node.array(|k| format!("{} [{k}]", node.what))?.iter().zip(origin[depth]..) {
        place.push(k);
        read_grid(item, origin, place, terms)?;
        place.pop();
    }
    Ok(())
}

fn of_name(table: &Table<'_>, named: &Node<'_>, dilation: Option<Dilation>) -> Result<LatticeMask, Problem> {
    if dilation.is_some() {
        return Err(named
            .problem("mask", "a named mask has its own dilation", "this name")
            .with_help("leave `dilation` out"));
    }
    let parameters = match table.get("parameters") {
        None => Vec::new(),
        Some(node) => {
            let list = node.array(|k| format!("parameter {k}"))?;
            list.iter().map(|p| p.text().map(str::to_owned)).collect::<Result<Vec<_>, _>>()?
        }
    };
    let made = named_mask(named.text()?, &parameters).ok_or_else(|| {
        named
            .problem("mask", format!("there is no mask on a lattice called {:?}", named.text().ok()), "not a name")
            .with_help("there are box-spline, butterfly, four-eight, loop, sqrt3 and tensor")
    })?;
    made.map_err(|e| problem(named, &e))
}
