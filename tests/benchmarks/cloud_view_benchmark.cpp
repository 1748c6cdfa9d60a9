// The lit picture of a cloud, 960x540 of 256x256x64 voxels, with and without leaping by its
// occupancy: the march alone, which is what leaps change, and the whole picture. Counters are
// fetches a pixel. tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true.
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "bakers/preview/bake_assets.h"
#include "bakers/render/cloud_framing.h"
#include "config/recipe/recipe.h"
#include "tests/support/cloud_marches.h"

namespace skybake {
namespace {

struct Scene {
    SkyMedium air;
    SkyTables tables;
    CloudMedium cloud;
    MarchSettings settings;
};

Scene make_scene(const std::string& preset) {
    const auto recipe = config::parse_recipe(
        "preset = \"earth_hillaire\"\n[noise.shape]\npreset = \"nubis_shape\"\npack = "
        "\"shape\"\nseed = 7\n"
        "[noise.detail]\npreset = \"nubis_detail\"\npack = \"detail\"\nseed = 11\n"
        "[clouds.c]\npreset = \"" +
            preset +
            "\"\n[bake.transmittance]\n[bake.multiple_scattering]\n"
            "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [256, 256, 64]\n",
        "benchmark.toml");
    const config::Parameters& parameters = recipe.value->parameters;
    const auto baked =
        bake_assets(*recipe.value, parameters.bakes, "benchmark", {0, Certification::off, nullptr});
    const PreviewAssets& assets = *baked.value;
    Scene scene;
    scene.air = make_sky_medium(parameters.atmosphere);
    scene.tables =
        *make_sky_tables(*assets.of_kind("transmittance"), assets.of_kind("multiple_scattering"))
             .value;
    scene.cloud = cloud_medium(parameters.clouds.front(),
                               assets.of_kind("cloud_volume")->voxels.data(), {256, 256, 64}, 1, 0);
    scene.cloud.leaps = leaps_of_voxels(scene.cloud, 4, 0);
    scene.settings = {framed_view(scene.cloud, {20, 105}, 960, 540)};
    return scene;
}

const Scene& scene_of(const std::string& preset) {
    static std::map<std::string, Scene> scenes;
    if (!scenes.contains(preset)) scenes.emplace(preset, make_scene(preset));
    return scenes.at(preset);
}

void march(benchmark::State& state, const std::string& preset, bool leaping) {
    const auto threads = static_cast<int>(state.range(0));
    const Scene& scene = scene_of(preset);
    MarchSettings settings = scene.settings;
    settings.leaping = leaping;
    FetchCounts fetches;
    for (auto _ : state) {
        const MarchedScene view = march_view(scene.cloud, settings, threads);
        benchmark::DoNotOptimize(view.results.texels.data());
        fetches = view.fetches;
    }
    const double pixels = static_cast<double>(settings.width) * settings.height;
    state.counters["volume"] =
        static_cast<double>(fetches.samples + fetches.light_samples) / pixels;
    state.counters["grid"] = static_cast<double>(fetches.cells) / pixels;
}

void picture(benchmark::State& state, const std::string& preset) {
    const auto threads = static_cast<int>(state.range(0));
    const Scene& scene = scene_of(preset);
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            render_cloud(scene.cloud, {scene.air, scene.tables}, scene.settings, threads));
    }
}

void leaping(benchmark::State& state, const std::string& preset) { march(state, preset, true); }
void straight(benchmark::State& state, const std::string& preset) { march(state, preset, false); }

// The argument is the number of threads.
void on_threads(benchmark::internal::Benchmark* benchmark) {
    benchmark->Arg(1)->Arg(2)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK_CAPTURE(leaping, congestus, "cumulus_congestus")->Apply(on_threads);
BENCHMARK_CAPTURE(straight, congestus, "cumulus_congestus")->Apply(on_threads);
BENCHMARK_CAPTURE(picture, congestus, "cumulus_congestus")->Apply(on_threads);
BENCHMARK_CAPTURE(leaping, humilis, "cumulus_humilis")->Apply(on_threads);
BENCHMARK_CAPTURE(straight, humilis, "cumulus_humilis")->Apply(on_threads);
BENCHMARK_CAPTURE(picture, humilis, "cumulus_humilis")->Apply(on_threads);
BENCHMARK_CAPTURE(leaping, stratocumulus, "stratocumulus")->Apply(on_threads);
BENCHMARK_CAPTURE(straight, stratocumulus, "stratocumulus")->Apply(on_threads);
BENCHMARK_CAPTURE(picture, stratocumulus, "stratocumulus")->Apply(on_threads);
BENCHMARK_CAPTURE(leaping, stratus, "stratus")->Apply(on_threads);
BENCHMARK_CAPTURE(straight, stratus, "stratus")->Apply(on_threads);
BENCHMARK_CAPTURE(picture, stratus, "stratus")->Apply(on_threads);

}  // namespace
}  // namespace skybake
