"""Each line that any command prints with --json satisfies the schema that `schema events` prints.

    validate_events.py SKYBAKE
Exit code 77, skipped, where python3-jsonschema is not installed.
"""
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

program = os.path.abspath(sys.argv[1])
schema = json.loads(subprocess.run([program, "schema", "events"], check=True, capture_output=True).stdout)
manifest_schema = json.loads(
    subprocess.run([program, "schema", "manifest"], check=True, capture_output=True).stdout)
jsonschema.Draft202012Validator.check_schema(schema)
seen = set()


def events(*words, code=0, text=None):
    """The names of the events of one run, all valid, and its last event."""
    run = subprocess.run([program, *words, "--json"], input=text, capture_output=True, text=True)
    assert run.returncode == code, (words, run.returncode, run.stderr)
    lines = [json.loads(line) for line in run.stdout.splitlines()]
    for line in lines:
        jsonschema.validate(line, schema)
    names = [line["event"] for line in lines]
    seen.update(names)
    return names, lines[-1]


recipe = ('preset = "earth_hillaire"\n[bake.transmittance]\nsize = [16, 4]\n'
          '[noise.plain.channels.Y]\ntype = "perlin"\nfrequency = 2\noctaves = 1\n'
          '[bake.plain]\nasset = "noise_volume"\nnoise = "plain"\nsize = [8, 8, 8]\n'
          'formats = ["exr", "bin", "vdb"]\n')
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    with open("recipe.toml", "w", encoding="utf-8") as file:
        file.write(recipe)

    # Bakes, and what is left behind.
    plan = ["plan", "asset", "asset", "asset", "asset", "done"]
    assert events("bake", "recipe.toml", "-o", "out")[0] == plan
    assert events("bake", "-", "-o", "other", text=recipe)[0] == plan
    assert events("bake", "recipe.toml", "-o", "out", "--dry-run")[0] == ["plan"]
    with open("less.toml", "w", encoding="utf-8") as file:
        file.write('preset = "earth_hillaire"\n[bake.transmittance]\nsize = [16, 4]\n')
    names, done = events("bake", "less.toml", "-o", "other")
    assert done["retired"] == ["plain.exr", "plain.bin", "plain.vdb"] and not done["pruned"], done
    names, last = events("bake", "less.toml", "-o", "other", "--prune", "--dry-run")
    assert last["pruned"] == ["plain.exr", "plain.bin", "plain.vdb"], last
    names, done = events("bake", "less.toml", "-o", "other", "--prune")
    assert done["pruned"] == ["plain.exr", "plain.bin", "plain.vdb"] and not done["retired"], done

    # Events about files.
    names, last = events("info", "out")
    jsonschema.validate(last["manifest"], manifest_schema)
    assert names == ["folder"] and last["missing"] == [], last
    os.remove("other/transmittance.exr")
    assert events("info", "other")[1]["missing"] == ["transmittance.exr"]
    assert events("info", "out/transmittance.exr")[0] == ["image"]
    assert events("info", "out/plain.vdb")[0] == ["grids"]
    # An EXR of another kind: two subsampled channels, RLE, a data window within the display window.
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + len(value).to_bytes(4, "little") + value

    def box(*corners):
        return b"".join(corner.to_bytes(4, "little", signed=True) for corner in corners)

    channel = lambda name, step: name + b"\0" + box(1, 0, step, step)  # half
    with open("foreign.exr", "wb") as file:
        file.write(b"\x76\x2f\x31\x01\x02\0\0\0" + attribute(
            b"channels", b"chlist", channel(b"BY", 2) + channel(b"Y", 1) + b"\0") +
            attribute(b"compression", b"compression", b"\x01") +
            attribute(b"dataWindow", b"box2i", box(-2, 0, 5, 3)) +
            attribute(b"displayWindow", b"box2i", box(0, 0, 7, 3)) +
            attribute(b"lineOrder", b"lineOrder", b"\0") +
            attribute(b"pixelAspectRatio", b"float", b"\0\0\x80\x3f") +
            attribute(b"screenWindowCenter", b"v2f", bytes(8)) +
            attribute(b"screenWindowWidth", b"float", b"\0\0\x80\x3f") + b"\0")
    names, last = events("info", "foreign.exr")
    part = last["parts"][0]
    assert names == ["parts"] and part["size"] == [8, 4] and part["compression"] == "rle", last
    assert part["channels"][0] == {"name": "BY", "type": "half", "sampling": [2, 2]}, part
    assert "vec3 baked_transmittance(" in events(
        "info", "--lookup", "out/transmittance.exr")[1]["glsl"]
    with open("png.toml", "w", encoding="utf-8") as file:
        file.write('preset = "earth_hillaire"\n[bake.transmittance]\nsize = [16, 4]\nformats = ["png"]\n'
                   'pixel_type = "unorm8"\n')
    events("bake", "png.toml", "-o", "png")
    names, last = events("info", "png/transmittance.png")
    assert names == ["file"] and last["asset"]["kind"] == "transmittance"
    assert events("verify", "out")[1]["passed"]
    assert not events("verify", "other", code=1)[1]["passed"]
    assert events("diff", "out", "out")[1]["equal"]
    assert events("diff", "out", "other", code=3)[0] == ["failed"]  # nothing is left in there
    events("bake", "less.toml", "-o", "third")
    assert not events("diff", "out", "third", code=1)[1]["equal"]
    assert events("preview", "out/transmittance.exr", "-o", "page")[0] == ["previewed"]

    # Recipes and words.
    assert events("check", "recipe.toml")[1]["assets"] == 2
    assert "zenith_optical_depths" in events("show", "recipe.toml")[1]
    assert len(events("show", "-", "atmosphere.layers.mie.g", text=recipe)[1]["values"]) == 1
    assert events("explain", "E0102")[1]["name"] == "E0102"
    assert events("explain")[0] == ["explanation"]
    assert {preset["kind"] for preset in events("init", "--list")[1]["presets"]} == {
        "atmosphere", "noise", "particles", "layers", "clouds"}
    assert events("init", "new/mars.toml", "--preset", "mars")[1]["preset"] == "atmosphere.mars"
    assert events("init", "-")[0] == ["recipe"]
    assert events("help")[0] == events("bake", "--help")[0] == ["help"]
    assert events("-V")[0] == ["version"]

    # Caches and sweeps.
    cache = ("--cache-dir", "cache")
    events("bake", "less.toml", "-o", "cached", *cache)
    assert events("cache", "stats", *cache)[1]["assets"] == 1
    assert events("cache", "verify", *cache)[1]["damaged"] == []
    assert events("cache", "gc", "--max-size", "0", *cache)[1]["removed"] == 1
    vary = ("sweep", "less.toml", "--vary", "atmosphere.ground_albedo=0,1", "-o", "sweep")
    assert events(*vary, "--dry-run")[0] == ["sweep", "planned_variant", "planned_variant"]
    assert events(*vary)[0] == ["sweep", "variant", "variant", "swept"]
    assert events(*vary, "--emit", "commands")[1]["text"].count("--shard") == 2

    # Failures: the last line, whatever was printed before.
    for words, code in (
        (("bake", "missing.toml"), 3),
        (("bake", "recipe.toml", "--set", "atmosphere.ground_albedo=3"), 2),
        (("bake", "recipe.toml", "--max-memory", "1", "-o", "fresh"), 2),
        (("bake", "recipe.toml", "-o", "sweep"), 3),
        (("check", "recipe.toml", "--set", "atmosphere.ground_albedo=3"), 2),
        (("cache", "dust", *cache), 2),
        (("verify", "out/transmittance.exr"), 2),
        (("sweep", "less.toml", "-o", "bad", "--vary", "atmosphere.ground_albedo=0,3"), 4),
        (("nonsense",), 2),
        (("--nonsense",), 2),
    ):
        names, last = events(*words, code=code)
        assert names[-1] == "failed" and names.count("failed") == 1, (words, names)
        assert last["exit_code"] == code and last["diagnostics"], last
    setting = events("bake", "recipe.toml", "--set", "atmosphere.ground_albedo=3", code=2)[1]
    assert "file" not in setting["diagnostics"][0] and "line" not in setting["diagnostics"][0], setting

known = {kind["properties"]["event"]["const"] for kind in schema["oneOf"]}
assert known - seen == {"watching"}, known - seen
print(f"{len(seen)} kinds of events satisfy their schema")
