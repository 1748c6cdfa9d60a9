// Each check of the VDB reader against a file that is wrong in one place alone: the message says which
// check has seen it. Where the library would take memory by a length, the process must not grow.
#include <gtest/gtest.h>
#include <openvdb/math/Maps.h>
#include <sys/resource.h>

#include <bit>
#include <cstring>
#include <limits>

#include "tests/volumes/damaged_files.h"
#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

namespace io = openvdb::io;

constexpr std::uint32_t kMasked = io::COMPRESS_ACTIVE_MASK;

// Where the parts of a file of one grid, "density", begin. The head is 57 bytes: magic, format, two
// versions, a flag and a UUID. Counts of metadata and grids follow, and the grid's descriptor.
constexpr std::size_t kFormat = 8;
constexpr std::size_t kHasOffsets = 20;
constexpr std::size_t kMetadataCount = 57;
constexpr std::size_t kGridName = 65;
constexpr std::size_t kEndOfGrid = kGridName + (4 + 7) + (4 + 16) + 4 + 2 * 8;
constexpr std::size_t kNodeMask = 4096;  // bytes of a mask of an upper node

// Returns the place of any text that stands once.
std::size_t place_of(const std::string& bytes, const std::string& text) {
    const std::size_t at = bytes.find(text);
    EXPECT_NE(at, std::string::npos) << text;
    return at;
}

// A tree begins with the number of buffers, 1, and the background.
std::size_t tree_of(const std::string& bytes, float background) {
    std::string head(8, '\0');
    head[0] = 1;
    std::memcpy(head.data() + 4, &background, sizeof background);
    return place_of(bytes, head);
}

std::string problem_of_bytes(const std::string& bytes, const std::string& grid = "density") {
    const TemporaryFolder folder;
    write_bytes(folder / "v.vdb", bytes);
    return testing::reason_of(open_vdb_grid(folder / "v.vdb", grid, VolumePart::voxels));
}

std::string bytes_of(const openvdb::GridBase::Ptr& grid, std::uint32_t compression = kMasked) {
    const TemporaryFolder folder;
    write_grid(grid, folder / "v.vdb", compression);
    return read_bytes(folder / "v.vdb");
}

// Writes a number at a place of a copy.
std::string with(std::string bytes, std::size_t at, std::uint64_t number, std::size_t count = 4) {
    std::memcpy(&bytes.at(at), &number, count);
    return bytes;
}

constexpr float kBackground = 0.123456F;
constexpr std::uint64_t kHalfGiB = 1U << 29U;

TEST(VdbGuards, TheFileIsWhole) {
    const std::string bytes = bytes_of(any_grid(kBackground));
    EXPECT_EQ(problem_of_bytes(bytes), "");
    EXPECT_EQ(problem_of_bytes(with(bytes, 0, 0)), "it does not begin as a VDB file");
    for (const std::uint64_t format : {0U, 213U, 9999U}) {
        EXPECT_EQ(problem_of_bytes(with(bytes, kFormat, format)), "its format is not known")
            << format;
    }
    EXPECT_EQ(problem_of_bytes(with(bytes, kHasOffsets, 0, 1)), "")
        << "then it is a stream, of the same grid";
}

TEST(VdbGuards, GridsEndBehindTheirHeads) {
    const std::string bytes = bytes_of(any_grid(kBackground));
    const std::string wrong = "a grid does not end behind its head";
    EXPECT_EQ(problem_of_bytes(with(bytes, kEndOfGrid, bytes.size(), 8)), "")
        << "it is the last one";
    EXPECT_EQ(problem_of_bytes(with(bytes, kEndOfGrid, bytes.size() + 1, 8)), wrong);
    EXPECT_EQ(problem_of_bytes(with(bytes, kEndOfGrid, 10, 8)), wrong);
    EXPECT_EQ(problem_of_bytes(with(bytes, kEndOfGrid, ~std::uint64_t{0}, 8)), wrong);
    EXPECT_EQ(problem_of_bytes(with(bytes, kEndOfGrid, bytes.size() - 4, 8)),
              "its voxels do not end where they should");
}

TEST(VdbGuards, MetadataHasTheSizeOfItsType) {
    const std::string bytes = bytes_of(any_grid(kBackground));
    const std::string type = "file_mem_bytes";
    const std::size_t size = place_of(bytes, type) + type.size() + 4 + std::strlen("int64");
    EXPECT_EQ(problem_of_bytes(with(bytes, size, 4)),
              "a value of its metadata has another size than its type");
}

