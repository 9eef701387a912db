"""Fixtures of all tests."""

import json
import warnings
from pathlib import Path

import pytest

import mist

VECTORS = Path(__file__).parent / "vectors"


@pytest.fixture(autouse=True)
def quiet():
    """Warnings of models are tested where they are meant."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mist.MistWarning)
        yield


@pytest.fixture(scope="session")
def pyscatmech():
    """Recorded calls of NIST's package by their names."""
    return json.loads((VECTORS / "pyscatmech.json").read_text())
