// Speed of light within clouds, processor time of one thread: optical depths of a cloud of 256 x 256 x
// 64 voxels, a texel for each 4 x 4 x 4 of them. items_per_second are texels times suns.
// tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_report_aggregates_only=true.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <numbers>
#include <string>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/field/baked.h"
#include "config/assets/cloud_volume.h"
#include "config/recipe/recipe.h"

namespace skybake::cloud_light {
namespace {

CloudLayer layer_of(const std::string& preset) {
    const auto recipe = config::parse_recipe(
        "[clouds.c]\npreset = \"" + preset +
            "\"\n[bake.v]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [256, 256, 64]\n",
        "benchmark");
    const config::Parameters& parameters = recipe.value->parameters;
    const auto& of = parameters.bakes[0].as<config::CloudVolumeBake>();
    Facts details;
    const auto inputs = cloud_inputs(parameters, of, details);
    const BakeOptions options{.threads = 1};
    return make_layer(hold_cloud_volume(parameters.clouds[0], of, *inputs.value, options, {}), 0,
                      spanned_cloud(parameters, of), options);
}

void bake_texels(const CloudLayer& layer, const config::CloudLightBake& bake) {
    const BakeOptions options{.threads = 1};
    Facts details;
    const SpacedValues values =
        cloud_light_values(layer, bake, cloud_light_spacing(bake), options, details);
    benchmark::DoNotOptimize(
        fitted_texels(values, cloud_light_size(layer.size, bake), bake, options));
}

// Suns from 10 to 85 degrees, all around, 16 of them as four assets hold them.
void sixteen_suns(benchmark::State& state, const std::string& preset) {
    const CloudLayer layer = layer_of(preset);
    for (auto _ : state) {
        for (int asset = 0; asset < 4; ++asset) {
            config::CloudLightBake bake;
            for (int i = 4 * asset; i < 4 * asset + 4; ++i) {
                bake.sun_elevations.push_back({(10 + 5.0 * i) * std::numbers::pi / 180});
                bake.sun_azimuths.push_back({2.4 * i});
            }
            bake_texels(layer, bake);
        }
    }
    const auto texels = static_cast<std::int64_t>(layer.values.size() / 64);
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * 16 * texels);
}

void sky(benchmark::State& state, const std::string& preset) {
    const CloudLayer layer = layer_of(preset);
    config::CloudLightBake bake;
    bake.contents = config::CloudLightContents::sky_visibility;
    for (auto _ : state) bake_texels(layer, bake);
}

BENCHMARK_CAPTURE(sixteen_suns, cumulus_mediocris, "cumulus_mediocris");
BENCHMARK_CAPTURE(sixteen_suns, stratus, "stratus");
BENCHMARK_CAPTURE(sky, cumulus_mediocris, "cumulus_mediocris");

}  // namespace
}  // namespace skybake::cloud_light
