// Speed of the noise kernels against point-wise vector code, which hashes every sample on its own
// as noise libraries do, and against what stores alone take: in one run, thread CPU time unless a
// name says wall. tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true. items_per_second are voxel octaves.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <cstring>
#include <string>
#include <vector>

#include "bakers/math/parallel.h"
#include "bakers/noise/noise_field.h"
#include "bakers/noise/scattered_kernel.h"
#include "config/recipe/recipe.h"
#include "tests/benchmarks/run.h"
#include "tests/support/every_target.h"

namespace skybake::noise {
namespace {

// The noise of a recipe's text, on a cube.
NoisePlan plan_of(const std::string& recipe, int size) {
    const auto parsed = config::parse_recipe(recipe, "benchmark");
    return make_noise_plan(parsed.value->parameters.noises.front(), {size, size, size});
}

NoisePlan perlin_plan(int size, int octaves) {
    return plan_of("[noise.n.channels.Y]\ntype = \"perlin\"\nfrequency = 4\noctaves = " +
                       std::to_string(octaves) + "\n",
                   size);
}

NoisePlan worley_plan(int size, int frequency) {
    return plan_of(
        "[noise.n.channels.Y]\ntype = \"worley\"\nvalue_form = \"distance\"\n"
        "frequency = " +
            std::to_string(frequency) + "\n",
        size);
}

// A channel Y with these keys, besides a frequency of 4.
NoisePlan channel_plan(const std::string& keys, const std::string& noise = "") {
    return plan_of("[noise.n]\n" + noise + "[noise.n.channels.Y]\nfrequency = 4\n" + keys, 128);
}

NoisePlan preset_plan(const std::string& preset, int size) {
    return plan_of("[noise.n]\npreset = \"" + preset + "\"\n", size);
}

// The voxels of a cube, reused from run to run as a baker reuses its buffers.
struct Cube {
    Cube(int size_, int channels)
        : size(size_),
          voxels(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_) *
                 static_cast<std::size_t>(size_) * static_cast<std::size_t>(channels)) {}
    VoxelBox box() const { return {{0, 0, 0}, {size, size, size}}; }
    std::vector<float*> channels() {
        std::vector<float*> result;
        const auto count = static_cast<std::size_t>(box().count());
        for (std::size_t at = 0; at < voxels.size(); at += count) {
            result.push_back(voxels.data() + at);
        }
        return result;
    }
    int size;
    AlignedFloats voxels;
};

void count_octaves(benchmark::State& state, int size, int octaves) {
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * octaves * size * size *
                            size);
}

void fill(benchmark::State& state, const NoisePlan& plan, int size, int octaves) {
    const NoiseField field(plan);
    Cube cube(size, plan.output_channels());
    for (auto _ : state) {
        field.fill(cube.box(), cube.channels());
        benchmark::ClobberMemory();
    }
    count_octaves(state, size, octaves);
}

// The same kernels held to one instruction set.
void fill_on(benchmark::State& state, std::int64_t target, const NoisePlan& plan, int size,
             int octaves) {
    test::on_target(target, [&] { fill(state, plan, size, octaves); });
}

void perlin_pointwise(benchmark::State& state, int size, int octaves) {
    const NoisePlan plan = perlin_plan(size, octaves);
    Cube cube(size, 1);
    const auto stride = static_cast<std::size_t>(size);
    std::vector<float> row(stride);
    for (auto _ : state) {
        for (int z = 0; z < size; ++z) {
            for (int y = 0; y < size; ++y) {
                float* out = cube.voxels.data() + static_cast<std::size_t>(z * size + y) * stride;
                for (int i = 0; i < octaves; ++i) {
                    const GradientOctave& octave =
                        plan.channels[0].gradient.octaves[static_cast<std::size_t>(i)];
                    fill_gradient_octave_pointwise(octave, {{0, y, z}, {size, 1, 1}}, stride,
                                                   i == 0 ? out : row.data());
                    if (i == 0) continue;
                    for (std::size_t x = 0; x < stride; ++x) out[x] += row[x];
                }
            }
        }
        benchmark::ClobberMemory();
    }
    count_octaves(state, size, octaves);
}

