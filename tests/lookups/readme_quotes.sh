#!/usr/bin/env bash
# Each block of GLSL in the README is a whole run of lines of one published lookup.
#   readme_quotes.sh SOURCE
set -euo pipefail
python3 - "$1" <<'PYTHON'
import pathlib, re, sys
source = pathlib.Path(sys.argv[1])
files = {file.name: file.read_text() for file in sorted((source / "examples/lookups").glob("*.glsl"))}
blocks = re.findall(r"^```glsl\n(.*?)^```$", (source / "README.md").read_text(), re.M | re.S)
strangers = [block for block in blocks
             if not any(text.startswith(block) or "\n" + block in text for text in files.values())]
for block in strangers:
    print("in no file of examples/lookups:\n" + block)
print(f"{len(blocks)} blocks, {len(files)} files")
sys.exit(1 if strangers or len(blocks) < 4 else 0)
PYTHON
