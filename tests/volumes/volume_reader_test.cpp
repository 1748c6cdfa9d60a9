// Volumes as a recipe places them: layouts of raw files, crops, axes and borders.
#include "bakers/io/volumes/volume_reader.h"

#include <gtest/gtest.h>

#include <bit>

#include "bakers/math/half_conversion.h"
#include "tests/io/files.h"
#include "tests/support/outcomes.h"
#include "tests/support/volumes.h"
#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

using config::AxisOrder;
using config::ByteOrder;
using config::Length;
using config::VolumeFile;
using config::VolumeFormat;
using config::VolumeUp;

using Place = std::array<int, 3>;

// Returns the number in voxel (x, y, z) of a file: its index in decimal digits, over 255 in bytes.
int number_of_voxel(const Place& at) { return at[0] + 10 * at[1] + 100 * at[2]; }

std::string bytes_of_number(int number, PixelType type, ByteOrder order) {
    std::uint32_t bits = static_cast<std::uint32_t>(number);
    std::size_t count = type == PixelType::unorm8 ? 1 : 2;
    if (type == PixelType::float32) {
        bits = std::bit_cast<std::uint32_t>(static_cast<float>(number));
        count = 4;
    }
    if (type == PixelType::half) bits = half_of_float(static_cast<float>(number));
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) {
        bytes += static_cast<char>(bits >> 8 * (order == ByteOrder::little ? i : count - 1 - i));
    }
    return bytes;
}

struct Order {
    AxisOrder order;
    std::array<std::size_t, 3> axes;  // fastest first
};
const std::array<Order, 6> orders = {{{AxisOrder::xyz, {0, 1, 2}},
                                      {AxisOrder::xzy, {0, 2, 1}},
                                      {AxisOrder::yxz, {1, 0, 2}},
                                      {AxisOrder::yzx, {1, 2, 0}},
                                      {AxisOrder::zxy, {2, 0, 1}},
                                      {AxisOrder::zyx, {2, 1, 0}}}};

constexpr Place raw_size = {4, 3, 2};

VolumeFile raw_volume(const std::filesystem::path& path) {
    VolumeFile volume;
    volume.file = "v.raw";
    volume.path = path;
    volume.format = VolumeFormat::raw;
    volume.size = raw_size;
    volume.voxel_size = {Length{1}, Length{2}, Length{3}};
    volume.file_place = {"recipe.toml", 2, 8, 7, "file = \"v.raw\""};
    return volume;
}

void write_raw(const VolumeFile& volume, const std::array<std::size_t, 3>& axes) {
    std::string bytes(static_cast<std::size_t>(volume.offset), '?');
    Place at{};
    const Place size = {raw_size[axes[0]], raw_size[axes[1]], raw_size[axes[2]]};
    testing::for_each_voxel(size, [&](int fast, int middle, int slow) {
        at[axes[0]] = fast;
        at[axes[1]] = middle;
        at[axes[2]] = slow;
        bytes += bytes_of_number(number_of_voxel(at), volume.type, volume.byte_order);
    });
    testing::write_bytes(volume.path, bytes);
}

SourceVoxels opened_volume(const VolumeFile& volume) {
    return test::without_diagnostics(open_volume(volume));
}

// Opens a raw volume whose order is x, y, z.
SourceVoxels written(const VolumeFile& volume) {
    write_raw(volume, orders[0].axes);
    return opened_volume(volume);
}

float voxel_of(const SourceVoxels& source, const Place& at) {
    float value = -1;
    source.voxels->fill({at, {1, 1, 1}}, {&value});
    return value;
}

// Expects that voxel `at` of the cloud holds number_of_voxel(file_at(at)), one by one and as one box.
template <class FileAt>
void expect_voxels(const SourceVoxels& source, const FileAt& file_at, float unit = 1) {
    const std::vector<float> all = testing::planes_of(*source.voxels, {{}, source.size}, 1)[0];
    std::size_t i = 0;
    testing::for_each_voxel(source.size, [&](int x, int y, int z) {
        const float wanted = static_cast<float>(number_of_voxel(file_at(Place{x, y, z}))) / unit;
        EXPECT_EQ(voxel_of(source, {x, y, z}), wanted) << x << " " << y << " " << z;
        EXPECT_EQ(all[i++], wanted);
    });
}

