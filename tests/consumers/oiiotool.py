"""oiiotool, which comes with OpenImageIO, reads the EXR files as the manifest says."""

import json
import re

import consumer


def numbers(text, name):
    found = re.search(rf"^\s*Stats {name}:((?:\s+[-+.\deE]+)+)", text, re.MULTILINE)
    return [float(number) for number in found.group(1).split()] if found else []


def entry_in(text):
    """What the file says of itself, whose text is in pieces, each in quotes on a line of its own."""
    pieces = re.findall(r'^\s*skybake/asset\.(\d+): "(.*)"$', text, re.MULTILINE)
    pieces = sorted((int(number), piece) for number, piece in pieces)
    return json.loads("".join(piece for _, piece in pieces) or "{}")


def main():
    oiiotool = consumer.program("oiiotool", "openimageio-tools")
    failures = consumer.Failures()
    for volume in consumer.baked_volumes():
        text = consumer.output_of(oiiotool, "--info", "-v", "--stats", volume.path("exr"))
        layout = volume.file("exr")["layout"]
        width, height, _ = volume.size
        size = f"{width * layout['columns']} x {height * layout['rows']}"
        channels = len(volume.channels)
        size = rf": +{re.sub(' x ', ' x +', size)}, {channels} channel, half openexr"
        failures.expect(bool(re.search(size, text)), True, f"{volume.name}: whether it is{size}")
        names = f"channel list: {', '.join(volume.channels)}"
        failures.expect(names in text, True, f"{volume.name}: whether it has the {names}")
        failures.expect(entry_in(text).get("content_hash"), volume.asset["content_hash"],
                        f"{volume.name}: the hash that it says")
        failures.expect(numbers(text, "NanCount"), [0.0] * channels, f"{volume.name}: NaN")
        failures.expect(numbers(text, "InfCount"), [0.0] * channels, f"{volume.name}: infinities")
        for name, key in {"Max": "max", "Min": "min", "Avg": "mean"}.items():
            found = numbers(text, name)
            failures.expect(len(found), channels, f"{volume.name}: the number of {name}")
            for value, statistics in zip(found, volume.statistics()):
                if name == "Avg" and layout["kind"] == "atlas":
                    continue  # empty cells count
                failures.expect_near(value, statistics[key], 1e-6, f"{volume.name}: {name}")
    failures.exit()


main()
