// Paths a second and the standard error that they buy: Earth over black ground, the 178 directions
// of sky_truth.h, one thread. tests/benchmarks/README.md keeps the figures reached.
//
// A path serves three channels. `error_squared_seconds` is the median over directions and channels
// of (standard error / radiance)^2 times the processor time: what more paths do not change.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bakers/light/path_tracer/path_tracer.h"
#include "config/recipe/recipe.h"
#include "tests/support/sky_truth.h"

namespace skybake {
namespace {

// Earth with the given g.
SkyMedium earth(const std::string& g, const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings = {"atmosphere.ground_albedo=0",
                                         "atmosphere.layers.mie.g=" + g};
    settings.insert(settings.end(), more.begin(), more.end());
    return make_sky_medium(
        config::parse_recipe("preset = \"earth_hillaire\"\n", "benchmark", {}, settings)
            .value->parameters.atmosphere);
}

void walk_sky(benchmark::State& state, const SkyMedium& medium) {
    constexpr std::int64_t kPaths = 4096;
    const auto directions = sky_truth_directions(0.5);
    std::vector<double> errors;
    for (auto _ : state) {
        const auto sky = trace_sky_truth(medium, directions, {1, kPaths}, 1);
        errors.clear();
        for (const SkyTruth& value : sky) errors.push_back(value.standard_error / value.radiance);
    }
    std::sort(errors.begin(), errors.end());
    const double paths = static_cast<double>(kPaths) * static_cast<double>(directions.size());
    const double all_paths = paths * static_cast<double>(state.iterations());
    state.counters["paths"] = benchmark::Counter(all_paths, benchmark::Counter::kIsRate);
    state.counters["channel_paths"] =
        benchmark::Counter(all_paths * medium.air.channels, benchmark::Counter::kIsRate);
    const double median = errors[errors.size() / 2];
    const double tail = errors[errors.size() * 9 / 10];
    state.counters["error_median"] = median;
    state.counters["error_p90"] = tail;
    state.counters["error_squared_seconds"] =
        benchmark::Counter(static_cast<double>(state.iterations()) / (median * median),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void make_tracer(benchmark::State& state) {
    const SkyMedium medium = earth("0.8");
    for (auto _ : state) benchmark::DoNotOptimize(PathMedium(medium));
}

BENCHMARK(make_tracer);

// One of Earth's channels alone.
SkyMedium one_channel(const std::string& nm, const std::string& rayleigh,
                      const std::string& ozone) {
    return earth("0.8", {"wavelengths=[\"" + nm + " nm\"]",
                         "atmosphere.layers.rayleigh.scattering=\"" + rayleigh + "e-6 /m\"",
                         "atmosphere.layers.ozone.absorption=\"" + ozone + "e-6 /m\""});
}

BENCHMARK_CAPTURE(walk_sky, three_channels_share_paths, earth("0.8"));
BENCHMARK_CAPTURE(walk_sky, 680_nm_alone, one_channel("680", "5.802", "0.650"));
BENCHMARK_CAPTURE(walk_sky, 550_nm_alone, one_channel("550", "13.558", "1.881"));
BENCHMARK_CAPTURE(walk_sky, 440_nm_alone, one_channel("440", "33.1", "0.085"));
BENCHMARK_CAPTURE(walk_sky, g_0_95, earth("0.95"));
BENCHMARK_CAPTURE(walk_sky, g_0, earth("0"));

}  // namespace
}  // namespace skybake
