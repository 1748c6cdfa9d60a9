#!/usr/bin/env bash
# Each block of GLSL in a page is a whole run of lines of one published lookup, and each asset's page
# quotes its lookup.
#   page_quotes.sh SOURCE
set -euo pipefail
python3 - "$1" <<'PYTHON'
import pathlib, re, sys
source = pathlib.Path(sys.argv[1])
files = {file.name: file.read_text() for file in sorted((source / "examples/lookups").glob("*.glsl"))}
pages = [source / "README.md", *sorted((source / "examples").rglob("*.md"))]
count = 0
failures = []
for page in pages:
    blocks = re.findall(r"^```glsl\n(.*?)^```$", page.read_text(), re.M | re.S)
    count += len(blocks)
    if page.parent.name == "assets" and not blocks:
        failures.append(f"{page.name} quotes no lookup")
    failures += [f"{page.name} quotes what is in no file of examples/lookups:\n{block}" for block in blocks
                 if not any(text.startswith(block) or "\n" + block in text for text in files.values())]
print(*failures, f"{count} blocks, {len(files)} files", sep="\n")
sys.exit(1 if failures or count < 14 else 0)
PYTHON
