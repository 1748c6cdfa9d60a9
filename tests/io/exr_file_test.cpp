#include "bakers/io/formats/exr/exr_file.h"

#include <fmt/format.h>

#include <sys/resource.h>

#include <algorithm>
#include <atomic>

#include "bakers/field/baked.h"
#include "tests/io/exr_bytes.h"
#include "tests/io/format_checks.h"
#include "tests/support/cancelled_at.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using config::Compression;
using testing::plain_volume;
using testing::sample_voxel;
using testing::word;
using testing::written;
using Kind = config::SheetLayout;

constexpr auto kFormat = config::FileFormat::exr;

// The image that the volume should be, texel by texel.
ExrImage expected_image(const Baked& volume, const testing::FunctionVoxels::Function& content) {
    const std::array<int, 3> size = volume.levels[0].size;
    const SheetGrid layout = testing::grid_of(size, volume.layout, volume.columns);
    const auto [width, height] = image_size(size, layout);
    const int channels = static_cast<int>(volume.channel_names.size());
    ExrImage image;
    image.pixels = Image2<float>(static_cast<int>(width), static_cast<int>(height), channels);
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        const int column = z % layout.columns * size[0] + x;
        const int from_top = z / layout.columns * size[1] + y;
        const int row = volume.flip ? image.pixels.height - 1 - from_top : from_top;
        for (int c = 0; c < channels; ++c) {
            image.pixels.texel(column, row)[c] =
                round_to_pixel_type(content(x, y, z, c), volume.pixel_type);
        }
    });
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

int rows_of(Compression compression) {
    if (compression == Compression::piz) return 32;
    return compression == Compression::zip ? 16 : 1;
}

// Where the table of chunks is in a file, and each chunk: its first row, its length, its bytes.
struct ChunkTable {
    std::size_t at = 0;
    std::vector<std::uint64_t> positions;
};

ChunkTable chunk_table(const std::string& bytes, const ExrImage& image) {
    ChunkTable table{testing::exr_attributes(bytes).back().end() + 1, {}};
    for (int row = 0; row < image.pixels.height; row += rows_of(image.compression)) {
        table.positions.push_back(testing::number<std::uint64_t>(
            bytes, table.at + sizeof(std::uint64_t) * table.positions.size()));
    }
    return table;
}

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = {
        {{1, 1, 1}, Kind::stack, 0},    {{7, 5, 3}, Kind::stack, 0}, {{31, 1, 17}, Kind::stack, 0},
        {{1, 37, 2}, Kind::stack, 0},   {{1, 1, 1}, Kind::atlas, 0}, {{7, 5, 3}, Kind::atlas, 2},
        {{13, 11, 17}, Kind::atlas, 0}, {{5, 3, 7}, Kind::atlas, 9},
    };
    return all;
}

// Expects the file that encode_exr makes, which writes a whole image from memory by the library
// alone: the same bytes where nothing is deflated, and else the same header and the same texels.
void expect_file_of_library(const std::string& bytes, const ExrImage& image) {
    const std::string wanted = encode_exr(image);
    if (image.compression != Compression::zip && image.compression != Compression::zips) {
        EXPECT_TRUE(bytes == wanted);
        return;
    }
    const TemporaryFolder folder;
    const ExrImage read = read_exr(folder.write("a.exr", bytes));
    EXPECT_TRUE(stored_bytes(read.pixels, image.pixel_type) ==
                stored_bytes(image.pixels, image.pixel_type));
    const ChunkTable ours = chunk_table(bytes, image);
    const ChunkTable theirs = chunk_table(wanted, image);
    EXPECT_TRUE(bytes.substr(0, ours.at) == wanted.substr(0, theirs.at));
    ASSERT_EQ(ours.positions.size(), theirs.positions.size());
    std::uint64_t next = ours.at + sizeof(std::uint64_t) * ours.positions.size();
    for (std::size_t i = 0; i < ours.positions.size(); ++i) {
        EXPECT_EQ(ours.positions[i], next);  // in the order of rows, without gaps
        EXPECT_EQ(word(bytes, next), word(wanted, theirs.positions[i])) << "the first row";
        next += 2 * sizeof(std::int32_t) + word(bytes, next + sizeof(std::int32_t));
    }
    EXPECT_EQ(bytes.size(), next);
}

float ramp(int x, int y, int z, int channel) {
    return static_cast<float>((x + 3 * y + 5 * z + 7 * channel) % 64) / 64.0F;
}

TEST(ExrVolume, IsTheFileOfTheLibrary) {
    const TemporaryFolder folder;
    // Noise, of which chunks do not shrink and are stored as they are, and what packs well.
    const std::vector<testing::FunctionVoxels::Function> contents = {
        sample_voxel, ramp, [](int, int, int, int) { return 0.0F; }};
    for (const Shape& shape : shapes()) {
        for (const int channels : {1, 3, 4}) {
            for (const PixelType type : {PixelType::half, PixelType::float32}) {
                for (const Compression compression :
                     {Compression::none, Compression::zip, Compression::zips, Compression::piz}) {
                    for (const auto& content : contents) {
                        Baked volume = plain_volume(shape.size, channels, type, content);
                        volume.layout = shape.layout;
                        volume.columns = shape.columns;
                        volume.compression = compression;
                        SCOPED_TRACE(fmt::format("{}x{}x{}, {} channels, {}", shape.size[0],
                                                 shape.size[1], shape.size[2], channels,
                                                 static_cast<int>(compression)));
                        expect_file_of_library(written(folder, kFormat, volume, 2),
                                               expected_image(volume, content));
                    }
                }
            }
        }
    }
}