// No kernel can undercut this: the voxels' memory is written once.
void stores(benchmark::State& state, int size, int channels) {
    Cube cube(size, channels);
    for (auto _ : state) {
        std::memset(cube.voxels.data(), 0, cube.voxels.size() * sizeof(float));
        benchmark::ClobberMemory();
    }
    count_octaves(state, size, channels);
}

void on_threads(benchmark::State& state, int threads) {
    constexpr int kSize = 256;
    constexpr int kDepth = 8;
    const NoisePlan plan = preset_plan("nubis_shape", kSize);
    const NoiseField field(plan);
    Cube cube(kSize, 4);
    const std::vector<float*> channels = cube.channels();
    for (auto _ : state) {
        parallel_for(kSize / kDepth, threads, [&](int tile) {
            std::vector<float*> targets = channels;
            for (float*& target : targets) target += std::ptrdiff_t{tile} * kDepth * kSize * kSize;
            field.fill({{0, 0, tile * kDepth}, {kSize, kSize, kDepth}}, targets);
        });
        benchmark::ClobberMemory();
    }
}

void register_all() {
    using benchmark::RegisterBenchmark;
    const auto add = [](const std::string& name, const auto&... arguments) {
        RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond);
    };
    add("perlin_fbm5_256", fill, perlin_plan(256, 5), 256, 5);
    add("perlin_fbm5_256_pointwise", perlin_pointwise, 256, 5);
    add("perlin_fbm5_256_stores", stores, 256, 1);
    add("perlin_1_128", fill, perlin_plan(128, 1), 128, 1);
    add("perlin_1_128_pointwise", perlin_pointwise, 128, 1);
    add("perlin_1_128_stores", stores, 128, 1);
    for (const int frequency : {4, 8, 16, 32, 64, 128, 192, 2048}) {
        add("worley_f1_128_cells" + std::to_string(frequency), fill, worley_plan(128, frequency),
            128, 1);
    }
    // Noises of 128³ voxels with one octave each.
    const std::string warp = "warp_strength = 0.1\n";
    const std::string moving = "period = 48\ntime = 5\n";
    for (const auto& [name, plan] : {
             std::pair{"alligator_128", channel_plan("type = \"alligator\"\n")},
             {"curly_alligator_128", channel_plan("type = \"curly_alligator\"\n")},
             {"curl_128", channel_plan("type = \"curl\"\n")},
             {"warped_perlin_128", channel_plan("type = \"perlin\"\n" + warp)},
             {"warped_worley_128", channel_plan("type = \"worley\"\n" + warp)},
             {"moving_perlin_128", channel_plan("type = \"perlin\"\n", moving)},
             {"moving_worley_128", channel_plan("type = \"worley\"\n", moving)},
         }) {
        add(name, fill, plan, 128, 1);
    }
    add("nubis_shape_128", fill, preset_plan("nubis_shape", 128), 128, 7);
    add("nubis_detail_32", fill, preset_plan("nubis_detail", 32), 32, 3);
    for (const auto& [name, target] :
         {std::pair<const char*, std::int64_t>{"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}}) {
        if ((hwy::SupportedTargets() & target) == 0) continue;
        const std::string on = std::string("_on_") + name;
        add("perlin_fbm5_256" + on, fill_on, target, perlin_plan(256, 5), 256, 5);
        add("worley_f1_128_cells4" + on, fill_on, target, worley_plan(128, 4), 128, 1);
        add("worley_f1_128_cells192" + on, fill_on, target, worley_plan(128, 192), 128, 1);
        add("nubis_shape_128" + on, fill_on, target, preset_plan("nubis_shape", 128), 128, 7);
    }
    for (const int threads : {1, 2}) {
        const std::string name = "nubis_shape_256_wall_threads" + std::to_string(threads);
        RegisterBenchmark(name.c_str(), on_threads, threads)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
}

}  // namespace
}  // namespace skybake::noise

int main(int argc, char** argv) {
    return skybake::run_benchmarks(argc, argv, skybake::noise::register_all);
}
