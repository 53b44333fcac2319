#!/usr/bin/env bash
# The Parquet table of a sweep in DuckDB: means equal those of the CSV, empty cells are null, `trusted` is a boolean, and units, version
# and hashes are in the metadata.
# tests/foreign/duckdb.sh [IBR]
set -euo pipefail
. "$(dirname "$0")/common"
needs duckdb=2.0.1
cd "$work"
cat > study.toml << 'END'
kind = "sweep"
scenario = "fpam"
outputs = ["tip", "ledger", "limits"]
[[vary]]
key = "pressure_kpa"
values = [0, 5, 20, 200]
[[vary]]
key = "effects.tip_load.force_y_n"
values = [0, 1, 5, -20]
END
"$ibr" --quiet sweep study.toml --out csv > /dev/null
"$ibr" --quiet sweep study.toml --parquet --out parquet > /dev/null
check
