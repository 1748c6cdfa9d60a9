// Pictures of a preview: the sky's dome, 512x512 per sun, and the solved sky by direct integration.
#include <benchmark/benchmark.h>
#include <hwy/detect_targets.h>
#include <hwy/targets.h>

#include <cstdint>
#include <string>

#include "bakers/preview/pictures/sky_reference.h"
#include "tests/benchmarks/on_target.h"
#include "tests/preview/skies.h"

namespace skybake {
namespace {

using test::earth;

// Elevation, threads.
void sky_dome(benchmark::State& state) {
    const SkyView view = test::dome(512, 0.2, static_cast<double>(state.range(0)));
    const int threads = static_cast<int>(state.range(1));
    earth();
    for (auto _ : state) {
        benchmark::DoNotOptimize(render_sky(earth().medium, earth().tables, view, threads));
    }
}

void sky_dome_on(benchmark::State& state, std::int64_t target) {
    const SkyView view = test::dome(512, 0.2, 10);
    earth();
    on_target(state, target, [&] {
        for (auto _ : state) {
            benchmark::DoNotOptimize(render_sky(earth().medium, earth().tables, view, 1));
        }
    });
}

void sky_by_direct_integration(benchmark::State& state) {
    const SkyView view = test::dome(128, 0.2, static_cast<double>(state.range(0)));
    const int threads = static_cast<int>(state.range(1));
    const SkyLight light(earth().recipe.parameters.atmosphere, config::SkyOrders::all, {},
                         {0, Certification::off, nullptr});
    for (auto _ : state) {
        benchmark::DoNotOptimize(render_sky_reference(light, view, threads));
    }
}

BENCHMARK(sky_dome)->ArgsProduct({{60, 10, 0, -4}, {1, 2}})->UseRealTime();
BENCHMARK(sky_by_direct_integration)->ArgsProduct({{60, 10, 0, -4}, {1, 2}})->UseRealTime();
BENCHMARK_CAPTURE(sky_dome_on, avx512, HWY_AVX3)->UseRealTime();
BENCHMARK_CAPTURE(sky_dome_on, avx2, HWY_AVX2)->UseRealTime();
BENCHMARK_CAPTURE(sky_dome_on, sse4, HWY_SSE4)->UseRealTime();

}  // namespace
}  // namespace skybake
