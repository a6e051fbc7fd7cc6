//! The statements that verdicts are instances of, in words. Reports quote them; `secant explain` prints them.

use crate::theorem::Statement;

/// A statement with its proof and reference, in the markup of [`super::document::line`].
#[derive(Debug, Clone, Copy)]
pub struct Theorem {
    /// The name by which `secant explain` knows it.
    pub id: &'static str,
    /// Its number and name.
    pub name: &'static str,
    /// What it says.
    pub body: &'static str,
    /// Why it is true.
    pub proof: &'static str,
    /// Where it comes from.
    pub reference: &'static str,
}

const SOURCE: &str = "docs/theory.md; S. Podkorytov, Tangent spaces for self-similar shapes, Dijon 2013, chapter 4.";

/// All statements, in the order of the theory.
pub const THEOREMS: &[Theorem] = &[
    Theorem {
        id: "lemma-1",
        name: "Lemma 1 (contraction by prefix codes)",
        body: "Let every state have a finite complete prefix code of admissible words with $τ(T_w)≤c<1$ for all its words, where \
               $τ(T)=½ \\max_{i,j} ∑_k |t_{ki}-t_{kj}|$ is the norm of $T$ on vectors of sum 0. Then the system contracts and its \
               attractors exist.",
        proof: "Cut a long word into code words, each read from the state where the one before ended, and a rest shorter than the \
                longest code word. $τ$ is submultiplicative and there are finitely many rests, so $τ(T_w)$ decreases geometrically \
                with the length of $w$.",
        reference: "docs/theory.md §1 (Dobrushin's coefficient).",
    },
    Theorem {
        id: "lemma-2",
        name: "Lemma 2 (collapsing pieces)",
        body: "Suppose $L$ is not nilpotent, and let $C⊂K$ be a cell of the ring with $L^{\\dim V}(C-q)=0$. Then the germ does not \
               see $C$: Theorems 1 to 4 hold with $C$ left out of the ring.",
        proof: "Limit directions are taken along addresses tending to $w^ω$, that is along $M^m K$ with $m→∞$; for $m≥\\dim V$ all of \
                $M^m C$ is the point $q$ itself, which is excluded.",
        reference: "docs/theory.md §3.",
    },
    Theorem {
        id: "theorem-1",
        name: "Theorem 1 (spectral subspace)",
        body: "At an isolated branch, for $ρ_i>0$: all limit directions lie in $E_1⊕…⊕E_i$ if and only if $0∉π_i(X)$.",
        proof: "If $x∈X∩F_i$, its orbit $L^m x$ stays in $F_i$, is never 0 by isolation, and its limit directions lie in $F_i$. \
                Conversely, by compactness $|π_i x|≥c>0$ on $X$; in adapted norms $|L^m π_i x|≥c' a^m$ and \
                $|L^m (1-π_i) x|≤C b^m$ with $b<a$, uniformly on $X$.",
        reference: SOURCE,
    },
    Theorem {
        id: "theorem-2",
        name: "Theorem 2 (complete set of eigenvectors)",
        body: "If at an isolated branch $0∉π_1(X)$ and $E_1$, the generalised eigenspace of the largest modulus, is semisimple, then \
               $D^*=E_1$. In particular, if one real simple eigenvalue $λ$ is alone in the largest modulus, with right eigenvector $v$ \
               and left eigenvector $g$, and $g(x)≠0$ for all $x∈X$, then $D^*$ is the line of $v$.",
        proof: "$D^*⊂E_1$ by Theorem 1. For $x∈X$, $L^m π_1 x / ρ_1^m$ is almost periodic, so its limit directions span the \
                $L$-cyclic hull of $π_1 x$; summed over $X$ that is $π_1$ of the hull of $X$, which is $π_1 V=E_1$.",
        reference: SOURCE,
    },
    Theorem {
        id: "theorem-3",
        name: "Theorem 3 (incomplete set of eigenvectors)",
        body: "Let $ℓ+1$ be the length of the longest Jordan block of the largest modulus $ρ_1>0$, and \
               $u(x)=∑_{|λ|=ρ_1} λ^{-ℓ}(L-λ)^ℓ x_λ$ the leading coefficient, with values in $U$, the span of the eigenvectors that end \
               the longest chains. If $u(x)≠0$ for all $x∈X$, then $D^*=U$.",
        proof: "$L^m x=C(m,ℓ)·(L^m u(x)+O(ρ_1^m/m))$ uniformly on $X$, and $u$ is a polynomial in $L$.",
        reference: SOURCE,
    },
    Theorem {
        id: "theorem-4",
        name: "Theorem 4 (null component)",
        body: "At an isolated branch let $x∈X$ have no component in $E_1⊕…⊕E_i$. Then the cyclic hull of its own leading \
               coefficient is contained in $D^*$, so $D^*$ is not contained in $E_1⊕…⊕E_i$; always $D^*$ contains $U$, too.",
        proof: "The orbit of $x$ stays in $F_i$ and is never 0; its limit directions, which span the hull of its leading coefficient, \
                lie in $F_i$ and are limit directions of the shape.",
        reference: SOURCE,
    },
    Theorem {
        id: "corollary",
        name: "Corollary (refuting without the ring)",
        body: "If $L$ is not nilpotent, then $U⊂D^*$, isolated or not, where $U$ is the span of the eigenvectors that end the longest \
               chains of the largest modulus ($U=E_1$ when $E_1$ is semisimple). So $\\dim U≥2$ refutes a tangent line.",
        proof: "The relevant space is spanned by the differences of the attractor; so some points of it have a leading coefficient \
                different from 0, and their hulls span $U$.",
        reference: SOURCE,
    },
    Theorem {
        id: "corollary-line",
        name: "Corollary on a line",
        body: "If $\\dim V=1$ and $L≠0$, then $D^*=V$, with no ring condition and isolated or not.",
        proof: "$U⊂D^*⊂V$ and $\\dim U≥1$.",
        reference: "docs/theory.md §5.",
    },
    Theorem {
        id: "section-6",
        name: "Criterion of §6 (one real block of length 2)",
        body: "Let the branch be isolated of depth 1, let $E_1$ be exactly one real Jordan block of length 2 with coordinates \
               $c_1, c_2$ along the chain, and let $u(x_0)=0$ at some $x_0∈X$. Then $D^*=U$ if and only if no sequence in $X$ has $c_2→0$, \
               $c_2≠0$ and $λ c_1 c_2<0$.",
        proof: "The points of the ring with $c_2=-sλ/m$ make $L^m x$ parallel to the second vector of the chain, where $s$ is the first \
                coordinate of $x_0$.",
        reference: "docs/theory.md §6.",
    },
    Theorem {
        id: "rays",
        name: "Rule for rays",
        body: "Let $D^*$ be the line of $v$ at an isolated branch, so that $L^m x$ is $λ^m c(x) v$ up to a positive factor and smaller terms, with \
               $c(x)≠0$ on $X$. Let $σ^-$ and $σ^+$ be the signs of $c$ on the parts of the ring before and after the point in the order of the curve, \
               and $ε=±1$ the product of the orientation signs along the cycle. At an end point there is one part: $λ>0$ gives the one ray $σ v$, \
               $λ<0$ both rays. Inside, for $ε=1$: $λ>0$ gives the ray $σ^+ v$ after and $σ^- v$ before the point, $λ<0$ both rays on each side. For \
               $ε=-1$: if $λ>0$ and $σ^+=σ^-$, the ray $σ^+ v$ on both sides, a cusp; if $λ<0$ and $σ^+≠σ^-$, the ray $σ^+ v$ after and \
               $σ^- v$ before the point; otherwise both rays on each side. Of a shape that is no curve there is one ray if and only if $λ>0$ and $c$ has one sign on $X$.",
        proof: "$M^m$ carries the part after the point to the side $ε^m$, and the secants of its points have the sign of $λ^m c(x)$.",
        reference: "docs/theory.md §5 (Rays).",
    },
    Theorem {
        id: "joint",
        name: "Rule for joints",
        body: "Let both branches of a joint be isolated, and let the directions not be killed on the way to the point. The curve has a \
               tangent line there if and only if both branches have one and the two lines agree; it is then regular, a cusp or \
               oscillating by the rays of the two sides.",
        proof: "$D^*$ of the joint is the sum of those of its two branches.",
        reference: "docs/theory.md §9; the thesis, chapter 4.",
    },
    Theorem {
        id: "theorem-5",
        name: "Theorem 5 (a dense set by finitely many checks)",
        body: "If every first-level joint of every reachable edge state is differentiable, and every $T_i$ and the projection by the \
               control points are injective on the (visible) relevant spaces, then the curve is differentiable, of the same kind, at \
               the image of every joint under every admissible word: a dense set.",
        proof: "The germ of the joint $uj$ is the image under $T_u$ of that of the joint $j$; an injective linear map takes limit \
                directions to limit directions and lines to lines.",
        reference: "docs/theory.md §9.",
    },
    Theorem {
        id: "theorem-5-projected",
        name: "Theorem 5′ (a projection that is not injective)",
        body: "Let all $T_i : W_δ→W_e$ be injective, and let every first-level joint $j$ of every reachable edge state $e$ be \
               differentiable in $W_e$ with tangent line $ℓ_j$. Then the projected curve is differentiable, of the same kind, at the \
               joint $uj$ for every path $u$ with $P T_u ℓ_j≠0$. If moreover the smallest invariant family that contains the lines is \
               all of $W$, every cell whose projection is more than a point contains such a joint.",
        proof: "The germ of the joint in $W_e$ has the only limit line $ℓ_j$; $P T_u$ does not kill it, so the image germ has the line \
                $P T_u ℓ_j$, and rays go to rays. For a cell $u$ with $P T_u W≠0$ some $T_x ℓ_j$ is not in the kernel of $P T_u$, because \
                these lines span $W$.",
        reference: "docs/theory.md §9.",
    },
    Theorem {
        id: "theorem-6",
        name: "Theorem 6 (common cones)",
        body: "Let every edge state have rays $G_e$ that span $V_e$, a functional $f_e$ with $f_e G_e>0$, a chord $G_e y_e$ with $y_e≥0$, \
               $y_e≠0$, and for every piece $ε_i T_i G_δ=G_e B_i$ with $B_i>0$ entrywise. If the pieces meet, then all secants of a cell $u$ \
               lie in the cone $ε_u T_u C$, these cones shrink to a ray at a uniform geometric rate, and both half-tangents exist at \
               every point. If they agree at the first-level joints of all reachable states, the curve is G¹ with a \
               Hölder-continuous tangent. With control points the same holds for the projected curve if $h P G>0$ for some $h$.",
        proof: "A secant between vertices of cells is a sum of chords of smaller cells, all in the cone; take closures. Positive matrices \
                shrink cones by $(\\sqrt{D}-1)/(\\sqrt{D}+1)$ in Hilbert's metric, $D$ the largest cross-ratio.",
        reference: "docs/theory.md §11; G. Birkhoff, Extensions of Jentzsch's theorem, Trans. AMS 85 (1957).",
    },
    Theorem {
        id: "theorem-6-slow",
        name: "Theorem 6′ (cones that shrink slowly)",
        body: "Theorem 6 holds, but for the rate, with $B_i≥0$ without zero columns, if every address has again and again factors of \
               bounded length with a positive product, or ends in one of finitely many cycles whose product on $V$ has one positive \
               eigenvalue with the one longest Jordan block of largest modulus, the leading coefficient of which is positive on all rays.",
        proof: "Nonnegative matrices do not expand Hilbert's metric, and each positive factor contracts it. Along the cycles all rays of \
                the cone tend to the eigenvector at the end of the longest chain. So the cones shrink along every address; their diameters \
                decrease, hence they shrink uniformly, by compactness.",
        reference: "docs/theory.md §11.",
    },
    Theorem {
        id: "similarities",
        name: "Similarities",
        body: "If all maps are similarities for one scalar product and $\\dim V≥2$, then $\\dim D^*≥2$ at every point, periodic or not.",
        proof: "Each cell at the point is a scaled copy of one of finitely many attractors; by compactness none lies in a fixed narrow \
                double cone about a line.",
        reference: "docs/theory.md §5; C. Bandt, A. Kravchenko, Differentiability of fractal curves, Nonlinearity 24 (2011), Theorem 1.",
    },
    Theorem {
        id: "surface-point",
        name: "Rule for points of a surface",
        body: "A point of a patch complex has one branch for each cell that contains it: one inside a cell, two inside an edge, one for each \
               incident patch at a vertex. The tangent subspace of the point is the sum of those of its branches, and the surface \
               is differentiable there if and only if the sum has dimension 2.",
        proof: "In a valid complex the map from the parameters to the surface is well defined and continuous, and the addresses of a \
                parameter are the paths through the cells that contain it: the cells of the branches make up a neighbourhood of it.",
        reference: "docs/theory.md §9; the thesis, chapter 4.",
    },
    Theorem {
        id: "theorem-5-surface",
        name: "Theorem 5″ (a dense set of a surface)",
        body: "Let all $T_i : W_δ→W_e$ be injective, and let every reachable face $e$ have a vertex $j_e$ inside it at which it is \
               differentiable in $W_e$ with tangent plane $Π_e$. Then the surface has the tangent plane $P T_u Π_e$ at the vertex \
               $u j_e$ for every path $u$ from the start on which $P T_u$ does not fold $Π_e$. If $P$ is injective on $W$ that is every \
               cell, hence a dense set.",
        proof: "The germ of the vertex $u j_e$ is the image under $T_u$ of the germ of $j_e$, because $j_e$ lies inside the face; a linear \
                map that is injective on the span of the limit directions takes it to the span of the limit directions of the image. \
                Every cell contains such a vertex, and cells shrink.",
        reference: "docs/theory.md §9.",
    },
    Theorem {
        id: "tensor-product",
        name: "Theorem on tensor products",
        body: "Let $p(s,t)=a(s)⊗b(t)$ in barycentric space, neither curve constant. The surface is differentiable at $(s,t)$ if and only \
               if both curves are, and $D^*=D^*_a⊗b(t)+a(s)⊗D^*_b$. With control points $P$ must be injective on $D^*$.",
        proof: "The mixed term $(a(s')-a(s))⊗(b(t')-b(t))$ is of higher order, and the two summands are independent because $a(s)$ has the \
                coordinate sum 1 and $D^*_a$ the sum 0.",
        reference: "docs/theory.md §9.",
    },
];

