// Tests faults: full disks, interruptions, values and files that are not what they should be.
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <sys/resource.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "bakers/math/bake_options.h"
#include "tests/io/files.h"
#include "tests/io/vdb_samples.h"

namespace skybake {
namespace {

using config::PixelType;
using config::VdbCompression;
using testing::first_code;
using testing::TemporaryFolder;
using testing::vdb_sample;
using testing::write_sample;

const auto go_on = [](const VdbSlab&) { return true; };

// Lets the process write files of so many bytes, as long as it lives.
class LargestFile {
  public:
    explicit LargestFile(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit = {bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~LargestFile() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST(VdbWriteFails, WhereTheDiskIsFull) {
    const auto written = write_sample(vdb_sample({64, 64, 64}, 1, PixelType::half), "/dev/full");
    EXPECT_FALSE(written.value.has_value());
    ASSERT_EQ(first_code(written.diagnostics), "E0301");
    EXPECT_NE(written.diagnostics[0].message.find("No space left on device"), std::string::npos)
        << written.diagnostics[0].message;
}

TEST(VdbWriteFails, InTheMiddleOfAFile) {
    const TemporaryFolder folder;
    const Baked volume = vdb_sample({128, 128, 128}, 2, PixelType::half);
    // In the tree of the first grid, in its voxels, in the second grid.
    for (const rlim_t bytes : {100000U, 3000000U, 5000000U}) {
        const LargestFile limit(bytes);
        const auto written = write_sample(volume, folder / "v.vdb");
        EXPECT_FALSE(written.value.has_value());
        ASSERT_EQ(first_code(written.diagnostics), "E0301");
        EXPECT_NE(written.diagnostics[0].message.find("File too large"), std::string::npos);
    }
}

TEST(VdbWriteFails, WhereTheFileCannotBeMade) {
    const TemporaryFolder folder;
    const Baked volume = vdb_sample({4, 4, 4}, 1, PixelType::half);
    EXPECT_EQ(first_code(write_sample(volume, folder / "none/v.vdb").diagnostics), "E0301");
    EXPECT_EQ(first_code(write_sample(volume, folder.path()).diagnostics), "E0301");
}

TEST(VdbWriteFails, ForValuesThatFilesCannotHold) {
    const TemporaryFolder folder;
    const auto code = [&](float value, PixelType type) {
        Baked volume = vdb_sample({130, 40, 20}, 2, type);
        volume.levels[0].voxels =
            std::make_shared<testing::FunctionVoxels>([=](int x, int y, int z, int channel) {
                return x == 129 && y == 33 && z == 7 && channel == 1 ? value : 0.5F;
            });
        const auto written = write_sample(volume, folder / "v.vdb");
        if (written.diagnostics.empty()) return std::string();
        EXPECT_NE(written.diagnostics[0].message.find("(129, 33, 7), channel G"), std::string::npos)
            << written.diagnostics[0].message;
        return written.diagnostics[0].code;
    };
    EXPECT_EQ(code(NAN, PixelType::float32), "E0401");
    EXPECT_EQ(code(-INFINITY, PixelType::half), "E0401");
    EXPECT_EQ(code(65520, PixelType::half), "E0402");
    EXPECT_EQ(code(-1e6F, PixelType::half), "E0402");
    EXPECT_EQ(code(std::nextafter(65520.0F, 0.0F), PixelType::half), "");  // rounds to 65504
    EXPECT_EQ(code(-1e6F, PixelType::float32), "");
}

TEST(VdbWriteFails, ForVolumesThatContradictThemselves) {
    const TemporaryFolder folder;
    const auto code = [&](auto&& change) {
        Baked volume = vdb_sample({4, 4, 4}, 1, PixelType::half);
        change(volume);
        return first_code(write_sample(volume, folder / "v.vdb").diagnostics);
    };
    EXPECT_EQ(code([](Baked&) {}), "");
    EXPECT_EQ(code([](Baked& v) { v.levels.clear(); }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.levels[0].size[1] = 0; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.levels[0].content_hash = "none"; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.pixel_type = PixelType::unorm8; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.voxel_size_m[1] = 0; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.channel_names.clear(); }), "E0500");
}

TEST(VdbWriteFails, WhereVoxelsThrow) {
    const TemporaryFolder folder;
    Baked volume = vdb_sample({64, 64, 64}, 1, PixelType::half);
    volume.levels[0].voxels = std::make_shared<testing::FunctionVoxels>(
        [](int, int, int, int) -> float { throw std::bad_alloc(); });
    EXPECT_EQ(first_code(write_sample(volume, folder / "v.vdb").diagnostics), "E0301");
}

class CancelledAfter : public Progress {
  public:
    explicit CancelledAfter(int looks) : left_(looks) {}
    void advance(std::string_view, double fraction) override { EXPECT_LT(fraction, 1); }
    bool cancelled() const override { return left_.fetch_sub(1) <= 0; }

  private:
    mutable std::atomic<int> left_;
};

TEST(VdbWriteInterrupted, ReturnsEarlyWithoutAnError) {
    const TemporaryFolder folder;
    std::atomic<int> asked = 0;
    Baked volume = vdb_sample({128, 128, 2048}, 1, PixelType::half);
    volume.levels[0].voxels =
        std::make_shared<testing::FunctionVoxels>([&asked](int x, int y, int z, int) {
            if (x % 128 == 0 && y % 32 == 0 && z % 128 == 0) ++asked;
            return 0.5F;
        });
    CancelledAfter progress(30);
    testing::write_bytes(folder / "v.vdb", "");
    const auto written = write_vdb(volume, 0, {}, 2, &progress, folder / "v.vdb");
    ASSERT_TRUE(written.value.has_value());
    EXPECT_FALSE(*written.value);
    EXPECT_GT(asked, 0);
    EXPECT_LT(asked, 32) << "of 64 parts";
}

// --- Reading ------------------------------------------------------------------------------------

TEST(VdbReadFails, WhereThereIsNoFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(first_code(read_vdb(folder / "none.vdb").diagnostics), "E0300");
    EXPECT_EQ(first_code(read_vdb_voxels(folder / "none.vdb", go_on).diagnostics), "E0300");
    EXPECT_EQ(first_code(read_vdb(folder.path()).diagnostics), "E0300");
    EXPECT_EQ(first_code(read_vdb("/dev/null").diagnostics), "E0300");
}

// A dense volume, one of which few voxels are active, and one of which none is.
std::vector<Baked> samples(int channels, VdbCompression compression) {
    std::vector<Baked> all(3, vdb_sample({9, 9, 9}, channels, PixelType::half, compression));
    for (const std::size_t sparse : {1U, 2U}) {
        all[sparse].sparse = true;
        all[sparse].levels[0].voxels =
            std::make_shared<testing::FunctionVoxels>([sparse](int x, int y, int z, int channel) {
                return sparse == 1 && x % 8 == 0 ? testing::sample_voxel(x, y, z, channel) : 0.0F;
            });
    }
    return all;
}

// Wherever the file ends, it is an error and nothing worse.
TEST(VdbReadFails, WhereTheFileEndsEarly) {
    const TemporaryFolder folder;
    for (const VdbCompression compression :
         {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
        for (const Baked& volume : samples(2, compression)) {
            ASSERT_TRUE(write_sample(volume, folder / "v.vdb").value);
            const std::string bytes = testing::read_bytes(folder / "v.vdb");
            ASSERT_TRUE(read_vdb_voxels(folder / "v.vdb", go_on).value.has_value());
            for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
                testing::write_bytes(folder / "cut.vdb", bytes.substr(0, size));
                EXPECT_EQ(first_code(read_vdb_voxels(folder / "cut.vdb", go_on).diagnostics),
                          "E0304")
                    << size << " of " << bytes.size();
            }
        }
    }
}

// Damage gives an error or other values, never a crash or a hang.
TEST(VdbReadFails, OrGivesOtherValuesWhereBytesDiffer) {
    const TemporaryFolder folder;
    testing::Random random(11);
    int refused = 0, changed = 0;
    for (const VdbCompression compression :
         {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
        for (const Baked& volume : samples(1, compression)) {
            ASSERT_TRUE(write_sample(volume, folder / "v.vdb").value);
            const std::string bytes = testing::read_bytes(folder / "v.vdb");
            for (int i = 0; i < 300; ++i) {
                std::string damaged = bytes;
                // Half of the damage goes to the head, which is small beside the voxels.
                const std::size_t at = random.below(i % 2 == 0 ? 700 : bytes.size());
                damaged[at] = static_cast<char>(damaged[at] ^ (1 << random.below(8)));
                testing::write_bytes(folder / "damaged.vdb", damaged);
                const auto read = read_vdb_voxels(folder / "damaged.vdb", go_on);
                read.value.has_value() ? ++changed : ++refused;
                EXPECT_EQ(first_code(read.diagnostics), read.value.has_value() ? "" : "E0304");
            }
        }
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(changed, 0);
}

// A sparse file says its size, which slabs are allocated for.
TEST(VdbReadFails, ForSizesThatAreNotThoseOfTheVoxels) {
    const TemporaryFolder folder;
    const Baked volume = samples(1, VdbCompression::none)[1];
    ASSERT_TRUE(write_sample(volume, folder / "v.vdb").value);
    const std::string bytes = testing::read_bytes(folder / "v.vdb");
    const std::string name = "skybake/size";
    const std::size_t type_at = bytes.find(name, bytes.find("density")) + name.size();
    const std::size_t size_at = type_at + 4 + std::string("vec3i").size() + 4;
    const auto code = [&](const std::array<std::int32_t, 3>& size) {
        std::string damaged = bytes;
        std::memcpy(damaged.data() + size_at, size.data(), sizeof(size));
        testing::write_bytes(folder / "damaged.vdb", damaged);
        return first_code(read_vdb_voxels(folder / "damaged.vdb", go_on).diagnostics);
    };
    EXPECT_EQ(code({9, 9, 9}), "");
    EXPECT_EQ(code({9, 300, 9}), "");     // the rest is 0
    EXPECT_EQ(code({8, 9, 9}), "E0304");  // a leaf less
    EXPECT_EQ(code({9, 9, 8}), "E0304");
    EXPECT_EQ(code({0, 9, 9}), "E0304");
    EXPECT_EQ(code({9, -9, 9}), "E0304");
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    EXPECT_EQ(code({most, most, most}), "E0304");
    EXPECT_EQ(code({9, 9, 16385}), "E0304");
}

TEST(VdbReadFails, ForFilesOfAnotherKind) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "empty.vdb", "");
    testing::write_bytes(folder / "text.vdb", std::string(1000, 'x'));
    EXPECT_EQ(first_code(read_vdb(folder / "empty.vdb").diagnostics), "E0304");
    EXPECT_EQ(first_code(read_vdb(folder / "text.vdb").diagnostics), "E0304");
}

// Files of others can be looked into, and their voxels be read where there is no doubt.
TEST(VdbReadFails, ForVoxelsOfOthersThatAreInDoubt) {
    openvdb::initialize();
    const TemporaryFolder folder;
    const auto code = [&](const openvdb::GridBase::Ptr& grid, const std::string& name) {
        grid->setName(name);
        openvdb::io::File((folder / "v.vdb").string()).write(openvdb::GridPtrVec{grid});
        const auto file = read_vdb(folder / "v.vdb");
        EXPECT_TRUE(file.value.has_value());
        EXPECT_EQ(file.value->grids.at(0).name, name);
        return first_code(read_vdb_voxels(folder / "v.vdb", go_on).diagnostics);
    };
    using openvdb::Coord;
    using openvdb::CoordBBox;
    using openvdb::FloatGrid;
    const auto filled = [](const CoordBBox& box) {
        FloatGrid::Ptr grid = FloatGrid::create();
        grid->denseFill(box, 0.5F);
        return grid;
    };
    const CoordBBox box(Coord(0), Coord(19, 9, 9));
    EXPECT_EQ(code(filled(box), "density"), "");
    EXPECT_EQ(code(filled(box), "temperature"), "");
    EXPECT_EQ(code(filled(CoordBBox(Coord(-1), Coord(9))), "density"), "E0304");
    const FloatGrid::Ptr hole = filled(box);
    hole->tree().setValueOff(Coord(3, 4, 5), 0.0F);
    EXPECT_EQ(code(hole, "density"), "");
    hole->tree().setValueOff(Coord(3, 4, 5), 0.5F);
    EXPECT_EQ(code(hole, "density"), "E0304");
    const FloatGrid::Ptr inactive_tile = filled(box);
    inactive_tile->tree().addTile(1, Coord(64), 0.5F, false);
    EXPECT_EQ(code(inactive_tile, "density"), "E0304");
    const FloatGrid::Ptr tile = FloatGrid::create();
    tile->sparseFill(CoordBBox(Coord(0), Coord(127)), 0.5F);
    EXPECT_EQ(code(tile, "density"), "E0304");
    EXPECT_EQ(code(FloatGrid::create(), "density"), "E0304");  // no voxels at all
    EXPECT_EQ(code(FloatGrid::create(1.0F), "density"), "E0304");
    EXPECT_EQ(code(openvdb::Vec3SGrid::create(), "density"), "E0304");
}

TEST(VdbRead, EndsWhereTheVisitorWants) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_sample(vdb_sample({8, 8, 64}, 1, PixelType::half), folder / "v.vdb").value);
    int slabs = 0;
    const auto read =
        read_vdb_voxels(folder / "v.vdb", [&](const VdbSlab&) { return ++slabs < 3; });
    ASSERT_TRUE(read.value.has_value());
    EXPECT_FALSE(*read.value);
    EXPECT_EQ(slabs, 3);
}

}  // namespace
}  // namespace skybake
