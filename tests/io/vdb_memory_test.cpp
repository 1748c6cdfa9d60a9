// A volume whose tree would take 2 GiB, within a quarter of that.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/io/files.h"
#include "tests/io/open_formats.h"
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
void expect_little_memory(const Baked& volume, const std::filesystem::path& path) {
    const double written = peak_memory_mib();
    const auto visit = [](std::int64_t, std::int64_t, const float*) { return true; };
    const auto read =
        testing::read_file_of(vdb_format(), path, testing::shape_of(volume), 0, visit);
    ASSERT_TRUE(read.value.has_value());
    fmt::print("peak memory: {:.0f} MiB after writing, {:.0f} MiB after reading\n", written,
               peak_memory_mib());
    EXPECT_LT(peak_memory_mib(), 256);
}

float ramp(int x, int y, int z, int) { return static_cast<float>((x + y + z) % 1024) / 1024; }

// A volume of 2 GiB whose voxels a function makes.
Baked volume_of(testing::FunctionVoxels::Function function) {
    Baked volume = testing::vdb_sample({1024, 1024, 512}, 1, config::PixelType::half);
    volume.levels[0].voxels = std::make_shared<testing::FunctionVoxels>(std::move(function));
    return volume;
}

TEST(VdbMemory, DoesNotGrowWithTheVolume) {
    const testing::TemporaryFolder folder;
    const Baked volume = volume_of(ramp);
    ASSERT_TRUE(testing::write_sample(volume, folder / "v.vdb").value.has_value());
    expect_little_memory(volume, folder / "v.vdb");
}

// A quarter of the voxels, in layers that each leaf has some of; the file takes 256 MiB.
TEST(VdbMemory, OfASparseVolumeIsWhatIsKept) {
    const testing::TemporaryFolder folder;
    Baked volume =
        volume_of([](int x, int y, int z, int c) { return z % 4 == 0 ? ramp(x, y, z, c) : 0.0F; });
    volume.sparse = true;
    testing::write_bytes(folder / "v.vdb", "");
    constexpr std::size_t kept = 32 << 20;
    ASSERT_TRUE(write_vdb(volume, 0, {}, 2, nullptr, folder / "v.vdb", kept).value.has_value());
    // A million leaves of 66 bytes, and as much as the dense volume takes.
    expect_little_memory(volume, folder / "v.vdb");
}

}  // namespace
}  // namespace skybake
