"""Files of the targets cosmoscout and stellarium, and phase functions for Bevy, hold the probes where the programs look.

The lookups follow what the programs' own shaders publish: csp-atmospheres of CosmoScout VR (Bruneton 2017) and
CalcMySky 0.3, whose textures Stellarium loads; they share nothing with skybake's. TIFF files are decoded twice, by
OpenImageIO and by this page from the tags of TIFF 6.0. COMMAND FOLDER bakes the tables without a target.
"""

import json
import math
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import consumer

GROUND, TOP = 6371.0, 6471.0  # km, of the preset
HORIZON = math.sqrt(TOP**2 - GROUND**2)
SPECTRUM = '["400 nm", "490 nm", "580 nm", "670 nm"]'


class Texture:
    """Texels of floats: x fastest, then y, then z."""

    def __init__(self, size, channels, texels):
        self.size, self.channels, self.texels = size, channels, texels

    def texel(self, place):
        x, y, z = (min(max(i, 0), n - 1) for i, n in zip(place, self.size))
        first = ((z * self.size[1] + y) * self.size[0] + x) * self.channels
        return self.texels[first:first + self.channels]

    def at(self, uvw):
        """What a clamped, linear sampler returns."""
        found = [0.0] * self.channels
        low = [math.floor(c * n - 0.5) for c, n in zip(uvw, self.size)]
        part = [c * n - 0.5 - l for c, n, l in zip(uvw, self.size, low)]
        for corner in range(8):
            steps = [corner >> a & 1 for a in range(3)]
            weight = math.prod(p if s else 1 - p for p, s in zip(part, steps))
            for c, value in enumerate(self.texel([l + s for l, s in zip(low, steps)])):
                found[c] += weight * value
        return found


def tif_by_tags(path):
    bytes_ = path.read_bytes()
    assert bytes_[:4] == b"II*\0", path
    texels, depth, at = [], 0, struct.unpack_from("<I", bytes_, 4)[0]
    while at:
        (count,) = struct.unpack_from("<H", bytes_, at)
        tags = {}
        for i in range(count):
            tag, kind, n, value = struct.unpack_from("<HHII", bytes_, at + 2 + 12 * i)
            tags[tag] = value & 0xFFFF if kind == 3 and n == 1 else value
            if kind == 3 and n > 2:
                tags[tag] = set(struct.unpack_from(f"<{n}H", bytes_, value))
        assert tags[258] == {32} and tags[339] == {3} and tags[259] == 1 and tags[284] == 1, tags
        floats = tags[256] * tags[257] * tags[277]
        assert tags[279] == 4 * floats and tags[278] == tags[257], tags
        texels += struct.unpack_from(f"<{floats}f", bytes_, tags[273])
        depth += 1
        size = tags[256], tags[257], tags[277]
        at = struct.unpack_from("<I", bytes_, at + 2 + 12 * count)[0]
    return Texture((size[0], size[1], depth), size[2], texels)


