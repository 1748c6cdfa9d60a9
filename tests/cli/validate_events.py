"""Each line of `bake --json` satisfies the schema that `schema events` prints.

    validate_events.py SKYBAKE
Exit code 77, skipped, where python3-jsonschema is not installed.
"""
import json
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(77)

program = sys.argv[1]
schema = json.loads(subprocess.run([program, "schema", "events"], check=True, capture_output=True).stdout)
with tempfile.TemporaryDirectory() as folder:
    recipe = f"{folder}/recipe.toml"
    with open(recipe, "w", encoding="utf-8") as file:
        file.write('preset = "earth"\n[bake.transmittance]\nsize = [16, 4]\n'
                   '[noise.plain.channels.Y]\ntype = "perlin"\nfrequency = 2\noctaves = 1\n'
                   '[bake.plain]\nasset = "noise_volume"\nnoise = "plain"\nsize = [8, 8, 8]\n'
                   'formats = ["exr", "bin"]\n')
    run = subprocess.run([program, "bake", recipe, "-o", f"{folder}/out", "--json"],
                         check=True, capture_output=True, text=True)
lines = run.stdout.splitlines()
assert [json.loads(line)["event"] for line in lines] == ["plan", "asset", "asset", "asset", "done"], lines
for line in lines:
    jsonschema.validate(json.loads(line), schema)
print(f"{len(lines)} events satisfy their schema")
