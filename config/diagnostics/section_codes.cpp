// Errors in what a recipe says of sweeps, noise, layers, particles and clouds.
#include <array>

#include "config/diagnostics/code_tables.h"

namespace skybake::config {
namespace {

constexpr std::array section_table = {
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
    DiagnosticCode{
        "E0133", "an asset of a cloud volume or a sequence that the recipe does not have",
        "`of` names the [bake.NAME] that an asset is made of: with asset = "
        "\"cloud_volume\" for occupancy, distances and light, and with `frames` for a "
        "flipbook. `clouds` of an environment names cloud volumes, and of a sequence one "
        "frame, such as NAME_0001. The recipe has no bake of that name, or that bake "
        "makes another asset.",
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
};

}  // namespace

std::span<const DiagnosticCode> section_codes() { return section_table; }

}  // namespace skybake::config
