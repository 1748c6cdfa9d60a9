// Speed of occupancy grids on one thread, CPU time: bytes_per_second are of densities read, in
// powers of 1024.
// tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "bakers/math/memory.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "tests/benchmarks/on_target.h"
#include "tests/occupancy/volumes_in_memory.h"
#include "tests/support/loops.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;

// Numbers in [0, 1), none like its neighbour: no cell is easier than another.
const AlignedFloats& noise_volume(int size) {
    static AlignedFloats voxels;
    voxels.resize(count_of({size, size, size}));
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        voxels[i] = test::share_of(test::mixed(static_cast<std::uint32_t>(i)));
    }
    return voxels;
}

void count_bytes(benchmark::State& state, const AlignedFloats& voxels) {
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                            static_cast<std::int64_t>(voxels.size() * sizeof(float)));
}

void ranges_of(benchmark::State& state, const AlignedFloats& voxels, OccupancyFilter filter,
               int cell) {
    const auto size = static_cast<int>(state.range(0));
    const CellGrid grid{{size, size, size}, cell};
    for (auto _ : state) {
        benchmark::DoNotOptimize(cell_ranges(voxels.data(), grid, filter));
    }
    count_bytes(state, voxels);
}

// Arguments are voxels along an edge of the volume and of a cell.
void ranges(benchmark::State& state, OccupancyFilter filter) {
    ranges_of(state, noise_volume(static_cast<int>(state.range(0))), filter,
              static_cast<int>(state.range(1)));
}

// Ranges of cells like those of clouds, all of which are in the lower eighth.
void ranges_of_layer(benchmark::State& state) {
    AlignedFloats voxels = noise_volume(static_cast<int>(state.range(0)));
    std::fill(voxels.begin() + static_cast<std::ptrdiff_t>(voxels.size() / 8), voxels.end(), 0.0F);
    ranges_of(state, voxels, OccupancyFilter::trilinear, 4);
}

void ranges_on(benchmark::State& state, std::int64_t target) {
    on_target(state, target, [&] { ranges(state, OccupancyFilter::trilinear); });
}

// The time of reading alone.
void reads(benchmark::State& state) {
    const AlignedFloats& voxels = noise_volume(static_cast<int>(state.range(0)));
    const auto* words = reinterpret_cast<const unsigned char*>(voxels.data());
    for (auto _ : state) {
        std::array<std::uint64_t, 4> sums{};
        for (std::size_t i = 0; i < voxels.size() * sizeof(float); i += sizeof sums) {
            std::array<std::uint64_t, 4> piece;
            std::memcpy(piece.data(), words + i, sizeof piece);
            for (std::size_t lane = 0; lane < sums.size(); ++lane) sums[lane] += piece[lane];
        }
        benchmark::DoNotOptimize(sums);
    }
    count_bytes(state, voxels);
}

// Calls a function of (x, y, z) that says which cells of 128³ are occupied.
template <class Occupied>
void leaps(benchmark::State& state, const Occupied& is_occupied) {
    OccupiedCells cells{{128, 128, 128}, {}};
    testing::for_each_voxel(cells.size, [&](int x, int y, int z) {
        cells.occupied.push_back(is_occupied(x, y, z) ? 1 : 0);
    });
    for (auto _ : state) benchmark::DoNotOptimize(leap_distance(cells));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells.occupied.size()));
}

BENCHMARK(reads)->Arg(128)->Arg(512);
BENCHMARK_CAPTURE(ranges, nearest, OccupancyFilter::nearest)->ArgsProduct({{128, 512}, {4}});
BENCHMARK_CAPTURE(ranges, trilinear, OccupancyFilter::trilinear)
    ->ArgsProduct({{128, 512}, {2, 4, 8, 16}});
BENCHMARK_CAPTURE(ranges, tricubic, OccupancyFilter::tricubic)->ArgsProduct({{128, 512}, {4}});
BENCHMARK(ranges_of_layer)->Arg(128)->Arg(512);
BENCHMARK_CAPTURE(ranges_on, avx512, HWY_AVX3)->ArgsProduct({{128, 512}, {4}});
BENCHMARK_CAPTURE(ranges_on, avx2, HWY_AVX2)->ArgsProduct({{128, 512}, {4}});
// A layer of clouds over a fifth of the height: about one cell in eight is occupied.
BENCHMARK_CAPTURE(leaps, cloud_layer, [](int x, int y, int z) {
    return 5 * z < 128 && std::sin(x * 0.2) + std::sin(y * 0.17) + std::sin(z * 0.3) > 0.3;
});
BENCHMARK_CAPTURE(leaps, single_cell, [](int x, int y, int z) { return x + y + z == 0; });
BENCHMARK_CAPTURE(leaps, one_cell_in_seven,
                  [](int x, int y, int z) { return ((z * 128 + y) * 128 + x) % 7 == 0; });

}  // namespace
}  // namespace skybake::occupancy
