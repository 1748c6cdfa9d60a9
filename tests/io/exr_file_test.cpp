#include "bakers/io/formats/exr/exr_file.h"

#include <fmt/format.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>

#include "bakers/field/baked.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using config::Compression;
using config::PixelType;
using testing::plain_volume;
using testing::sample_voxel;
using testing::TemporaryFolder;
using Kind = config::SheetLayout;

// Writes level 0 into a file of the folder and returns its bytes.
std::string written(const TemporaryFolder& folder, const Baked& volume, int threads) {
    testing::write_bytes(folder / "a.exr", "what was there");
    const auto result =
        testing::write_as(config::FileFormat::exr, volume, threads, nullptr, folder / "a.exr");
    EXPECT_EQ(result.value, true);
    for (const auto& diagnostic : result.diagnostics) ADD_FAILURE() << diagnostic.message;
    return testing::read_bytes(folder / "a.exr");
}

// The image that the volume should be, texel by texel.
ExrImage expected_image(const Baked& volume) {
    const std::array<int, 3> size = volume.levels[0].size;
    const SheetGrid layout = testing::grid_of(size, volume.layout, volume.columns);
    const auto [width, height] = image_size(size, layout);
    const int channels = static_cast<int>(volume.channel_names.size());
    ExrImage image;
    image.pixels = Image2<float>(static_cast<int>(width), static_cast<int>(height), channels);
    for (int z = 0; z < size[2]; ++z) {
        const int left = z % layout.columns * size[0];
        const int top = z / layout.columns * size[1];
        for (int y = 0; y < size[1]; ++y) {
            for (int x = 0; x < size[0]; ++x) {
                for (int c = 0; c < channels; ++c) {
                    image.pixels.texel(left + x, top + y)[c] =
                        round_to_pixel_type(sample_voxel(x, y, z, c), volume.pixel_type);
                }
            }
        }
    }
    image.channel_names = volume.channel_names;
    image.pixel_type = volume.pixel_type;
    image.compression = volume.compression;
    image.attributes = {{"skybake/asset", "{}"}};
    return image;
}

struct Shape {
    std::array<int, 3> size;
    Kind layout;
    int columns;
};

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = {
        {{1, 1, 1}, Kind::stack, 0},    {{7, 5, 3}, Kind::stack, 0}, {{31, 1, 17}, Kind::stack, 0},
        {{1, 37, 2}, Kind::stack, 0},   {{1, 1, 1}, Kind::atlas, 0}, {{7, 5, 3}, Kind::atlas, 2},
        {{13, 11, 17}, Kind::atlas, 0}, {{5, 3, 7}, Kind::atlas, 9},
    };
    return all;
}

// encode_exr, which writes a whole image from memory by other code, makes the same bytes.
TEST(ExrVolume, HasTheBytesOfTheWholeImage) {
    const TemporaryFolder folder;
    for (const Shape& shape : shapes()) {
        for (const int channels : {1, 3, 4}) {
            for (const PixelType type : {PixelType::half, PixelType::float32}) {
                for (const Compression compression :
                     {Compression::none, Compression::zip, Compression::zips, Compression::piz}) {
                    Baked volume = plain_volume(shape.size, channels, type);
                    volume.layout = shape.layout;
                    volume.columns = shape.columns;
                    volume.compression = compression;
                    EXPECT_EQ(written(folder, volume, 1), *encode_exr(expected_image(volume)).value)
                        << fmt::format("{}x{}x{}", shape.size[0], shape.size[1], shape.size[2]);
                }
            }
        }
    }
}

// Several boxes: parts of slices, several slices, cell rows in parts; on several threads.
TEST(ExrVolume, DoesNotDependOnBoxesAndThreads) {
    const TemporaryFolder folder;
    const std::vector<Shape> large = {
        {{1031, 523, 3}, Kind::stack, 0},  // a slice in three boxes, rows that end within a block
        {{67, 61, 211}, Kind::stack, 0},   // boxes of some slices
        {{301, 257, 41}, Kind::atlas, 5},  // cell rows in parts, unused cells at the end
        {{64, 64, 50}, Kind::atlas, 7},    // boxes of several cell rows
    };
    for (const Shape& shape : large) {
        Baked volume = plain_volume(shape.size, 4, PixelType::half);
        volume.layout = shape.layout;
        volume.columns = shape.columns;
        volume.compression = Compression::zip;
        const std::string wanted = *encode_exr(expected_image(volume)).value;
        for (const int threads : {1, 2, 5}) {
            EXPECT_TRUE(written(folder, volume, threads) == wanted) << shape.size[0];
        }
    }
}

