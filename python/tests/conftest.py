"""What the tests share: the command that the package is compared with."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def told():
    """JSON of the command `ibr`, built beside the package."""
    program = os.environ.get("IBR", str(ROOT / "target/release/ibr"))

    def run(*typed):
        made = subprocess.run([program, *typed, "--json"], capture_output=True, text=True)
        assert made.returncode == 0, made.stderr
        return json.loads(made.stdout)

    return run
