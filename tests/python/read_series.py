"""Compares one table in three formats: python read_series.py table.csv table.npz table.parquet

NumPy and PyArrow read what they must read; every number must have the bits that the CSV's text stands for. Prints the
columns and the number of rows, one line of JSON, or fails naming the first difference.
"""

import csv
import json
import sys

import numpy
import pyarrow.parquet


def read_csv(path):
    with open(path, newline="") as file:
        names, *rows = csv.reader(file)
    return {name: numpy.array([float(row[n]) for row in rows]) for n, name in enumerate(names)}


def read_npz(path):
    with numpy.load(path, allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def read_parquet(path):
    table = pyarrow.parquet.read_table(path)
    return {name: table.column(name).to_numpy() for name in table.column_names}


def compare(kind, expected, found):
    # The order of columns is part of the table.
    if list(found) != list(expected):
        sys.exit(f"{kind}: columns {list(found)} instead of {list(expected)}")
    for name, numbers in expected.items():
        other = found[name]
        if other.dtype != numpy.float64 or other.shape != numbers.shape:
            sys.exit(f"{kind}: {name} is {other.dtype}{other.shape} instead of float64{numbers.shape}")
        different = numpy.flatnonzero(other.view(numpy.uint64) != numbers.view(numpy.uint64))
        if different.size:
            row = different[0]
            sys.exit(f"{kind}: {name} in row {row} is {other[row]!r} instead of {numbers[row]!r}")


def main():
    table, npz, parquet = sys.argv[1:]
    expected = read_csv(table)
    compare("npz", expected, read_npz(npz))
    compare("parquet", expected, read_parquet(parquet))
    print(json.dumps({"columns": list(expected), "rows": len(next(iter(expected.values())))}))


main()
