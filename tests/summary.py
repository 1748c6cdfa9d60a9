#!/usr/bin/env python3
"""What a run of the tests took, and what it did not test.

    ctest --test-dir BUILD ... --output-junit RESULTS
    tests/summary.py BUILD RESULTS [STEP WALL_SECONDS PROCESSOR_SECONDS]...
    tests/summary.py --failed RESULTS   prints which tests failed, and the last lines of each

Prints the time of each label and of each folder of tests/, the slowest tests, the steps of the run, and
last, so that nobody overlooks it, every test that was skipped or left out, with the reason that it
gave. Ends with 1 if the second tier names a test that is none, or if --failed finds none that failed.
"""

import json
import re
import subprocess
import sys
import xml.etree.ElementTree as xml
from collections import defaultdict
from pathlib import Path

SLOWEST = 20
LAST_LINES = 25  # of a test that failed
BUDGET = 600  # seconds of the first tier on two idle cores
SECOND_TIER = Path(__file__).parent / "second_tier/label.cmake"
# Finds what tests say of what they leave out: scripts of all or of a part, GoogleTest in the next line.
REASON = re.compile(r"^(.*(?:skipped: |not tested).*|(?<=: Skipped\n).*)$", re.M)


class Test:
    """A test as CTest knows it."""

    def __init__(self, name, properties):
        self.name = name
        folders = Path(properties.get("WORKING_DIRECTORY", "")).parts
        self.room = folders[folders.index("tests") + 1] if "tests" in folders[:-1] else "tests"
        # The folder is a label, too, but it has a table of its own.
        self.labels = [label for label in properties.get("LABELS", []) if label != self.room]


def known_tests(build):
    text = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"],
                          stdout=subprocess.PIPE, text=True, check=True).stdout
    tests = {}
    for entry in json.loads(text)["tests"]:
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        tests[entry["name"]] = Test(entry["name"], properties)
    return tests


class Result:
    """What became of a test in the run."""

    def __init__(self, case):
        self.name = case.get("name")
        self.seconds = float(case.get("time"))
        self.skipped = case.get("status") in ("notrun", "disabled")
        self.failed = case.get("status") == "fail"
        self.output = output = case.findtext("system-out") or ""
        self.reasons = [reason.strip() for reason in REASON.findall(output)]
        if self.skipped and not self.reasons:
            skipped = case.find("skipped")
            self.reasons = [case.get("status") if skipped is None else skipped.get("message")]


def table(title, rows):
    """Rows of a name, a number of tests and seconds, the longest first."""
    lines = [f"\n{title:<24}{'tests':>8}{'seconds':>10}"]
    for name, (count, seconds) in sorted(rows.items(), key=lambda row: -row[1][1]):
        lines.append(f"{name:<24}{count:>8}{seconds:>10.1f}")
    return lines


def times(tests, results):
    labels, rooms = defaultdict(lambda: (0, 0.0)), defaultdict(lambda: (0, 0.0))
    for result in results:
        test = tests.get(result.name) or Test(result.name, {})
        for rows, names in ((labels, test.labels or ["(no label)"]), (rooms, [test.room])):
            for name in names:
                rows[name] = (rows[name][0] + 1, rows[name][1] + result.seconds)
    return table("label", labels) + table("folder", rooms)


def slowest(results):
    lines = ["\nthe slowest tests, in seconds"]
    for result in sorted(results, key=lambda r: -r.seconds)[:SLOWEST]:
        lines.append(f"{result.seconds:>8.1f}  {result.name}")
    return lines


def steps_table(words):
    """The steps of a run, and their sum beside the budget of the first tier."""
    if not words:
        return []
    steps = [(name, int(wall), int(cores)) for name, wall, cores in zip(*[iter(words)] * 3)]
    sums = ("sum", sum(step[1] for step in steps), sum(step[2] for step in steps))
    lines = [f"\n{'step':<24}{'seconds':>8}{'of all cores':>14}"]
    lines += [f"{name:<24}{wall:>8}{cores:>14}" for name, wall, cores in [*steps, sums]]
    return lines + [f"{'budget, two idle cores':<24}{BUDGET:>8}{2 * BUDGET:>14}"]


def unknown_in_second_tier(tests):
    names = re.findall(r"^    (\S+)$", SECOND_TIER.read_text(), re.M)
    return [name for name in names if name not in tests]


def not_tested(tests, results):
    lines = []
    for result in results:
        what = "skipped" if result.skipped else "left out in part"
        lines += [f"  {what}: {result.name}: {reason}" for reason in result.reasons]
    run = {result.name for result in results}
    left_out = defaultdict(list)
    for test in tests.values():
        if test.name not in run:
            left_out[" and ".join(test.labels) or "no label"].append(test.name)
    for label, names in sorted(left_out.items()):
        lines.append(f"  left out, with the label {label}: {len(names)} tests")
        lines += [f"    {name}" for name in sorted(names)]
    if not lines:
        return ["\nEvery test was run, and none was skipped."]
    return ["\n" + "=" * 100, "THIS RUN DID NOT TEST EVERYTHING:", *lines, "=" * 100]


def failures(results):
    lines = []
    for result in (result for result in results if result.failed):
        lines += [f"failed: {result.name}", *result.output.splitlines()[-LAST_LINES:]]
    return lines


def main():
    build, path, *steps = sys.argv[1:]
    results = [Result(case) for case in xml.parse(path).getroot().iter("testcase")]
    if build == "--failed":
        failed = failures(results)
        print("\n".join(failed))
        return 0 if failed else 1
    tests = known_tests(build)
    print("\n".join(times(tests, results) + slowest(results) + steps_table(steps)
                    + not_tested(tests, results)))
    unknown = unknown_in_second_tier(tests)
    for name in unknown:
        print(f"{SECOND_TIER}: there is no test {name}")
    return 1 if unknown else 0


if __name__ == "__main__":
    sys.exit(main())
