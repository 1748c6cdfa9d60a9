// Speed of the noise kernels against point-wise vector code, which hashes every sample on its own
// as noise libraries do, and against what stores alone take: in one run, thread CPU time unless a
// name says wall. tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true. items_per_second are voxel octaves.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstring>
#include <string>
#include <vector>

#include "bakers/math/parallel.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/scattered_kernel.h"
#include "config/recipe/recipe.h"
#include "tests/benchmarks/on_target.h"
#include "tests/support/loops.h"

namespace skybake::noise {
namespace {

// The noise of a recipe's text, on a cube.
NoisePlan plan_of(const std::string& recipe, int size) {
    const auto parsed = config::parse_recipe(recipe, "benchmark");
    return make_noise_plan(parsed.value->parameters.noises.front(), {size, size, size});
}

NoisePlan perlin_plan(int size, int octaves) {
    return plan_of(
        fmt::format("[noise.n.channels.Y]\ntype = 'perlin'\nfrequency = 4\noctaves = {}\n",
                    octaves),
        size);
}

NoisePlan worley_plan(int frequency) {
    return plan_of(fmt::format("[noise.n.channels.Y]\ntype = 'worley'\nvalue_form = 'distance'\n"
                               "frequency = {}\n",
                               frequency),
                   128);
}

// A channel Y with these keys, besides a frequency of 4.
NoisePlan channel_plan(const std::string& keys, const std::string& noise = "") {
    return plan_of("[noise.n]\n" + noise + "[noise.n.channels.Y]\nfrequency = 4\n" + keys, 128);
}

NoisePlan preset_plan(const std::string& preset, int size) {
    return plan_of("[noise.n]\npreset = \"" + preset + "\"\n", size);
}

// The voxels of a plan's cube, reused from run to run as a baker reuses its buffers.
struct Cube {
    explicit Cube(const NoisePlan& plan)
        : box{{}, {plan.axes[0].size, plan.axes[1].size, plan.axes[2].size}} {
        const auto count = static_cast<std::size_t>(box.count());
        voxels.resize(count * static_cast<std::size_t>(plan.output_channels()));
        for (std::size_t at = 0; at < voxels.size(); at += count) {
            channels.push_back(voxels.data() + at);
        }
    }

    void count_octaves(benchmark::State& state, int octaves) const {
        state.SetItemsProcessed(state.iterations() * octaves * box.count());
    }

