// Warnings. A run that has no errors ends with 0.
#include <array>

#include "config/diagnostics/code_tables.h"

namespace skybake::config {
namespace {

constexpr std::array warning_table = {
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
        "W0215", "a cloud volume without cloud",
        "No voxel holds cloud, so that the file is empty. That is what coverage = 0, or a scatter "
        "of no towers, gives, and what a threshold above all densities does.",
        "coverage = 0", "cover = \"40 %\"", 0},
    DiagnosticCode{
        "W0216", "a key of pictures that no picture uses",
        "[preview] has a key that no picture of the recipe uses, because the recipe bakes "
        "no cloud, or none of the tables that pictures of a sky are made from. Bakes do "
        "not depend on [preview]; `skybake preview` says what is missing.",
        "preset = \"earth\"\n[bake.transmittance]\n[preview]\nsun_elevation = \"20 deg\"",
        "preset = \"earth\"\n[bake.transmittance]\n[bake.multiple_scattering]\n[preview]\n"
        "sun_elevation = \"20 deg\"",
        0},
    DiagnosticCode{
        "W0217", "a tower that its tile moves or cuts",
        "A cloud repeats along x and y, so a tower outside the tile stands where one of its copies "
        "is "
        "within. Nothing reaches above the cloud's extent: a taller dome has a flat top.",
        "extent = [\"6 km\", \"6 km\", \"0.75 km\"]\n[clouds.c.towers.0]\nshape = \"dome\"\n"
        "foot = [\"30 km\", \"3 km\", \"0 m\"]\nsize = [\"1 km\", \"1 km\", \"9 km\"]",
        "extent = [\"6 km\", \"6 km\", \"0.75 km\"]\n[clouds.c.towers.0]\nshape = \"dome\"\n"
        "foot = [\"3 km\", \"3 km\", \"0 m\"]\nsize = [\"1 km\", \"1 km\", \"0.7 km\"]",
        0},
    DiagnosticCode{
        "W0218", "a single cloud that its tile cuts",
        "A picture of a single tile shows no copies of it, and cloud that reaches the tile's sides "
        "ends there in a straight wall. Show the layer instead (single = false), or give the cloud "
        "a larger extent, so that it stands free.",
        "[preview]\nsingle = true", "[preview]\nsingle = false", 0},
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
        "W0220", "a name that Windows does not allow",
        "Windows takes con, prn, aux, nul, com1 to com9 and lpt1 to lpt9 for devices, whatever "
        "ending follows, so that nobody can copy these files there.",
        "preset = \"earth\"\n[bake.con]\nasset = \"transmittance\"",
        "preset = \"earth\"\n[bake.transmittance]", 0},
    DiagnosticCode{"W0221", "a key that is set twice",
                   "Two options --set give the same key a value. The last one counts.",
                   "skybake bake earth.toml --set a.b=1 --set a.b=2",
                   "skybake bake earth.toml --set a.b=2", 0},
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

std::span<const DiagnosticCode> warning_codes() { return warning_table; }

}  // namespace skybake::config
