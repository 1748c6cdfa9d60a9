// Reports what accuracy costs. The report of an asset lists its variants (variants.h), each with the
// time, the error and the bytes that a bake of it has.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "bakers/report/variants.h"
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
    config::PixelType pixel_type = config::PixelType::float32;
    std::uint64_t file_bytes = 0;
    double time_ms = 0;   // processor time of making the texels or voxels on one thread
    double write_ms = 0;  // processor time of encoding the files in memory on one thread
    ErrorFigures texel;
    ErrorFigures lookup;
    bool on_time_front = false;   // time against lookup.rms
    bool on_bytes_front = false;  // bytes against lookup.rms
};

// The cost and savings of one way of skipping empty cells.
struct SkippingRow {
    std::string structure;            // "no skipping", "exact, Chebyshev leaps"
    double occupied_share = 0;        // of the cells
    std::int64_t samples = 0;         // number of filtered samples drawn
    std::int64_t lost_samples = 0;    // skipped samples that are above the threshold
    std::array<double, 3> fetches{};  // of density and structure, per ray: up, within, down
    std::int64_t changed_rays = 0;    // optical depth differs from that without skipping
    std::uint64_t structure_bytes = 0;
    double time_ms = 0;
};

// Facts that are reported only for occupancy grids.
struct SkippingFacts {
    std::array<int, 3> size{};  // the volume's size in voxels
    int cell = 0;               // voxels along each edge
    int rays = 0;               // in each of the three sets
    double smallest_safe_share = 0;
    std::vector<SkippingRow> rows;
};

struct AssetReport {
    std::string name;
    std::string kind;       // "transmittance", "multiple_scattering", "noise_volume"
    std::string reference;  // what errors were measured against
    std::string scale;      // what an error of 1 means
    std::string timing;     // what the times mean
    int texel_points = 0;   // the most texels that were compared
    int lookup_points = 0;
    int repetitions = 0;                    // each time is the median of this many
    std::optional<SkyError> sky;            // of the recipe's asset, if its light is compared
    std::vector<std::string> notes;         // what was left out, and why
    std::optional<SkippingFacts> skipping;  // only for occupancy grids, which have no rows
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
config::Outcome<AssetReport> report_asset(const LoadRecipe& load, const config::Recipe& recipe,
                                          const config::Bake& bake, const ReportOptions& options);

}  // namespace skybake