const auto as_it_is = [](const Place& at) { return at; };

std::string first_message(const VolumeFile& volume) {
    const auto source = open_volume(volume);
    if (source.value) return "";
    const config::Diagnostic& first = source.diagnostics.at(0);
    EXPECT_EQ(first.where.line, 2) << "the recipe's line of `file`";
    return first.code + ": " + first.message;
}

TEST(RawVolume, IsReadInEveryLayout) {
    const TemporaryFolder folder;
    for (const PixelType type :
         {PixelType::float32, PixelType::half, PixelType::unorm8, PixelType::unorm16}) {
        for (const ByteOrder byte_order : {ByteOrder::little, ByteOrder::big}) {
            for (const Order& order : orders) {
                for (const int offset : {0, 5}) {
                    VolumeFile volume = raw_volume(folder / "v.raw");
                    volume.type = type;
                    volume.byte_order = byte_order;
                    volume.axis_order = order.order;
                    volume.offset = offset;
                    write_raw(volume, order.axes);
                    const float unit = type == PixelType::unorm8
                                           ? 255.0F
                                           : (type == PixelType::unorm16 ? 65535.0F : 1.0F);
                    expect_voxels(opened_volume(volume), as_it_is, unit);
                }
            }
        }
    }
}

TEST(RawVolume, HasTheSizeOfItsVoxels) {
    const TemporaryFolder folder;
    VolumeFile volume = raw_volume(folder / "v.raw");
    const SourceVoxels source = written(volume);
    EXPECT_EQ(source.size, raw_size);
    EXPECT_EQ(source.voxel_size_m, (std::array<double, 3>{1, 2, 3}));
    EXPECT_EQ(source.largest, 123.0F);
    EXPECT_EQ(read_volume_shape(volume).value->size, raw_size);
}

TEST(RawVolume, IsEmptyBeyondItsSize) {
    const TemporaryFolder folder;
    VolumeFile volume = raw_volume(folder / "v.raw");
    write_raw(volume, orders[5].axes);
    volume.axis_order = orders[5].order;
    const SourceVoxels source = opened_volume(volume);
    for (const Place& at : {Place{-1, 0, 0}, Place{4, 0, 0}, Place{0, 3, 0}, Place{0, 0, -1}}) {
        EXPECT_EQ(voxel_of(source, at), 0.0F);
    }
    EXPECT_EQ(voxel_of(source, {3, 2, 1}), 123.0F);
}

// With y up the cloud is turned, not mirrored: x, y and z of the cloud are x, -z and y of the file.
TEST(VolumeAxes, AreTurnedWhereYIsUp) {
    const TemporaryFolder folder;
    VolumeFile volume = raw_volume(folder / "v.raw");
    volume.up_axis = VolumeUp::y;
    const SourceVoxels source = written(volume);
    EXPECT_EQ(source.size, (Place{4, 2, 3}));
    EXPECT_EQ(source.voxel_size_m, (std::array<double, 3>{1, 3, 2}));
    expect_voxels(source, [](const Place& at) { return Place{at[0], at[2], 1 - at[1]}; });
}

TEST(VolumeCrop, TakesTheVoxelsThatItCounts) {
    const TemporaryFolder folder;
    for (const VolumeUp up : {VolumeUp::z, VolumeUp::y}) {
        VolumeFile volume = raw_volume(folder / "v.raw");
        volume.up_axis = up;
        volume.crop_first = {1, 1, 0};
        volume.crop_size = {2, 2, 1};
        const SourceVoxels source = written(volume);
        EXPECT_EQ(source.size, (up == VolumeUp::z ? Place{2, 2, 1} : Place{2, 1, 2}));
        expect_voxels(source, [up](const Place& at) {
            const Place file = up == VolumeUp::z ? at : Place{at[0], at[2], 0};
            return Place{1 + file[0], 1 + file[1], file[2]};
        });
        EXPECT_EQ(voxel_of(source, {2, 0, 0}), 0.0F) << "the file goes on, the crop does not";
    }
}

