// Writing a sparse volume as VDB, against OpenVDB's own io::File and a tree that it has in memory:
// 512^3 halves of which 12 % are active, Blosc, to a file system in memory. In one run, wall clock;
// tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true. peak_memory is what a write adds to the process's
// memory, divided by the length of the file.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <tbb/global_control.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <string>

#include "bakers/field/baked.h"
#include "bakers/field/voxel_array.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "tests/support/memory_file.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

constexpr int size = 512;
const VoxelBox whole = {{}, {size, size, size}};

// Balls on a lattice, whose density falls off towards their rim.
float ball_density(int x, int y, int z) {
    constexpr int period = 64;
    constexpr double radius = 19.6;  // 4/3 pi radius^3 / period^3 = 0.12
    const auto offset = [](int i) { return i % period - (period - 1) / 2.0; };
    const double squared = offset(x) * offset(x) + offset(y) * offset(y) + offset(z) * offset(z);
    return static_cast<float>(std::max(0.0, 1 - squared / (radius * radius)));
}

// The voxels in memory, so that making them takes no time worth speaking of.
std::shared_ptr<const VoxelArray> balls() {
    const testing::FunctionVoxels source(
        [](int x, int y, int z, int) { return ball_density(x, y, z); });
    static const auto array =
        std::make_shared<const VoxelArray>(read_voxels(source, whole.size, 1, {}, "balls"));
    return array;
}

Baked volume_of_balls() {
    Baked volume = testing::plain_volume(whole.size, 1, PixelType::half);
    volume.sparse = true;
    volume.levels[0].voxels = balls();
    volume.levels[0].content_hash = "0123456789abcdef0123456789abcdef";
    return volume;
}

openvdb::FloatGrid::Ptr grid_of_balls() {
    openvdb::initialize();
    const openvdb::CoordBBox box(openvdb::Coord(0), openvdb::Coord(size - 1));
    const openvdb::tools::Dense<const float, openvdb::tools::LayoutXYZ> dense(
        box, balls()->channel(0).data());
    openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0F);
    openvdb::tools::copyFromDense(dense, *grid, 0.0F);
    grid->setName("density");
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setSaveFloatAsHalf(true);
    return grid;
}

double status_kib(const std::string& wanted) {
    std::ifstream status("/proc/self/status");
    std::string name;
    double value = 0;
    while (status >> name) {
        if (name == wanted && status >> value) return value;
    }
    return NAN;
}

template <class Write>
void measure(benchmark::State& state, Write&& write) {
    const testing::MemoryFile file;
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins anew
    const double before = status_kib("VmRSS:");
    write(file.path());
    const double peak = status_kib("VmHWM:") - before;
    for (auto _ : state) write(file.path());
    const auto bytes = static_cast<double>(file.size());
    state.counters["file_MiB"] = bytes / (1 << 20);
    state.counters["peak_memory"] = peak * 1024 / bytes;
}

void write_with_skybake(benchmark::State& state, std::size_t most_kept_bytes) {
    const auto threads = static_cast<int>(state.range(0));
    const Baked volume = volume_of_balls();
    measure(state, [&](const std::string& path) {
        const auto written = write_vdb(volume, 0, {}, threads, nullptr, path, most_kept_bytes);
        if (!written.value) state.SkipWithError(written.diagnostics.at(0).message.c_str());
    });
}

void write_with_openvdb(benchmark::State& state) {
    static const openvdb::FloatGrid::Ptr grid = grid_of_balls();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
    state.counters["active"] =
        static_cast<double>(grid->activeVoxelCount()) / static_cast<double>(whole.count());
    measure(state, [&](const std::string& path) {
        openvdb::io::File file(path);
        file.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_BLOSC);
        file.write(openvdb::GridPtrVec{grid});
    });
}

BENCHMARK(write_with_openvdb)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(write_with_skybake, as_usual, vdb_most_kept_bytes)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(write_with_skybake, nothing_kept, 0)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace skybake
