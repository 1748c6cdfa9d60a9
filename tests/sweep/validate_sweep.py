"""sweep.json, index.jsonl, index.csv, timing.csv and the events of `sweep --json` are what their schemas say.

    validate_sweep.py SKYBAKE
Exit code 77, skipped, where python3-jsonschema is not installed.
"""
import csv
import json
import os
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(77)

program = sys.argv[1]


def schema_of(name):
    text = subprocess.run([program, "schema", name], check=True, capture_output=True).stdout
    return json.loads(text)


def sweep(recipe, folder, *options):
    return subprocess.run([program, "sweep", recipe, "-o", folder, *options],
                          capture_output=True, text=True)


schema = schema_of("sweep")
jsonschema.Draft202012Validator.check_schema(schema)
variant_schema = {"$defs": schema["$defs"], "$ref": "#/$defs/variant"}
event_schema = schema_of("events")
with tempfile.TemporaryDirectory() as folder:
    recipe = f"{folder}/recipe.toml"
    with open(recipe, "w", encoding="utf-8") as file:
        file.write('preset = "earth_hillaire"\n[bake.transmittance]\nsize = [16, 4]\n[sweep]\n'
                   '"atmosphere.ground_albedo" = [0.1, 2, [0.1, 0.2, 0.3]]\n'
                   '"bake.transmittance.pixel_type" = ["float", "half"]\n')
    out = f"{folder}/out"
    planned = sweep(recipe, out, "--json", "--dry-run").stdout.splitlines()
    made = sweep(recipe, out, "--json")
    assert made.returncode == 4, made
    with open(f"{out}/sweep.json", encoding="utf-8") as file:
        manifest = json.load(file)
    with open(f"{out}/index.jsonl", encoding="utf-8") as file:
        rows = [json.loads(line) for line in file]
    with open(f"{out}/index.csv", encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    with open(f"{out}/timing.csv", encoding="utf-8", newline="") as file:
        times = list(csv.DictReader(file))
    done = [row for row in rows if row["status"] == "done"]
    for row, line in zip(done, times, strict=True):
        asset, = row["assets"]
        assert asset["bytes"] == sum(os.path.getsize(f"{out}/{name}") for name in asset["files"]), asset
        with open(f"{out}/{row['name']}/manifest.json", encoding="utf-8") as file:
            timing = json.load(file)["assets"][0]["timing"]
        assert line == {"index": str(row["index"]), "asset": "transmittance", "name": row["name"],
                        **{name: str(value) for name, value in timing.items()}}, (line, timing)

jsonschema.validate(manifest, schema)
for row in rows:
    jsonschema.validate(row, variant_schema)
assert manifest["variants"] == rows
assert [row["status"] for row in rows] == ["done", "done", "failed", "failed", "done", "done"]
assert rows[5]["values"] == {"atmosphere.ground_albedo": [0.1, 0.2, 0.3],
                             "bake.transmittance.pixel_type": "half"}
assert [row["name"] for row in table] == [row["name"] for row in rows]
assert table[0]["transmittance.content_hash"] == rows[0]["assets"][0]["content_hash"]
assert int(table[0]["transmittance.bytes"]) == rows[0]["assets"][0]["bytes"]
assert float(table[0]["transmittance.lookup_max"]) == rows[0]["assets"][0]["lookup_error"]["max"]
assert table[2]["error"].startswith("E0110"), table[2]
for damaged in ({**rows[0], "status": "failed"}, {**rows[0], "name": "../x"}, {**rows[2], "assets": []}):
    assert not jsonschema.Draft202012Validator(variant_schema).is_valid(damaged), damaged
events = planned + made.stdout.splitlines()
for line in events:
    jsonschema.validate(json.loads(line), event_schema)
print(f"{len(rows)} variants and {len(events)} events satisfy their schemas")