    VoxelBox box;
    AlignedFloats voxels;
    std::vector<float*> channels;
};

void fill(benchmark::State& state, const NoisePlan& plan, int octaves) {
    const NoiseField field(plan);
    const Cube cube(plan);
    for (auto _ : state) {
        field.fill(cube.box, cube.channels);
        benchmark::ClobberMemory();
    }
    cube.count_octaves(state, octaves);
}

// The same kernels held to one instruction set.
void fill_on(benchmark::State& state, std::int64_t target, const NoisePlan& plan, int octaves) {
    on_target(state, target, [&] { fill(state, plan, octaves); });
}

void perlin_pointwise(benchmark::State& state, int size, int octaves) {
    const NoisePlan plan = perlin_plan(size, octaves);
    Cube cube(plan);
    const auto stride = static_cast<std::size_t>(size);
    std::vector<float> row(stride);
    for (auto _ : state) {
        testing::for_each_texel(size, size, [&](int y, int z) {
            float* out = cube.voxels.data() + static_cast<std::size_t>(z * size + y) * stride;
            for (const GradientOctave& octave : plan.channels[0].gradient.octaves) {
                const bool is_first = &octave == plan.channels[0].gradient.octaves.data();
                fill_gradient_octave_pointwise(octave, {{0, y, z}, {size, 1, 1}}, stride,
                                               is_first ? out : row.data());
                if (is_first) continue;
                for (std::size_t x = 0; x < stride; ++x) out[x] += row[x];
            }
        });
        benchmark::ClobberMemory();
    }
    cube.count_octaves(state, octaves);
}

// No kernel can undercut this: the voxels' memory is written once.
void stores(benchmark::State& state) {
    Cube cube(perlin_plan(static_cast<int>(state.range(0)), 1));
    for (auto _ : state) {
        std::memset(cube.voxels.data(), 0, cube.voxels.size() * sizeof(float));
        benchmark::ClobberMemory();
    }
    cube.count_octaves(state, 1);
}

void on_threads(benchmark::State& state) {
    constexpr int kSize = 256;
    constexpr int kDepth = 8;
    const NoisePlan plan = preset_plan("nubis_shape", kSize);
    const NoiseField field(plan);
    const Cube cube(plan);
    for (auto _ : state) {
        parallel_for(kSize / kDepth, static_cast<int>(state.range(0)), [&](int tile) {
            std::vector<float*> targets = cube.channels;
            for (float*& target : targets) target += std::ptrdiff_t{tile} * kDepth * kSize * kSize;
            field.fill({{0, 0, tile * kDepth}, {kSize, kSize, kDepth}}, targets);
        });
        benchmark::ClobberMemory();
    }
}

BENCHMARK_CAPTURE(fill, perlin_fbm5_256, perlin_plan(256, 5), 5);
BENCHMARK_CAPTURE(perlin_pointwise, fbm5_256, 256, 5);
BENCHMARK_CAPTURE(fill, perlin_1_128, perlin_plan(128, 1), 1);
BENCHMARK_CAPTURE(perlin_pointwise, 1_128, 128, 1);
BENCHMARK(stores)->Arg(256)->Arg(128);

void worley_f1_128(benchmark::State& state) {
    fill(state, worley_plan(static_cast<int>(state.range(0))), 1);
}
BENCHMARK(worley_f1_128)->ArgsProduct({{4, 8, 16, 32, 64, 128, 192, 2048}});

// Noises of 128³ voxels with one octave each.
const std::string kWarp = "warp_strength = 0.1\n";
const std::string kMoving = "period = 48\ntime = 5\n";
BENCHMARK_CAPTURE(fill, alligator_128, channel_plan("type = \"alligator\"\n"), 1);
BENCHMARK_CAPTURE(fill, curly_alligator_128, channel_plan("type = \"curly_alligator\"\n"), 1);
BENCHMARK_CAPTURE(fill, curl_128, channel_plan("type = \"curl\"\n"), 1);
BENCHMARK_CAPTURE(fill, warped_perlin_128, channel_plan("type = \"perlin\"\n" + kWarp), 1);
BENCHMARK_CAPTURE(fill, warped_worley_128, channel_plan("type = \"worley\"\n" + kWarp), 1);
BENCHMARK_CAPTURE(fill, moving_perlin_128, channel_plan("type = \"perlin\"\n", kMoving), 1);
BENCHMARK_CAPTURE(fill, moving_worley_128, channel_plan("type = \"worley\"\n", kMoving), 1);
BENCHMARK_CAPTURE(fill, nubis_shape_128, preset_plan("nubis_shape", 128), 7);
BENCHMARK_CAPTURE(fill, nubis_detail_32, preset_plan("nubis_detail", 32), 3);

BENCHMARK_CAPTURE(fill_on, avx512_perlin_fbm5_256, HWY_AVX3, perlin_plan(256, 5), 5);
BENCHMARK_CAPTURE(fill_on, avx512_worley_cells4, HWY_AVX3, worley_plan(4), 1);
BENCHMARK_CAPTURE(fill_on, avx512_worley_cells192, HWY_AVX3, worley_plan(192), 1);
BENCHMARK_CAPTURE(fill_on, avx512_nubis_shape, HWY_AVX3, preset_plan("nubis_shape", 128), 7);
BENCHMARK_CAPTURE(fill_on, avx2_perlin_fbm5_256, HWY_AVX2, perlin_plan(256, 5), 5);
BENCHMARK_CAPTURE(fill_on, avx2_worley_cells4, HWY_AVX2, worley_plan(4), 1);
BENCHMARK_CAPTURE(fill_on, avx2_worley_cells192, HWY_AVX2, worley_plan(192), 1);
BENCHMARK_CAPTURE(fill_on, avx2_nubis_shape, HWY_AVX2, preset_plan("nubis_shape", 128), 7);
BENCHMARK(on_threads)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace skybake::noise
