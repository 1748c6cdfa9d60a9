#include "config/diagnostics/diagnostic_codes.h"

#include <algorithm>
#include <array>

namespace skybake::config {
namespace {

constexpr int usage = 2;
constexpr int input_or_output = 3;
constexpr int failed_check = 4;
constexpr int internal = 5;

constexpr std::array codes = {
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
    DiagnosticCode{"E0130", "unknown noise",
                   "`noise` names the [noise.NAME] to bake or to make a cloud of, and `detail` "
                   "names the one that erodes it; the recipe has no noise of that name. Presets of "
                   "clouds bring their noises along, unless the recipe has one of that name.",
                   "[noise.shape]\npreset = \"nubis_shape\"\n[bake.shape]\n"
                   "asset = \"noise_volume\"\nnoise = \"shap\"",
                   "[noise.shape]\npreset = \"nubis_shape\"\n[bake.shape]\n"
                   "asset = \"noise_volume\"\nnoise = \"shape\"",
                   usage},
    DiagnosticCode{
        "E0131", "pixel type that a format cannot hold",
        "EXR, VDB and vol files hold float and half. unorm8 and unorm16 exist in bin, npy, "
        "PNG, DDS and KTX2 files, unorm8 in TGA files too; bc4 and bc6h in DDS and "
        "KTX2 files; fp8 and fp16 in nvdb files. Types of blocks are for volumes of one, "
        "two or three channels, and usda files refer to VDB files. A section writes all "
        "its formats with one pixel type: bake the noise in two sections to have both.",
        "[noise.shape]\npreset = \"nubis_shape\"\n[bake.shape]\n"
        "asset = \"noise_volume\"\nnoise = \"shape\"\npixel_type = \"unorm8\"",
        "[noise.shape]\npreset = \"nubis_shape\"\n[bake.shape]\n"
        "asset = \"noise_volume\"\nnoise = \"shape\"\npixel_type = \"unorm8\"\n"
        "formats = [\"bin\"]",
        usage},

    DiagnosticCode{"E0132", "unknown cloud",
                   "`cloud` names the [clouds.NAME] to bake, and the recipe has none of that name.",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"d\"\n"
                   "size = [64, 64, 16]",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]",
                   usage},
    DiagnosticCode{"E0133", "occupancy or light without a cloud volume",
                   "`of` names the [bake.NAME] with asset = \"cloud_volume\" whose empty cells are "
                   "marked, or whose light is found. The recipe has no bake of that name, or that "
                   "bake makes another asset.",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]\n[bake.o]\n"
                   "asset = \"occupancy\"\nof = \"c\"",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]\n[bake.o]\n"
                   "asset = \"occupancy\"\nof = \"v\"",
                   usage},
    DiagnosticCode{"E0134", "no such channel of the cloud volume",
                   "A cloud volume has the channel Y; with channels = \"noise\" it has those of "
                   "its noise, if there are several and they are not packed.",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]\n[bake.o]\n"
                   "asset = \"occupancy\"\nof = \"v\"\n"
                   "channel = \"G\"",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]\n[bake.o]\n"
                   "asset = \"occupancy\"\nof = \"v\"\n"
                   "channel = \"Y\"",
                   usage},

    DiagnosticCode{
        "E0135", "bad range of a sweep",
        "A range in [sweep] has a `from`, a different `to`, and a `count`, unless `sobol` says how "
        "many points cover all ranges without a count. If the key takes whole numbers, the count "
        "must give whole numbers, and a log range must be above 0. Keys that take strings or "
        "several numbers have no ranges: list their values.",
        "[sweep]\n\"noise.shape.seed\" = { from = 1, to = 4, count = 3 }",
        "[sweep]\n\"noise.shape.seed\" = { from = 1, to = 4, count = 4 }", usage},
    DiagnosticCode{
        "E0136", "zipped keys need equally many values",
        "`zip` names paths that vary in lockstep: each of them varies, by a list or a range "
        "with a count, is named once, and has as many values as the others.",
        "[sweep]\n\"noise.n.seed\" = [1, 2, 3]\n\"clouds.c.coverage\" = [0.3, 0.6]\n"
        "zip = [\"noise.n.seed\", \"clouds.c.coverage\"]",
        "[sweep]\n\"noise.n.seed\" = [1, 2, 3]\n\"clouds.c.coverage\" = [0.3, 0.6, 0.9]\n"
        "zip = [\"noise.n.seed\", \"clouds.c.coverage\"]",
        usage},
    DiagnosticCode{
        "E0137", "too many variants",
        "The cross product of everything that varies has more than 100000 variants. Vary "
        "paths in lockstep with `zip`, or cover their ranges with `sobol` points.",
        "", "", usage},

    DiagnosticCode{
        "E0138", "unknown layer",
        "`layers` names those of [atmosphere.layers.NAME] whose light is baked. The atmosphere has "
        "no layer of that name, or the layer is switched off or named twice.",
        "preset = \"earth\"\n[bake.sky_view]\nsun_elevations = [\"30 deg\"]\n"
        "orders = \"single\"\nlayers = [\"haze\"]",
        "preset = \"earth\"\n[bake.sky_view]\nsun_elevations = [\"30 deg\"]\n"
        "orders = \"single\"\nlayers = [\"mie\"]",
        usage},
    DiagnosticCode{"E0139", "key that contradicts what a layer is made of",
                   "A layer with phase = \"mie\" gets its scattering, its extinction and its phase "
                   "function from its particles; one with `gas` gets its coefficients from the "
                   "gas, one with `aerosol` or `components` from their spheres, and one with "
                   "`optical_depth` or `visibility` from these. A coefficient would contradict "
                   "them.",
                   "preset = \"earth\"\n[particles.fog]\npreset = \"fog\"\n"
                   "[atmosphere.layers.fog]\nprofile = \"slab\"\nbottom_altitude = \"0 m\"\n"
                   "top_altitude = \"200 m\"\nphase = { mie = \"fog\" }\n"
                   "number_density = \"15 /cm3\"\nscattering = \"0.01 /m\"",
                   "preset = \"earth\"\n[particles.fog]\npreset = \"fog\"\n"
                   "[atmosphere.layers.fog]\nprofile = \"slab\"\nbottom_altitude = \"0 m\"\n"
                   "top_altitude = \"200 m\"\nphase = { mie = \"fog\" }\n"
                   "number_density = \"15 /cm3\"",
                   usage},
    DiagnosticCode{"E0140", "unknown particles",
                   "A layer or a bake names particles; the recipe has no [particles.NAME] of that "
                   "name. In `components` OPAC's kinds of spheres have names too.",
                   "[particles.fog]\npreset = \"fog\"\n[bake.phase]\nparticles = \"frog\"",
                   "[particles.fog]\npreset = \"fog\"\n[bake.phase]\nparticles = \"fog\"", usage},
    DiagnosticCode{
        "E0141", "phase function without particles",
        "A bake of a phase function must name the particles that scatter, or a layer of the "
        "atmosphere.",
        "[particles.fog]\npreset = \"fog\"\n[bake.phase]\nsize = 1024",
        "[particles.fog]\npreset = \"fog\"\n[bake.phase]\nparticles = \"fog\"\nsize = 1024", usage},
    DiagnosticCode{
        "E0142", "size that the table cannot have",
        "Each axis of a table has an end point on its first and on its last texel, so it needs at "
        "least two texels; an axis that the table does not use has one. A table of scattering "
        "holds `nu_size` sub-images side by side, so `nu_size` must divide the first number; the "
        "second must be even, since half of it is for rays to the ground. An environment that is a "
        "cube is six times as high as wide, and an octahedral one is a square.",
        "preset = \"earth\"\n[bake.bruneton]\nsize = [256, 128, 32]\nnu_size = 7",
        "preset = \"earth\"\n[bake.bruneton]\nsize = [256, 128, 32]\nnu_size = 8", usage},

    DiagnosticCode{
        "E0144", "particles whose scattering cannot be computed",
        "Spheres with the refractive index of air scatter nothing; the index of water is known "
        "from 200 nm to 4 um, and that of `indices` between its ends; some spheres that count must "
        "lie between smallest_radius and largest_radius; and the largest spheres may have a "
        "circumference of 300 000 "
        "wavelengths, which they reach in rain of some 25 mm/h in blue light. A layer of "
        "particles, like any other, may have an extinction of at most 1e6 /m.",
        "[particles.p]\nmaterial = \"constant\"\nrefractive_index = 1\n"
        "effective_radius = \"1 um\"\n[bake.phase]\nparticles = \"p\"",
        "[particles.p]\nmaterial = \"constant\"\nrefractive_index = 1.5\n"
        "effective_radius = \"1 um\"\n[bake.phase]\nparticles = \"p\"",
        usage},

    DiagnosticCode{
        "E0145", "gas or aerosol whose coefficients cannot be computed",
        "Each gas and each kind of spheres is known at visible wavelengths and somewhat beyond; "
        "the "
        "message says from where to where. An optical depth or a visibility of spheres needs them "
        "at 550 nm. The profile must have some density between the ground and the top of the air, "
        "over which the amount is spread, and its extinction must be at most 1e6 /m.",
        "preset = \"earth\"\nwavelengths = [\"2000 nm\"]\n[atmosphere.layers.rayleigh]\n"
        "scattering = \"0 /m\"\n[atmosphere.layers.ozone]\nabsorption = \"0 /m\"\n"
        "[atmosphere.layers.o3]\nprofile = \"standard\"\ngas = \"ozone\"\ncolumn = \"300 DU\"",
        "preset = \"earth\"\nwavelengths = [\"600 nm\"]\n[atmosphere.layers.rayleigh]\n"
        "scattering = \"0 /m\"\n[atmosphere.layers.ozone]\nabsorption = \"0 /m\"\n"
        "[atmosphere.layers.o3]\nprofile = \"standard\"\ngas = \"ozone\"\ncolumn = \"300 DU\"",
        usage},
    DiagnosticCode{
        "E0147", "wavelengths that an asset cannot hold",
        "If the recipe has [color] with a space, light itself (sky_view, environment, irradiance, "
        "aerial_perspective, bruneton) is held as colours, which are made of two wavelengths or "
        "more, all of them visible. Other assets hold wavelengths, a channel for each. Of more "
        "than four, assets NAME_1, NAME_2 and so on hold four each, so no other section may have "
        "these names; `packet` asks for one of them.",
        "preset = \"earth\"\nwavelengths = \"550 nm\"\n[color]\n"
        "[bake.sky_view]\nsun_elevations = [\"30 deg\"]",
        "preset = \"earth\"\nwavelengths = \"best 4\"\n[color]\n"
        "[bake.sky_view]\nsun_elevations = [\"30 deg\"]",
        usage},
    DiagnosticCode{
        "E0174", "frames of what stands still",
        "`frames` bakes a volume once per frame in time, as assets NAME_0001, NAME_0002 and so on, "
        "and `frame` bakes one of them. Something must move for that: a noise that has a `period`, "
        "or towers with `life` of a cloud that has one. No other section may have the name of a "
        "frame.",
        "[noise.base]\nchannels.Y.type = \"perlin\"\n"
        "[bake.fog]\nasset = \"noise_volume\"\nnoise = \"base\"\nframes = 48",
        "[noise.base]\nperiod = 48\nchannels.Y.type = \"perlin\"\n"
        "[bake.fog]\nasset = \"noise_volume\"\nnoise = \"base\"\nframes = 48",
        usage},
    DiagnosticCode{
        "E0182", "towers that do not fit into a loop",
        "A tower with `life` grows, stays and dissolves within the loop of its cloud, in that "
        "order, and begins anew in the next loop. So the cloud must have a `period`, the three "
        "shares must not add up to more than 1, and those of growth and decay must be above 0, "
        "because the tower would jump otherwise. Towers without `life` must be carried by whole "
        "tiles per loop.",
        "[noise.n]\nchannels.Y.type = \"perlin\"\n[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"4 km\", \"4 km\", \"1 km\"]\nperiod = 48\n[[clouds.c.towers]]\n"
        "center = [0.5, 0.5]\nsigma = [0.1, 0.1]\namplitude = 1\nlife = [0.5, 0.5, 0.5]",
        "[noise.n]\nchannels.Y.type = \"perlin\"\n[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"4 km\", \"4 km\", \"1 km\"]\nperiod = 48\n[[clouds.c.towers]]\n"
        "center = [0.5, 0.5]\nsigma = [0.1, 0.1]\namplitude = 1\nlife = [0.4, 0.3, 0.3]",
        usage},
    DiagnosticCode{
        "E0189", "clear sky that a cloud does not have above it",
        "contents = \"clear_sky_radiance\" of a cloud_light is the light of the recipe's own sky, "
        "seen from the top of the cloud's layer. So the recipe needs an atmosphere, the layer must "
        "end below the top of the air, and the air above it must scatter light. Without an "
        "atmosphere, contents = \"sky_radiance\" is the light of a uniform sky.",
        "[noise.n.channels.Y]\ntype = \"worley\"\n[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"4 km\", \"4 km\", \"1 km\"]\n[bake.v]\nasset = \"cloud_volume\"\n"
        "cloud = \"c\"\nsize = [64, 64, 16]\n[bake.l]\nasset = \"cloud_light\"\nof = \"v\"\n"
        "contents = \"clear_sky_radiance\"\nsun_elevations = \"30 deg\"",
        "preset = \"earth\"\n[noise.n.channels.Y]\ntype = \"worley\"\n[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"4 km\", \"4 km\", \"1 km\"]\n[bake.v]\nasset = \"cloud_volume\"\n"
        "cloud = \"c\"\nsize = [64, 64, 16]\n[bake.l]\nasset = \"cloud_light\"\nof = \"v\"\n"
        "contents = \"clear_sky_radiance\"\nsun_elevations = \"30 deg\"",
        usage},
    DiagnosticCode{
        "E0143", "atmosphere that the convention cannot express",
        "takram's AtmosphereParameters have three wavelengths and at most three layers: an "
        "exponential one that scatters by Rayleigh's phase function and absorbs nothing, an "
        "exponential one of phase cornette_shanks, and a tent that only absorbs. Tables of any "
        "other atmosphere would be read with wrong parameters. convention = \"bruneton\" takes any "
        "atmosphere.",
        "preset = \"takram\"\n[atmosphere.layers.fog]\nprofile = \"slab\"\n"
        "bottom_altitude = \"0 m\"\ntop_altitude = \"100 m\"\nscattering = \"1e-4 /m\"\n"
        "phase = \"isotropic\"\n"
        "[bake.scattering]\nasset = \"bruneton\"\nconvention = \"takram\"",
        "preset = \"takram\"\n[bake.scattering]\nasset = \"bruneton\"\nconvention = \"takram\"",
        usage},
    DiagnosticCode{
        "E0150", "cells that do not tile",
        "A cloud volume repeats along x and y, and so do the cells of its occupancy. If the cell "
        "does not divide the size, the last cell sticks out of the tile, and a runtime that "
        "repeats both finds the wrong cells for its voxels. In the same way each level of `mips` "
        "needs an even number of cells, or one cell, along each axis of the level before.",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [68, 68, 17]\n[bake.o]\n"
        "asset = \"occupancy\"\nof = \"v\"\ncell = 8",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [68, 68, 17]\n[bake.o]\n"
        "asset = \"occupancy\"\nof = \"v\"",
        usage},
    DiagnosticCode{
        "E0156", "channels that a weather map cannot have",
        "A weather map has the channels of its noise. `covered`, `full`, `streaks` and `yields_to` "
        "have one item for each of them, or one for all. Of a channel, no more may be `full` than "
        "is `covered`, and it may yield to another channel that yields to none. "
        "content = \"directions\" takes a noise of three channels, R, G and B.",
        "[noise.w.channels.Y]\ntype = \"worley\"\n[bake.m]\nasset = \"weather_map\"\n"
        "noise = \"w\"\ncovered = 0.2\nfull = 0.3",
        "[noise.w.channels.Y]\ntype = \"worley\"\n[bake.m]\nasset = \"weather_map\"\n"
        "noise = \"w\"\ncovered = 0.3\nfull = 0.2",
        usage},
    DiagnosticCode{
        "E0160", "asset or file that a target cannot load",
        "`target` names the program that files are for. It decides the keys of files that a "
        "section leaves out. It cannot load every asset, nor every mapping of an environment, and "
        "not from any file: the message says what it loads. Give the section another target, or "
        "leave the key out.",
        "preset = \"earth\"\n[bake.sky_view]\nsun_elevation = \"20 deg\"\ntarget = \"pbrt\"",
        "preset = \"earth\"\n[bake.sky_view]\nsun_elevation = \"20 deg\"\ntarget = \"three\"",
        usage},
    DiagnosticCode{
        "E0170", "unknown volume",
        "`volume` of a cloud names the [volumes.NAME] whose density it takes, and the recipe has "
        "none of that name.",
        "[volumes.v]\nfile = \"v.raw\"\nformat = \"raw\"\nsize = [2, 2, 2]\n"
        "voxel_size = [\"1 m\", \"1 m\", \"1 m\"]\n"
        "[clouds.c]\nvolume = \"w\"\nextent = [\"2 m\", \"2 m\", \"2 m\"]",
        "[volumes.v]\nfile = \"v.raw\"\nformat = \"raw\"\nsize = [2, 2, 2]\n"
        "voxel_size = [\"1 m\", \"1 m\", \"1 m\"]\n"
        "[clouds.c]\nvolume = \"v\"\nextent = [\"2 m\", \"2 m\", \"2 m\"]",
        usage},
    DiagnosticCode{
        "E0171", "suns or harmonics that light of a cloud does not have",
        "Each sun of a cloud_light has an elevation and, where `sun_azimuths` is given, an "
        "azimuth. "
        "Harmonics of degree d have (d + 1)^2 coefficients, and a part holds four of them: degree "
        "0 "
        "and 1 have one part, degree 2 has three and degree 3 four.",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [64, 64, 16]\n[bake.l]\n"
        "asset = \"cloud_light\"\nof = \"v\"\ncontents = \"sky_visibility\"\npart = 2",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [64, 64, 16]\n[bake.l]\n"
        "asset = \"cloud_light\"\nof = \"v\"\ncontents = \"sky_visibility\"\ndegree = 2\npart = 2",
        usage},

    DiagnosticCode{
        "E0175", "distances that cannot be stored",
        "A cloud_distance holds metres to the cloud, 0 at its surface and negative within it. Its "
        "`range` begins at or below 0 and ends above 0, and its `contents` begin with "
        "\"distance\".",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [64, 64, 16]\n[bake.d]\n"
        "asset = \"cloud_distance\"\nof = \"v\"\nrange = [\"10 m\", \"4 km\"]",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [64, 64, 16]\n[bake.d]\n"
        "asset = \"cloud_distance\"\nof = \"v\"\nrange = [\"-250 m\", \"4 km\"]",
        usage},
    DiagnosticCode{
        "E0176", "radiance of several suns in one file",
        "A cloud_light with `contents = \"sun_radiance\"` or \"clear_sky_radiance\" holds "
        "harmonics of the light of one sun or of its sky, four coefficients in a file. "
        "Other suns are assets of their own.",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [64, 64, 16]\n[bake.l]\n"
        "asset = \"cloud_light\"\nof = \"v\"\ncontents = \"sun_radiance\"\n"
        "sun_elevations = [\"60 deg\", \"30 deg\", \"10 deg\"]",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "size = [64, 64, 16]\n[bake.l]\n"
        "asset = \"cloud_light\"\nof = \"v\"\ncontents = \"sun_radiance\"\n"
        "sun_elevations = [\"30 deg\"]",
        usage},
    DiagnosticCode{
        "E0172", "environment that cannot be made",
        "Keys of an environment contradict each other. Clouds are volumes of densities, each of "
        "which is named once, and the camera below or above them is in the air. Faces of a cube "
        "and octahedra halve to four texels at least. Levels of roughness need `mips` above 1, "
        "since the first level is the map itself.",
        "preset = \"earth\"\n[bake.environment]\nsun_elevation = \"20 deg\"\n"
        "level_content = \"ggx\"",
        "preset = \"earth\"\n[bake.environment]\nsun_elevation = \"20 deg\"\n"
        "level_content = \"ggx\"\nmips = 6",
        usage},

    DiagnosticCode{"E0300", "cannot open or read",
                   "A file does not exist, is a folder, or may not be read.",
                   "skybake check erth.toml", "skybake check earth.toml", input_or_output},
    DiagnosticCode{"E0301", "cannot write",
                   "A file could not be written completely: the disk is full, the folder may not "
                   "be written to, or the medium failed. No partial file is left behind.",
                   "", "", input_or_output},
    DiagnosticCode{"E0302", "output folder not usable",
                   "The output folder cannot be created or is not a folder.", "", "",
                   input_or_output},
    DiagnosticCode{"E0303", "would overwrite a file that is not skybake's",
                   "A file of that name exists, and no manifest in its folder says that skybake "
                   "wrote it. Move it away, choose another folder with -o, or pass --force.",
                   "skybake init notes.toml", "skybake init earth.toml", input_or_output},
    DiagnosticCode{"E0304", "damaged, or not the expected kind of file",
                   "The file cannot be read as the expected kind, or it lacks the metadata that "
                   "skybake writes into every file. If a manifest has another format, the message "
                   "names the release that wrote it: bake its recipe again. A map over a cloud "
                   "must be a PNG, TIFF or OpenEXR picture with values from 0 to 1. A volume must "
                   "have finite values, and the message names the first that is not.",
                   "", "", input_or_output},

    DiagnosticCode{"E0401", "not finite",
                   "A baked value is infinite or not a number. Nothing is written.", "", "",
                   failed_check},
    DiagnosticCode{"E0402", "out of the pixel type's range",
                   "A baked value is beyond what the pixel type holds: 65504 for half, [0, 1] for "
                   "unorm8 and unorm16. Nothing is clamped and nothing is written. Choose "
                   "pixel_type = \"float\", give the channel of a noise a `remap`, `smoothstep` or "
                   "`clamp`, or bake content = \"transmittance\" in place of an optical depth.",
                   "pixel_type = \"half\"", "pixel_type = \"float\"", failed_check},
    DiagnosticCode{"E0403", "max_error cannot be reached",
                   "No table up to the largest size, and no `cell` of a cloud_light, keeps the "
                   "lookup error within `max_error`; the message names the error that it reached. "
                   "Choose a larger `max_error`, or a mapping or pixel type that suits the asset "
                   "better. Nothing is written.",
                   "max_error = 1e-7\npixel_type = \"half\"", "max_error = 0.01", failed_check},
    DiagnosticCode{
        "E0404", "max_texel_error cannot be reached",
        "Even the finest quadrature does not bring the texel error within `max_texel_error`; the "
        "message names the error that it reached. Nothing is written.",
        "max_texel_error = 1e-5", "max_texel_error = \"0.2 %\"", failed_check},
    DiagnosticCode{
        "E0405", "physical check failed",
        "A baked table breaks a law that it must obey, such as a transmittance above 1 or energy "
        "from nowhere, or the light of all orders could not be solved for, as in air with an "
        "optical depth above 100, in air higher than 100 radii of its ground, or with much "
        "scattering of g beyond 0.95. Such air is beyond skybake; everything else is a bug: please "
        "report the recipe. Nothing is written.",
        "", "", failed_check},

    DiagnosticCode{"E0406", "variants of a sweep failed",
                   "Some variants could not be baked; index.csv lists them, and error.json in the "
                   "folder of each says why. The others are complete. Fix the recipe or the values "
                   "and sweep again: only what is missing is baked.",
                   "", "", failed_check},

    DiagnosticCode{
        "E0407", "probes that would miss a wrong file",
        "Too few of all places that were tried tell the asset from a file that is wrong: reversed "
        "along an axis, with two axes exchanged, half a texel off, or empty. Its probes would pass "
        "such a file, so nothing is written. This is a bug: please report the recipe.",
        "", "", failed_check},

    DiagnosticCode{
        "E0411", "share of a weather map that cannot be reached",
        "A channel of the noise has one value at many texels, so that no threshold divides them "
        "and the wanted share is not between its parts. Worley noise clamped at 0 and constants "
        "are like that. The message names the value and the shares below and above it. Nothing is "
        "written.",
        "covered = 0.5", "covered = 1", failed_check},

    DiagnosticCode{"E0500", "internal error",
                   "skybake reached a state that its authors thought impossible. Please report the "
                   "recipe and the command line.",
                   "", "", internal},

    DiagnosticCode{"W0201", "values below the pixel type's normal range",
                   "Some values are so small that the pixel type stores them with fewer digits or "
                   "as 0. Lookups there lose precision: choose pixel_type = \"float\", or "
                   "content = \"optical_depth\" for dense air.",
                   "pixel_type = \"half\"", "pixel_type = \"float\"", 0},
    DiagnosticCode{"W0202", "very large optical depth",
                   "This layer lets less than e^-100 of the light pass straight up through the "
                   "whole atmosphere. That is rarely intended; most often a coefficient per "
                   "kilometre was given as one per metre.",
                   "scattering = \"0.0331 /m\"", "scattering = \"0.0331 /km\"", 0},
    DiagnosticCode{"W0203", "octaves too fine for the voxels",
                   "An octave has so many lattice cells that there are fewer than four voxels per "
                   "cell: it aliases, and a lookup between voxels has little to do with the noise. "
                   "Each bake warns once and names the size that would show all octaves. Presets "
                   "that copy an aliasing source (thesis, takram_shape, takram_detail) say so with "
                   "`aliases = true` and trigger this only below their own size.",
                   "[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 16\n[bake.n]\n"
                   "asset = \"noise_volume\"\nnoise = \"n\"\nsize = [32, 32, 32]",
                   "[noise.n.channels.Y]\ntype = \"worley\"\nfrequency = 8\n[bake.n]\n"
                   "asset = \"noise_volume\"\nnoise = \"n\"\nsize = [32, 32, 32]",
                   0},
    DiagnosticCode{"W0204", "tower narrower than a voxel",
                   "In its narrowest direction the tower's standard deviation is less than one "
                   "voxel of the volume, so that it falls between voxels: what is left of it "
                   "depends on where they happen to lie. Each bake warns once.",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[clouds.c.towers.0]\n"
                   "center = [0.5, 0.5]\nsigma = [0.01, 0.1]\n"
                   "amplitude = 1\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[clouds.c.towers.0]\n"
                   "center = [0.5, 0.5]\nsigma = [0.1, 0.1]\n"
                   "amplitude = 1\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]",
                   0},
    DiagnosticCode{
        "W0205", "not what takram's loader reads",
        "@takram/three-atmosphere assumes certain sizes, half floats and one stack of "
        "slices: it reads any other table wrongly, or not at all. Other readers of its "
        "convention may accept it. STBNLoader of @takram/three-geospatial takes masks of "
        "blue noise of 128 x 128 pixels and 64 frames.",
        "preset = \"takram\"\n[bake.scattering]\nasset = \"bruneton\"\n"
        "convention = \"takram\"\nsize = [128, 64, 16]",
        "preset = \"takram\"\n[bake.scattering]\nasset = \"bruneton\"\n"
        "convention = \"takram\"",
        0},
    DiagnosticCode{
        "W0208", "octave that adds nothing",
        "At this size every voxel lies on a lattice point of the octave, and gradient noise is 0 "
        "there. The octave takes its share of the weight and adds nothing. That does not matter in "
        "a draft; otherwise make the volume larger or its size odd, or choose a lower frequency.",
        "[noise.n]\naliases = true\nsize = [32, 32, 32]\n[noise.n.channels.Y]\n"
        "type = \"perlin\"\nfrequency = 64\n[bake.n]\n"
        "asset = \"noise_volume\"\nnoise = \"n\"",
        "[noise.n]\nsize = [32, 32, 32]\n[noise.n.channels.Y]\n"
        "type = \"perlin\"\nfrequency = 8\n[bake.n]\n"
        "asset = \"noise_volume\"\nnoise = \"n\"",
        0},
    DiagnosticCode{
        "W0209", "names that differ only in case",
        "Two bakes have names that differ only in capital letters. They are two files on Linux and "
        "one on most disks of macOS and Windows, where the second overwrites the first.",
        "preset = \"earth\"\n[bake.t]\nasset = \"transmittance\"\n[bake.T]\n"
        "asset = \"irradiance\"",
        "preset = \"earth\"\n[bake.t]\nasset = \"transmittance\"\n[bake.irradiance]", 0},
    DiagnosticCode{
        "W0210", "an extent that is rounded up",
        "A cloud volume with `voxel_size` has cubes of exactly that edge. Where the cloud's extent "
        "is not a whole number of them, the volume is longer by part of a voxel, and the cloud is "
        "stretched to fit: towers, maps and noise keep their places in the tile, and the tile "
        "repeats with the longer extent. The manifest's axes state it.",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "voxel_size = \"70 m\"",
        "[noise.n.channels.Y]\ntype = \"worley\"\n"
        "[clouds.c]\nnoise = \"n\"\n"
        "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
        "asset = \"cloud_volume\"\ncloud = \"c\"\n"
        "voxel_size = \"75 m\"",
        0},
    DiagnosticCode{"W0211", "voxels that are not cubes",
                   "A VDB file states the edges of its voxels along each axis, and these differ "
                   "here. Many programs assume that they are equal: OpenVDB's own ray tracer "
                   "refuses such a grid, and others show it stretched. Choose a size in the "
                   "proportions of the extent, or voxel_size instead.",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 64]",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n"
                   "[clouds.c]\nnoise = \"n\"\n"
                   "extent = [\"6 km\", \"6 km\", \"1.5 km\"]\n[bake.v]\n"
                   "asset = \"cloud_volume\"\ncloud = \"c\"\n"
                   "size = [64, 64, 16]",
                   0},
    DiagnosticCode{
        "W0212", "an image that engines do not import",
        "Unreal, Unity, Godot and the graphics interfaces below them take images of at most 16384 "
        "rows and columns; Godot 3 aborts the import. An atlas lays the slices in rows and "
        "columns. Without `layout`, a volume whose stack would be too high becomes an atlas.",
        "[noise.n.channels.Y]\ntype = \"worley\"\n[bake.n]\n"
        "asset = \"noise_volume\"\nnoise = \"n\"\nsize = [256, 256, 128]\n"
        "layout = \"stack\"",
        "[noise.n.channels.Y]\ntype = \"worley\"\n[bake.n]\n"
        "asset = \"noise_volume\"\nnoise = \"n\"\nsize = [256, 256, 128]",
        0},
    DiagnosticCode{"W0213", "an atlas with empty cells",
                   "Engines assume that an atlas has as many slices as columns times rows. Where "
                   "the slices do not fill the cells, engines read slices of zeros at the end, and "
                   "the volume no longer tiles. Without `columns` skybake chooses a divisor of the "
                   "number of slices; a prime number of them has none that fits.",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n[bake.n]\n"
                   "asset = \"noise_volume\"\nnoise = \"n\"\nsize = [32, 32, 32]\n"
                   "layout = \"atlas\"\ncolumns = 6",
                   "[noise.n.channels.Y]\ntype = \"worley\"\n[bake.n]\n"
                   "asset = \"noise_volume\"\nnoise = \"n\"\nsize = [32, 32, 32]\n"
                   "layout = \"atlas\"\ncolumns = 8",
                   0},
    DiagnosticCode{
        "W0219", "frames that do not make a loop",
        "The number of frames is not a multiple of the `period` of a noise or a cloud, "
        "so that the last frame does not lead to the first. That is right for a shot that does not "
        "repeat.",
        "period = 48\nframes = 40", "period = 48\nframes = 48", 0},
    DiagnosticCode{"W0214", "lookups far from the truth",
                   "Between its texels the asset is so far off that it is of little use: the root "
                   "mean square of the lookup errors is 0.3 or more, where 1 is what the error "
                   "figures are relative to. Its texels are right; they "
                   "are too few for how fast the light changes between them, as it does in layers "
                   "of a metre, on planets as large as their air, or in tables of a few texels. "
                   "Choose a larger size, or a mapping with more texels where the message says.",
                   "size = [2, 2]", "size = [64, 32]", 0},
    DiagnosticCode{
        "W0301", "the cache could not keep an asset",
        "The bake succeeded, but its assets could not be put into the cache: its folder may not be "
        "written to, or the disk is full. The next bake elsewhere will take as long.",
        "", "", 0},
    DiagnosticCode{"W0302", "pictures without labels",
                   "The font DejaVu Sans was not found, so the axes of charts have no numbers. "
                   "Debian's package fonts-dejavu-core has it.",
                   "", "", 0},
    DiagnosticCode{"W0303", "an asset with other values was kept",
                   "A bake of part of a recipe (--only) keeps the other assets of the folder. One "
                   "of them was baked with values that the recipe no longer has, so the assets of "
                   "the folder do not match. Bake the whole recipe.",
                   "", "", 0},
    DiagnosticCode{"W0304", "file that does not match its manifest",
                   "A file that is previewed was changed or replaced after the bake, so its "
                   "errors, statistics and hashes in manifest.json are those of another file. Bake "
                   "again, or preview the file in a folder of its own.",
                   "", "", 0},
    DiagnosticCode{"W0305", "trouble with the cache on a server",
                   "The bake succeeded, but the server of --cache failed or held damaged assets, "
                   "which were baked instead, so that the bake took longer. After three failures "
                   "the server is left alone for the rest of the run, and after three damaged "
                   "assets it is no longer read. A damaged asset is replaced by the one that was "
                   "baked. Status 403 or 405 of a PUT says that the server may only be read, and "
                   "409 that its folder does not exist.",
                   "", "", 0},
};

}  // namespace

std::span<const DiagnosticCode> diagnostic_codes() { return codes; }

const DiagnosticCode* find_diagnostic_code(std::string_view code) {
    for (const DiagnosticCode& entry : codes) {
        if (entry.code == code) return &entry;
    }
    return nullptr;
}

int exit_code(std::span<const Diagnostic> diagnostics) {
    int result = 0;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity != Severity::error) continue;
        const DiagnosticCode* code = find_diagnostic_code(diagnostic.code);
        result = std::max(result, code ? code->exit_code : internal);
    }
    return result;
}

}  // namespace skybake::config
