// Damaged VDB and NanoVDB files are errors, or volumes with other numbers: nothing crashes, hangs
// or takes memory that the file does not fill.
#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <sys/resource.h>

#include <ctime>

#include "bakers/clouds/resampled_volume.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/volumes/volume_reader.h"
#include "tests/io/open_formats.h"
#include "tests/io/vdb_samples.h"
#include "tests/support/volumes.h"
#include "tests/volumes/damaged_files.h"
#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

using testing::damaged;

namespace io = openvdb::io;

struct Original {
    config::VolumeFormat format = config::VolumeFormat::vdb;
    std::string bytes;
    std::string grid = {};
};

// The library's file of leaves of codes.
template <class Build>
Original coded_original(const TemporaryFolder& folder) {
    nanovdb::OpenToNanoVDB<float, Build> convert;
    nanovdb::io::writeGrid((folder / "coded.nvdb").string(), convert(*any_grid()));
    return {config::VolumeFormat::nvdb, testing::read_bytes(folder / "coded.nvdb")};
}

// Dense and sparse files of our own, and those of all types of leaves.
std::vector<Original> nvdb_originals(const TemporaryFolder& folder) {
    std::vector<Original> all = {coded_original<nanovdb::Fp8>(folder),
                                 coded_original<nanovdb::Fp16>(folder)};
    for (const bool is_sparse : {false, true}) {
        Baked volume = testing::plain_volume({20, 17, 9}, 1, config::PixelType::float32);
        volume.voxel_size_m = {1, 2, 3};
        volume.sparse = is_sparse;
        testing::write_bytes(folder / "own.nvdb", "");
        EXPECT_TRUE(format_of(config::FileFormat::nvdb)
                        .write({volume, 0, "{}", 1, nullptr}, folder / "own.nvdb")
                        .value);
        all.push_back({config::VolumeFormat::nvdb, testing::read_bytes(folder / "own.nvdb")});
    }
    return all;
}

