"""csv/table.csv and parquet/table.parquet of one sweep, read by DuckDB."""

import sys

# This file has the name of the package that it uses.
sys.path.pop(0)
import duckdb  # noqa: E402

CSV, PARQUET = "read_csv('csv/table.csv')", "'parquet/table.parquet'"


def one(query):
    return duckdb.sql(query).fetchall()[0][0]


rows = one(f"select count(*) from {PARQUET}")
assert rows == one(f"select count(*) from {CSV}") == 16
empty = 0
for name in ["tip_x_mm", "tip_y_mm", "tip_angle_deg", "actuator_gas_mj", "wall_mj"]:
    mean, same = one(f"select avg({name}) from {PARQUET}"), one(f"select avg({name}) from {CSV}")
    assert abs(mean - same) <= 1e-12 * abs(same), (name, mean, same)
    missing, same = one(f"select count(*) - count({name}) from {PARQUET}"), one(f"select count(*) - count({name}) from {CSV}")
    assert missing == same, (name, missing, same)
    empty += missing
    print(f"{name}: mean {mean:.6g} in both, {missing} null")
assert empty > 0, "no case failed: the study does not test empty cells"
assert one(f"select typeof(trusted) from {PARQUET} limit 1") == "BOOLEAN"
about = {bytes(key).decode(): bytes(value).decode() for key, value in
         duckdb.sql("select key, value from parquet_kv_metadata('parquet/table.parquet')").fetchall()}
assert about["unit.tip_y_mm"] == "mm" and about["ibr.program"].startswith("ibr ") and len(about["ibr.sha256.study.toml"]) == 64, about
print(f"metadata: {about['ibr.program']}, {sum(key.startswith('unit.') for key in about)} units")
