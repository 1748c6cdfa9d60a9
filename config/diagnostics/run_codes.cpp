// Errors of a run: files, checks of results, and the program itself.
#include <array>

#include "config/diagnostics/code_tables.h"

namespace skybake::config {
namespace {

constexpr std::array run_table = {
    DiagnosticCode{"E0300", "cannot open or read",
                   "A file does not exist, is a folder, or may not be read.",
                   "skybake check erth.toml", "skybake check earth.toml", input_or_output},
    DiagnosticCode{"E0301", "cannot write",
                   "A file could not be written completely: the disk is full, the folder may not "
                   "be written to, or the medium failed. No partial file is left behind.",
                   "", "", input_or_output},
    DiagnosticCode{
        "E0302", "output folder not usable",
        "The output folder cannot be created or is not a folder. The folder of a cache "
        "must be missing or empty, or hold the CACHEDIR.TAG that skybake writes into it.",
        "skybake cache gc --cache-dir ~/projects --max-size 10GiB",
        "skybake cache gc --cache-dir ~/.cache/skybake --max-size 10GiB", input_or_output},
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
    DiagnosticCode{"E0306", "too few threads",
                   "A library could not begin a thread that it cannot do without. The number of "
                   "threads is limited for a user by `ulimit -u` and for a container by pids.max, "
                   "and other processes of the user count too. skybake itself goes on with fewer "
                   "threads. Nothing is left half written.",
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
    DiagnosticCode{
        "E0412", "cover of a cloud that cannot be reached",
        "No coverage gives the cloud this cover. With coverage = 1 there may be less cloud than is "
        "asked for, since nothing grows where height profile, towers and noise are 0, and with "
        "coverage = 0 there may be more, since towers above 1 remain. Where the noise has one "
        "value "
        "in many columns, all of them fill at once. The message says what can be reached. Nothing "
        "is "
        "written.",
        "cover = \"99 %\"", "cover = \"90 %\"", failed_check},

    DiagnosticCode{"E0500", "internal error",
                   "skybake reached a state that its authors thought impossible. Please report the "
                   "recipe and the command line.",
                   "", "", internal},
};

}  // namespace

std::span<const DiagnosticCode> run_codes() { return run_table; }

}  // namespace skybake::config
