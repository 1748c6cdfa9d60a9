#!/usr/bin/env python3
"""Which tests see that a source is wrong.

    tests/mutants.py BUILD FILE TEST[:FILTER]... [--lines FIRST-LAST] [--kinds a,b] [--most N]

Plants one small fault after the other into FILE: a sign, an offset by one, one per cent, an exchanged
axis or channel, a comparison, a bound, a removed line. Each mutant is compiled alone, linked before the
project's libraries, and each TEST (the target of a program of GoogleTest, with a filter of its cases) is
run up to its first failure. Prints a table: the line, the mutant, and the case that killed it, `lived`,
or `not run` where no case ran the line. Mutants that do not compile are left out. Ends with 1 if any
lived. BUILD holds a build by Ninja and GCC, in which the tests pass and are up to date.

A mutant may be equivalent: it changes no result. Whoever reads the table judges that.
"""

import argparse
import json
import re
import resource
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

NUMBER = r"(?<![\w.])"
# A kind of fault, the code that it takes the place of, and what stands there then.
FAULTS = [
    ("sign", r" \+ (?!\+)", " - "), ("sign", r" - ", " + "), ("sign", r" \+= ", " -= "),
    ("sign", r" -= ", " += "), ("sign", r"(?<=[(,=?:] )-(?=\w)|(?<=\()-(?=\w)|(?<=return )-(?=\w)", ""),
    ("factor", r" \* ", " / "), ("factor", r" / ", " * "),
    ("one per cent", NUMBER + r"(\d+\.\d*(?:e-?\d+)?|\d+e-?\d+)(?![\w.])", r"(1.01 * \1)"),
    ("off by one", NUMBER + r"(\d+)(?![\w.'])", r"(\1 + 1)"),
    ("axis", r"\.x\b", ".y"), ("axis", r"\.y\b", ".x"), ("axis", r"\.z\b", ".x"),
    ("channel", r"(?<=\w)\[(?!0\])[^][]+\]", "[0]"), ("channel", r"\w+(?:\.\w+)? % (?=\w)", "0 % "),
    ("comparison", r" < ", " <= "), ("comparison", r" <= ", " < "), ("comparison", r" > ", " >= "),
    ("comparison", r" >= ", " > "), ("comparison", r" == ", " != "), ("comparison", r" != ", " == "),
    ("condition", r" && ", " || "), ("condition", r" \|\| ", " && "),
    ("bound", r"\b(std::f?)min\(", r"\1max("), ("bound", r"\b(std::f?)max\(", r"\1min("),
    ("one sided", r"std::f?abs\(", "("),
]
STATEMENT = re.compile(r"^\s+(?=[\w(*])(?!\s|return|const |using |break|continue|auto |static|case ).*;$")
# Processor time of a mutant over that of the right program, above which it is said to hang.
PATIENCE = 10


def masked(text):
    """The text with comments and strings blanked out, at the same places."""
    hidden = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^#[^\n]*', re.S | re.M)
    return hidden.sub(lambda found: re.sub(r"[^\n]", "~", found.group()), text)


def mutants_of(text):
    """(line, kind, before, after, changed text) of each mutant, from the first line on."""
    code, found = masked(text), []
    for kind, pattern, replacement in FAULTS:
        for at in re.finditer(pattern, code):
            after = at.expand(replacement)
            found.append((at.start(), kind, at.group(), after, text[:at.start()] + after + text[at.end():]))
    start, before = 0, ";"
    for line in code.splitlines(keepends=True):
        words = line.rstrip()
        if STATEMENT.match(words) and before.endswith((";", "{", "}", ":", "~")):
            end = start + len(words)
            kept = ";" if re.match(r"\s+(if|for|while) ", words) else ""
            found.append((start, "removed line", words.strip(), kept, text[:start] + kept + text[end:]))
        start, before = start + len(line), words or before
    found.sort(key=lambda mutant: mutant[0])
    return [(code.count("\n", 0, at) + 1, *rest) for at, *rest in found]


class Build:
    """How Ninja compiles and links, and how mutants replace what it would have made."""

    def __init__(self, folder, source, scratch):
        self.folder, self.source, self.scratch = Path(folder), Path(source).resolve(), Path(scratch)
        commands = json.loads(self.ninja("-t", "compdb"))
        for entry in commands:
            file = self.folder / entry["file"]
            if not entry["file"].endswith((".cpp", ".cxx")) or not entry["output"].endswith(".o"):
                continue
            if file.resolve() == self.source:
                break
            if "Unity" in entry["file"] and file.exists() and f'"{self.source}"' in file.read_text():
                break
        else:
            sys.exit(f"{self.folder} compiles no {source}")
        self.input, self.output, self.command = entry["file"], entry["output"], entry["command"]
        self.neighbours = self.compile_neighbours()

    def ninja(self, *words):
        return subprocess.run(["ninja", "-C", str(self.folder), "--quiet", *words],
                              stdout=subprocess.PIPE, text=True, check=True).stdout

    def compile(self, source, output, flags=()):
        """Compiles a file as Ninja compiles FILE; false if that fails."""
        words = shlex.split(self.command)
        # The mutant's folder comes first, so that a file that includes itself finds the mutant.
        words = [str(source) if word == self.input else str(output) if word == self.output else word
                 for word in words if word not in ("-Werror", "-MD")]
        for flag in ("-MT", "-MF"):
            if flag in words:
                del words[words.index(flag):words.index(flag) + 2]
        return subprocess.run([*words, "-w", *flags], cwd=self.folder, stderr=subprocess.DEVNULL,
                              check=False).returncode == 0

    def compile_neighbours(self):
        """The object of the sources that FILE is compiled together with, without it."""
        file = self.folder / self.input
        if file.resolve() == self.source:
            return []
        rest = self.scratch / "neighbours.cpp"
        rest.write_text("".join(line for line in file.read_text().splitlines(keepends=True)
                                if str(self.source) not in line))
        if not self.compile(rest, self.scratch / "neighbours.o"):
            sys.exit(f"{file} does not compile without {self.source}")
        return [str(self.scratch / "neighbours.o")]

    def link(self, target, program, objects, flags=()):
        paths = re.findall(rf"^([^/\n]\S*/{target}): \w+_EXECUTABLE_LINKER_", self.ninja("-t", "targets", "all"),
                           re.M)
        if not paths:
            sys.exit(f"{self.folder} builds no program {target}")
        path = paths[0]
        command = self.ninja("-t", "commands", "-s", path)
        words = shlex.split(next(part for part in command.split(" && ") if f" -o {path} " in part))
        at = words.index("-o")
        words[at + 1] = str(program)
        words = [word for word in words if word != self.output]
        words[at:at] = [*objects, *self.neighbours]
        subprocess.run([*words, *flags], cwd=self.folder, check=True)


