//! What the certificate of one branch of a surface proves about the tangent subspace of its germ (docs/certificate.md, section 8.1).

use crate::base::{Checked, Enclosed, Field, Matrix, Node, need, products, spend, values};
use crate::curve::{Address, Branch, Germ, Model, Root, Top, outer, residual};
use num_bigint::BigInt;
use num_traits::Zero;

/// Most vectors among which independent ones are looked for.
const MAX_VECTORS: usize = 100;

/// Bounds of the tangent subspace of a germ.
pub struct Bounds {
    /// It contains these vectors.
    pub contains: Vec<Enclosed>,
    /// It lies in the span of these vectors, given by their coefficients …
    pub within: Vec<Matrix>,
    /// … whose dimension is at most this.
    pub dimension: usize,
}

/// Checks the certificate of the branch with this address.
pub fn check(model: &Model<'_>, root: &Root, address: &Address, node: &Node<'_>) -> Checked<Bounds> {
    let branch = Branch { model, germ: Germ::new(model, root, address)? };
    let germ = &branch.germ;
    let [top_node, orbits, bound] = node.fields("top orbits bound")?;
    let top = Top::read(&top_node, &germ.linear, &())?;
    let (mut contains, mut within) = (top.directions(&germ.view)?, top.ends(&germ.view)?);
    for orbit in orbits.list()? {
        let [point, own] = orbit.fields("address own")?;
        let (own, view) = branch.orbit_top(&point, &own)?;
        contains.extend(own.directions(&view)?);
        within.extend(own.ends(&view)?);
    }
    if bound.is_null() {
        // All secants lie in G Y.
        return Ok(Bounds { contains, within: vec![germ.view.clone()], dimension: germ.view.rank()? });
    }
    let (dimension, functionals, cover) = match bound.tag("by")? {
        "leading" => leading(germ, &top, &bound)?,
        _ => group(germ, &bound)?,
    };
    model.cover(germ, &model.enclosed(germ, &functionals)?, None, &cover)?;
    let reached = dimension > 0 && independent(&contains.iter().collect::<Vec<_>>(), dimension)?;
    bound.need(reached, "bound", "the vectors are not seen to span the space that holds the limit directions")?;
    Ok(Bounds { contains, within, dimension })
}

/// Rows that read coefficients of the last vectors of the longest chains: what lies in their common kernel has `u = 0`.
fn leading<'n>(germ: &Germ, top: &Top, bound: &Node<'n>) -> Checked<(usize, Vec<Enclosed>, Node<'n>)> {
    let [_, list, cover] = bound.fields("by functionals cover")?;
    let zero = [Zero::zero(), Zero::zero()];
    let (field, imaginary, parts, chains) = match top {
        Top::Real { field, chains } => (field.clone(), zero, 1, chains.as_slice()),
        Top::Pair { square: [_, y], field, .. } => (field.clone(), y.clone(), 2, [].as_slice()),
        Top::Conformal(_) => (Field::rational(&Zero::zero()), zero, 0, [].as_slice()),
    };
    bound.need(parts > 0, "leading", "a top that is real, or a pair, is needed here")?;
    // A pair has no chains here: its rows are asked for nothing but to be left eigenvectors.
    let longest = chains.iter().fold(0, |most, c| most.max(c.vectors.len()));
    let mut rows = Vec::new();
    for item in list.list()? {
        let row = field.vector(&item, germ.dim())?;
        let left = |sign| Ok(residual(&field, &germ.linear.transpose(), sign, &row)?.is_zero());
        item.need(left(1)? || left(-1)?, "leading", "the row is no left eigenvector")?;
        for chain in chains.iter().filter(|c| c.vectors.len() < longest) {
            let value = field.dot(&row, &chain.vectors[chain.vectors.len() - 1])?;
            item.need(value.is_zero(), "leading", "the row sees a shorter chain")?;
        }
        rows.extend(values(&row, &field.interval, &imaginary)?.into_iter().take(parts));
    }
    let count = chains.iter().filter(|c| c.vectors.len() == longest).count();
    Ok((if parts == 2 { 2 } else { count }, rows, cover))
}

/// Rational rows whose common kernel is the sum of the generalised eigenspaces inside a disc.
fn group<'n>(germ: &Germ, bound: &Node<'n>) -> Checked<(usize, Vec<Enclosed>, Node<'n>)> {
    let [_, radius, rows, cover] = bound.fields("by radius rows cover")?;
    bound.need(bound.tag("by")? == "group", "format", "unknown bound")?;
    let (dimension, list) = outer(germ, &(), &radius, &rows)?;
    let exact = |i: usize| Enclosed::exact(list.row(i).transpose());
    Ok((dimension, (0..list.rows).map(exact).collect(), cover))
}

/// The sets of `k` numbers below `n`.
fn subsets(n: usize, k: usize) -> Vec<Vec<usize>> {
    if k == 0 {
        return vec![Vec::new()];
    }
    (0..n).flat_map(|last| subsets(last, k - 1).into_iter().map(move |s| [s, vec![last]].concat())).collect()
}

/// Bounds of the determinant of some vectors in the coordinates given.
fn minor(vectors: &[&Enclosed], rows: &[usize]) -> [BigInt; 2] {
    let Some((first, rest)) = vectors.split_first() else { return [1, 1].map(BigInt::from) };
    let mut sum = [BigInt::zero(), BigInt::zero()];
    for (k, &row) in rows.iter().enumerate() {
        let [lo, hi] = products(&first.ends(row), &minor(rest, &[&rows[..k], &rows[k + 1..]].concat()));
        let [low, high] = if k % 2 == 0 { [lo, hi] } else { [-hi, -lo] };
        sum = [&sum[0] + low, &sum[1] + high];
    }
    sum
}

/// Whether some `k` of the vectors, `k ≤ 3`, have a minor that is certainly not 0.
pub fn independent(vectors: &[&Enclosed], k: usize) -> Checked<bool> {
    need((1..=3).contains(&k) && vectors.len() <= MAX_VECTORS, "limit", "too many dimensions, or vectors")?;
    let Some(first) = vectors.first() else { return Ok(false) };
    let rows = subsets(first.lo.rows, k);
    let bits = vectors.iter().fold(0, |most, v| v.lo.bits().max(v.hi.bits()).max(most));
    for chosen in subsets(vectors.len(), k) {
        let chosen: Vec<&Enclosed> = chosen.iter().map(|&i| vectors[i]).collect();
        for rows in &rows {
            spend(16, bits)?;
            let [lo, hi] = minor(&chosen, rows);
            if lo > BigInt::zero() || hi < BigInt::zero() {
                return Ok(true);
            }
        }
    }
    Ok(false)
}
