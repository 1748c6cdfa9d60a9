#!/usr/bin/env python3
"""Divides the sources of a test program into batches that compile as one.

    tests/batches.py SOURCE...

Prints, for each source that may share a batch, the name of the batch and the source. Sources of a batch
share their unnamed namespaces and their headers, so no two of them may define one name, nor one a name
of a header of tests/ that another includes. Which names a file defines is told from lines that begin in
the first column. Kernels that are compiled for several instruction sets
include themselves, and some libraries bring macros of their own: sources that include them stay alone.
"""

import re
import sys
from pathlib import Path

LARGEST = 16
ROOT = Path(__file__).parent.parent
ALONE = re.compile(r'#include .*(hwy/|-inl\.h|toml\+\+|OpenEXR/|Imf)')
NO_DEFINITION = re.compile(r"TEST|namespace|using \w+::|extern|return|[A-Z]+_|[#/} ]")
DEFINITION = re.compile(
    r"(?:template.*> )?(?:struct|class|enum class|enum|union) (\w+)"
    r"|using (\w+) ="
    r"|[\w:<>,&*\[\] ]+[&* ](\w+)(?:[({;\[]| =)")


def names_of(text):
    matches = (DEFINITION.match(line) for line in text.splitlines() if not NO_DEFINITION.match(line))
    return {name for match in matches if match for name in match.groups() if name}


def names_of_headers(text):
    headers = re.findall(r'#include "(tests/.*)"', text)
    return set().union(*(names_of((ROOT / header).read_text()) for header in headers))


def batches_of(sources):
    batches = []
    for source in sources:
        text = Path(source).read_text()
        if ALONE.search(text):
            continue
        own, headers = names_of(text), names_of_headers(text)
        for batch, taken, included in batches:
            if len(batch) < LARGEST and not taken & (own | headers) and not included & own:
                break
        else:
            batch, taken, included = [], set(), set()
            batches.append((batch, taken, included))
        batch.append(source)
        taken |= own
        included |= headers
    return [batch for batch, _, _ in batches]


for number, sources in enumerate(batches_of(sys.argv[1:])):
    for path in sources:
        print(f"batch_{number} {path}")
