//! The statements that verdicts are instances of. Each is one file of `docs/statements`, which `docs/theory.md`, the
//! reports and `secant explain` quote; a new statement is one such file and one line of the list below.

use std::sync::OnceLock;

/// What a statement says, in the markup of [`crate::report::document::line`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text {
    /// Its number and name.
    pub name: String,
    /// What it asks for, in order; every hypothesis has a name of its own.
    pub hypotheses: Vec<Hypothesis>,
    /// What follows, by paragraphs.
    pub body: Vec<String>,
    /// Why, by paragraphs.
    pub proof: Vec<String>,
    /// Where it comes from.
    pub reference: String,
}

/// A hypothesis of a statement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hypothesis {
    /// The name by which evidence refers to it.
    pub name: String,
    /// What is asked for.
    pub text: String,
}

macro_rules! statements {
    ($($variant:ident = $id:literal,)*) => {
        /// A statement of `docs/theory.md`, in the order of that page.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Statement {
            $(
                #[doc = concat!("`docs/statements/", $id, ".md`")]
                $variant,
            )*
        }

        impl Statement {
            /// All statements, in the order of the theory.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];

            /// The name of its file, by which JSON and `secant explain` know it.
            #[must_use]
            pub fn id(self) -> &'static str {
                match self {
                    $(Self::$variant => $id,)*
                }
            }

            /// Its file as it stands.
            #[must_use]
            pub fn source(self) -> &'static str {
                match self {
                    $(Self::$variant => include_str!(concat!("../docs/statements/", $id, ".md")),)*
                }
            }

            /// What it says.
            #[must_use]
            pub fn text(self) -> &'static Text {
                match self {
                    $(Self::$variant => {
                        static TEXT: OnceLock<Text> = OnceLock::new();
                        TEXT.get_or_init(|| self.read())
                    })*
                }
            }
        }
    };
}

statements! {
    Lemma1 = "lemma-1",
    Lemma1Prime = "lemma-1-prime",
    Lemma2 = "lemma-2",
    Theorem1 = "theorem-1",
    Theorem2 = "theorem-2",
    Theorem3 = "theorem-3",
    Theorem4 = "theorem-4",
    Theorem4Sign = "theorem-4-sign",
    Theorem4Winding = "theorem-4-winding",
    Corollary = "corollary",
    CorollaryLine = "corollary-line",
    CorollaryImage = "corollary-image",
    BothBounds = "both-bounds",
    NullExists = "null-exists",
    Rates = "rates",
    Rays = "rays",
    Similarities = "similarities",
    Section6Exact = "section-6-exact",
    Section6 = "section-6",
    Section6Surface = "section-6-surface",
    Section6TwoBlocks = "section-6-two-blocks",
    Enclosures = "enclosures",
    LinkedPieces = "linked-pieces",
    OwnPoints = "own-points",
    Holder = "holder",
    LocalDerivative = "local-derivative",
    CharacteristicMap = "characteristic-map",
    Transport = "transport",
    BranchAndShape = "branch-and-shape",
    LowerBounds = "lower-bounds",
    Joint = "joint",
    Theorem5 = "theorem-5",
    Theorem5Projected = "theorem-5-projected",
    Frames = "theorem-11",
    FramesDense = "theorem-11-prime",
    FramesCones = "theorem-11-cones",
    SurfacePoint = "surface-point",
    Theorem5Surface = "theorem-5-surface",
    TensorProduct = "tensor-product",
    ProductContraction = "product-contraction",
    NoLimit = "no-limit",
    Lemma3 = "lemma-3",
    Theorem7 = "theorem-7",
    Theorem8 = "theorem-8",
    Lemma4 = "lemma-4",
    Lemma4Prime = "lemma-4-prime",
    Theorem9 = "theorem-9",
    MeshVertex = "mesh-vertex",
    BorderVertex = "border-vertex",
    BorderJordan = "border-jordan",
    BorderOneFace = "border-one-face",
    BorderRefuted = "border-refuted",
    MeshSurface = "mesh-surface",
    CurvatureSize = "curvature-size",
    Theorem6 = "theorem-6",
    Theorem6Slow = "theorem-6-slow",
    Theorem6Polynomial = "theorem-6-polynomial",
    ConeExponent = "cone-exponent",
    Graph = "theorem-12",
    Components = "theorem-13",
    Radius = "radius",
    Smoothness = "smoothness",
    DifferencePolygons = "difference-polygons",
    TensorEveryPoint = "tensor-every-point",
    PatchDerivative = "patch-derivative",
    SurfaceCones = "surface-cones",
    VertexEveryPoint = "vertex-every-point",
    Theorem10 = "theorem-10",
    JunctionFamily = "junction",
    SurfaceJunction = "surface-junction",
    Refinement = "refinement",
    FamilyWords = "family-words",
    FamilyHulls = "family-hulls",
    FamilyCurves = "family-curves",
    ConeEnds = "cone-ends",
    TangentsJump = "tangents-jump",
    FamilyPlane = "family-plane",
    FamilyVertex = "family-vertex",
    LatticeMask = "lattice-mask",
    StableShifts = "stable-shifts",
    Border = "border",
}

impl Statement {
    /// Whether it is about frames.
    #[must_use]
    pub fn uses_frames(self) -> bool {
        matches!(self, Self::Frames | Self::FramesDense | Self::FramesCones)
    }

