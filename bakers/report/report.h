// Reports what accuracy costs. The report of an asset lists the variants that its settings allow,
// each with its time, error and bytes, beside the baselines of the papers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"
#include "config/sections/file_formats.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// Measurements of a volume's file, which tables do not have.
struct VolumeFile {
    config::FileFormat format = config::FileFormat::exr;
    std::string compression;  // "zip", "blosc", "none"
    double write_ms = 0;      // processor time of encoding and writing it to memory on one thread
    bool on_bytes_front = false;  // Pareto: file_bytes against lookup.rms, among all rows
};

// One variant of an asset. For the Pareto fronts, errors of a volume are compared to two digits.
struct ReportRow {
    std::string asset;    // NAME of [bake.NAME]
    std::string family;   // what it shares with others: "exact, half", "midpoint rule", "bin, half"
    std::string variant;  // what it differs in: "256x64", "40 steps", "level 3", "exr zip"
    std::string baseline;    // the name of a baseline, or empty
    bool of_recipe = false;  // the variant that `bake` makes from the recipe
    // The variants of the quadrature sweep have the same size, mapping and pixel type, and differ
    // in what they sum: steps, directions, octaves, methods.
    bool in_quadrature_sweep = false;
    std::vector<int> size;  // texels along u, v; voxels along x, y, z
    config::PixelType pixel_type = config::PixelType::float32;
    std::uint64_t file_bytes = 0;
    double time_ms = 0;  // processor time of making the texels or voxels on one thread
    ErrorFigures texel;
    ErrorFigures lookup;
    bool on_lookup_front = false;  // Pareto: time against lookup.rms, among all rows of the asset
    bool on_texel_front = false;   // Pareto: time against texel.rms, within the quadrature sweep
    std::optional<VolumeFile> volume_file;  // none for a table
};

// Facts that are reported only for volumes.
struct VolumeFacts {
    std::vector<std::string> channels;
    std::vector<ValueStatistics> statistics;  // of the recipe's volume as stored, one per channel
    double seam_error = 0;
    int write_repetitions = 0;  // each write time is the median of this many
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
    std::optional<VolumeFacts> volume;      // only for volumes with rows
    std::optional<SkippingFacts> skipping;  // only for occupancy grids, which have no rows
    std::vector<ReportRow> rows;
};

struct ReportOptions {
    int threads = 0;     // for references only; 0: as many as the machine has
    bool quick = false;  // fewer repetitions, points and sizes
    Progress* progress = nullptr;
    Intermediates* intermediates = nullptr;  // what the reports of a recipe share; null: nothing
};

// Makes and measures the variants for one section of a recipe. Errors are pure functions of the
// parameters; times are not. If the user interrupts, there is neither a value nor a diagnostic.
// Diagnostics are those of bake_asset.
config::Outcome<AssetReport> report_asset(const config::Recipe& recipe, const config::Bake& bake,
                                          const ReportOptions& options);

// Makes the report of an asset that has no variants. It refers to the certificate, which states the
// errors of lookups.
config::Outcome<AssetReport> nothing_to_compare(const config::Bake& bake);

}  // namespace skybake
