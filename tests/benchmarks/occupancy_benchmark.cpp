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

#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "tests/benchmarks/run.h"
#include "tests/support/every_target.h"
#include "tests/support/loops.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;

// Multiples of 2^-24 in [0, 1), none like its neighbour: no cell is easier than another.
float noise_at(std::size_t index) {
    auto bits = static_cast<std::uint32_t>(index);
    bits = (bits ^ (bits >> 16)) * 0x7feb352dU;
    bits = (bits ^ (bits >> 15)) * 0x846ca68bU;
    return static_cast<float>(bits >> 8) * 0x1p-24F;
}

const AlignedFloats& noise_volume(int size) {
    static AlignedFloats voxels;
    const std::size_t count = count_of({size, size, size});
    if (voxels.size() != count) {
        voxels.resize(count);
        for (std::size_t i = 0; i < count; ++i) voxels[i] = noise_at(i);
    }
    return voxels;
}

void count_bytes(benchmark::State& state, const AlignedFloats& voxels) {
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                            static_cast<std::int64_t>(voxels.size() * sizeof(float)));
}

void ranges(benchmark::State& state, OccupancyFilter filter, int size, int cell) {
    const AlignedFloats& voxels = noise_volume(size);
    const CellGrid grid{{size, size, size}, cell};
    for (auto _ : state) {
        benchmark::DoNotOptimize(cell_ranges(voxels.data(), grid, filter));
    }
    count_bytes(state, voxels);
}

// Ranges of cells like those of clouds, all of which are in the lower eighth.
void ranges_of_layer(benchmark::State& state, int size) {
    AlignedFloats voxels = noise_volume(size);
    std::fill(voxels.begin() + static_cast<std::ptrdiff_t>(voxels.size() / 8), voxels.end(), 0.0F);
    const CellGrid grid{{size, size, size}, 4};
    for (auto _ : state) {
        benchmark::DoNotOptimize(cell_ranges(voxels.data(), grid, OccupancyFilter::trilinear));
    }
    count_bytes(state, voxels);
}

void ranges_on(benchmark::State& state, std::int64_t target, int size) {
    test::on_target(target, [&] { ranges(state, OccupancyFilter::trilinear, size, 4); });
}

// The time of reading alone.
void reads(benchmark::State& state, int size) {
    const AlignedFloats& voxels = noise_volume(size);
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

// A layer of clouds over a fifth of the height: about one cell in eight is occupied.
OccupiedCells cloud_layer(int size) {
    OccupiedCells cells{{size, size, size}, {}};
    testing::for_each_voxel(cells.size, [&](int x, int y, int z) {
        const double wave = std::sin(x * 0.2) + std::sin(y * 0.17) + std::sin(z * 0.3);
        cells.occupied.push_back(5 * z < size && wave > 0.3 ? 1 : 0);
    });
    return cells;
}

void leaps(benchmark::State& state, const OccupiedCells& cells) {
    for (auto _ : state) benchmark::DoNotOptimize(leap_distance(cells));
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                            static_cast<std::int64_t>(cells.occupied.size()));
}

void register_all() {
    const auto add = [](const std::string& name, const auto&... arguments) {
        benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond);
    };
    for (const int size : {128, 512}) {
        const std::string of = '_' + std::to_string(size);
        add("read" + of, reads, size);
        add("range_nearest" + of, ranges, OccupancyFilter::nearest, size, 4);
        for (const int cell : {2, 4, 8, 16}) {
            add("range_trilinear" + of + "_cell" + std::to_string(cell), ranges,
                OccupancyFilter::trilinear, size, cell);
        }
        add("range_trilinear" + of + "_layer", ranges_of_layer, size);
        add("range_tricubic" + of, ranges, OccupancyFilter::tricubic, size, 4);
        for (const auto& [on, target] :
             {std::pair<const char*, std::int64_t>{"_on_avx512", HWY_AVX3},
              {"_on_avx2", HWY_AVX2}}) {
            if ((hwy::SupportedTargets() & target) == 0) continue;
            add("range_trilinear" + of + on, ranges_on, target, size);
        }
    }
    add("leap_128_cloud_layer", leaps, cloud_layer(128));
    OccupiedCells cells{{128, 128, 128}, std::vector<std::uint8_t>(128 * 128 * 128)};
    cells.occupied[0] = 1;
    add("leap_128_single_cell", leaps, cells);
    for (std::size_t i = 0; i < cells.occupied.size(); i += 7) cells.occupied[i] = 1;
    add("leap_128_one_cell_in_seven", leaps, cells);
}

}  // namespace
}  // namespace skybake::occupancy

int main(int argc, char** argv) {
    return skybake::run_benchmarks(argc, argv, skybake::occupancy::register_all);
}
