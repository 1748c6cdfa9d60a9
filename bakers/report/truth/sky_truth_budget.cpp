#include "bakers/report/truth/sky_truth_budget.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace skybake {

namespace {

// Paths are traced in blocks of so many (path_tracer.cpp): whole blocks keep all threads busy.
constexpr std::int64_t kBlock = 1024;
constexpr std::int64_t kMostPilotPaths = 4 * kBlock;
constexpr std::int64_t kPilotShare = 16;
// Each direction has a seed of its own; pilots have others, so that no path that decided how many
// there are is counted.
constexpr std::uint64_t kPilotSeeds = std::uint64_t{1} << 32;

// RMS over channels of (standard error / radiance), 0 where all is black.
double relative_spread(const std::vector<SkyTruth>& channels) {
    double squares = 0;
    int lit = 0;
    for (const SkyTruth& truth : channels) {
        if (!(truth.radiance > 0)) continue;
        const double spread = truth.standard_error / truth.radiance;
        squares += spread * spread;
        ++lit;
    }
    return lit == 0 ? 0 : std::sqrt(squares / lit);
}

void advance(Progress* progress, double fraction) {
    if (progress != nullptr) progress->advance("tracing paths", fraction);
}

}  // namespace

std::optional<std::vector<SkyTruth>> trace_sky_truth_within(
    const SkyMedium& medium, const std::vector<SkyTruthDirection>& directions,
    std::int64_t mean_paths, int threads, Progress* progress) {
    const std::int64_t pilot_paths =
        std::clamp(mean_paths / kPilotShare, std::int64_t{2}, kMostPilotPaths);
    std::vector<double> spreads;
    double sum = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (is_cancelled(progress)) return std::nullopt;
        spreads.push_back(relative_spread(
            trace_sky_truth(medium, {directions[i]}, {kPilotSeeds + i, pilot_paths}, threads)));
        sum += spreads.back();
    }
    const double all_paths = static_cast<double>(mean_paths) * static_cast<double>(spreads.size());
    std::vector<SkyTruth> result;
    double done = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        advance(progress, std::min(done / all_paths, 1.0));
        if (is_cancelled(progress)) return std::nullopt;
        const double share = sum > 0 ? spreads[i] / sum * all_paths : 0;
        std::int64_t paths = std::max(static_cast<std::int64_t>(share), pilot_paths);
        if (paths > kBlock) paths = (paths + kBlock - 1) / kBlock * kBlock;
        const auto traced = trace_sky_truth(medium, {directions[i]}, {i, paths}, threads);
        result.insert(result.end(), traced.begin(), traced.end());
        done += static_cast<double>(paths);
    }
    return result;
}

}  // namespace skybake
