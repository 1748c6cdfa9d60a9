// Errors in what people type: command lines, and the text, keys and values of any recipe.
#include <array>

#include "config/diagnostics/code_tables.h"

namespace skybake::config {
namespace {

constexpr std::array text_table = {
    DiagnosticCode{"E0001", "wrong use of the command line",
                   "A command, option or argument is missing or unknown, or has an invalid value.",
                   "skybake bka earth.toml", "skybake bake earth.toml", usage},

    DiagnosticCode{
        "E0002", "more memory than allowed",
        "The bake may need more memory than --max-memory allows, so it was not started. Allow more "
        "memory, bake fewer assets at once with --only, or choose smaller sizes.",
        "skybake bake sky.toml --max-memory 16MiB", "skybake bake sky.toml --max-memory 2GiB",
        usage},

    DiagnosticCode{"E0100", "not UTF-8 text",
                   "A recipe is TOML, and TOML is UTF-8 text. The file holds bytes that are not "
                   "UTF-8: it is binary, or it was saved in another encoding. Save it as UTF-8; a "
                   "byte order mark is allowed.",
                   "", "", usage},
    DiagnosticCode{"E0101", "not TOML",
                   "The text breaks the rules of TOML (https://toml.io). Only the first such error "
                   "of a file is reported, since what follows it cannot be trusted. Quantities "
                   "with a unit are strings in quotes.",
                   "scale_height = 8 km", "scale_height = \"8 km\"", usage},
    DiagnosticCode{"E0102", "unknown key",
                   "No such key exists in this table. Keys are never ignored, since a misspelt one "
                   "would silently leave the default in place. `skybake explain` lists all keys.",
                   "scale_hieght = \"8 km\"", "scale_height = \"8 km\"", usage},
    DiagnosticCode{"E0103", "wrong type",
                   "The value is not of the type that the key takes: for example, it is a string "
                   "in place of a number, or one value in place of a table.",
                   "enabled = \"no\"", "enabled = false", usage},
    DiagnosticCode{"E0104", "unknown choice",
                   "The key takes one of a few names, and this is none of them.",
                   "phase = \"raleigh\"", "phase = \"rayleigh\"", usage},
    DiagnosticCode{
        "E0105", "missing key",
        "A key that has no default is missing: neither the recipe nor its preset, its includes or "
        "--set gives it. Which keys a layer needs depends on its profile and its phase.",
        "[atmosphere.layers.haze]\nprofile = \"exponential\"",
        "[atmosphere.layers.haze]\nprofile = \"exponential\"\nscale_height = \"1.2 km\"", usage},
    DiagnosticCode{
        "E0106", "not a quantity",
        "The text is not a number followed by a unit that skybake knows, or the number is beyond "
        "the range of double precision. The decimal separator is a point in every locale.",
        "scale_height = \"8 kilometers\"", "scale_height = \"8 km\"", usage},
    DiagnosticCode{"E0107", "wrong dimension",
                   "The unit does not fit the key, or is missing. A length is never taken for a "
                   "coefficient, nor a bare number for a length, since a slip by a factor of 1000 "
                   "would go unseen.",
                   "scale_height = 8000", "scale_height = \"8000 m\"", usage},
    DiagnosticCode{"E0108", "wrong number of values",
                   "The key takes a fixed number of values. A key with values per channel takes "
                   "one value for all channels, or exactly one per wavelength.",
                   "scattering = [\"5.802e-6 /m\", \"1.3558e-5 /m\"]",
                   "scattering = [\"5.802e-6 /m\", \"1.3558e-5 /m\", \"3.31e-5 /m\"]", usage},
    DiagnosticCode{
        "E0109", "two ways to say one thing",
        "The keys exclude each other, since each determines the other. Keep one. A later source "
        "(the recipe after its preset, --set after the recipe) that names one of them replaces "
        "what the earlier ones said, so it is an error only if one source names two of them.",
        "extinction = \"4.44e-6 /m\"\nabsorption = \"4.44e-7 /m\"", "extinction = \"4.44e-6 /m\"",
        usage},
    DiagnosticCode{"E0110", "out of range",
                   "The value lies outside what the key can mean. It is not clamped.", "g = 1.2",
                   "g = 0.8", usage},
    DiagnosticCode{"E0111", "key of another profile, phase or type",
                   "The key would have no effect: it belongs to a profile or phase function that "
                   "the layer does not have, to another type of noise, another layout or another "
                   "height profile, to a `detail`, `period` or `warp_strength` that is not given, "
                   "or to pictures that the "
                   "recipe does not have. A later source that names "
                   "another profile drops the keys of the earlier one automatically.",
                   "profile = \"exponential\"\nscale_height = \"8 km\"\nhalf_width = \"15 km\"",
                   "profile = \"exponential\"\nscale_height = \"8 km\"", usage},
    DiagnosticCode{"E0112", "extinction below scattering",
                   "Extinction is scattering plus absorption, so it cannot be below scattering in "
                   "any channel. If the number is an absorption coefficient, call it `absorption`: "
                   "published tables confuse the two.",
                   "scattering = \"3.996e-6 /m\"\nextinction = \"4.4e-7 /m\"",
                   "scattering = \"3.996e-6 /m\"\nabsorption = \"4.44e-7 /m\"", usage},
    DiagnosticCode{"E0113", "bounds in the wrong order",
                   "The upper bound is not above the lower one: the top of the atmosphere lies on "
                   "or below the ground, or the top of a slab on or below its bottom. The two "
                   "bounds of a range in `scatter` may be equal.",
                   "ground_radius = \"6460 km\"\ntop_radius = \"6360 km\"",
                   "ground_radius = \"6360 km\"\ntop_radius = \"6460 km\"", usage},
    DiagnosticCode{
        "E0114", "bad table",
        "A density table is a list of [altitude, density] pairs, at least two, with strictly "
        "increasing altitudes. Density is linear between the entries and zero outside. A cloud's "
        "height table is a list of [height, value] pairs, at least one, with strictly increasing "
        "heights from 0 to 1; beyond them the table keeps its first and last values. A table of "
        "refractive indices has a wavelength and two numbers in each entry, and a list of "
        "components a name and a number per volume.",
        "table = [[\"0 km\", 1.0], [\"0 km\", 0.5]]", "table = [[\"0 km\", 1.0], [\"10 km\", 0.5]]",
        usage},
    DiagnosticCode{"E0115", "unknown preset",
                   "No preset has that name. `skybake init --list` names them all. Presets of "
                   "atmospheres are named at the top level, those of noises below [noise.NAME], "
                   "and those of clouds below [clouds.NAME].",
                   "preset = \"eart\"", "preset = \"earth\"", usage},
    DiagnosticCode{
        "E0116", "cyclic include",
        "A file includes itself, directly or through others. The message names the chain.",
        "# a.toml\ninclude = [\"a.toml\"]", "# a.toml\ninclude = [\"base.toml\"]", usage},
    DiagnosticCode{"E0117", "bad name",
                   "The name of a [bake.NAME] section becomes the name of a file, and bakes and "
                   "files refer to the name of a [noise.NAME] or [clouds.NAME]. So a name may hold "
                   "only letters, digits, `_` and `-`.",
                   "[bake.\"sky/blue\"]", "[bake.sky_blue]", usage},
    DiagnosticCode{"E0118", "unknown asset",
                   "The section asks for an asset that skybake cannot bake. `asset` says what to "
                   "bake; its default is the section's own name.",
                   "[bake.sky]", "[bake.sky]\nasset = \"transmittance\"", usage},
    DiagnosticCode{"E0119", "unknown recipe format",
                   "`format` is the version of the recipe's language. This release reads format 1.",
                   "format = 2", "format = 1", usage},
    DiagnosticCode{"E0120", "recipe too large",
                   "A recipe is a page of text; a file of more than 4 MiB is something else and is "
                   "not read.",
                   "", "", usage},
    DiagnosticCode{"E0121", "nested too deeply",
                   "A dotted key has too many names, or arrays and tables are nested too deeply. "
                   "No recipe needs more than a few levels.",
                   "", "", usage},
    DiagnosticCode{"E0122", "bad setting",
                   "--set takes KEY=VALUE with a dotted key, in the syntax of a recipe. --vary "
                   "takes KEY=FROM:TO:COUNT, or a list, KEY=VALUE,VALUE.",
                   "--set atmosphere.ground_albedo", "--set atmosphere.ground_albedo=0.3", usage},
    DiagnosticCode{"E0123", "too many errors",
                   "Only the first thousand diagnostics are shown. Fix those and check again.", "",
                   "", usage},
    DiagnosticCode{"E0124", "nothing to bake",
                   "The recipe asks for no asset. Each [bake.NAME] section asks for one; presets "
                   "bring none, since the recipe decides what to bake.",
                   "preset = \"earth\"", "preset = \"earth\"\n[bake.transmittance]", usage},
    DiagnosticCode{"E0125", "too many includes",
                   "The recipe reads more files than any sensible one does; it probably includes "
                   "files that include each other many times over.",
                   "", "", usage},
    DiagnosticCode{"E0126", "volume too large",
                   "The volume has more than 2^36 voxels. The message says how many bytes it would "
                   "need. Noises tile, so a smaller volume that repeats is usually enough. A mask "
                   "of blue noise, which is made in memory, has at most 2^26 voxels.",
                   "[noise.shape]\npreset = \"nubis_shape\"\n[bake.shape]\n"
                   "asset = \"noise_volume\"\nnoise = \"shape\"\nsize = [10000, 10000, 10000]",
                   "[noise.shape]\npreset = \"nubis_shape\"\n[bake.shape]\n"
                   "asset = \"noise_volume\"\nnoise = \"shape\"\nsize = [512, 512, 512]",
                   usage},
    DiagnosticCode{
        "E0128", "octave with too high a frequency",
        "Each octave has `lacunarity` times the frequency of the one before, and a cloud "
        "multiplies them by `noise_scale` or `detail_scale`. The octave that the message names has "
        "more than 1048576 lattice cells per tile, which no volume can show.",
        "[noise.n.channels.Y]\ntype = \"perlin\"\nfrequency = 4\noctaves = 16\n"
        "lacunarity = 3",
        "[noise.n.channels.Y]\ntype = \"perlin\"\nfrequency = 4\noctaves = 5\n"
        "lacunarity = 3",
        usage},
    DiagnosticCode{
        "E0129", "a set of channels that no file can hold",
        "A noise has one channel (Y or R), three (R, G, B) or four (R, G, B, A); a "
        "channel of type = \"constant\" can stand in for a missing one. `pack` needs "
        "the channels that its formula names: shape needs R, G, B and A, and detail "
        "needs R, G and B. An occupancy grid has one, three or four contents, and light of a "
        "cloud as many suns. An aerial "
        "perspective holds in_scatter and transmittance together only with three "
        "channels of light, and a combined table of scattering only with one or three.",
        "[noise.n.channels.R]\ntype = \"perlin\"\n"
        "[noise.n.channels.G]\ntype = \"worley\"",
        "[noise.n.channels.R]\ntype = \"perlin\"\n"
        "[noise.n.channels.G]\ntype = \"worley\"\n"
        "[noise.n.channels.B]\ntype = \"constant\"\nvalue = 0",
        usage},
};

}  // namespace

std::span<const DiagnosticCode> text_codes() { return text_table; }

}  // namespace skybake::config
