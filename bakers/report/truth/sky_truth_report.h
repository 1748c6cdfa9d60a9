// How wrong a sky is by each way to multiple scattering, against a path-traced one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/sky_truth.h"
#include "bakers/math/bake_options.h"
#include "bakers/report/truth/sky_methods.h"

namespace skybake {

// A method with what it has made.
struct MadeSkyMethod {
    SkyMethod method;
    double time_ms = 0;                    // processor time of making it, median; 0 of nothing
    std::unique_ptr<HigherOrders> orders;  // null: none
    AirRadiance whole;                     // of SkyMethod::make_whole, else empty
};

// What the air sends by a method: the whole, or single scattering and its higher orders integrated
// along the ray. Both must outlive it.
AirRadiance air_radiance(const SkyMedium& medium, const MadeSkyMethod& made);

// Makes and times all, in turn. None: the user has interrupted.
std::optional<std::vector<MadeSkyMethod>> make_sky_methods(std::vector<SkyMethod> methods,
                                                           int repetitions, Progress* progress);

// Figures of |relative error| over directions and channels, those of black sky left out. On the
// dome, errors are weighed by the solid angle that their direction stands for, up to the
// horizontal.
struct SkyErrorFigures {
    double median = 0;
    double p90 = 0;
    double max = 0;
    // RMS error as a share of the mean, [sun][channel], suns as in SkyErrorReport.
    std::vector<Spectrum> dome_rms;
};

struct SkyErrorRow {
    SkyMethod method;
    double time_ms = 0;
    double time_ratio = 0;  // to the cheapest that takes any
    SkyErrorFigures error;
    bool on_front = false;  // Pareto: time against median error
};

struct SkyErrorReport {
    int channels = 0;
    std::vector<double> sun_zenith_degrees;
    int directions = 0;
    std::int64_t mean_paths = 0;  // of the truth, a direction
    int black = 0;                // values of no light, left out
    int repetitions = 0;          // times are medians of so many
    SkyErrorFigures truth_error;  // the standard errors of the truth itself
    std::vector<SkyErrorRow> rows;
};

// `truth` has each channel of each direction once, in any order.
SkyErrorReport measure_sky_errors(const SkyMedium& medium,
                                  const std::vector<MadeSkyMethod>& methods,
                                  const std::vector<SkyTruth>& truth, int repetitions, int threads);

// All channels of the first direction, of the second, and so on: as of trace_sky_truth.
std::vector<SkyTruth> by_direction(std::vector<SkyTruth> truth);

// The sky as a method has it, in the directions of a truth that is in this order and without the
// ground that they hit; in the same order.
std::vector<double> sky_radiances(const SkyMedium& medium, const MadeSkyMethod& made,
                                  const std::vector<SkyTruth>& truth, int threads);

// Shares of the dome of directions with one sun, by their places in `directions`: halfway to the
// neighbours in zenith angle and azimuth, of which one half of the dome stands for both. Sum 1.
std::vector<double> dome_shares(const std::vector<SkyTruthDirection>& directions);

// RMS over the channels: one figure for a sun.
double joined(const Spectrum& channels, int count);

// One row a method and one of the truth's own standard error; the first line names the columns.
// Errors are shares, of 1; dome_rms_SUN_CHANNEL as of SkyErrorFigures, SUN in degrees from the
// zenith.
std::string sky_truth_report_csv(const SkyErrorReport& report);

// One object; keys are those of the structs in sky_truth_report.h.
std::string sky_truth_report_json(const SkyErrorReport& report);

}  // namespace skybake