def run(program, case_filter, seconds=resource.RLIM_INFINITY):
    """The case that failed first, or None; and the processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    done = subprocess.run([program, "--gtest_fail_fast", "--gtest_brief=0", f"--gtest_filter={case_filter}"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          preexec_fn=limit, check=False)
    spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if done.returncode == 0:
        return None, spent
    cases = re.findall(r"^\[ +(?:FAILED|RUN) +\] ([\w./]+)", done.stdout, re.M)
    failed = re.findall(r"^\[  FAILED  \] ([\w./]+)", done.stdout, re.M)
    how = "" if failed else " (hangs)" if spent > 0.9 * seconds else " (crashes)"
    return (failed or cases[-1:] or ["before the first case"])[0] + how, spent


def is_run(line, counts):
    """Whether a line is run: by its own count, or where it has none, as the second line of a statement and
    constants have, by those before and after it."""
    if line in counts:
        return counts[line] > 0
    before, after = [at for at in counts if at < line], [at for at in counts if at > line]
    return any(counts[at] > 0 for at in (max(before, default=None), min(after, default=None)) if at)


def count_lines(build, tests, right):
    """How often the tests run each line that has code, by gcov, and each test's processor time."""
    source = build.scratch / "counted.cpp"
    source.write_text(f'#line 1 "{build.source}"\n' + right)
    counted, times = build.scratch / "counted.o", []
    if not build.compile(source, counted, ["--coverage", "-Og", f"-I{build.source.parent}"]):
        sys.exit(f"{build.source} does not compile")
    for target, case_filter in tests:
        program = build.scratch / "program"
        build.link(target, program, [counted], ["--coverage"])
        failed, spent = run(program, case_filter)
        if failed:
            sys.exit(f"{failed} fails without a mutant")
        times.append(spent)
    report = json.loads(subprocess.run(["gcov", "--json-format", "--stdout", counted.with_suffix(".gcno")],
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                       cwd=build.scratch, check=True).stdout)
    lines = [line for file in report["files"] if Path(file["file"]) == build.source for line in file["lines"]]
    counts = {}
    for line in lines:  # templates have one for each instance
        counts[line["line_number"]] = counts.get(line["line_number"], 0) + line["count"]
    return counts, times


def fate_of(build, text, tests, times):
    """The case that kills a mutant, `lived`, or None if it does not compile."""
    source, mutant = build.scratch / "mutant.cpp", build.scratch / "mutant.o"
    source.write_text(f'#line 1 "{build.source}"\n' + text)
    if not build.compile(source, mutant, [f"-I{build.source.parent}"]):
        return None
    for (target, case_filter), spent in zip(tests, times):
        build.link(target, build.scratch / "program", [mutant])
        failed, _ = run(build.scratch / "program", case_filter, int(PATIENCE * spent) + 10)
        if failed:
            return failed
    return "lived"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("file")
    parser.add_argument("tests", nargs="+")
    parser.add_argument("--lines", default="1-1000000")
    parser.add_argument("--kinds", default="")
    parser.add_argument("--most", type=int, default=10**6)
    options = parser.parse_args()
    first, last = (int(number) for number in options.lines.split("-"))
    right = Path(options.file).read_text()
    mutants = [mutant for mutant in mutants_of(right) if first <= mutant[0] <= last
               and (not options.kinds or mutant[1] in options.kinds.split(","))]
    tests = [(name, case_filter or "*") for name, _, case_filter in (t.partition(":") for t in options.tests)]
    counts = {"killed": 0, "lived": 0, "not run": 0}
    with tempfile.TemporaryDirectory() as scratch:
        build = Build(options.build, options.file, scratch)
        line_counts, times = count_lines(build, tests, right)
        step = max(len(mutants) / options.most, 1)
        print("| line | kind | mutant | |\n|---|---|---|---|")
        for line, kind, before, after, text in (mutants[int(i * step)] for i in range(int(len(mutants) / step))):
            fate = fate_of(build, text, tests, times) if is_run(line, line_counts) else "not run"
            if fate is None:
                continue
            counts[fate if fate in counts else "killed"] += 1
            change = f"`{before.strip()}` → `{after.strip()}`" if after.strip() else f"`{before.strip()}`"
            print(f"| {line} | {kind} | {change} | {fate} |", flush=True)
    print(f"\n{options.file}: " + ", ".join(f"{count} {fate}" for fate, count in counts.items()))
    return 1 if counts["lived"] else 0


if __name__ == "__main__":
    sys.exit(main())
