#!/usr/bin/env python3
"""Divides the sources of a test program into batches that compile as one.

    tests/batches.py SOURCE...

Prints, for each source that may share a batch, the name of the batch and the source. Sources of a batch
share their unnamed namespaces, so no two of them may define one name; which names a source defines is
told from lines that begin in the first column. Kernels that are compiled for several instruction sets
include themselves, and some libraries bring macros of their own: sources that include them stay alone.
"""

import re
import sys
from pathlib import Path

LARGEST = 16
ALONE = re.compile(r'#include .*(hwy/|-inl\.h|CLI/|toml\+\+|OpenEXR/|Imf)')
NO_DEFINITION = re.compile(r"TEST|namespace|using \w+::|extern|return|[A-Z]+_|[#/} ]")
DEFINITION = re.compile(
    r"(?:template.*> )?(?:struct|class|enum class|enum|union) (\w+)"
    r"|using (\w+) ="
    r"|[\w:<>,&*\[\] ]+[&* ](\w+)(?:[({;\[]| =)")


def names_of(text):
    matches = (DEFINITION.match(line) for line in text.splitlines() if not NO_DEFINITION.match(line))
    return {name for match in matches if match for name in match.groups() if name}


def batches_of(sources):
    batches = []
    for source in sources:
        text = Path(source).read_text()
        if ALONE.search(text):
            continue
        names = names_of(text)
        for batch, taken in batches:
            if len(batch) < LARGEST and not taken & names:
                break
        else:
            batch, taken = [], set()
            batches.append((batch, taken))
        batch.append(source)
        taken |= names
    return [batch for batch, _ in batches]


for number, sources in enumerate(batches_of(sys.argv[1:])):
    for path in sources:
        print(f"batch_{number} {path}")
