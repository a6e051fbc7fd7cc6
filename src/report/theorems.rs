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
        id: "lemma-1-prime",
        name: "Lemma 1′ (contraction by polytopes)",
        body: "Let every state $e$ have finitely many points of coordinate sum 1 that affinely span its space, with the convex hull \
               $H_e$, and let every piece map them as $T_i h=m c+(1-m) h'$, $h'∈H_e$, with a number $0<m≤1$ and a point $c∈H_e$ that \
               depend on the piece only. Then the system contracts and $A_e⊂H_e$.",
        proof: "Then $T_i$ maps $H_δ-H_δ$ into $(1-m)(H_e-H_e)$. These are unit balls of norms on the vectors of sum 0, in which every \
                operator has a norm of at most the largest $1-m<1$. So the system contracts, and as the compact sets $H_e$ are mapped \
                into one another, they hold the attractors.",
        reference: "docs/theory.md §1.",
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
               chains of the largest modulus ($U=E_1$ when $E_1$ is semisimple). The same holds for the image of $U$ at the point. So an image of \
               dimension 2 or more refutes a tangent line, and one of dimension 3 or more a tangent plane.",
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
        id: "corollary-image",
        name: "Corollary on the image",
        body: "Let $G$ carry the branch to the point. If $\\dim G U=\\dim G V$, then the tangent subspace of the germ is $G U=G V$, with no ring \
               condition and isolated or not.",
        proof: "All secants at the point lie in $G V$, and $G U$ is contained in the tangent subspace.",
        reference: "docs/theory.md §5.",
    },
    Theorem {
        id: "both-bounds",
        name: "Upper and lower bound together",
        body: "Let the branch be isolated, $0∉π_i(X)$, and let $C$ be spanned by images under $G$ of vectors of $D^*$. If \
               $\\dim C=\\dim(E_1⊕…⊕E_i)$, then the tangent subspace of the germ is $C$.",
        proof: "$D^*⊂E_1⊕…⊕E_i$ by Theorem 1, so $C⊂G(E_1⊕…⊕E_i)$, with equality by the dimension; hence $G$ is injective there, and \
                $G D^*⊃C$.",
        reference: "docs/theory.md §5.",
    },
    Theorem {
        id: "section-6-surface",
        name: "Criterion of §6 on a connected part",
        body: "Let $E_1$ be exactly one real Jordan block of length 2, $0∉π_1(X)$, and let a path-connected part of the ring carry \
               points with $c_2>0$ and points with $c_2<0$. Then $D^*=E_1$. If $E_1$ is two such blocks of one eigenvalue, and the image of a closed path in a \
               disc of the ring under the pair $c_2$ winds around 0, then $\\dim D^*≥3$.",
        proof: "On a path from negative to positive values some zero of $c_2$ is approached by points with $λ c_1 c_2<0$; there \
                $L^m x$, with $m$ nearest to $-λ c_1/c_2$, tends to the direction of the second vector of the chain. For two blocks, $c_2+λ c_1/m$ winds around 0 for \
                large $m$ as well, so it has a zero in the disc, where $L^m x$ has the same property.",
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
        body: "Let $W_e$ be $V_e$ divided by the vectors that $P T_u$ kills for every path $u$ from the start to $e$ (without control points \
               $W_e=V_e$). If every first-level joint of every reachable edge state is differentiable, and every $T_i$, leading from $e$ to \
               $δ$, is injective as a map $W_δ→W_e$ and the projection $P$ on $W$ of the start, then the curve is differentiable, of the \
               same kind, at the image of every joint under every admissible word: a dense set.",
        proof: "The germ of the joint $uj$ is the image under $T_u$ of that of the joint $j$; an injective linear map takes limit \
                directions to limit directions and lines to lines.",
        reference: "docs/theory.md §9.",
    },
    Theorem {
        id: "theorem-5-projected",
        name: "Theorem 5′ (a projection that is not injective)",
        body: "Let $W_e$ be $V_e$ divided by the vectors that $P T_u$ kills for every path $u$ from the start to $e$. Let every $T_i$, leading \
               from $e$ to $δ$, be injective as a map $W_δ→W_e$, and let every first-level joint $j$ of every reachable edge state $e$ be \
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
               $y_e≠0$, and for every piece $i$, leading from $e$ to $δ$, $ε_i T_i G_δ=G_e B_i$ with $B_i>0$ entrywise, where $ε_i=-1$ for a piece \
               that runs backwards and $ε_i=1$ otherwise. If the pieces meet, then all secants of a cell $u$, directed forward, \
               lie in the cone $ε_u T_u C$, where $C$ is the cone of the rays of its state; these cones shrink to a ray at a uniform geometric rate, and both half-tangents exist at \
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
        body: "Let $W_e$ be $V_e$ divided by the vectors that $P T_u$ kills for every path $u$ from the start to $e$. Let every $T_i$, leading \
               from $e$ to $δ$, be injective as a map $W_δ→W_e$, and let every reachable face $e$ have a vertex $j_e$ inside it at which it is \
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
    Theorem {
        id: "lemma-3",
        name: "Lemma 3 (winding)",
        body: "Let $Ψ$ be the characteristic map of frequency $k$, $0<k<n/2$, at a vertex of valence $n$, so that $Ψ$ turned by one sector is $ω Ψ$, \
               $ω=e^{2πik/n}$. If a functional is positive on the image of one sector, then $0∉Ψ(K)$, and the outer boundary of the ring winds \
               $k$ times around 0.",
        proof: "The images of the sectors are turned copies. Along one sector the image of the boundary leads from $P$ to $ω P$ in an open \
                half-plane, so its argument changes by less than $π$, hence by $2πk/n$; there are $n$ sectors.",
        reference: "docs/theory.md §10.1.",
    },
    Theorem {
        id: "lemma-4",
        name: "Lemma 4 (limits of schemes without Bézier patches)",
        body: "Let a rule on a regular lattice make it $N$ times finer with each step, keep linear functions, and be symmetric under half a turn. Let $Ω$ be \
               the points that determine a cell and its parts, $T_s$ the map of nets on $Ω$ to the part $s$, which lies upside down if $σ_s=-1$, $F p$ the slopes of \
               the linear fit of a net $p$ at the corners, and $D(p)$ the largest absolute second difference of $p$ in $Ω$. If for some $k$ the number \
               $R=\\max |ℓ N^k T_w|$ over words $w$ of length $k$ and second differences $ℓ$ is below 1, then the limit $f$ of $p$ is C¹, and on the whole cell its \
               gradient differs from $F p$ by at most $e_1 D(p)$ with $e_1=\\max |σ_w N^k F T_w-F|/(1-R)$; the values differ in the same way from those of the fit, by at \
               most $e_0 D(p)$. Where $N=2$ and the mask has the factors $(1+z^u)(1+z^v)$ for all pairs of directions, second differences come from second \
               differences by the divided masks, and $R$ may be $2^k$ times the largest sum of absolute weights in $k$ steps of these.",
        proof: "$D(N^{mk} T_w p)≤R^m D(p)$ for words of length $mk$, so the slopes of the fits converge uniformly, to the gradient of $f$. The best constant $e_1$ \
                satisfies $e_1≤e_1 R+\\max |σ_w N^k F T_w-F|$, since the gradient on the part $w$ is $σ_w N^k$ times that of the limit of $T_w p$.",
        reference: "docs/theory.md §10.1.",
    },
    Theorem {
        id: "theorem-7",
        name: "Theorem 7 (C¹ at an extraordinary vertex)",
        body: "Let $λ≠0$ be real, alone in the largest modulus below 1 with Jordan blocks as long as its longest, and let it have exactly one of \
               them in each of the Fourier blocks 1 and $n-1$, $n≥3$. If the Jacobian determinant of the characteristic map $Ψ$ has one strict sign on the \
               ring $K$, and a functional is positive on the image of a sector, then for almost all control points the surface is a C¹ \
               manifold at the vertex, and $Ψ$ is injective. (The scheme is symmetric, with rings of C¹ functions that form a space of finite dimension: splines, or by Lemma 4.)",
        proof: "In ring $m$ the surface is $p+C(m,ℓ) λ^{m-ℓ}(AΨ+o(1))$ with $A$ injective and $o(1)$ in C¹, so the normals converge. The \
                projection to the limit plane is a local homeomorphism of the late rings that avoids $p$, and proper, hence a covering of a punctured disc; its degree is \
                the winding number of a boundary, 1 by Lemma 3. So the surface is a graph over its tangent plane.",
        reference: "docs/theory.md §10.1; U. Reif, CAGD 12 (1995), for one simple pair; J. Peters, U. Reif, Subdivision Surfaces (2008), chapters 4 and 5.",
    },
    Theorem {
        id: "theorem-8",
        name: "Theorem 8 (not C¹ at an extraordinary vertex)",
        body: "Let $U$ be the span of the eigenvectors that end the longest chains of the largest modulus below 1. For almost all control points the surface is not a C¹ manifold at \
               the vertex if (a) the leading eigenvalue of Theorem 7 is in the blocks $k$ and $n-k$ with $2≤k<n/2$ instead, and it is semisimple or \
               $0∉Ψ(K)$; or (b) $\\dim U=2$, semisimple, with both eigenvectors in the blocks 0 and $n/2$ and the same eigenvalue; or (c) the Jacobian determinant of $Ψ$ \
               takes both signs; or (d) $\\dim U≥3$; or (e) $\\dim U=1$ and the function of the eigenvector has no zero on $K$, or \
               only, for an eigenvalue of block 0, none on a closed path around the vertex.",
        proof: "(d) and the first part of (e): $U⊂D^*$, and one line is too little. In the others the limit directions of a C¹ \
                surface span its tangent plane, onto which late rings would project as a homeomorphism: their boundary would wind $±1$ times around the vertex and not \
                as $Ψ$ does, (a), (b); the local degree would be the same everywhere, (c); and a path would not stay on one side, (e).",
        reference: "docs/theory.md §10.1; U. Reif, CAGD 12 (1995); D. Zorin, Constructive Approximation 16 (2000).",
    },
    Theorem {
        id: "theorem-9",
        name: "Theorem 9 (all valences at once)",
        body: "For Catmull–Clark, Loop, Doo–Sabin and Doo–Sabin with the weights of Catmull and Clark the surface is C¹ in the sense of \
               Theorem 7 at every valence $n≥3$; for Loop with Warren's weights and the midedge scheme at every $n≥4$, and at $n=3$ by Theorem 7.",
        proof: "The entries of the Fourier blocks depend on $n$ through $t=2\\cos(2π/n)$ only. All other eigenvalues are smaller on the whole \
                interval of $t$; the Bernstein coefficients of the Jacobian determinant and of the functional are rational functions of one parameter, of one strict \
                sign on the whole interval by their own Bernstein coefficients. `secant certify CASE --valence all` computes all of these signs.",
        reference: "docs/theory.md §10.2.",
    },
    Theorem {
        id: "radius",
        name: "Exponents from the joint spectral radius",
        body: "Let every state have $N$ pieces and $a≤r≤b<1$ for the joint spectral radius $r$ of the operators on $V$. Then the Hölder \
               exponent of the curve in the uniform parameter, where it is at most 1, lies in $[-\\log_N b, -\\log_N a]$. If no piece is \
               reversed, $F_e⊂V_e$ have codimension 1, $T_i F_δ⊂F_e$ and $N T_i c_δ-c_e∈F_e$ for the chords $c$, and the radius on $F$ is less than \
               $N^{-1-α}$, $0<α≤1$, then the curve is $C^{1,α}$ in the uniform parameter if and only if the two derivatives agree at every \
               first-level joint of every reachable state.",
        proof: "Cells of level $m$ have diameters of the order of the norms of products of $m$ operators. With the radius on $F$ the \
                difference quotients over cells converge uniformly, with Hölder exponent $α$ on addresses; at joints the limits of the two addresses must agree.",
        reference: "docs/theory.md §11; I. Daubechies, J. Lagarias, SIAM J. Math. Anal. 23 (1992).",
    },
];

/// The statement with an id, or the one nearest to what was typed.
///
/// # Errors
/// The ids, where none fits.
pub fn find(text: &str) -> Result<&'static Theorem, Vec<&'static str>> {
    let names = [("5″", "5-surface"), ("5''", "5-surface"), ("5′", "5-projected"), ("5'", "5-projected")];
    let slow = [("6′", "6-slow"), ("6'", "6-slow")];
    let plain = names.iter().chain(&slow).fold(text.trim().to_lowercase(), |t, (a, b)| t.replace(a, b));
    let wanted: String = plain.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
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
    by_id(id)
}

/// The statement with exactly this id; the first one for an id that does not exist.
#[must_use]
pub(super) fn by_id(id: &str) -> &'static Theorem {
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
        assert_eq!(find("Theorem 5″").unwrap().id, "theorem-5-surface");
        assert_eq!(find("theorem 6'").unwrap().id, "theorem-6-slow");
        assert_eq!(find("8").unwrap().id, "theorem-8");
        assert_eq!(of(Statement::Joint).id, "joint");
        assert!(find("theorem-99").is_err());
    }
}