TEST(ExrVolume, ReadsBackInTheOrderOfTheVoxels) {
    const TemporaryFolder folder;
    std::vector<Shape> all = shapes();
    all.push_back({{301, 257, 41}, Kind::atlas, 5});
    all.push_back({{1031, 523, 3}, Kind::stack, 0});
    for (const Shape& shape : all) {
        Baked volume = plain_volume(shape.size, 3, PixelType::half);
        volume.layout = shape.layout;
        volume.columns = shape.columns;
        written(folder, volume, 2);
        std::int64_t next = 0;
        long wrong = 0;
        const auto visit = [&](std::int64_t first, std::int64_t count, const float* values) {
            EXPECT_EQ(first, next);
            for (; next < first + count; ++next) {
                const int x = static_cast<int>(next % shape.size[0]);
                const int y = static_cast<int>(next / shape.size[0] % shape.size[1]);
                const int z = static_cast<int>(next / shape.size[0] / shape.size[1]);
                for (int c = 0; c < 3; ++c) {
                    const float wanted =
                        round_to_pixel_type(sample_voxel(x, y, z, c), PixelType::half);
                    wrong += *values++ == wanted ? 0 : 1;
                }
            }
            return true;
        };
        EXPECT_EQ(exr_format().read(folder / "a.exr", testing::shape_of(volume), 0, visit).value,
                  true);
        EXPECT_EQ(next, (VoxelBox{{}, shape.size}.count()));
        EXPECT_EQ(wrong, 0);
    }
}

TEST(ExrVolume, RefusesWhatExrDoesNotHave) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.exr", "");
    const Baked unorm = plain_volume({2, 2, 2}, 1, PixelType::unorm8);
    EXPECT_EQ(testing::first_code(
                  testing::write_as(config::FileFormat::exr, unorm, 1, nullptr, folder / "a.exr")
                      .diagnostics),
              "E0500");
    const Baked high = plain_volume({1, 60000, 60000}, 1, PixelType::half);
    EXPECT_EQ(testing::first_code(
                  testing::write_as(config::FileFormat::exr, high, 1, nullptr, folder / "a.exr")
                      .diagnostics),
              "E0500");
}

TEST(ExrVolume, SaysWhyItCannotWrite) {
    const Baked volume = plain_volume({64, 64, 64}, 4, PixelType::half);
    for (const int threads : {1, 3}) {
        const auto full =
            testing::write_as(config::FileFormat::exr, volume, threads, nullptr, "/dev/full");
        ASSERT_EQ(testing::first_code(full.diagnostics), "E0301");
        EXPECT_NE(full.diagnostics[0].message.find("No space left on device"), std::string::npos)
            << full.diagnostics[0].message;
    }
    // Small enough to fail only when the table of line offsets is written at the very end.
    const Baked tiny = plain_volume({1, 1, 1}, 1, PixelType::half);
    EXPECT_EQ(
        testing::first_code(
            testing::write_as(config::FileFormat::exr, tiny, 1, nullptr, "/dev/full").diagnostics),
        "E0301");
    const auto absent =
        testing::write_as(config::FileFormat::exr, tiny, 1, nullptr, "/absent/a.exr");
    ASSERT_EQ(testing::first_code(absent.diagnostics), "E0301");
    EXPECT_NE(absent.diagnostics[0].message.find("No such file"), std::string::npos);
}

class StopsAfter : public Progress {
  public:
    explicit StopsAfter(int calls) : left_(calls) {}
    void advance(std::string_view, double fraction) override {
        EXPECT_TRUE(fraction >= last_ && fraction <= 1);
        last_ = fraction;
        --left_;
    }
    bool cancelled() const override { return left_ <= 0; }

  private:
    std::atomic<int> left_;
    double last_ = 0;
};

TEST(ExrVolume, StopsWhenInterrupted) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.exr", "");
    std::atomic<std::int64_t> made = 0;
    const Baked volume =
        plain_volume({1024, 1024, 1024}, 1, PixelType::half, [&](int, int, int, int) {
            ++made;
            return 0.5F;
        });
    StopsAfter progress(2);
    EXPECT_EQ(
        testing::write_as(config::FileFormat::exr, volume, 2, &progress, folder / "a.exr").value,
        false);
    EXPECT_LT(made, 8 * BoxSequence::kFloats);
}

// Fast, so that the test is about the writer.
class RampVoxels : public VoxelSource {
  public:
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        for (float* channel : channels) {
            for (std::int64_t i = 0; i < box.count(); ++i) {
                channel[i] = static_cast<float>((i + box.origin[2]) & 1023) / 1024.0F;
            }
        }
    }
};

// Labelled slow: 2 GiB go to the disk. In a child, whose peak is its own.
TEST(LargeExrVolume, StaysWithinOneGibibyteOfMemory) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.exr", "");
    const pid_t child = ::fork();
    if (child == 0) {
        Baked volume = plain_volume({1024, 1024, 256}, 4, PixelType::half);
        volume.levels[0].voxels = std::make_shared<RampVoxels>();
        volume.compression = Compression::none;
        const auto result =
            testing::write_as(config::FileFormat::exr, volume, 4, nullptr, folder / "a.exr");
        ::_exit(result.value == true ? 0 : 1);
    }
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    EXPECT_EQ(status, 0);
    EXPECT_GT(fs::file_size(folder / "a.exr"), std::uintmax_t{2} << 30);
    // Six boxes of 24 MiB, buffers, and what the child inherits of earlier tests.
    EXPECT_LT(usage.ru_maxrss, 384 * 1024) << "KiB";
    RecordProperty("peak_kib", static_cast<int>(usage.ru_maxrss));
}

}  // namespace
}  // namespace skybake