TEST(VolumeCrop, TakesMetres) {
    const TemporaryFolder folder;
    VolumeFile volume = raw_volume(folder / "v.raw");
    volume.crop_corner = {Length{1.2}, Length{0}, Length{3}};
    volume.crop_extent = {Length{2}, Length{2}, Length{3}};
    const SourceVoxels source = written(volume);
    EXPECT_EQ(source.size, (Place{2, 1, 1}));
    expect_voxels(source, [](const Place& at) { return Place{1 + at[0], 0, 1}; });
}

TEST(VolumeCrop, TakesMetresOfAVdbFilesSpace) {
    const TemporaryFolder folder;
    const auto grid = testing::any_grid();
    const auto transform = openvdb::math::Transform::createLinearTransform(2);
    transform->postTranslate(openvdb::Vec3d(100, 0, 0));
    grid->setTransform(transform);
    testing::write_grid(grid, folder / "v.vdb");
    VolumeFile volume;
    volume.path = folder / "v.vdb";
    // Voxel 0 is centred at 100 m and reaches from 99 m to 101 m.
    volume.crop_corner = {Length{99}, Length{-1}, Length{-1}};
    volume.crop_extent = {Length{8}, Length{6}, Length{4}};
    const SourceVoxels source = opened_volume(volume);
    ASSERT_EQ(source.size, (Place{4, 3, 2}));
    const auto voxels = grid->getConstAccessor();
    for (int x = 0; x < 4; ++x) {
        EXPECT_EQ(voxel_of(source, {x, 2, 1}), voxels.getValue(openvdb::Coord(x, 2, 1)));
    }
}

TEST(VolumeBorder, IsBackgroundAtTheSides) {
    const TemporaryFolder folder;
    VolumeFile volume = raw_volume(folder / "v.raw");
    volume.border = 2;
    const SourceVoxels source = written(volume);
    EXPECT_EQ(source.size, (Place{8, 7, 2}));
    EXPECT_EQ(voxel_of(source, {2, 2, 0}), 0.0F);
    EXPECT_EQ(voxel_of(source, {3, 4, 1}), 121.0F);
    EXPECT_EQ(voxel_of(source, {1, 2, 1}), 0.0F);
    EXPECT_EQ(voxel_of(source, {6, 4, 1}), 0.0F);
    EXPECT_EQ(read_volume_shape(volume).value->size, source.size);
}

TEST(VolumeBackground, IsTheFilesTimesTheScale) {
    const TemporaryFolder folder;
    testing::write_grid(testing::any_grid(0.25F), folder / "v.vdb");
    VolumeFile volume;
    volume.path = folder / "v.vdb";
    volume.scale = 3;
    volume.border = 1;
    const SourceVoxels source = opened_volume(volume);
    EXPECT_EQ(source.beyond, 0.75F);
    EXPECT_EQ(voxel_of(source, {0, 0, 0}), 0.75F) << "in the border";
    EXPECT_EQ(voxel_of(source, {-5, 0, 0}), 0.75F);
    EXPECT_FALSE(source.voxels->is_empty({{-5, 0, 0}, {1, 1, 1}}));
    EXPECT_EQ(source.largest, 3.0F * (96.0F / 97));
}

TEST(VolumeFails, WhereTheFileIsNotWhatTheRecipeSays) {
    const TemporaryFolder folder;
    const std::string path = (folder / "v.raw").string();
    VolumeFile volume = raw_volume(path);
    EXPECT_EQ(first_message(volume),
              "E0300: cannot read `" + path + "`: No such file or directory");
    write_raw(volume, orders[0].axes);
    volume.type = PixelType::half;
    EXPECT_EQ(first_message(volume),
              "E0304: cannot read `" + path +
                  "` as a raw volume: it has 96 bytes, and the layout has 48");
    volume.type = PixelType::float32;
    volume.offset = 1;
    EXPECT_EQ(first_message(volume),
              "E0304: cannot read `" + path +
                  "` as a raw volume: it has 96 bytes, and the layout has 97");
    volume.offset = 0;
    volume.byte_order = ByteOrder::big;
    EXPECT_EQ(first_message(volume), "") << "small numbers are finite that way too";
    volume.byte_order = ByteOrder::little;
    std::string bytes = testing::read_bytes(path);
    bytes.replace(
        4 * 17, 4,
        bytes_of_number(0x7fc0, PixelType::unorm16, ByteOrder::big) + std::string(2, '\0'));
    std::reverse(bytes.begin() + 4 * 17, bytes.begin() + 4 * 18);
    testing::write_bytes(path, bytes);
    EXPECT_EQ(
        first_message(volume),
        "E0304: cannot read `" + path +
            "` as a raw volume: its voxel (1, 1, 1) is nan; not_finite = \"background\" takes the "
            "background in their place");
    volume.not_finite = config::NotFinite::background;
    const auto cleared = open_volume(volume);
    ASSERT_TRUE(cleared.value);
    EXPECT_EQ(voxel_of(*cleared.value, {1, 1, 1}), 0);
    EXPECT_EQ(voxel_of(*cleared.value, {2, 1, 1}), 112);
}

