from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def cases() -> Path:
    return Path(__file__).parents[2] / "cases"
