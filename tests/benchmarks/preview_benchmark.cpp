// Pictures of a preview: the sky's dome, 512x512 per sun, and the solved sky by direct integration.
#include <benchmark/benchmark.h>
#include <hwy/detect_targets.h>
#include <hwy/targets.h>

#include <cstdint>
#include <string>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/preview/pictures/sky_reference.h"
#include "bakers/render/sky_view.h"
#include "config/recipe/recipe.h"
#include "tests/support/every_target.h"

namespace skybake {
namespace {

struct Sky {
    SkyMedium medium;
    SkyTables tables;
    config::Atmosphere atmosphere;
};

Sky make_earth() {
    const auto recipe = config::parse_recipe(
        "preset = \"earth_hillaire\"\n[bake.transmittance]\nsize = [256, 64]\n"
        "[bake.multiple_scattering]\nmethod = \"converged\"\nmapping = \"hillaire\"\nsize = [32, "
        "32]\n",
        "benchmark.toml");
    PreviewAsset transmittance;
    PreviewAsset multiple_scattering;
    for (const config::Bake& bake : recipe.value->parameters.bakes) {
        const auto baked = bake_asset(*recipe.value, bake, {0, Certification::off, nullptr});
        PreviewAsset& asset = bake.name == "transmittance" ? transmittance : multiple_scattering;
        asset.entry = describe(*baked.value);
        asset.table = baked.value->image();
    }
    return {make_sky_medium(recipe.value->parameters.atmosphere),
            *make_sky_tables(transmittance, &multiple_scattering).value,
            recipe.value->parameters.atmosphere};
}

const Sky& earth() {
    static const Sky sky = make_earth();
    return sky;
}

SkyView dome(int pixels, double sun_elevation_degrees) {
    SkyView view;
    view.width = pixels;
    view.height = pixels;
    view.camera_altitude_km = 0.2;
    view.sun_elevation_degrees = sun_elevation_degrees;
    return view;
}

// Elevation, threads.
void sky_dome(benchmark::State& state) {
    const SkyView view = dome(512, static_cast<double>(state.range(0)));
    const int threads = static_cast<int>(state.range(1));
    earth();
    for (auto _ : state) {
        benchmark::DoNotOptimize(render_sky(earth().medium, earth().tables, view, threads));
    }
}

void sky_dome_on(benchmark::State& state, std::int64_t target) {
    const SkyView view = dome(512, 10);
    earth();
    test::on_target(target, [&] {
        for (auto _ : state) {
            benchmark::DoNotOptimize(render_sky(earth().medium, earth().tables, view, 1));
        }
    });
}

void sky_by_direct_integration(benchmark::State& state) {
    const SkyView view = dome(128, static_cast<double>(state.range(0)));
    const int threads = static_cast<int>(state.range(1));
    const SkyLight light(earth().atmosphere, config::SkyOrders::all, {},
                         {0, Certification::off, nullptr});
    for (auto _ : state) {
        benchmark::DoNotOptimize(render_sky_reference(light, view, threads));
    }
}

}  // namespace
}  // namespace skybake

int main(int argc, char** argv) {
    using namespace skybake;
    for (const int sun : {60, 10, 0, -4}) {
        for (const int threads : {1, 2}) {
            benchmark::RegisterBenchmark("sky/dome_512", sky_dome)
                ->Args({sun, threads})
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
            benchmark::RegisterBenchmark("sky/direct_128", sky_by_direct_integration)
                ->Args({sun, threads})
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
        }
    }
    // Adds a benchmark for each of the targets that the compiler made.
    for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
        const std::int64_t target = left & -left;
        const std::string name = std::string("sky/dome_512_one_thread/") + hwy::TargetName(target);
        benchmark::RegisterBenchmark(name.c_str(), sky_dome_on, target)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
