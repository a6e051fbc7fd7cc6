"""Proves, in exact arithmetic, where self-similar shapes have tangents.

>>> import secant
>>> secant.certify("four-point w=1/16").verdict
<Verdict.PROVED: 'proved'>
"""

from ._answers import JointRadius, Regularity, Solution, certify, check, jsr, regularity, solve
from ._errors import CertificateError, InputError, InternalError, SecantError
from ._executors import RayExecutor
from ._meshes import CertifiedMesh, MeshVertex
from ._numbers import Algebraic
from ._regions import RegionClaim, RegionOrder, RegionPart, Regions, RegionTable, RegionValence, region
from ._results import Certificate, Certified, Checked, Claim, Direction, Point, Verdict
from ._secant import version as __version__
from ._spectra import Eigenvalue, JordanForm, Spectrum, jordan_form, spectra, spectrum
from ._sweep import Folder, Row, iter_sweep, sweep

__all__ = [
    "Algebraic",
    "Certificate",
    "CertificateError",
    "Certified",
    "CertifiedMesh",
    "Checked",
    "Claim",
    "Direction",
    "Eigenvalue",
    "Folder",
    "InputError",
    "InternalError",
    "JointRadius",
    "JordanForm",
    "MeshVertex",
    "Point",
    "RayExecutor",
    "RegionClaim",
    "RegionOrder",
    "RegionPart",
    "RegionTable",
    "RegionValence",
    "Regions",
    "Regularity",
    "Row",
    "SecantError",
    "Solution",
    "Spectrum",
    "Verdict",
    "__version__",
    "certify",
    "check",
    "iter_sweep",
    "jordan_form",
    "jsr",
    "region",
    "regularity",
    "solve",
    "spectra",
    "spectrum",
    "sweep",
]