TEST(VdbGuards, NodesAreInTheirPlaces) {
    const std::string bytes = bytes_of(any_grid(kBackground));
    const std::size_t tree = tree_of(bytes, kBackground);
    const std::size_t corner = tree + 16;
    EXPECT_EQ(problem_of_bytes(with(bytes, tree, 2)), "its leaves have several buffers");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const std::uint64_t place : {std::uint64_t{8}, std::uint64_t{1} << 30U,
                                          (std::uint64_t{1} << 32U) - (std::uint64_t{1} << 30U)}) {
            EXPECT_EQ(problem_of_bytes(with(bytes, corner + 4 * axis, place)),
                      "a node is not in its place")
                << axis << " " << place;
        }
    }
}

TEST(VdbGuards, NoTwoNodesAreInOnePlace) {
    const FloatGrid::Ptr grid = FloatGrid::create(kBackground);
    grid->setName("density");
    grid->tree().addTile(3, Coord(0, 0, 0), 0.5F, true);
    grid->tree().addTile(3, Coord(4096, 0, 0), 0.25F, true);
    std::string bytes = bytes_of(grid);
    EXPECT_EQ(problem_of_bytes(bytes), "");
    const std::size_t first = tree_of(bytes, kBackground) + 16;
    bytes.replace(first + 17, 12, bytes.substr(first, 12));  // a corner, a value and a flag each
    EXPECT_EQ(problem_of_bytes(bytes), "two nodes are in the same place");
}

// A node of 512 active tiles, whose values come after two masks and the byte that says which there are.
struct TileNode {
    std::string bytes;
    std::size_t length;  // where the length of the compressed values stands
};
TileNode tile_node(std::uint32_t compression) {
    const FloatGrid::Ptr grid = FloatGrid::create(kBackground);
    grid->setName("density");
    for (int i = 0; i < 512; ++i) {
        grid->tree().addTile(2, Coord(i % 8 * 128, i / 8 % 8 * 128, i / 64 * 128),
                             static_cast<float>(1 + i / 100), true);
    }
    TileNode node{bytes_of(grid, compression | kMasked), 0};
    node.length = tree_of(node.bytes, kBackground) + 16 + 12 + 2 * kNodeMask + 1;
    return node;
}

std::int64_t number_at(const std::string& bytes, std::size_t at, std::size_t count) {
    std::int64_t number = 0;
    std::memcpy(&number, bytes.data() + at, count);
    return number;
}

TEST(VdbGuards, LengthsOfValuesFit) {
    for (const std::uint32_t compression : {io::COMPRESS_ZIP, io::COMPRESS_BLOSC}) {
        const TileNode node = tile_node(compression);
        EXPECT_EQ(problem_of_bytes(node.bytes), "");
        const std::int64_t length = number_at(node.bytes, node.length, 8);
        ASSERT_GT(length, 16);
        ASSERT_LT(length, 2048);
        for (const std::int64_t wrong :
             {std::int64_t{0}, std::int64_t{-1}, std::int64_t{-2047}, std::int64_t{4096},
              std::int64_t{1} << 40U, std::numeric_limits<std::int64_t>::min() + 1}) {
            EXPECT_EQ(problem_of_bytes(
                          with(node.bytes, node.length, static_cast<std::uint64_t>(wrong), 8)),
                      "the length of its values is damaged")
                << wrong;
        }
    }
}

// Blosc trusts the lengths in its own head: of the values, and of itself.
TEST(VdbGuards, BloscsOwnLengthsFit) {
    const TileNode node = tile_node(io::COMPRESS_BLOSC);
    const std::size_t head = node.length + 8;
    EXPECT_EQ(number_at(node.bytes, head + 4, 4), 2048);
    EXPECT_EQ(number_at(node.bytes, head + 12, 4), number_at(node.bytes, node.length, 8));
    const std::string wrong = "its values are damaged";
    EXPECT_EQ(problem_of_bytes(with(node.bytes, head + 4, 2044)), wrong);
    EXPECT_EQ(problem_of_bytes(with(node.bytes, head + 4, 1 << 24)), wrong);
    EXPECT_EQ(problem_of_bytes(with(node.bytes, head + 12, 20)), wrong);
    EXPECT_EQ(problem_of_bytes(with(node.bytes, head + 12, 1 << 24)), wrong);
    EXPECT_EQ(problem_of_bytes(with(node.bytes, node.length, 8, 8)), wrong)
        << "shorter than the head";
    const std::string tiny = with(node.bytes, node.length, 8, 8);
    EXPECT_EQ(problem_of_bytes(with(tiny, head + 12, 8)), wrong) << "and so does the head say";
}

