// Pictures of a preview: the sky's dome, 512x512 per sun, and the solved sky by direct integration.
#include <benchmark/benchmark.h>
#include <hwy/detect_targets.h>
#include <hwy/targets.h>

#include <cstdint>
#include <string>

#include "bakers/preview/pictures/sky_reference.h"
#include "tests/benchmarks/run.h"
#include "tests/preview/skies.h"
#include "tests/support/every_target.h"

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
    test::on_target(target, [&] {
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

void register_all() {
    const auto add = [](const std::string& name, auto... function) {
        return benchmark::RegisterBenchmark(name.c_str(), function...)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    };
    for (const int sun : {60, 10, 0, -4}) {
        for (const int threads : {1, 2}) {
            add("sky/dome_512", sky_dome)->Args({sun, threads});
            add("sky/direct_128", sky_by_direct_integration)->Args({sun, threads});
        }
    }
    // Adds a benchmark for each of the targets that the compiler made.
    for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
        const std::int64_t target = left & -left;
        add(std::string("sky/dome_512_one_thread/") + hwy::TargetName(target), sky_dome_on, target);
    }
}

}  // namespace
}  // namespace skybake

int main(int argc, char** argv) {
    return skybake::run_benchmarks(argc, argv, skybake::register_all);
}
