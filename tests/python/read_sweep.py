"""Reads the table of a sweep with Apache Arrow's own reader of Parquet.

    python read_sweep.py FOLDER

The folder has what `afpc sweep -o FOLDER/` writes. The Parquet file must say what the CSV file says,
cell by cell and to the last bit, in types that need no conversion. No code of the project takes part.
"""

import csv
import sys
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

COUNTS = ["run", "seed", "collisions", "interruptions", "deadline_misses"]
WALL = ["wall_error_judged_s", "wall_error_max_m", "wall_error_mean_m"]
NUMBERS = ["walldist_si", "time_s", "distance_m", "contacts_s", *WALL, "took_s"]
TEXTS = ["world", "walldist", "ending", "where", "why", "touched", "trace", "command"]
TYPES = (
    dict.fromkeys(COUNTS, pa.uint64())
    | dict.fromkeys(NUMBERS, pa.float64())
    | dict.fromkeys(TEXTS, pa.string())
)


def main(folder):
    table = pq.read_table(folder / "outcomes.parquet")
    types = {field.name: field.type for field in table.schema}
    assert types == TYPES, types
    with open(folder / "outcomes.csv", newline="", encoding="utf-8") as file:
        written = list(csv.DictReader(file))
    assert len(written) == table.num_rows > 1, (len(written), table.num_rows)
    assert list(written[0]) == table.column_names, table.column_names
    for line, row in zip(written, table.to_pylist()):
        for name, value in row.items():
            assert read(line[name], types[name]) == value, (name, line[name], value)
    gaps = table.column("wall_error_mean_m").null_count
    assert 0 < gaps < table.num_rows, f"{gaps} runs without a wall: the test shows nothing"
    print(f"{table.num_rows} runs, {table.num_columns} columns: Parquet and CSV say the same")


def read(text, kind):
    if pa.types.is_uint64(kind):
        return int(text)
    if pa.types.is_float64(kind):
        return float(text) if text else None
    return text


if __name__ == "__main__":
    main(Path(sys.argv[1]))