// Lengths of half a gigabyte in a file of some kilobytes: of the first text of the metadata and of the
// names of the grid.
TEST(VdbGuards, LengthsOfTextsTakeNoMemory) {
    const std::string bytes = bytes_of(any_grid(kBackground));
    ASSERT_EQ(problem_of_bytes(bytes), "");
    const long before = testing::peak_kib();
    const std::string text = with(with(bytes, kMetadataCount, 1), kMetadataCount + 4, kHalfGiB);
    EXPECT_EQ(problem_of_bytes(text), "it ends early");
    EXPECT_EQ(problem_of_bytes(with(bytes, kGridName, kHalfGiB)), "it ends early");
    EXPECT_EQ(problem_of_bytes(with(bytes, kGridName + 11, kHalfGiB)), "it ends early");
    EXPECT_EQ(problem_of_bytes(with(bytes, kGridName + 31, kHalfGiB)), "it ends early");
    EXPECT_LT(testing::peak_kib() - before, 100 << 10);
}

TEST(VdbGuards, SharedTreesAreRefused) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr grid = any_grid(kBackground);
    const openvdb::GridBase::Ptr other = grid->copyGrid();
    other->setName("other");
    io::File((folder / "v.vdb").string()).write(openvdb::GridCPtrVec{grid, other});
    const std::string bytes = read_bytes(folder / "v.vdb");
    const std::string shared = "grids share a tree";
    EXPECT_EQ((problem_of_bytes(bytes) == shared) + (problem_of_bytes(bytes, "other") == shared),
              1);
}

TEST(VdbGuards, TransformsAreBoxes) {
    const FloatGrid::Ptr grid = any_grid(kBackground);
    grid->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(8)), 0.5, 10));
    EXPECT_EQ(problem_of_bytes(bytes_of(grid)), "the transform of a grid is a frustum");
}

// The library itself refuses some of these: it cannot invert the transform.
TEST(VdbGuards, TransformsAreFinite) {
    constexpr double kEdge = 0.53125;
    constexpr double kMoved = 7.3125;
    const FloatGrid::Ptr grid = any_grid(kBackground);
    const auto moved = openvdb::math::Transform::createLinearTransform(kEdge);
    moved->postTranslate(openvdb::Vec3d(0, kMoved, 0));
    grid->setTransform(moved);
    const std::string bytes = bytes_of(grid);
    ASSERT_EQ(problem_of_bytes(bytes), "");
    for (const double number : {kEdge, kMoved}) {
        const std::string text(reinterpret_cast<const char*>(&number), sizeof number);
        const std::size_t at = bytes.find(text);
        ASSERT_NE(at, std::string::npos);
        for (const double wrong :
             {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
            EXPECT_NE(problem_of_bytes(with(bytes, at, std::bit_cast<std::uint64_t>(wrong), 8)), "")
                << number << " " << wrong;
        }
    }
}

TEST(VdbGuards, StatedSizesAreSizes) {
    const auto with_size = [](const openvdb::Vec3i& size) {
        const FloatGrid::Ptr grid = any_grid(kBackground);
        grid->insertMeta("skybake/size", openvdb::Vec3IMetadata(size));
        return problem_of_bytes(bytes_of(grid));
    };
    EXPECT_EQ(with_size({5, 16384, 1}), "");
    EXPECT_EQ(with_size({5, 4, 0}), "its size is damaged");
    EXPECT_EQ(with_size({-5, 4, 1}), "its size is damaged");
    EXPECT_EQ(with_size({5, 16385, 1}), "") << "a crop may choose a part";
}

// The voxels are read when they are asked for. A file that is cut or overwritten by then is an
// exception, and no endless loop.
TEST(VdbGuards, FilesDoNotChangeUnseen) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "v.vdb";
    write_grid(any_grid(kBackground), path, io::COMPRESS_ZIP | kMasked);
    const std::string bytes = read_bytes(path);
    const FileVoxels file = testing::opened(path);
    const VoxelBox box{file.first, file.size};
    std::vector<float> values(static_cast<std::size_t>(box.count()));
    const auto reason = [&]() -> std::string {
        try {
            file.voxels->fill(box, {values.data()});
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(reason(), "");
    std::filesystem::resize_file(path, 200);
    EXPECT_EQ(reason(), "it has changed while it was read");
    write_bytes(path, std::string(bytes.size(), '\0'));
    EXPECT_NE(reason(), "");
    write_bytes(path, bytes);
    EXPECT_EQ(reason(), "");
}

}  // namespace
}  // namespace skybake