    /// Its number and name.
    #[must_use]
    pub fn name(self) -> &'static str {
        &self.text().name
    }

    /// Its name without what stands in brackets behind it.
    #[must_use]
    pub fn short_name(self) -> &'static str {
        let name = self.name();
        name.split_once(" (").map_or(name, |(short, _)| short)
    }

    /// The statement that a user means by `theorem-2`, `Theorem 2`, `2`, `lemma 1'`, `5″`.
    #[must_use]
    pub fn named(text: &str) -> Option<Self> {
        let wanted = key(text);
        let is = |s: &&Self| {
            let short = key(s.short_name());
            key(s.id()) == wanted || short == wanted || short.strip_prefix("theorem ") == Some(wanted.as_str())
        };
        Self::ALL.iter().find(is).copied()
    }

    /// The ids that resemble a text, the nearest first, at most five.
    #[must_use]
    pub fn near(text: &str) -> Vec<&'static str> {
        let wanted = key(text);
        let likeness = |s: &Self| {
            let (id, name) = (key(s.id()), key(s.name()));
            let inside = wanted.len() > 2 && (id.contains(&wanted) || name.contains(&wanted));
            (inside, strsim::jaro_winkler(&id, &wanted).max(strsim::jaro_winkler(&name, &wanted)))
        };
        let mut listed: Vec<((bool, f64), &'static str)> = Self::ALL.iter().map(|s| (likeness(s), s.id())).collect();
        listed.retain(|((inside, similar), _)| *inside || *similar > 0.75);
        listed.sort_by(|(a, _), (b, _)| b.0.cmp(&a.0).then(b.1.total_cmp(&a.1)));
        listed.into_iter().map(|(_, id)| id).take(5).collect()
    }

    /// Its file, read; the whole file as its body where the file is not as it should be, so that nothing is lost.
    fn read(self) -> Text {
        Text::read(self.source()).unwrap_or_else(|_| Text {
            name: self.id().to_owned(),
            hypotheses: Vec::new(),
            body: vec![self.source().to_owned()],
            proof: Vec::new(),
            reference: String::new(),
        })
    }
}

impl Text {
    /// Reads a file of `docs/statements`: a title, then the sections *Hypotheses* (a list of `- **name**: text`),
    /// *Statement*, *Proof* and *Reference*.
    ///
    /// # Errors
    /// What is missing or does not belong there.
    pub fn read(source: &str) -> Result<Self, String> {
        let mut sections = source.split("\n## ");
        let head = sections.next().ok_or("no title")?;
        let name = head.trim().strip_prefix("# ").ok_or("the first line is no title")?.to_owned();
        let mut next = |wanted: &str| -> Result<&str, String> {
            let section = sections.next().ok_or_else(|| format!("no section {wanted}"))?;
            section.strip_prefix(wanted).ok_or_else(|| format!("{wanted} is not where it should be"))
        };
        let listed = next("Hypotheses\n")?;
        let items = paragraphs(&listed.replace("\n- ", "\n\n- "));
        let hypotheses = items.iter().map(|item| hypothesis(item)).collect::<Result<Vec<_>, _>>()?;
        let (body, proof) = (paragraphs(next("Statement\n")?), paragraphs(next("Proof\n")?));
        let reference = paragraphs(next("Reference\n")?).join(" ");
        if let Some(more) = sections.next() {
            return Err(format!("nothing is known of the section {}", more.lines().next().unwrap_or("")));
        }
        if hypotheses.is_empty() || body.is_empty() || proof.is_empty() || reference.is_empty() {
            return Err("an empty section".to_owned());
        }
        Ok(Self { name, hypotheses, body, proof, reference })
    }
}

fn hypothesis(item: &str) -> Result<Hypothesis, String> {
    let parts = item.strip_prefix("- **").and_then(|rest| rest.split_once("**: "));
    let (name, text) = parts.ok_or_else(|| format!("no hypothesis: {item}"))?;
    Ok(Hypothesis { name: name.to_owned(), text: text.to_owned() })
}

/// The paragraphs of a text, each in one line.
fn paragraphs(text: &str) -> Vec<String> {
    let joined = text.trim().split("\n\n").map(|p| p.split_whitespace().collect::<Vec<_>>().join(" "));
    joined.filter(|p| !p.is_empty()).collect()
}

/// A name as it is compared: small letters, primes as signs, words apart by one space.
fn key(text: &str) -> String {
    let small = text.to_lowercase().replace(['″', '"'], "′′").replace('\'', "′");
    let spaced: String = small.chars().map(|c| if c.is_alphanumeric() || c == '′' { c } else { ' ' }).collect();
    spaced.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_file_is_read() {
        for s in Statement::ALL {
            let text = Text::read(s.source()).unwrap_or_else(|e| panic!("{}: {e}", s.id()));
            let names: BTreeSet<_> = text.hypotheses.iter().map(|h| &h.name).collect();
            assert_eq!(names.len(), text.hypotheses.len(), "{}: two hypotheses of one name", s.id());
        }
        assert!(Text::read("# A\n\n## Statement\n\nB.\n").is_err());
    }

    #[test]
    fn a_user_finds_a_statement() {
        for s in Statement::ALL {
            assert_eq!(Statement::named(s.id()), Some(*s));
            assert_eq!(Statement::named(s.short_name()), Some(*s), "{}", s.short_name());
        }
        for (text, wanted) in [
            ("2", Statement::Theorem2),
            ("5′", Statement::Theorem5Projected),
            ("Theorem 5''", Statement::Theorem5Surface),
            ("theorem 6'", Statement::Theorem6Slow),
            ("lemma 4′", Statement::Lemma4Prime),
            ("Lemma_1'", Statement::Lemma1Prime),
        ] {
            assert_eq!(Statement::named(text), Some(wanted), "{text}");
        }
        assert_eq!(Statement::named("theorem-99"), None);
        assert!(Statement::near("tensor").contains(&"tensor-product"));
        assert!(Statement::near("theorm-2").contains(&"theorem-2"));
        assert!(Statement::near("xyzzy").is_empty());
    }
}
