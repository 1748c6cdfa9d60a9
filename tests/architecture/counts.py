#!/usr/bin/env python3
"""Counts what the layout of the code is judged by, and prints a table of it.

    counts.py SOURCE          prints the table
    counts.py SOURCE --check  fails where a figure is worse than what the layout promises
"""

import pathlib
import re
import statistics
import sys
import tomllib

source = pathlib.Path(sys.argv[1])
PRODUCT = ("config", "bakers", "cli")
# A change of one asset's struct compiles at most so many units again, of the product and of tests.
MOST_PRODUCT_UNITS = 36
MOST_TEST_UNITS = 34
# The sections whose keys change most often, and the units of the product that a change of one of them
# compiles again. Headers declare their structs, and only who reads them includes them.
SECTIONS = ("noise", "cloud", "layer", "volume", "files")
MOST_SECTION_UNITS = 170
# A change that adds a feature gives as many lines back. Lower these where lines were saved. Published tables
# (*.inc) are data, as presets are, and do not count.
MOST_PRODUCT_LINES = 130_961
MOST_TEST_LINES = 72_826
MOST_HELPER_LINES = 17_973


def sources(*rooms):
    for room in rooms:
        for path in sorted((source / room).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path.relative_to(source).as_posix()


def includers(texts):
    """Which files include each file, itself or by another."""
    direct = {}
    for name, text in texts.items():
        for included in re.findall(r'^#include "([^"]+)"', text, re.M):
            direct.setdefault(included, set()).add(name)

    def of(name):
        found, open_ = set(), [name]
        while open_:
            for user in direct.get(open_.pop(), ()):
                if user not in found:
                    found.add(user)
                    open_.append(user)
        return found

    return of


# Of C++, what no brace or semicolon counts in: comments, strings, characters, preprocessing.
NO_CODE = re.compile(r'//[^\n]*|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'
                     r"|(?<!\w)'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.S | re.M)
IS_SCOPE = re.compile(r"(?:inline\s+)?namespace\b|(?:template\s*<.*>\s*)?(?:struct|class|enum|union)\b[^()]*$",
                      re.S)
IS_FUNCTION = re.compile(r"\)\s*(?:const|noexcept|override|->[^{]*|\s)*$|\)\s*:\s.*$", re.S)
IS_TEST = re.compile(r"(?:TEST|TEST_F|TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\s*\(")


def helper_lines(text):
    """The lines of the functions that are no test."""
    code = NO_CODE.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)
    count, open_, last = 0, [], 0
    for match in re.finditer("[{};]", code):
        inside = any(kind != "scope" for kind, _ in open_)
        if match.group() == "{":
            head = code[last:match.start()].strip()
            kind = "scope" if not inside and IS_SCOPE.match(head) else "other"
            if not inside and kind == "other" and IS_FUNCTION.search(head):
                kind = "test" if IS_TEST.match(head) else "function"
            open_.append((kind, last + re.search(r"\S|$", code[last:]).start()))
            last = match.end() if kind == "scope" else last
        elif match.group() == "}" and open_:
            kind, begin = open_.pop()
            count += code.count("\n", begin, match.end()) + 1 if kind == "function" else 0
            last = match.end() if kind != "other" or not open_ else last
        elif not inside:
            last = match.end()
    return count


texts = {name: (source / name).read_text() for name in sources(*PRODUCT, "tests")}
product = [name for name in texts if not name.startswith("tests/")]
lines = {name: texts[name].count("\n") for name in product}
product_lines = sum(lines.values())
tests = [name for name in texts if name.startswith("tests/")]
test_lines = sum(texts[name].count("\n") for name in tests)
helpers = sum(helper_lines(texts[name]) for name in tests)
folders = {}
for name in product:
    folder = name.rsplit("/", 1)[0]
    folders[folder] = folders.get(folder, 0) + 1
largest = max(folders, key=folders.get)

of = includers(texts)
assets = re.findall(r'#include "(config/assets/(?!asset\.h)\w+)\.h"', texts["config/assets/assets.h"])
recompiled = {}
for asset in assets:
    units = [name for name in of(asset + ".h") if name.endswith(".cpp")]
    tests = sum(name.startswith("tests/") for name in units)
    recompiled[asset.rsplit("/", 1)[1]] = (len(units) - tests, tests)
of_section = {section: sum(name.endswith(".cpp") and not name.startswith("tests/")
                           for name in of(f"config/sections/{section}.h")) for section in SECTIONS}
worst_product = max(recompiled, key=lambda name: recompiled[name][0])
worst_tests = max(recompiled, key=lambda name: recompiled[name][1])

# GLM's vectors serve: nobody writes a type of vectors of three again.
OWN_VECTOR = re.compile(r"^ *(?:struct|class) Vector(?:3\w*)? *\{"
                        r"|^ *using \w*(?:Vector|Direction)\w* = std::array<double, 3>", re.M)
own_vectors = [name for name in product if OWN_VECTOR.search(texts[name])]

# A kernel's numbers are lanes of many items (lanes-inl.h), the channels of one spectrum
# (channels-inl.h), or blocks of azimuthal orders times channels, which light's transport alone has
# (transport_kernel.cpp); the rest is Highway as it comes. Whoever wraps a vector again writes a
# fourth kind.
OWN_LANES = re.compile(r"^ *hn::Vec<\w+> \w+(?:\[\w+\])?;|vector_size\(", re.M)
MOST_KINDS_OF_LANES = 3
own_lanes = [name for name in product if OWN_LANES.search(texts[name])]

# Every code of a message is explained.
explained = tomllib.loads((source / "config/diagnostics/codes.toml").read_text())
unexplained = sorted({code for name in product for code in re.findall(r'"([EW]0\d{3})"', texts[name])}
                     - explained.keys())

rows = [
    ("assets", str(len(assets))),
    ("product files", str(len(product))),
    ("lines of the median file", f"{statistics.median(lines.values()):.0f}"),
    ("files of the largest folder", f"{folders[largest]} ({largest})"),
    ("product lines", str(product_lines)),
    ("lines of C++ in tests", str(test_lines)),
    ("… of functions that are no test", str(helpers)),
    ("units compiled again after a change of an asset's struct: product",
     f"{recompiled[worst_product][0]} ({worst_product})"),
    ("… tests", f"{recompiled[worst_tests][1]} ({worst_tests})"),
    ("units compiled again after a change of a section's struct: product",
     ", ".join(f"{units} ({section})" for section, units in of_section.items())),
    ("files with a vector type of their own", str(len(own_vectors))),
    ("kinds of vectors of a processor", str(len(own_lanes))),
]
for what, count in rows:
    print(f"{what:66} {count}")

if "--check" in sys.argv:
    failures = [name for name, (units, tests) in recompiled.items()
                if units > MOST_PRODUCT_UNITS or tests > MOST_TEST_UNITS]
    for name in failures:
        print(f"{name}: {recompiled[name]} units are compiled again, and "
              f"{MOST_PRODUCT_UNITS} and {MOST_TEST_UNITS} are allowed")
    wide = [name for name, units in of_section.items()
            if not 0 < units <= MOST_SECTION_UNITS]
    for name in wide:
        print(f"config/sections/{name}.h: {of_section[name]} units are compiled again, and "
              f"{MOST_SECTION_UNITS} are allowed")
    for name in own_vectors:
        print(f"{name}: has a type of vectors of its own; bakers/math/vectors.h has GLM's")
    for code in unexplained:
        print(f"{code}: config/diagnostics/codes.toml says nothing of it")
    if len(own_lanes) > MOST_KINDS_OF_LANES:
        print(f"{', '.join(own_lanes)}: lanes-inl.h and channels-inl.h of bakers/math serve")
    sizes = [("the product has", product_lines, MOST_PRODUCT_LINES),
             ("tests have", test_lines, MOST_TEST_LINES),
             ("functions of tests that are no test have", helpers, MOST_HELPER_LINES)]
    too_long = [size for size in sizes if size[1] > size[2]]
    for what, found, most in too_long:
        print(f"{what} {found} lines, and {most} are allowed")
    too_many = len(own_lanes) > MOST_KINDS_OF_LANES or too_long
    sys.exit(1 if failures or wide or own_vectors or unexplained or too_many or len(assets) < 11 else 0)
