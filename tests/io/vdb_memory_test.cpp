// A volume whose tree would take 2 GiB, within a quarter of that.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>

#include "tests/io/files.h"
#include "tests/io/vdb_samples.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

double peak_memory_mib() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

// Reads a file that has been written; neither may take much memory.
void expect_little_memory(const std::filesystem::path& path) {
    const double written = peak_memory_mib();
    const auto read = testing::read_vdb_voxels(path, [](const testing::VdbSlab&) { return true; });
    ASSERT_TRUE(read.value.has_value());
    fmt::print("peak memory: {:.0f} MiB after writing, {:.0f} MiB after reading\n", written,
               peak_memory_mib());
    EXPECT_LT(peak_memory_mib(), 256);
}

// Cheap values: the test is of what the writer and reader need.
class Ramp : public VoxelSource {
  public:
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        float* out = channels[0];
        testing::for_each_voxel(box.size, [&](int x, int y, int z) {
            *out++ = static_cast<float>((x + y + z) % 1024) / 1024;
        });
    }
};

TEST(VdbMemory, DoesNotGrowWithTheVolume) {
    const testing::TemporaryFolder folder;
    Baked volume = testing::vdb_sample({1024, 1024, 512}, 1, config::PixelType::half);
    volume.levels[0].voxels = std::make_shared<Ramp>();
    ASSERT_TRUE(testing::write_sample(volume, folder / "v.vdb").value.has_value());
    expect_little_memory(folder / "v.vdb");
}

// A quarter of the voxels, in layers that each leaf has some of; the file takes 256 MiB.
class Layers : public VoxelSource {
  public:
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        Ramp().fill(box, channels);
        const std::int64_t plane = std::int64_t{box.size[0]} * box.size[1];
        for (int z = 0; z < box.size[2]; ++z) {
            if ((box.origin[2] + z) % 4 != 0) std::fill_n(channels[0] + z * plane, plane, 0.0F);
        }
    }
};

TEST(VdbMemory, OfASparseVolumeIsWhatIsKept) {
    const testing::TemporaryFolder folder;
    Baked volume = testing::vdb_sample({1024, 1024, 512}, 1, config::PixelType::half);
    volume.sparse = true;
    volume.levels[0].voxels = std::make_shared<Layers>();
    testing::write_bytes(folder / "v.vdb", "");
    constexpr std::size_t kept = 32 << 20;
    ASSERT_TRUE(write_vdb(volume, 0, {}, 2, nullptr, folder / "v.vdb", kept).value.has_value());
    // A million leaves of 66 bytes, and as much as the dense volume takes.
    expect_little_memory(folder / "v.vdb");
}

}  // namespace
}  // namespace skybake
