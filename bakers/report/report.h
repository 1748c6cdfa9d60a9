// Reports what accuracy costs. The report of an asset lists its variants (measurement.h), each with the
// time, the error and the bytes that a bake of it has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "bakers/report/measurement.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"
#include "config/sections/file_formats.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// One variant of an asset. For the fronts, errors are compared to two digits.
struct ReportRow {
    std::string asset;  // NAME of [bake.NAME]
    std::string family;
    std::string variant;
    std::string baseline;
    bool of_recipe = false;
    std::vector<int> size;  // texels along u, v; voxels along x, y, z
    PixelType pixel_type = PixelType::float32;
    std::uint64_t file_bytes = 0;
    double time_ms = 0;   // processor time of making the texels or voxels on one thread
    double write_ms = 0;  // processor time of encoding the files in memory on one thread
    ErrorFigures texel;
    ErrorFigures lookup;
    bool on_time_front = false;   // time against lookup.rms
    bool on_bytes_front = false;  // bytes against lookup.rms
};

struct AssetReport {
    std::string name;
    std::string kind;       // "transmittance", "multiple_scattering", "noise_volume"
    std::string reference;  // what errors were measured against
    std::string scale;      // what an error of 1 means
    std::string timing;     // what the times mean
    int texel_points = 0;   // the most texels that were compared
    int lookup_points = 0;
    int repetitions = 0;             // each time is the median of this many
    std::optional<SkyError> sky;     // of the recipe's asset, if its light is compared
    std::vector<std::string> notes;  // what was left out, and why
    std::vector<ReportRow> rows;
};

struct ReportOptions {
    int threads = 0;     // for references only; 0: as many as the machine has
    bool quick = false;  // fewer repetitions and points
    Progress* progress = nullptr;
    Intermediates* intermediates = nullptr;  // what the reports of a recipe share; null: nothing
};

// Makes and measures the variants for one section of a recipe, which `load` reads. Variants that the
// recipe's other keys do not allow are left out. Errors are pure functions of the parameters; times
// are not. If the user interrupts, there is neither a value nor a diagnostic. Diagnostics are those of
// bake_asset for the recipe itself.
Outcome<AssetReport> report_asset(const LoadRecipe& load, const Recipe& recipe, const Bake& bake,
                                  const ReportOptions& options);

}  // namespace skybake
