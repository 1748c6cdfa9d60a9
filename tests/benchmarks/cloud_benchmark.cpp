// The cost of a cloud beside its noise, and the saving where there is none: in one run, thread
// CPU time. tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true. items_per_second are voxels.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bakers/clouds/cloud_field.h"
#include "config/recipe/recipe.h"

namespace skybake::cloud {
namespace {

using Size = std::array<int, 3>;

// The cloud of a recipe's text, without maps.
CloudPlan plan_of(const std::string& text, const Size& size) {
    const auto recipe = config::parse_recipe(text, "benchmark");
    const config::Parameters& parameters = recipe.value->parameters;
    const config::Cloud& cloud = parameters.clouds.front();
    return make_cloud_plan(
        cloud, config::noise_named(parameters, cloud.noise),
        cloud.detail.empty() ? nullptr : &config::noise_named(parameters, cloud.detail), size, {});
}

// Box by box, as writers take them, into the same memory.
void fill(benchmark::State& state, const VoxelSource& source, const CloudPlan& plan) {
    const Size& size = plan.size;
    VoxelBox box{{}, {size[0], size[1], 16}};
    const auto plane = static_cast<std::size_t>(box.count());
    AlignedFloats memory(plane * static_cast<std::size_t>(plan.channels));
    std::vector<float*> targets;
    for (int c = 0; c < plan.channels; ++c)
        targets.push_back(memory.data() + plane * std::size_t(c));
    std::int64_t filled = 0;
    for (auto _ : state) {
        filled = 0;
        for (int z = 0; z < size[2]; z += box.size[2]) {
            box.origin[2] = z;
            source.fill(box, targets);
            benchmark::ClobberMemory();
            state.PauseTiming();
            filled += std::count_if(memory.begin(), memory.begin() + std::ptrdiff_t(plane),
                                    [](float value) { return value > 0; });
            state.ResumeTiming();
        }
    }
    const double voxels = double(size[0]) * size[1] * size[2];
    state.SetItemsProcessed(static_cast<std::int64_t>(voxels) * state.iterations());
    state.counters["filled"] = static_cast<double>(filled) / voxels;
}

void cloud(benchmark::State& state, const std::string& text, const Size& size) {
    const CloudPlan plan = plan_of(text, size);
    fill(state, CloudField(plan), plan);
}

const Size kThesisSize = {128, 128, 128};
const Size kWide = {512, 512, 128};
const std::string kThesis =
    "[noise.shape]\npreset = 'thesis'\n[clouds.thesis]\npreset = 'thesis'\n";

std::string cumulus(const std::string& keys) {
    return "[noise.shape]\npreset = 'nubis_shape'\npack = 'shape'\n"
           "[noise.detail]\npreset = 'nubis_detail'\npack = 'detail'\n"
           "[clouds.c]\nnoise = 'shape'\nnoise_scale = [4, 4, 1]\ndetail = 'detail'\n"
           "detail_scale = [16, 16, 4]\nextent = ['6 km', '6 km', '1.5 km']\n" +
           keys;
}

// Full from base to top; and towers alone, which leave 5 % of it.
const std::string kFull =
    cumulus("threshold = 0.05\nheight_profile = { type = 'tabulated', table = [[0, 1]] }\n");
const std::string kTowers = cumulus(
    "threshold = 0.05\nheight_profile = { type = 'tabulated', table = [[0, 0]] }\n"
    "towers = [{ center = [0.2, 0.3], sigma = [0.06, 0.08], amplitude = 0.9 },"
    " { center = [0.7, 0.6], sigma = [0.05, 0.07], amplitude = 0.9 }]\n");
const std::string kCoverage = cumulus("coverage = '5 %'\n");

void thesis_noise_alone(benchmark::State& state) {
    const CloudPlan thesis = plan_of(kThesis, kThesisSize);
    fill(state, *thesis.base, thesis);
}
BENCHMARK(thesis_noise_alone);
BENCHMARK_CAPTURE(cloud, thesis_128, kThesis, kThesisSize);
BENCHMARK_CAPTURE(cloud, cumulus_512_full, kFull, kWide);
BENCHMARK_CAPTURE(cloud, cumulus_512_towers, kTowers, kWide);
BENCHMARK_CAPTURE(cloud, cumulus_512_coverage_5_percent, kCoverage, kWide);

}  // namespace
}  // namespace skybake::cloud
