// Measures the error of the sky with each method of multiple scattering, against a path-traced sky.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/sky_truth.h"
#include "bakers/math/bake_options.h"
#include "bakers/report/truth/error_ladder.h"
#include "bakers/report/truth/sky_methods.h"

namespace skybake {

// A method and its results.
struct MadeSkyMethod {
    SkyMethod method;
    double time_ms = 0;                    // median processor time of making it; 0 if not made
    std::unique_ptr<HigherOrders> orders;  // null: none
    AirRadiance whole;                     // the result of SkyMethod::make_whole, else empty
};

// Returns the radiance of the air by a method: its `whole`, or single scattering and its higher
// orders integrated along the ray. Both arguments must outlive the result.
AirRadiance air_radiance(const SkyMedium& medium, const MadeSkyMethod& made);

// Makes and times all methods, in turn. Returns nothing if the user has interrupted.
std::optional<std::vector<MadeSkyMethod>> make_sky_methods(std::vector<SkyMethod> methods,
                                                           int repetitions, Progress* progress);

// Figures of |relative error| over directions and channels, except where the sky is black. Dome
// errors are weighted by the solid angle that a direction represents, up to the horizontal.
struct SkyErrorFigures {
    double median = 0;
    double p90 = 0;
    double max = 0;
    // The RMS error as a share of the mean, [sun][channel], with the suns of SkyErrorReport.
    std::vector<Spectrum> dome_rms;
};

struct SkyErrorRow {
    SkyMethod method;
    double time_ms = 0;
    double time_ratio = 0;  // to that of the cheapest method with a time above 0
    SkyErrorFigures error;
    bool on_front = false;  // Pareto: time against median error
};

struct SkyErrorReport {
    int channels = 0;
    std::vector<double> sun_zenith_degrees;
    int directions = 0;
    std::int64_t mean_paths = 0;  // paths of the truth per direction
    int black = 0;                // number of values without light, which are left out
    int repetitions = 0;          // each time is the median of this many
    SkyErrorFigures truth_error;  // the standard errors of the truth itself
    std::vector<SkyErrorRow> rows;
    std::vector<LadderStep> ladder;  // filled in by the caller (error_ladder.h)
};

// Returns the errors of all methods, as the ladder takes them.
MethodErrors method_errors(const SkyErrorReport& report);

// Measures the errors of all methods. `truth` has each channel of each direction once, in any
// order.
SkyErrorReport measure_sky_errors(const SkyMedium& medium,
                                  const std::vector<MadeSkyMethod>& methods,
                                  const std::vector<SkyTruth>& truth, int repetitions, int threads);

// Sorts a truth by directions, with all channels of a direction together, as trace_sky_truth does.
std::vector<SkyTruth> by_direction(std::vector<SkyTruth> truth);

// Returns the radiances of the sky by a method, without the ground, in the directions of a truth
// that is sorted by by_direction. The result is in the same order.
std::vector<double> sky_radiances(const SkyMedium& medium, const MadeSkyMethod& made,
                                  const std::vector<SkyTruth>& truth, int threads);

// Returns the share of the dome that each direction represents, in the order of `directions`, all
// with the same sun. A direction's area extends halfway to its neighbours in zenith angle and
// azimuth. The directions lie in one half of the dome, which represents both. The shares sum to 1.
std::vector<double> dome_shares(const std::vector<SkyTruthDirection>& directions);

// Returns the RMS over the channels, as one figure for a sun.
double joined(const Spectrum& channels, int count);

// Returns a text in quotes, or nothing of none. It must not contain quotes.
std::string csv_quoted(const std::string& text);

// Returns CSV with one row per method and one row for the standard error of the truth. The first
// line names the columns. An error of 1 means 100 %. dome_rms_SUN_CHANNEL is that of
// SkyErrorFigures, with SUN in degrees from the zenith.
std::string sky_truth_report_csv(const SkyErrorReport& report);

// Returns one JSON object. Its keys are those of the structs in this header.
std::string sky_truth_report_json(const SkyErrorReport& report);

}  // namespace skybake
