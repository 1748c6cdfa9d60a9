#!/usr/bin/env python3
"""Holds the pages to what they speak of.

    pages.py links SOURCE                 links and anchors lead somewhere, nothing is left without a page
    pages.py commands SOURCE SKYBAKE      printed recipes pass `skybake check`, printed options exist
    pages.py bakes SOURCE SKYBAKE PAGE    the recipe of a page bakes, with the sizes and errors printed there

The recipe of a page is the one that stands above the first bake that it prints. That of README.md is
examples/earth.toml, which its script bakes.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[2])
LINES, BYTES = 200, 10000  # of README.md, at most


def pages():
    rooms = ("bakers", "config", "cli", "examples", "tests")
    return [source / "README.md", *(page for room in rooms for page in sorted((source / room).rglob("*.md")))]


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.M | re.S)


def without_code(text):
    """Without blocks and pieces of code, whose brackets are no links."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(page):
    """What renderers of Markdown make of a page's titles."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.*)$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def links(page):
    return re.findall(r"\]\(([^()\s]+)\)", without_code(page.read_text()))


def broken_links():
    count = 0
    for page in pages():
        for link in links(page):
            count += 1
            path, _, anchor = link.partition("#")
            if path.startswith("http"):
                continue
            target = (page.parent / path) if path else page
            if not target.exists():
                yield f"{page.relative_to(source)}: there is no {link}"
            elif anchor and anchor not in anchors(target):
                yield f"{page.relative_to(source)}: {path or 'the page'} has no title for #{anchor}"
    if count < 100:
        yield f"only {count} links were found"


def broken_where_installed():
    """Links of installed pages to what is not installed: pages of examples, and what cli/CMakeLists.txt adds."""
    text = (source / "cli/CMakeLists.txt").read_text()
    added = [source / name for name in re.search(r"foreach\(linked IN ITEMS(.*?)\)", text, re.S)[1].split()]
    installed = [page for page in pages() if page.is_relative_to(source / "examples") or page in added]
    for page in installed:
        for link in links(page):
            path = link.partition("#")[0]
            target = (page.parent / path).resolve() if path else page
            if not path.startswith("http") and not any(
                    target.is_relative_to(place) for place in [source / "examples", *added]):
                yield f"{page.relative_to(source)}: {link} is not installed"


def left_out():
    """An asset without a page, a page or lookup that nothing links, a README that has grown."""
    listed = (source / "config/assets/assets.h").read_text()
    assets = {name for name in re.findall(r'#include "config/assets/(\w+)\.h"', listed)}
    described = {page.stem for page in (source / "examples/assets").glob("*.md")}
    # Headers that several assets share are no assets.
    assets &= {path.name for path in (source / "bakers/assets").iterdir()}
    for name in sorted(assets ^ described):
        yield f"examples/assets/{name}.md and config/assets/assets.h disagree on whether {name} is an asset"
    linked = {(page.parent / link.partition("#")[0]).resolve() for page in pages() for link in links(page)}
    for pattern in ("examples/**/*.md", "examples/*.toml", "examples/lookups/*.glsl", "examples/pictures/*"):
        for path in sorted(source.glob(pattern)):
            if path.resolve() not in linked:
                yield f"no page links {path.relative_to(source)}"
    text = (source / "README.md").read_text()
    if text.count("\n") > LINES or len(text.encode()) > BYTES:
        yield f"README.md has more than {LINES} lines or {BYTES} bytes"


def run(skybake, *arguments, **options):
    return subprocess.run([skybake, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          cwd=source / "examples", **options)


def failing_recipes(skybake):
    count = 0
    for page in pages():
        for recipe in blocks(page, "toml"):
            count += 1
            result = run(skybake, "check", "-", input=recipe)
            if result.returncode:
                yield f"{page.relative_to(source)}:\n{recipe}{result.stderr}"
    if count < 15:
        yield f"only {count} recipes were found"


def commands(page):
    """The words of each call of skybake that the page prints, in blocks and within lines."""
    lines = [line[2:] for block in blocks(page, "console") for line in block.split("\n") if line.startswith("$ ")]
    lines += re.findall(r"`(skybake [^`\n]*)`", re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S))
    for line in lines:
        words = shlex.split(line, comments=True)
        while "skybake" in words:
            words = words[words.index("skybake") + 1:]
            end = min((words.index(word) for word in ("&&", "|", ">") if word in words), default=len(words))
            yield line, words[:end]


def wrong_commands(skybake):
    helps = {}
    presets = run(skybake, "init", "--list").stdout
    count = 0
    for page in pages():
        for line, (command, *words) in commands(page):
            count += 1
            if command not in helps:
                helps[command] = run(skybake, command, "--help")
            if helps[command].returncode:
                yield f"{page.relative_to(source)}: there is no command {command}: {line}"
                continue
            common = "--json --quiet -q --verbose -v"
            known = re.findall(r"(?<![\w-])--?[a-zA-Z][\w-]*", helps[command].stdout + common)
            for word, value in zip(words, [*words[1:], ""]):
                key = value.split("=")[0]
                if word.startswith("-") and word != "-" and word.split("=")[0] not in known:
                    yield f"{page.relative_to(source)}: {command} has no option {word}: {line}"
                if word in ("--set", "--vary") and run(skybake, "explain", key).returncode:
                    yield f"{page.relative_to(source)}: there is no key {key}: {line}"
                if word == "--preset" and value.isidentifier() and value.islower() \
                        and not re.search(rf"^  {value} ", presets, re.M):
                    yield f"{page.relative_to(source)}: there is no preset {value}: {line}"
                if word.startswith("examples/") and not (source / word).exists():
                    yield f"{page.relative_to(source)}: there is no {word}: {line}"
            if command == "explain" and words and words[0] != words[0].upper() \
                    and run(skybake, "explain", words[0]).returncode:
                yield f"{page.relative_to(source)}: {words[0]} is nothing that explain knows: {line}"
    if count < 50:
        yield f"only {count} commands were found"


def recipe_of(page):
    """The last recipe before the first table that a bake prints, and that table."""
    text = page.read_text()
    table = re.search(r"^```console\n(?:(?!```).)*?^  asset  .*?^```$", text, re.M | re.S)
    if page.name == "README.md":
        return (source / "examples/earth.toml").read_text(), table[0]
    recipes = re.findall(r"^```toml\n(.*?)^```$", text[:table.start()], re.M | re.S)
    return recipes[-1], table[0]


def two_digits(*figures):
    return [float(f"{figure:.2g}") for figure in figures]


def same_figures(printed, error):
    if not error:
        return printed == "not measured"
    return [float(figure) for figure in printed.split(" / ")] == two_digits(error["lookup"]["max"], error["lookup"]["rms"])


def same_sky(printed, error):
    sky = error and error.get("sky")
    if not sky:
        return not printed
    wanted = two_digits(*(100 * sky[name] for name in ("median", "max", "standard_error")))
    if "worst_sun_elevation_deg" in sky:
        wanted.append(float(f"{sky['worst_sun_elevation_deg']:.3g}"))
    return [float(figure) for figure in re.findall(r"[\d.e+-]+", printed)] == wanted


def same_colour(printed, error):
    colour = error and error.get("color")
    if not colour:
        return not printed
    wanted = two_digits(*(100 * colour[name] for name in ("median", "max")))
    return [float(figure) for figure in re.findall(r"[\d.e+-]+", printed)] == wanted


def wrong_figures(skybake, page):
    recipe, table = recipe_of(page)
    with tempfile.TemporaryDirectory() as folder:
        result = run(skybake, "bake", "-", "-o", folder, input=recipe)
        if result.returncode:
            yield result.stderr
            return
        manifest = json.loads((pathlib.Path(folder) / "manifest.json").read_text())
    row = r"^  (\w+) +(\d+(?:x\d+)+) +.*?  (?:(\S+ / \S+ ± \S+ %(?: \(sun \S+°\))?) +)?(?:(\S+ / \S+ %) +)?" \
        r"(\S+ / \S+|not measured)$"
    printed = {name: figures for name, *figures in re.findall(row, table, re.M)}
    baked = {asset["name"]: asset for asset in manifest["assets"]}
    if printed.keys() != baked.keys():
        yield f"the page prints {list(printed)}, and {list(baked)} were baked"
    for name in printed.keys() & baked.keys():
        size, sky, colour, figures = printed[name]
        error = baked[name].get("error")
        right_size = size == "x".join(map(str, baked[name]["size"]))
        same = same_sky(sky, error) and same_colour(colour, error) and same_figures(figures, error)
        if not right_size or not same:
            yield f"the page prints {name} of {size} with {sky} {colour} {figures}; skybake printed\n{result.stderr}"
    for line in re.findall(r"^ +\w+: .*$", table, re.M):
        if line not in result.stderr:
            yield f"the page prints `{line}`; skybake printed\n{result.stderr}"


mode, arguments = sys.argv[1], sys.argv[3:]
if mode == "links":
    failures = [*broken_links(), *broken_where_installed(), *left_out()]
elif mode == "commands":
    failures = [*failing_recipes(*arguments), *wrong_commands(*arguments)]
else:
    failures = list(wrong_figures(arguments[0], source / arguments[1]))
print(*failures, sep="\n")
sys.exit(1 if failures else 0)