def tif_by_openimageio(oiiotool, path):
    """The same from what OpenImageIO prints of every pixel."""
    text = consumer.output_of(oiiotool, "-a", "--dumpdata", str(path))
    sizes = re.findall(r"(\d+) x\s+(\d+), (\d+) channel, float tiff", text)
    texels = [float(n) for line in re.findall(r"Pixel \(\d+, \d+\): ([^(\n]+)", text) for n in line.split()]
    width, height, channels = map(int, sizes[0])
    return Texture((width, height, len(texels) // (width * height * channels)), channels, texels)


def f32(path):
    bytes_ = path.read_bytes()
    for head in ("<2H", "<4H"):
        sizes = struct.unpack_from(head, bytes_)
        first = struct.calcsize(head)
        if first + 16 * math.prod(sizes) == len(bytes_):
            texels = struct.unpack_from(f"<{4 * math.prod(sizes)}f", bytes_, first)
            return sizes, texels
    sys.exit(f"{path} has {len(bytes_)} bytes")


def on_centres(x, size):
    return 0.5 / size + x * (1 - 1 / size)


def rho_of(h):
    return math.sqrt(h * (2 * GROUND + h))


def to_top(r, mu):
    return -r * mu + math.sqrt(max(r * r * (mu * mu - 1) + TOP**2, 0))


def transmittance_uv(size, h, mu):
    low, high = TOP - GROUND - h, rho_of(h) + HORIZON
    return (on_centres((to_top(GROUND + h, mu) - low) / (high - low), size[0]), on_centres(rho_of(h) / HORIZON, size[1]), 0.5)


def irradiance_uv(size, h, sun):
    return on_centres(sun / 2 + 0.5, size[0]), on_centres(h / (TOP - GROUND), size[1]), 0.5


def view_share(h, mu, ground):
    r = GROUND + h
    if ground:
        low, high = h, rho_of(h)
        distance = -r * mu - math.sqrt(max(r * r * (mu * mu - 1) + GROUND**2, 0))
    else:
        low, high, distance = TOP - r, rho_of(h) + HORIZON, to_top(r, mu)
    return 0 if high == low else (distance - low) / (high - low)


def sun_share(sun, largest):
    """`largest` is A, the share where the axis ends."""
    low, high = TOP - GROUND, HORIZON
    a = (to_top(GROUND, sun) - low) / (high - low)
    return max(1 - a / largest, 0) / (1 + a)


def cosmoscout_scattering(texture, nu_size, least, h, mu, sun, nu, ground):
    """getCombinedScattering of csp-atmospheres."""
    low, high = TOP - GROUND, HORIZON
    largest = (to_top(GROUND, least) - low) / (high - low)
    width, height, depth = texture.size
    x = on_centres(view_share(h, mu, ground), height // 2)
    v = 0.5 - 0.5 * x if ground else 0.5 + 0.5 * x
    u = on_centres(sun_share(sun, largest), width // nu_size)
    w = on_centres(rho_of(h) / HORIZON, depth)
    place = (nu + 1) / 2 * (nu_size - 1)
    first = math.floor(place)
    a, b = (texture.at(((i + u) / nu_size, v, w)) for i in (first, first + 1))
    return [p + (q - p) * (place - first) for p, q in zip(a, b)]


def stellarium_scattering(sizes, texels, h, mu, sun, nu, ground):
    """sample4DTexture of CalcMySky, whose texture is of the view, nu times the sun, and altitude."""
    view_size, nu_size, sun_size, depth = sizes
    texture = Texture((view_size, nu_size * sun_size, depth), 4, texels)
    x = on_centres(view_share(h, mu, ground), view_size // 2)
    u = 0.5 - 0.5 * x if ground else 0.5 + 0.5 * x
    index = sun_share(sun, GROUND / (HORIZON - (TOP - GROUND))) * (sun_size - 1)
    w = on_centres(rho_of(h) / HORIZON, depth)
    rows = nu_size * sun_size
    nu_place = (nu + 1) / 2 * (nu_size - 1)
    place = lambda i: on_centres((i * nu_size + nu_place) / (rows - 1), rows)
    a, b = (texture.at((u, place(i), w)) for i in (math.floor(index), math.ceil(index)))
    return [p + (q - p) * (index - math.floor(index)) for p, q in zip(a, b)]


def check_probes(failures, name, asset, look_up):
    for i, probe in enumerate(asset["probes"]):
        for c, found in enumerate(look_up(probe["at"])[:len(probe["value"])]):
            failures.expect_near(found, probe["value"][c], probe["tolerance"][c] + 2e-6, f"{name}, probe {i}, channel {c}")


def check_table(failures, name, asset, texture, scattering):
    size = texture.size
    flat = {"bruneton_transmittance": lambda at: texture.at(transmittance_uv(size, at["altitude_km"], at["cos_zenith"])),
            "bruneton_irradiance": lambda at: texture.at(irradiance_uv(size, at["altitude_km"], at["sun_cos_zenith"]))}
    in_space = lambda at: scattering(at["altitude_km"], at["cos_zenith"], at["sun_cos_zenith"], at["nu"], at["ground"] != 0)
    check_probes(failures, name, asset, flat.get(asset["mapping"]["name"], in_space))


def baked(recipe, *settings):
    *command, _ = sys.argv[1:]
    folder = tempfile.TemporaryDirectory()
    here = Path(sys.argv[3]).parent
    more = [part for setting in settings for part in ("--set", setting)]
    consumer.output_of(*command[:2], str(here / recipe), *command[3:], *more, "--output", folder.name)
    assets = json.loads((Path(folder.name) / "manifest.json").read_text())["assets"]
    return folder, Path(folder.name), assets


def check_cosmoscout(failures, oiiotool):
    keep, folder, assets = baked("skies.toml", 'target="cosmoscout"')
    metadata = json.loads((folder / "multiple_scattering.cosmoscout.json").read_text())
    least = math.cos(metadata["maxSunZenithAngle"])
    failures.expect(metadata["sunIlluminance"], [1, 1, 1], "the sun's illuminance")
    for asset in assets:
        path = folder / f"{asset['name']}.tif"
        for decoder, texture in (("tags", tif_by_tags(path)), ("OpenImageIO", tif_by_openimageio(oiiotool, path))):
            failures.expect([*texture.size, texture.channels], [*asset["size"], 3], f"{path.name} by {decoder}: the size")
            scattering = lambda *at: cosmoscout_scattering(texture, metadata["scatteringTextureNuSize"], least, *at)
            check_table(failures, f"{path.name} by {decoder}", asset, texture, scattering)
    keep.cleanup()
    check_phases(failures, oiiotool)


def check_phases(failures, oiiotool):
    """The command in the sidecar makes the picture of two rows."""
    keep, folder, assets = baked("phases.toml", 'target="cosmoscout"')
    command = re.search(r"`oiiotool ([^`]*)`", json.loads((folder / "aerosols.cosmoscout.json").read_text())["about"])
    words = command.group(1).replace("MOLECULES", "molecules").replace("AEROSOLS", "aerosols").split()
    subprocess.run([oiiotool, *words], cwd=folder, check=True)
    text = consumer.output_of(oiiotool, "--dumpdata", str(folder / "phase.tif"))
    failures.expect("32 x    2, 3 channel, float tiff" in text, True, "whether phase.tif has two rows of floats")
    both = tif_by_openimageio(oiiotool, folder / "phase.tif")
    for row, asset in enumerate(assets):
        place = lambda at: on_centres(at["scattering_angle_deg"] / 180, 32)
        check_probes(failures, f"row {row} of phase.tif", asset, lambda at: both.at((place(at), 0.25 + 0.5 * row, 0.5)))
    keep.cleanup()


def check_bevy(failures):
    """Bevy takes N x 1 texels of Rgba32Float, whose first is for cos theta = -1 and whose last for 1."""
    keep, folder, assets = baked("phases.toml", 'target="bevy"')
    for asset in assets:
        bytes_ = (folder / f"{asset['name']}.ktx2").read_bytes()
        vk_format, _, width, height = struct.unpack_from("<4I", bytes_, 12)
        failures.expect((vk_format, width, height), (109, 32, 1), f"{asset['name']}: VkFormat and size")
        (at,) = struct.unpack_from("<Q", bytes_, 80)
        texture = Texture((32, 1, 1), 4, struct.unpack_from("<128f", bytes_, at))
        place = lambda at: on_centres((1 + math.cos(math.radians(at["scattering_angle_deg"]))) / 2, 32)
        check_probes(failures, f"{asset['name']} for Bevy", asset, lambda at: texture.at((place(at), 0.5, 0.5)))
        failures.expect("from_chromatic_texture" in (folder / f"{asset['name']}.bevy.rs").read_text(), True, "Bevy's module")
    keep.cleanup()


def check_stellarium(failures):
    keep, folder, assets = baked("skies.toml", 'target="stellarium"', f"wavelengths={SPECTRUM}")
    planet = folder / "planet"
    for asset in assets:
        script = [sys.executable, str(folder / f"{asset['name']}.stellarium.py"), str(planet), "0", "some"]
        placed = Path(subprocess.run(script, check=True, stdout=subprocess.PIPE, text=True).stdout.strip())
        sizes, texels = f32(placed)
        texture = Texture((*sizes, 1), 4, texels) if len(sizes) == 2 else None
        scattering = lambda *at: stellarium_scattering(sizes, texels, *at)
        wanted = asset["size"] if texture else None
        failures.expect(list(texture.size) if texture else wanted, wanted, f"{placed.name}: the size")
        if texture:
            check_table(failures, placed.name, asset, texture, scattering)
        else:
            check_probes(failures, placed.name, asset, lambda at: scattering(
                at["altitude_km"], at["cos_zenith"], at["sun_cos_zenith"], at["nu"], at["ground"] != 0))
    names = sorted(str(path.relative_to(planet)) for path in planet.rglob("*") if path.is_file())
    failures.expect(names, ["irradiance-wlset0.f32", "multiple-scattering-wlset0.f32", "params.atmo",
                            "single-scattering/0/some.f32", "transmittance-wlset0.f32"], "what lies in Stellarium's folder")
    failures.expect(any(f32(planet / "multiple-scattering-wlset0.f32")[1]), False, "whether light is counted twice")
    keep.cleanup()


def main():
    oiiotool = consumer.program("oiiotool", "openimageio-tools")
    failures = consumer.Failures()
    check_cosmoscout(failures, oiiotool)
    check_stellarium(failures)
    check_bevy(failures)
    failures.exit()


main()
