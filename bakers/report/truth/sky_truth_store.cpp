#include "bakers/report/truth/sky_truth_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "bakers/io/files/file_io.h"
#include "bakers/math/hash.h"
#include "config/assets/asset_kind.h"

namespace skybake {

// --- Tracing -------------------------------------------------------------------------------------

namespace {

// Paths are traced in blocks of this size (path_tracer.cpp). Whole blocks keep all threads busy.
constexpr std::int64_t kBlock = 1024;
constexpr std::int64_t kMostPilotPaths = 4 * kBlock;
constexpr std::int64_t kPilotShare = 16;
// Each direction has its own seed. Pilot paths have other seeds, so that no path is counted that
// decided the number of paths.
constexpr std::uint64_t kPilotSeeds = std::uint64_t{1} << 32;

// Returns the RMS over channels of (standard error / radiance), or 0 if all channels are black.
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

// --- Storing -------------------------------------------------------------------------------------

namespace {

constexpr std::string_view kSign = "# skybake sky truth ";
constexpr std::uintmax_t kLargestFile = 16 << 20;

// Returns the text after its first line.
std::string_view after_first_line(std::string_view text) {
    const std::size_t end = text.find('\n');
    return end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
}

std::string first_line(const std::string& key, std::string_view values) {
    return fmt::format("{}{}, values {}", kSign, key, xxh3_hex(values));
}

}  // namespace

std::string sky_truth_key(const config::Recipe& recipe,
                          const std::vector<SkyTruthDirection>& directions,
                          std::int64_t mean_paths) {
    const std::vector<config::Read> air =
        config::reads_of_light(recipe.parameters, config::Roles::all());
    std::string text = fmt::format("version {}\n{} paths\n{}\n", kSkyTruthVersion, mean_paths,
                                   config::parameters_toml(recipe, air));
    for (const SkyTruthDirection& at : directions) {
        text += fmt::format("{} {} {} {}\n", at.altitude_km, at.sun_zenith_degrees,
                            at.view_zenith_degrees, at.azimuth_degrees);
    }
    return xxh3_hex(text);
}

std::string stored_sky_truth(const std::vector<SkyTruth>& truth, const std::string& key) {
    const std::string csv = sky_truth_csv(truth, "");
    const std::string_view values = after_first_line(csv);
    return fmt::format("{}\n{}", first_line(key, values), values);
}

bool is_stored_sky_truth(std::string_view text) { return text.starts_with(kSign); }

std::optional<std::vector<SkyTruth>> parse_stored_sky_truth(std::string_view text,
                                                            const std::string& key) {
    const std::string_view values = after_first_line(text);
    if (!text.starts_with(first_line(key, values) + '\n')) return std::nullopt;
    return parse_sky_truth_csv(text);
}

std::optional<std::vector<SkyTruth>> load_sky_truth(const std::filesystem::path& path,
                                                    const std::string& key) {
    const auto text = read_file(path, kLargestFile);
    if (!text.value) return std::nullopt;
    return parse_stored_sky_truth(*text.value, key);
}

std::filesystem::path cached_sky_truth_path(const std::filesystem::path& cache,
                                            const std::string& key) {
    return cache / "sky_truth" / key.substr(0, 2) / (key + ".csv");
}

}  // namespace skybake
