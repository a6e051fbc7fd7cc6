import doctest
import importlib
import inspect

import pytest

import secant

MODULES = ["secant", "secant._answers", "secant._meshes", "secant._numbers", "secant._regions", "secant._results", "secant._spectra", "secant._sweep"]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings(name):
    module = importlib.import_module(name)
    failed, _ = doctest.testmod(module)
    assert failed == 0


def test_everything_public_is_documented():
    for name in secant.__all__:
        thing = getattr(secant, name)
        if name.startswith("__"):
            continue
        assert inspect.getdoc(thing), name
        if inspect.isfunction(thing):
            for parameter in inspect.signature(thing).parameters.values():
                assert parameter.name.lstrip("*") in (thing.__doc__ or ""), (name, parameter.name)


def test_stubs_name_what_there_is():
    from pathlib import Path

    from secant import _secant

    stub = (Path(secant.__file__).parent / "_secant.pyi").read_text()
    there = {n for n in dir(_secant) if not n.startswith("_")}
    named = {line.split("(")[0].split(":")[0].split()[-1] for line in stub.splitlines() if line.startswith(("def ", "class "))}
    assert named | {"version"} == there