// Files of OpenVDB's writer in all compressions, as float and half, of numbers and of vectors, and a sparse file
// of our own.
std::vector<Original> vdb_originals(const TemporaryFolder& folder) {
    std::vector<Original> all;
    const auto add = [&] {
        all.push_back({config::VolumeFormat::vdb, testing::read_bytes(folder / "v.vdb")});
    };
    for (const bool half : {false, true}) {
        const auto grid = testing::any_grid();
        grid->setSaveFloatAsHalf(half);
        for (const std::uint32_t compression :
             {std::uint32_t{io::COMPRESS_ACTIVE_MASK},
              io::COMPRESS_ZIP | std::uint32_t{io::COMPRESS_ACTIVE_MASK},
              io::COMPRESS_BLOSC | std::uint32_t{io::COMPRESS_ACTIVE_MASK}}) {
            testing::write_grid(grid, folder / "v.vdb", compression);
            add();
            const auto flow = openvdb::Vec3SGrid::create();
            flow->setName("flow");
            flow->setSaveFloatAsHalf(half);
            flow->tree().topologyUnion(grid->tree());
            for (auto value = flow->beginValueOn(); value; ++value) {
                const float density = grid->tree().getValue(value.getCoord());
                value.setValue({density, -density, 1});
            }
            testing::write_grid(flow, folder / "v.vdb", compression);
            add();
            all.back().grid = "flow.x";
        }
    }
    Baked own =
        testing::vdb_sample({20, 17, 9}, 1, config::PixelType::half, config::VdbCompression::blosc);
    own.sparse = true;
    EXPECT_TRUE(testing::write_sample(own, folder / "own.vdb").value);
    all.push_back({config::VolumeFormat::vdb, testing::read_bytes(folder / "own.vdb")});
    return all;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Tally {
    int refused = 0;
    int opened = 0;
    double longest = 0;  // seconds of processor time for one file
    long grown_kib = 0;  // of the process's peak memory
};

// Reads a volume as a cloud of few voxels does. What a damaged file calls its size may be more than
// there is time to read.
void use(const SourceVoxels& source) {
    constexpr std::int64_t most_voxels = 1 << 26;
    if (VoxelBox{{}, source.size}.count() > most_voxels) return;
    const std::array<int, 3> size = {4, 4, 4};
    const cloud::ResampledVolume voxels({source, config::VolumeWrap::empty}, size);
    const std::vector<float> values = testing::planes_of(voxels, {{}, size}, 1)[0];
    for (const float value : values) EXPECT_LE(value, source.largest * 1.0001F);
}

// The readers of own files are held to the same.
void read_as_own(const Original& original, const std::filesystem::path& path) {
    const bool is_vdb = original.format == config::VolumeFormat::vdb;
    const Format& format = format_of(is_vdb ? config::FileFormat::vdb : config::FileFormat::nvdb);
    static_cast<void>(testing::inspect_file(format, path));
    static_cast<void>(
        testing::read_file_of(format, path, {{20, 17, 9}, 1, config::PixelType::float32, {}, 1}, 0,
                              [](std::int64_t, std::int64_t, const float*) { return true; }));
}

Tally read_damaged(const TemporaryFolder& folder, const std::vector<Original>& files,
                   std::uint64_t first_seed, int count) {
    config::VolumeFile volume;
    volume.path = folder / "damaged.vdb";
    const long before = testing::peak_kib();
    Tally tally;
    for (int i = 0; i < count; ++i) {
        const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
        const Original& original = files[seed % files.size()];
        volume.format = original.format;
        volume.grid = original.grid;
        testing::write_bytes(volume.path, damaged(original.bytes, seed));
        const double begin = processor_seconds();
        const auto source = open_volume(volume);
        if (source.value) {
            ++tally.opened;
            use(*source.value);
        } else {
            ++tally.refused;
            const std::string& code = source.diagnostics.at(0).code;
            EXPECT_TRUE(code == "E0304" || code == "E0110") << code << ", seed " << seed;
        }
        read_as_own(original, volume.path);
        tally.longest = std::max(tally.longest, processor_seconds() - begin);
    }
    tally.grown_kib = testing::peak_kib() - before;
    return tally;
}

// Some damage goes unseen: that of voxels, and of places that hold nothing.
void expect_harmless(const Tally& tally, double least_refused) {
    std::printf("%d refused, %d opened, longest %.3f s, peak memory grew by %ld KiB\n",
                tally.refused, tally.opened, tally.longest, tally.grown_kib);
    EXPECT_GT(tally.refused, least_refused * (tally.refused + tally.opened));
    EXPECT_LT(tally.longest, 10) << "no file hangs";
    EXPECT_LT(tally.grown_kib, 300 << 10);
}

TEST(DamagedVdb, DoesNoHarm) {
    const TemporaryFolder folder;
    expect_harmless(read_damaged(folder, vdb_originals(folder), 1, 200), 0.5);
}

TEST(DamagedNvdb, DoesNoHarm) {
    const TemporaryFolder folder;
    expect_harmless(read_damaged(folder, nvdb_originals(folder), 1, 200), 0.4);
}

TEST(ManyDamagedVdbs, DoNoHarm) {
    const TemporaryFolder folder;
    expect_harmless(read_damaged(folder, vdb_originals(folder), 1000, 2000), 0.5);
}

TEST(ManyDamagedNvdbs, DoNoHarm) {
    const TemporaryFolder folder;
    expect_harmless(read_damaged(folder, nvdb_originals(folder), 1000, 2000), 0.4);
}

// Every early end of a file is seen.
TEST(DamagedVdb, IsRefusedWhereverItEnds) {
    const TemporaryFolder folder;
    config::VolumeFile volume;
    volume.path = folder / "cut.vdb";
    for (const Original& original : vdb_originals(folder)) {
        const std::string& bytes = original.bytes;
        volume.grid = original.grid;
        for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 40) {
            testing::write_bytes(volume.path, bytes.substr(0, size));
            const auto source = open_volume(volume);
            EXPECT_FALSE(source.value) << size << " of " << bytes.size();
        }
    }
}

}  // namespace
}  // namespace skybake
