//! Cases with `[scheme]`: masks, symbols, filters, named curves and tensor products of them, written out as states by this crate
//! itself (docs/schemes.md says what they stand for).

mod curves;
mod interpolate;
mod masks;
mod symbol;

use super::{End, case};
use crate::base::{Checked, Json, Matrix, Node, flag, some};
use curves::Curve;

/// The keys that say what is built; each table has exactly one.
const FORMS: [&str; 7] = ["name", "mask", "symbol", "filter", "tensor", "mesh", "interpolate"];

/// What to do where a case is not built here.
pub const ELSEWHERE: &str = "check the expanded case, which `secant certify --certificate FILE` writes beside the certificate, \
    and `secant expand` prints";

/// A key with its value.
type Field = (String, Json);

fn text(word: &str) -> Json {
    Json::Text(word.to_owned())
}

fn field(key: &str, value: Json) -> Field {
    (key.to_owned(), value)
}

/// A matrix as a file has it.
fn rows(m: &Matrix) -> Json {
    let row = |i: usize| Json::List((0..m.cols).map(|j| text(&m.at(i, j).to_string())).collect());
    Json::List((0..m.rows).map(row).collect())
}

/// What the table `[scheme]` stands for: the keys of a case in its place.
pub fn expanded(node: &Node<'_>) -> Checked<Vec<Field>> {
    let spans = node.get("ends").is_some() || node.get("knots").is_some();
    node.need(!spans, "scheme", format_args!("polygons of several spans are not built here: {ELSEWHERE}"))?;
    match form(node)? {
        "tensor" => tensor(node),
        "interpolate" => interpolate::expanded(node, "interpolate"),
        "mesh" => node.reject("scheme", format_args!("meshes are not built here: {ELSEWHERE}")),
        form => curve(node, form, flag(node, "vertices")?)?.fields(),
    }
}

/// What the table `[interpolate]` stands for.
pub fn interpolated(node: &Node<'_>) -> Checked<Vec<Field>> {
    interpolate::expanded(node, "points")
}

fn form(node: &Node<'_>) -> Checked<&'static str> {
    let given: Vec<&'static str> = FORMS.into_iter().filter(|key| node.get(key).is_some()).collect();
    match given.as_slice() {
        [form] => Ok(form),
        _ => node.reject("format", format_args!("a scheme has exactly one of the keys {}", FORMS.join(", "))),
    }
}

/// A curve; with its vertices, where they are asked for.
fn curve(node: &Node<'_>, form: &str, vertices: bool) -> Checked<Curve> {
    if form == "name" {
        if let Some(mask) = masks::named(node)? {
            return mask.curve(node, vertices);
        }
        let curve = curves::named(node)?;
        return if vertices { curve.with_end_points(node) } else { Ok(curve) };
    }
    masks::given(node, form)?.curve(node, vertices)
}

/// One state of a product: a curve (`true`) or its vertex, times another one.
fn tensor(node: &Node<'_>) -> Checked<Vec<Field>> {
    node.known("tensor")?;
    let factors = node.field("tensor")?.exactly(2, "format")?;
    let factor = |node: &Node<'_>| {
        let form = form(node)?;
        let plain = form != "interpolate";
        node.need(
            plain,
            "scheme",
            format_args!("products of functions that interpolate are not built here: {ELSEWHERE}"),
        )?;
        node.need(!matches!(form, "tensor" | "mesh"), "format", "the factors of a tensor product are curves")?;
        let curve = curve(node, form, true)?;
        node.need(curve.vertex.is_some(), "format", "a factor of a tensor product is a curve, no set")?;
        Ok(curve)
    };
    let (a, b) = (factor(&factors[0])?, factor(&factors[1])?);
    let mut states = Vec::new();
    for x in [true, false] {
        for y in [true, false] {
            states.push(product(&a, x, &b, y)?);
        }
    }
    let states = Json::List(states.into_iter().map(Json::Object).collect());
    Ok(vec![field("convention", text("columns")), field("start", text(&pair(true, true))), field("state", states)])
}

/// The name of a product of a curve or its vertex with another one.
fn pair(x: bool, y: bool) -> String {
    format!("{}⊗{}", if x { "u" } else { "v" }, if y { "w" } else { "v" })
}