// Several boxes: parts of slices, several slices, cell rows in parts; on several threads. Boxes end
// within chunks.
TEST(ExrVolume, DoesNotDependOnBoxesAndThreads) {
    const TemporaryFolder folder;
    const std::vector<std::pair<Shape, int>> large = {
        {{{1031, 523, 2}, Kind::stack, 0}, 1},  // slices in parts that end within a chunk
        {{{67, 61, 211}, Kind::stack, 0}, 1},   // boxes of some slices
        {{{301, 257, 11}, Kind::atlas, 5}, 3},  // cell rows in parts, unused cells at the end
        {{{64, 64, 250}, Kind::atlas, 7}, 1},   // boxes of several cell rows
    };
    for (const auto& [shape, channels] : large) {
        for (const Compression compression : {Compression::zip, Compression::piz}) {
            for (const bool flip : {false, true}) {
                Baked volume = plain_volume(shape.size, channels, PixelType::half, ramp);
                volume.layout = shape.layout;
                volume.columns = shape.columns;
                volume.flip = flip;
                volume.compression = compression;
                SCOPED_TRACE(fmt::format("{} columns, {}", shape.size[0], flip));
                const std::string wanted = written(folder, kFormat, volume, 1);
                expect_file_of_library(wanted, expected_image(volume, ramp));
                EXPECT_TRUE(written(folder, kFormat, volume, 5) == wanted);
            }
        }
    }
}

TEST(ExrVolume, SaysThatNamesAreLong) {
    const TemporaryFolder folder;
    for (const std::size_t length : {31U, 32U}) {
        Baked volume = plain_volume({3, 2, 1}, 1, PixelType::half);
        volume.channel_names[0] = std::string(length, 'n');
        volume.compression = Compression::none;
        expect_file_of_library(written(folder, kFormat, volume, 1),
                               expected_image(volume, sample_voxel));
    }
}

// Noise of which a chunk is larger when it is deflated is stored as it is.
TEST(ExrVolume, NoChunkIsLargerThanItsTexels) {
    const TemporaryFolder folder;
    for (const Compression compression : {Compression::zip, Compression::zips, Compression::piz}) {
        const auto noise = [](int x, int y, int z, int c) {
            testing::Random random(static_cast<std::uint64_t>((z * 64 + y) * 64 + x) * 4 +
                                   static_cast<std::uint64_t>(c));
            return static_cast<float>(random.next() >> 40) / 3.0F;
        };
        Baked volume = plain_volume({40, 32, 3}, 3, PixelType::float32, noise);
        volume.compression = compression;
        const ExrImage image = expected_image(volume, noise);
        const std::string bytes = written(folder, kFormat, volume, 2);
        expect_file_of_library(bytes, image);
        for (const std::uint64_t position : chunk_table(bytes, image).positions) {
            const auto row = static_cast<int>(word(bytes, position));
            EXPECT_LE(word(bytes, position + 4),
                      static_cast<unsigned>(std::min(rows_of(compression), 96 - row)) * 40 * 3 * 4);
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
        written(folder, kFormat, volume, 2);
        EXPECT_EQ(testing::wrong_values(kFormat, volume, folder / "a.file"), 0);
    }
}

TEST(ExrVolume, RefusesWhatExrDoesNotHave) {
    for (const Baked& volume : {plain_volume({2, 2, 2}, 1, PixelType::unorm8),
                                plain_volume({1, 60000, 60000}, 1, PixelType::half)}) {
        EXPECT_EQ(testing::write_code(kFormat, volume), "E0500");
    }
}

TEST(ExrVolume, SaysWhyItCannotWrite) { testing::expect_says_why_it_cannot_write(kFormat); }

TEST(ExrVolume, StopsWhenInterrupted) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.exr", "");
    std::atomic<std::int64_t> made = 0;
    const Baked volume =
        plain_volume({1024, 1024, 1024}, 1, PixelType::half, [&](int, int, int, int) {
            ++made;
            return 0.5F;
        });
    testing::CancelledAt progress("", 2);
    progress.in_order = true;
    EXPECT_EQ(testing::write_as(kFormat, volume, 2, &progress, folder / "a.exr").value, false);
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

// Labelled slow: 2 GiB go to the disk. In a child, whose peak is its own; no other child is as large.
TEST(LargeExrVolume, StaysWithinOneGibibyteOfMemory) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.exr", "");
    const int status = testing::in_child([&] {
        Baked volume = plain_volume({1024, 1024, 256}, 4, PixelType::half);
        volume.levels[0].voxels = std::make_shared<RampVoxels>();
        volume.compression = Compression::none;
        const auto result = testing::write_as(kFormat, volume, 4, nullptr, folder / "a.exr");
        return result.value == true ? 0 : 1;
    });
    EXPECT_EQ(status, 0);
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_GT(fs::file_size(folder / "a.exr"), std::uintmax_t{2} << 30);
    // Six boxes of 24 MiB, buffers, and what the child inherits of earlier tests.
    EXPECT_LT(usage.ru_maxrss, 384 * 1024) << "KiB";
    RecordProperty("peak_kib", static_cast<int>(usage.ru_maxrss));
}

}  // namespace
}  // namespace skybake
