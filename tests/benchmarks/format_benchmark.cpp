// Writing volumes as textures and NanoVDB grids to a file in memory, on one thread, in CPU time. The
// voxels come from memory, so that making them takes no time worth speaking of. Bytes are those of
// the files. tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bakers/field/bc4.h"
#include "bakers/field/bc6h.h"
#include "bakers/io/formats/format.h"
#include "tests/support/loops.h"
#include "tests/support/memory_file.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using config::FileFormat;

constexpr int edge = 256;

// Smooth values in [0, 1] with some noise, whole rows at a time.
class HeldVoxels : public VoxelSource {
  public:
    HeldVoxels() : values_(std::size_t{edge} * edge * edge) {
        float* out = values_.data();
        testing::for_each_voxel({edge, edge, edge}, [&](int x, int y, int z) {
            const int wave = (x * 3 + y * 5 + z * 2) % 512;
            const float ramp = static_cast<float>(wave < 256 ? wave : 511 - wave) / 300;
            *out++ = 0.05F + 0.95F * ramp + testing::sample_voxel(x, y, z, 0) / 50;
        });
    }
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        fill_rows(box, channels, [&](std::size_t, int y, int z, float* out) {
            std::copy_n(values_.begin() + (z * edge + y) * edge + box.origin[0], box.size[0], out);
        });
    }
    const std::vector<float>& values() const { return values_; }

  private:
    std::vector<float> values_;
};

std::shared_ptr<const HeldVoxels> held() {
    static const auto source = std::make_shared<const HeldVoxels>();
    return source;
}

void write_format(benchmark::State& state, FileFormat format, PixelType type, int channels) {
    Baked volume = testing::plain_volume({edge, edge, edge}, channels, type);
    volume.levels[0].voxels = held();
    volume.ktx2_compression = config::Ktx2Compression::none;
    const testing::MemoryFile file;
    for (auto _ : state) {
        const auto written = format_of(format).write({volume, 0, "{}", 1, nullptr}, file.path());
        if (written.value != true) state.SkipWithError("not written");
    }
    state.SetBytesProcessed(state.iterations() * file.size());
}

// Encoding planes of blocks; items are voxels of a channel.
void encode_blocks(benchmark::State& state, bool is_bc6h) {
    std::vector<float> texels(held()->values().begin(), held()->values().begin() + (1 << 20));
    texels.resize(texels.size() + bc4_padding);
    const std::size_t rows = is_bc6h ? 64 : 4096;
    const TexelPlane plane = {texels.data(), edge, edge / 4, rows / 4};
    std::vector<std::uint8_t> blocks(plane.blocks_x * plane.blocks_y * 16);
    for (auto _ : state) {
        if (is_bc6h) {
            encode_bc6h({plane, plane, plane}, blocks.data());
        } else {
            encode_bc4(plane, blocks.data(), bc4_bytes);
        }
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rows * edge));
}

BENCHMARK_CAPTURE(write_format, bin_half, FileFormat::bin, PixelType::half, 1);
BENCHMARK_CAPTURE(write_format, bin_float, FileFormat::bin, PixelType::float32, 1);
BENCHMARK_CAPTURE(write_format, dds_half, FileFormat::dds, PixelType::half, 1);
BENCHMARK_CAPTURE(write_format, dds_float, FileFormat::dds, PixelType::float32, 1);
BENCHMARK_CAPTURE(write_format, dds_unorm8_rgb, FileFormat::dds, PixelType::unorm8, 3);
BENCHMARK_CAPTURE(write_format, ktx2_half, FileFormat::ktx2, PixelType::half, 1);
BENCHMARK_CAPTURE(write_format, ktx2_float, FileFormat::ktx2, PixelType::float32, 1);
BENCHMARK_CAPTURE(write_format, ktx2_unorm8, FileFormat::ktx2, PixelType::unorm8, 1);
BENCHMARK_CAPTURE(write_format, nvdb_float, FileFormat::nvdb, PixelType::float32, 1);
BENCHMARK_CAPTURE(write_format, nvdb_half, FileFormat::nvdb, PixelType::half, 1);
BENCHMARK_CAPTURE(write_format, vol_float, FileFormat::vol, PixelType::float32, 1);
BENCHMARK_CAPTURE(encode_blocks, bc4, false);
BENCHMARK_CAPTURE(encode_blocks, bc6h, true);

}  // namespace
}  // namespace skybake