/// The state of a product: a face, a curve along one of the factors, or a vertex.
fn product(a: &Curve, x: bool, b: &Curve, y: bool) -> Checked<Vec<Field>> {
    let (first, second) = (a.operators(x)?, b.operators(y)?);
    let (n, m) = (a.size(x)?, b.size(y)?);
    let mut pieces = Vec::new();
    // The first factor runs fastest.
    for (q, backwards_v) in &second {
        for (p, backwards_u) in &first {
            let mut piece = vec![field("to", text(&pair(x, y))), field("matrix", rows(&kronecker(p, q)?))];
            if x && y {
                // Corner k of the piece lies at this corner of its part.
                let corner = |k: u64| if *backwards_u { k ^ 1 } else { k };
                let corner = |k: u64| if *backwards_v { 3 - corner(k) } else { corner(k) };
                piece.push(field("corners", Json::List((0..4).map(|k| number(corner(k))).collect())));
            } else {
                piece.push(field("reversed", Json::Flag(*backwards_u || *backwards_v)));
            }
            pieces.push(Json::Object(piece));
        }
    }
    let kind = match (x, y) {
        (true, true) => "face",
        (false, false) => "vertex",
        _ => "edge",
    };
    let dimension = number((n * m) as u64);
    let mut state = vec![field("name", text(&pair(x, y))), field("kind", text(kind)), field("dimension", dimension)];
    let along_u = |end: End| kronecker(&a.boundary(end)?, &Matrix::identity(m));
    let along_v = |end: End| kronecker(&Matrix::identity(n), &b.boundary(end)?);
    let side = |key: &str, to: &str, name: String, op: Matrix| {
        field(key, Json::Object(vec![field(to, text(&name)), field("matrix", rows(&op))]))
    };
    let (left, right) = (End::Start, End::Finish);
    match (x, y) {
        (true, true) => state.extend([
            field("layout", text(&format!("{}x{}", first.len(), second.len()))),
            side("bottom", "edge", pair(true, false), along_v(left)?),
            side("right", "edge", pair(false, true), along_u(right)?),
            side("top", "edge", pair(true, false), along_v(right)?),
            side("left", "edge", pair(false, true), along_u(left)?),
        ]),
        (true, false) => state.extend([
            side("left", "vertex", pair(false, false), along_u(left)?),
            side("right", "vertex", pair(false, false), along_u(right)?),
        ]),
        (false, true) => state.extend([
            side("left", "vertex", pair(false, false), along_v(left)?),
            side("right", "vertex", pair(false, false), along_v(right)?),
        ]),
        (false, false) => {}
    }
    state.push(field("piece", Json::List(pieces)));
    Ok(state)
}

/// A number of a case file.
fn number(k: u64) -> Json {
    Json::Number(k.to_string())
}

/// `A ⊗ B`: coordinate `(i, j)` has the number `i m + j`, `m` the size of `B`.
pub fn kronecker(a: &Matrix, b: &Matrix) -> Checked<Matrix> {
    let (rows, cols) = (a.rows * b.rows, a.cols * b.cols);
    crate::base::spend(rows * cols, a.bits().max(b.bits()))?;
    let entry = |k: usize| {
        let (i, j) = (k / cols, k % cols);
        &a.integers(i / b.rows)[j / b.cols] * &b.integers(i % b.rows)[j % b.cols]
    };
    Ok(Matrix { rows, cols, data: (0..rows * cols).map(entry).collect(), den: &a.den * &b.den })
}

impl Curve {
    /// The operators of the curve or of its vertex, with whether they run backwards.
    fn operators(&self, curve: bool) -> Checked<Vec<(Matrix, bool)>> {
        if curve {
            return Ok(self.pieces.clone());
        }
        let vertex = some(self.vertex.as_ref(), "scheme", "a curve without vertices")?;
        Ok(vec![(vertex.op.clone(), false)])
    }

    /// The number of coordinates of the curve or of its vertex.
    fn size(&self, curve: bool) -> Checked<usize> {
        Ok(self.operators(curve)?[0].0.rows)
    }

    /// The boundary operator at an end.
    fn boundary(&self, end: End) -> Checked<Matrix> {
        let vertex = some(self.vertex.as_ref(), "scheme", "a curve without vertices")?;
        Ok(vertex.ends[end as usize].clone())
    }

    /// The curve as the keys of a case.
    fn fields(&self) -> Checked<Vec<Field>> {
        let mut keys = vec![field("convention", text("columns"))];
        keys.extend((!self.curve).then(|| field("kind", text("set"))));
        if let Some(points) = &self.control {
            keys.push(field("control", rows(points)));
        }
        let Some(vertex) = &self.vertex else {
            let backwards = (0..self.pieces.len()).filter(|k| self.pieces[*k].1).map(|k| number(k as u64)).collect();
            keys.push(field("pieces", Json::List(self.pieces.iter().map(|p| rows(&p.0)).collect())));
            keys.push(field("reversed", Json::List(backwards)));
            return Ok(keys);
        };
        let piece = |to: &str, op: &Matrix, backwards: bool| {
            let keys = [field("to", text(to)), field("matrix", rows(op)), field("reversed", Json::Flag(backwards))];
            Json::Object(keys.into())
        };
        let end = |key: &str, op: &Matrix| {
            field(key, Json::Object(vec![field("vertex", text("v")), field("matrix", rows(op))]))
        };
        let size = |n: usize| field("dimension", number(n as u64));
        let pieces = self.pieces.iter().map(|(op, backwards)| piece("e", op, *backwards)).collect();
        let edge = vec![
            field("name", text("e")),
            field("kind", text("edge")),
            size(self.pieces[0].0.rows),
            end("left", &vertex.ends[0]),
            end("right", &vertex.ends[1]),
            field("piece", Json::List(pieces)),
        ];
        let point = vec![
            field("name", text("v")),
            field("kind", text("vertex")),
            size(vertex.op.rows),
            field("piece", Json::List(vec![piece("v", &vertex.op, false)])),
        ];
        keys.push(field("start", text("e")));
        keys.push(field("state", Json::List(vec![Json::Object(edge), Json::Object(point)])));
        Ok(keys)
    }

    /// The curve with its end points as vertices on one coordinate; one that has vertices is left as it is.
    fn with_end_points(mut self, node: &Node<'_>) -> Checked<Self> {
        node.need(self.curve, "format", "only curves have vertices")?;
        if self.vertex.is_none() {
            let tree = Json::Object(Self { control: None, ..self.clone() }.fields()?);
            let shape = case::shape(&Node { value: &tree, place: node.place.clone() })?;
            let ends = [shape.end_point(0, End::Start)?, shape.end_point(0, End::Finish)?];
            self.vertex = Some(curves::Vertex { op: Matrix::identity(1), ends });
        }
        Ok(self)
    }
}
