// Errors in what a recipe asks for: assets that cannot be made as it says.
#include <array>

#include "config/diagnostics/code_tables.h"

namespace skybake::config {
namespace {

constexpr std::array asset_table = {
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
        "E0177", "two files of one name",
        "Two files of a recipe would have one name, so that the second would overwrite the first: "
        "a companion such as NAME.json or a file of a target beside another asset's, the "
        "manifest.json of every bake, or names that differ only in capital letters, which are one "
        "file on most disks of macOS and Windows.",
        "preset = \"earth\"\n[bake.t]\nasset = \"transmittance\"\n[bake.T]\n"
        "asset = \"irradiance\"",
        "preset = \"earth\"\n[bake.t]\nasset = \"transmittance\"\n[bake.irradiance]",
        usage},
    DiagnosticCode{
        "E0178", "a name that is too long for a file",
        "Names of files have at most 255 bytes, with the ending of the longest of an asset's files: "
        "`.mip1.exr` or `.babylon.js`, for example. Give the asset a shorter name.",
        "", "", usage},
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
};

}  // namespace

std::span<const DiagnosticCode> asset_codes() { return asset_table; }

}  // namespace skybake::config
