// Pixels of EXR files of kinds that skybake does not write, as OpenEXR itself writes them.
#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/io/formats/exr/exr_file.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

constexpr int width = 37, height = 19;

// Numbers that every codec keeps exactly, or nearly if it is lossy.
std::vector<float> pixels() {
    std::vector<float> values;
    for (int i = 0; i < width * height; ++i)
        values.push_back(static_cast<float>(64 + i % 64) / 256);
    return values;
}

Imf::Header header_of(Imf::Compression compression) {
    Imf::Header header(width, height);
    header.compression() = compression;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    return header;
}

Imf::FrameBuffer buffer_of(std::vector<float>& values) {
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                  sizeof(float) * width));
    return buffer;
}

void write_image(const std::string& path, Imf::Header header, const Imf::TileDescription* tiles) {
    std::vector<float> values = pixels();
    if (tiles == nullptr) {
        Imf::OutputFile file(path.c_str(), header, 0);
        file.setFrameBuffer(buffer_of(values));
        return file.writePixels(height);
    }
    header.setTileDescription(*tiles);
    Imf::TiledOutputFile file(path.c_str(), header, 0);
    file.setFrameBuffer(buffer_of(values));
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
}

float worst_of(const std::filesystem::path& path) {
    auto image = ExrRows::open(path);
    if (!image.value) return INFINITY;
    EXPECT_EQ(image.value->facts().width, width);
    EXPECT_EQ(image.value->facts().height, height);
    std::vector<float> read(width * height);
    if (image.value->read(0, height, read.data())) return INFINITY;
    float worst = 0;
    for (std::size_t i = 0; i < read.size(); ++i) {
        worst = std::max(worst, std::fabs(read[i] - pixels()[i]));
    }
    return worst;
}

TEST(ExrKinds, OfAnyCodecAreRead) {
    const TemporaryFolder folder;
    const std::string path = (folder / "c.exr").string();
    const Imf::TileDescription tiles(16, 8, Imf::MIPMAP_LEVELS);
    for (int codec = 0; codec < Imf::NUM_COMPRESSION_METHODS; ++codec) {
        const Imf::Header header = header_of(static_cast<Imf::Compression>(codec));
        const double allowed = codec >= Imf::B44_COMPRESSION ? 0.02 : 0;
        write_image(path, header, nullptr);
        EXPECT_LE(worst_of(path), allowed) << codec;
        write_image(path, header, &tiles);
        EXPECT_LE(worst_of(path), allowed) << codec << " in tiles";
    }
}

// The library allocates a whole tile, and as many places as a part says that it has chunks.
TEST(ExrKinds, ClaimNoMoreThanTheFileHas) {
    const TemporaryFolder folder;
    const std::string path = (folder / "t.exr").string();
    const Imf::TileDescription description(16, 8);
    write_image(path, header_of(Imf::DWAB_COMPRESSION), &description);
    const std::string bytes = testing::read_bytes(path);
    const std::size_t tiles = bytes.find("tiledesc") + sizeof("tiledesc") + 4;
    for (std::size_t at = tiles; at < tiles + 8; ++at) {
        std::string damaged = bytes;
        damaged[at] = '\x7f';
        testing::write_bytes(path, damaged);
        const auto image = ExrRows::open(path);
        const bool is_small = (at - tiles) % 4 < 2;  // the low bytes of an edge
        EXPECT_EQ(image.value.has_value(), is_small) << at - tiles;
    }
    for (std::size_t size = 0; size < bytes.size(); size += 40) {
        testing::write_bytes(path, bytes.substr(0, size));
        EXPECT_EQ(worst_of(path), INFINITY) << size;
    }
}

}  // namespace
}  // namespace skybake
