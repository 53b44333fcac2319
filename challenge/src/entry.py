"""An entry by `ibr diagnose`: answers every case of this folder and writes entry.csv.

    pip install ibr        # or from a checkout: pip install .
    python entry.py
"""

import csv
import pathlib

import ibr

with open("entry.csv", "w", newline="") as file:
    rows = csv.writer(file)
    rows.writerow(["case", "verdict", "names"])
    for case in sorted(pathlib.Path(".").glob("case-*")):
        found = ibr.diagnose(ibr.Scenario.named(case / "scenario.toml"), case)
        names = [name.replace(" + ", "+") for name in found.indistinguishable]
        is_effect = found.verdict == "effect"
        rows.writerow([case.name, found.verdict, " ".join(names) if is_effect else ""])