// A file knows where it lies; what is cut and bordered lies accordingly.
TEST(Volume, LiesWhereItsFileSays) {
    const TemporaryFolder folder;
    const testing::FloatGrid::Ptr grid = testing::any_grid();
    const auto transform = openvdb::math::Transform::createLinearTransform(0.5);
    transform->postTranslate(openvdb::Vec3d(1234.5, -77, 900));
    grid->setTransform(transform);
    grid->tree().setValue(testing::Coord(20000, 0, 0), 1);
    testing::write_grid(grid, folder / "v.vdb");
    VolumeFile volume;
    volume.path = folder / "v.vdb";
    EXPECT_NE(open_volume(volume).diagnostics.at(0).message.find(
                  "it has 20033 voxels along x, and at most 16384 are "
                  "read; crop_first and crop_size choose a part"),
              std::string::npos);
    volume.crop_first = {-3, 2, 5};
    volume.crop_size = {10, 20, 8};
    const auto corner = [&] { return read_volume_shape(volume).value.value().corner_m; };
    EXPECT_EQ(corner(), (std::array<double, 3>{1234.5 - 1.75, -77 + 0.75, 900 + 2.25}));
    volume.border = 2;
    EXPECT_EQ(corner(), (std::array<double, 3>{1234.5 - 2.75, -77 - 0.25, 900 + 2.25}));
    volume.border = 0;
    volume.up_axis = VolumeUp::y;  // the cloud's y is the file's -z, which ends at 900 + 2.25 + 4
    EXPECT_EQ(corner(), (std::array<double, 3>{1234.5 - 1.75, -906.25, -77 + 0.75}));
}

TEST(Volume, WarnsOfValuesBelowZero) {
    const TemporaryFolder folder;
    const testing::FloatGrid::Ptr grid = testing::any_grid();
    grid->tree().setValue(testing::Coord(3, 4, 5), -2);
    grid->tree().setValue(testing::Coord(30, 4, 5), -7);
    testing::write_grid(grid, folder / "v.vdb");
    VolumeFile volume;
    volume.path = folder / "v.vdb";
    const auto source = open_volume(volume);
    ASSERT_TRUE(source.value);
    ASSERT_EQ(source.diagnostics.size(), 1U);
    EXPECT_EQ(source.diagnostics[0].code, "W0226");
    EXPECT_NE(source.diagnostics[0].message.find(
                  "its voxel (3, 4, 5) is -2, the first of 2 that are below 0, "
                  "and -7 is the least; they count as 0"),
              std::string::npos)
        << source.diagnostics[0].message;
}

TEST(VolumeFails, WhereTheCropIsBesideTheFile) {
    const TemporaryFolder folder;
    const std::string path = (folder / "v.raw").string();
    VolumeFile volume = raw_volume(path);
    write_raw(volume, orders[0].axes);
    volume.crop_first = {0, 3, 0};
    volume.crop_size = {1, 1, 1};
    EXPECT_EQ(first_message(volume),
              "E0110: cannot take a volume from `" + path +
                  "`: its voxels along y are 0 to 2, and the crop is 3 to 3");
    volume.crop_first = {0, 2, 0};
    volume.crop_size = {16384, 1, 1};
    volume.border = 1;
    EXPECT_EQ(first_message(volume),
              "E0110: cannot take a volume from `" + path +
                  "`: with its crop and border it has 16386 voxels along x, and at most 16384 are "
                  "read");
}

}  // namespace
}  // namespace skybake
