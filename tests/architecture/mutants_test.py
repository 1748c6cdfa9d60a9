#!/usr/bin/env python3
"""Whether tests/mutants.py tells mutants that a test kills from those that live and those that no test
runs, in a project of two sources that are compiled as one, and two tests.

    mutants_test.py SOURCE
"""

import subprocess
import sys
import tempfile
from pathlib import Path

SUMS = """\
int sum(int a, int b) {
    // a - b, a < b: no code
    return a + b;
}

bool is_less(int a, int b) {
    int first = 0 + a;
    first += 1;
    return first < b + 1;
}

int unused(int a) { return a - 1; }
"""
TESTS = """\
#include <gtest/gtest.h>
int sum(int a, int b);
int product(int a, int b);
bool is_less(int a, int b);
TEST(Sum, IsTheSum) { EXPECT_EQ(product(sum(2, 3), 2), 10); }
TEST(Less, IsTheOrder) { EXPECT_TRUE(is_less(1, 2)); }
"""
NINJA = """\
rule CXX_COMPILER__all_Release
  command = c++ -O0 -c $in -o $out
rule CXX_EXECUTABLE_LINKER__sums_tests_Release
  command = : && c++ tests/tests.o -o tests/sums_tests libsums.a -lgtest_main -lgtest -lpthread && :
rule AR
  command = rm -f $out && ar crs $out $in
build Unity/unity_0.cxx.o: CXX_COMPILER__all_Release Unity/unity_0.cxx
build tests/tests.o: CXX_COMPILER__all_Release tests.cpp
build libsums.a: AR Unity/unity_0.cxx.o
build tests/sums_tests: CXX_EXECUTABLE_LINKER__sums_tests_Release tests/tests.o libsums.a
"""
WANTED = """\
| line | kind | mutant | |
|---|---|---|---|
| 3 | sign | `+` → `-` | Sum.IsTheSum |
| 7 | off by one | `0` → `(0 + 1)` | Less.IsTheOrder |
| 7 | sign | `+` → `-` | lived |
| 8 | removed line | `first += 1;` | lived |
| 8 | sign | `+=` → `-=` | lived |
| 8 | off by one | `1` → `(1 + 1)` | Less.IsTheOrder |
| 9 | comparison | `<` → `<=` | lived |
| 9 | sign | `+` → `-` | Less.IsTheOrder |
| 9 | off by one | `1` → `(1 + 1)` | lived |
| 12 | sign | `-` → `+` | not run |
| 12 | off by one | `1` → `(1 + 1)` | not run |
"""


def main():
    tool = Path(sys.argv[1]) / "tests/mutants.py"
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch).resolve()
        for name in ("Unity", "tests"):
            (folder / name).mkdir()
        (folder / "sums.cpp").write_text(SUMS)
        (folder / "products.cpp").write_text("int product(int a, int b) { return a * b; }\n")
        (folder / "Unity/unity_0.cxx").write_text(
            f'#include "{folder}/sums.cpp"\n#include "{folder}/products.cpp"\n')
        (folder / "tests.cpp").write_text(TESTS)
        (folder / "build.ninja").write_text(NINJA)
        subprocess.run(["ninja", "-C", str(folder), "--quiet"], check=True)
        done = subprocess.run([sys.executable, str(tool), str(folder), str(folder / "sums.cpp"), "sums_tests"],
                              stdout=subprocess.PIPE, text=True, check=False)
        table = done.stdout.split("\n\n")[0] + "\n"
        if table != WANTED or done.returncode != 1:
            sys.exit(f"ended with {done.returncode}, and printed\n{done.stdout}\nin the place of\n{WANTED}")
        # A test that knows the order of equal numbers kills what lived.
        more = TESTS + "TEST(Less, IsStrict) { EXPECT_FALSE(is_less(2, 2)); }\n"
        (folder / "tests.cpp").write_text(more)
        subprocess.run(["ninja", "-C", str(folder), "--quiet"], check=True)
        done = subprocess.run([sys.executable, str(tool), str(folder), str(folder / "sums.cpp"),
                               "sums_tests:Less.*", "--lines", "9-9", "--kinds", "comparison"],
                              stdout=subprocess.PIPE, text=True, check=False)
        if "| 9 | comparison | `<` → `<=` | Less.IsStrict |" not in done.stdout or done.returncode != 0:
            sys.exit(f"ended with {done.returncode}, and printed\n{done.stdout}")
    print("the tool tells which mutants are killed, which live and which are not run")


if __name__ == "__main__":
    main()
