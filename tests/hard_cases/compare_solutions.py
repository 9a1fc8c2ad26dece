#!/usr/bin/env python3
"""Compares the solutions.txt of folders (print_solutions.cpp) with that of the first: the largest difference of an
amplitude over the largest of its curve, by method, and where the numbers of solutions differ.

usage: compare_solutions.py FOLDER FOLDER …      exit 1: more than TOLERANCE, another number of solutions, or nothing compared
"""
import collections
import os
import sys

TOLERANCE = 1e-9


def read(folder):
    table = {}
    with open(os.path.join(folder, "solutions.txt"), encoding="ascii") as file:
        for line in file:
            scene, method, frequency, largest, *amplitudes = line.split()
            table[scene, method, frequency] = float(largest), [float(value) for value in amplitudes]
    return table


def compare(first, other):
    """Largest difference by method, numbers compared by method, places where other solutions are found."""
    worst, compared, places = collections.Counter(), collections.Counter(), []
    if first.keys() != other.keys():
        sys.exit("compare_solutions: not the same scenes and frequencies")
    for place, (largest, amplitudes) in first.items():
        others = other[place][1]
        if len(others) != len(amplitudes):
            places.append(f"{' '.join(place)}: {len(amplitudes)} and {len(others)} solutions")
            continue
        for one, two in zip(amplitudes, others):
            compared[place[1]] += 1
            worst[place[1]] = max(worst[place[1]], abs(one - two) / largest)
    return worst, compared, places


def main():
    folders = sys.argv[1:]
    first = read(folders[0])
    failed = False
    for folder in folders[1:]:
        worst, compared, places = compare(first, read(folder))
        for method in sorted({place[1] for place in first}):
            print(f"{os.path.basename(folders[0])} and {os.path.basename(folder)}, {method}: {compared[method]} solutions, "
                  f"largest difference {worst[method]:.1e}")
            failed |= worst[method] > TOLERANCE or compared[method] == 0
        for place in places:
            print(f"  {place}")
        failed |= bool(places)
    return 1 if failed or len(folders) < 2 else 0


if __name__ == "__main__":
    sys.exit(main())
