// Headers of EXR files of all kinds, as OpenEXR itself writes them.
#include "bakers/io/formats/exr/exr_heads.h"

#include <ImfChannelList.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include "bakers/io/formats/png/map_image.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

std::vector<ExrPartHead> heads_of(const std::filesystem::path& path) {
    const auto parts = read_exr_heads(path);
    for (const auto& diagnostic : parts.diagnostics) ADD_FAILURE() << diagnostic.message;
    return parts.value.value_or(std::vector<ExrPartHead>{ExrPartHead{}});
}

TEST(ExrHeads, SayTilesAndLevels) {
    const TemporaryFolder folder;
    const std::string path = (folder / "t.exr").string();
    Imf::Header header(64, 48);
    header.compression() = Imf::DWAA_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.setTileDescription({16, 8, Imf::MIPMAP_LEVELS});
    { const Imf::TiledOutputFile file(path.c_str(), header); }
    const ExrPartHead head = heads_of(path).front();
    EXPECT_EQ(head.kind, "tiles of 16 x 8, one level after another");
    EXPECT_EQ(head.compression, "dwaa");
    EXPECT_EQ(head.size(), (std::array<std::int64_t, 2>{64, 48}));
    EXPECT_EQ(head.channels.at(0).type, "half");
}

TEST(ExrHeads, SayWindowsAndTexts) {
    const TemporaryFolder folder;
    const std::string path = (folder / "w.exr").string();
    Imf::Header header(Imath::Box2i({0, 0}, {99, 49}), Imath::Box2i({-10, 5}, {20, 30}));
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    header.compression() = Imf::B44A_COMPRESSION;
    Imf::addOwner(header, "somebody");
    { const Imf::OutputFile file(path.c_str(), header); }
    const ExrPartHead head = heads_of(path).front();
    EXPECT_EQ(head.data_window, (std::array{-10, 5, 20, 30}));
    EXPECT_EQ(head.display_window, (std::array{0, 0, 99, 49}));
    EXPECT_EQ(head.compression, "b44a");
    EXPECT_EQ(head.channels.at(1).type, "uint");
    EXPECT_EQ(head.attributes, (Attributes{{"owner", "somebody"}}));
}

TEST(ExrHeads, SayPartsAndDeepSamples) {
    const TemporaryFolder folder;
    const std::string path = (folder / "p.exr").string();
    std::vector<Imf::Header> headers(2, Imf::Header(8, 4));
    headers[0].setName("beauty");
    headers[0].setType(Imf::SCANLINEIMAGE);
    headers[0].channels().insert("G", Imf::Channel(Imf::HALF));
    headers[1].setName("depth");
    headers[1].setType(Imf::DEEPSCANLINE);
    headers[1].compression() = Imf::ZIPS_COMPRESSION;
    headers[1].channels().insert("Z", Imf::Channel(Imf::FLOAT));
    { const Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2); }
    const std::vector<ExrPartHead> parts = heads_of(path);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].name, "beauty");
    EXPECT_EQ(parts[0].kind, "scan lines");
    EXPECT_EQ(parts[1].name, "depth");
    EXPECT_EQ(parts[1].kind, "deep scan lines");
    EXPECT_EQ(parts[1].channels.at(0).name, "Z");
}

// Luminance at each pixel, and colours at every second one along both axes.
std::string subsampled(const TemporaryFolder& folder) {
    std::string path = (folder / "yc.exr").string();
    Imf::Header header(4, 4);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    header.channels().insert("BY", Imf::Channel(Imf::HALF, 2, 2));
    { const Imf::OutputFile file(path.c_str(), header); }
    return path;
}

TEST(ExrHeads, SayWhichChannelIsSubsampled) {
    const TemporaryFolder folder;
    const std::vector<ExrPartHead> parts = heads_of(subsampled(folder));
    EXPECT_EQ(parts.at(0).channels.at(0).sampling, (std::array{2, 2}));
    EXPECT_EQ(subsampled_channel(parts), "its channel `BY` is subsampled (2 x 2)");
}

TEST(ExrHeads, ClaimNoMoreThanTheFileHas) {
    const TemporaryFolder folder;
    const std::string path = subsampled(folder);
    const std::string bytes = testing::read_bytes(path);
    const auto with = [&](std::size_t at, char byte) {
        std::string damaged = bytes;
        damaged[at] = byte;
        testing::write_bytes(folder / "d.exr", damaged);
        return read_exr_heads(folder / "d.exr");
    };
    for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 400); ++at) {
        const auto parts = with(at, '\x7f');
        EXPECT_TRUE(parts.value || parts.diagnostics.at(0).code == "E0304") << at;
    }
    for (std::size_t size : {0, 3, 8, 40, 200}) {
        testing::write_bytes(folder / "d.exr", bytes.substr(0, size));
        EXPECT_EQ(read_exr_heads(folder / "d.exr").diagnostics.at(0).code, "E0304") << size;
    }
    EXPECT_EQ(read_exr_heads(folder / "none.exr").diagnostics.at(0).code, "E0300");
}

TEST(MapImage, SaysThatAChannelIsSubsampled) {
    const TemporaryFolder folder;
    config::CloudMap map;
    map.path = subsampled(folder);
    const auto image = read_map_image(map);
    ASSERT_FALSE(image.value);
    EXPECT_TRUE(
        image.diagnostics.at(0).message.ends_with(": its channel `BY` is subsampled (2 x 2)"));
}

}  // namespace
}  // namespace skybake