/// The statement with an id, or the one nearest to what was typed.
///
/// # Errors
/// The ids, where none fits.
pub fn find(text: &str) -> Result<&'static Theorem, Vec<&'static str>> {
    let wanted: String =
        text.trim().to_lowercase().chars().map(|c| if c.is_alphanumeric() || c == '′' { c } else { '-' }).collect();
    let wanted = wanted.replace("5′", "5-projected").replace("5'", "5-projected");
    let found = THEOREMS.iter().find(|t| t.id == wanted || t.id.strip_prefix("theorem-") == Some(wanted.as_str()));
    found.ok_or_else(|| THEOREMS.iter().map(|t| t.id).collect())
}

/// The words of the statement that was applied.
#[must_use]
pub fn of(statement: Statement) -> &'static Theorem {
    let id = match statement {
        Statement::Theorem2 => "theorem-2",
        Statement::Theorem3 => "theorem-3",
        Statement::Theorem4 => "theorem-4",
        Statement::Corollary => "corollary",
        Statement::CorollaryLine => "corollary-line",
        Statement::Section6 => "section-6",
        Statement::Joint => "joint",
        Statement::Theorem5 => "theorem-5",
        Statement::Theorem5Projected => "theorem-5-projected",
        Statement::Similarities => "similarities",
        Statement::SurfacePoint => "surface-point",
        Statement::Theorem5Surface => "theorem-5-surface",
        Statement::TensorProduct => "tensor-product",
    };
    THEOREMS.iter().find(|t| t.id == id).unwrap_or(&THEOREMS[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_statement_is_found() {
        for theorem in THEOREMS {
            assert_eq!(find(theorem.id).unwrap().id, theorem.id);
        }
        assert_eq!(find("Theorem 2").unwrap().id, "theorem-2");
        assert_eq!(find("2").unwrap().id, "theorem-2");
        assert_eq!(find("5′").unwrap().id, "theorem-5-projected");
        assert_eq!(of(Statement::Joint).id, "joint");
        assert!(find("theorem-99").is_err());
    }
}
