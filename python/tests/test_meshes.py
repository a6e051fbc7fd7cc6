import pickle

import pytest

import secant

TETRAHEDRON = {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, "1.5"]], "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}


def test_an_octahedron(cases, tmp_path):
    found = secant.certify(cases / "meshes" / "octahedron.obj", scheme="loop")
    assert found.proved and found.smooth == "proved" and len(found.vertices) == 6 and not found.bad
    first = found.vertices[0]
    assert first.valence == 4 and first.line == 2 and first.point_exact == ("24/55", "0", "0") and first.normal == (1, 0, 0)
    again = pickle.loads(pickle.dumps(found))
    assert again.to_dict() == found.to_dict() and again.svg == found.svg and again.report() == found.report()
    found.ply(tmp_path / "o.ply")
    found.report(tmp_path / "o.html")
    assert (tmp_path / "o.ply").read_text().startswith("ply") and "<svg" in found._repr_html_() and "valence" in str(found)
    with pytest.raises(secant.CertificateError):
        found.certificate
    with pytest.raises(TypeError):
        bool(found)


def test_bad_vertices_have_their_lines(cases):
    found = secant.certify(cases / "meshes" / "line.obj", scheme="loop")
    assert found.verdict == "refuted" and [v.line for v in found.bad] == [2, 3, 4, 5, 6, 7]
    assert all(v.verdict == "refuted" and "line" in v.reason for v in found.bad) and found.patches["bad"]


def test_arrays():
    found = secant.certify(TETRAHEDRON, scheme="loop")
    assert found.proved and found.closed and [v.valence for v in found.vertices] == [3] * 4
    np = pytest.importorskip("numpy")
    floats = {"points": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.5]]), "faces": np.array(TETRAHEDRON["faces"])}
    with pytest.raises(secant.InputError, match="float"):
        secant.certify(floats, scheme="loop")
    for exact in ("decimal", "binary"):
        same = secant.certify(floats, scheme="loop", exact=exact)
        assert [v.point_exact for v in same.vertices] == [v.point_exact for v in found.vertices]


@pytest.mark.parametrize("change", [
    {"points": [["1/3", 0, 0]]}, {"points": []}, {"points": [[0, 0]] * 4}, {"faces": [[0, 1, 9]]}, {"faces": [[0, 1, -1]]},
    {"faces": [[0, 1, 0.5]]}, {"faces": [["a"]]}, {"faces": [[0, 1, 2, 3]]}, {"faces": []},
])
def test_wrong_meshes(change):
    with pytest.raises(secant.InputError):
        secant.certify({**TETRAHEDRON, **change}, scheme="loop")


def test_wrong_questions(cases, tmp_path):
    octahedron = cases / "meshes" / "octahedron.obj"
    for options in ({}, {"scheme": "butterfly"}, {"scheme": "loop", "at": "(0)"}, {"scheme": "loop", "effort": "huge"}):
        with pytest.raises(secant.InputError) as caught:
            secant.certify(octahedron, **options)
        assert caught.value.help
    with pytest.raises(secant.InputError, match="mesh"):
        secant.certify("four-point", scheme="loop")
    with pytest.raises(secant.InputError):
        secant.certify(tmp_path / "none.obj", scheme="loop")
    (tmp_path / "torn.obj").write_text("v 0 0 0\nv 1 0 0\nf 1 2 9\n")
    with pytest.raises(secant.InputError) as caught:
        secant.certify(tmp_path / "torn.obj", scheme="loop")
    assert caught.value.line == 3


def test_a_sweep_of_meshes(cases, tmp_path):
    paths = [cases / "meshes" / f"{n}.obj" for n in ("octahedron", "line", "cube")]
    rows = list(secant.iter_sweep(paths, workers=0, folder=tmp_path, scheme="loop"))
    assert [r.verdict for r in rows] == ["proved", "refuted", None] and "cube.obj:10" in rows[2].error.message
    again = list(secant.iter_sweep(paths, workers=0, folder=tmp_path, scheme="loop"))
    assert all(r.kept for r in again[:2]) and again[1].result.bad[0].line == 2
