#include "bakers/io/formats/png/map_image.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "bakers/io/files/load_module.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/math/hash.h"
#include "tests/io/files.h"
#include "tests/support/exr_image.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

using config::CloudMap;
using config::MapColorSpace;

const std::filesystem::path data = SKYBAKE_TEST_DATA "/maps";

config::Outcome<MapImage> read(const std::filesystem::path& path, const std::string& channel = "",
                               MapColorSpace color_space = MapColorSpace::linear) {
    CloudMap map;
    map.path = path;
    map.channel = channel;
    map.color_space = color_space;
    return read_map_image(map);
}

// The error's code and what it says; or nothing where there is none.
std::string error_of(const std::filesystem::path& path, const std::string& channel = "") {
    const auto map = read(path, channel);
    EXPECT_NE(map.value.has_value(), !map.diagnostics.empty());
    return map.diagnostics.empty() ? ""
                                   : map.diagnostics[0].code + " " + map.diagnostics[0].message;
}

// --- Values -------------------------------------------------------------------------------------

std::vector<float> over(float largest, std::vector<float> values) {
    for (float& value : values) value /= largest;
    return values;
}
const std::vector<float> red = over(255, {0, 10, 51, 255, 100, 7});
const std::vector<float> green = over(255, {1, 11, 128, 254, 90, 200});
const std::vector<float> blue = over(255, {2, 12, 255, 253, 80, 33});
const std::vector<float> alpha = over(255, {0, 1, 128, 254, 255, 64});
const std::vector<float> grey16 = over(65535, {0, 1, 256, 32768, 65534, 65535});
const std::vector<float> grey16_as_half = {0, 0x1p-16F, 0x1p-8F, 0.5F, 1, 1};
const std::vector<float> grey32 = {0, 0.25F, 1, 0.1F, 0.5F, 1e-30F};
const std::vector<float> grey32_as_half = {0, 0.25F, 1, 0x1.998p-4F, 0.5F, 0};

struct Sample {
    const char* file;
    const char* channel;
    std::vector<float> values;
};

// Colours under alpha 0 are there too: nothing was multiplied by it.
TEST(MapImage, HasTheValuesOfTheFile) {
    const std::vector<Sample> samples = {
        {"rgba8.png", "", red},
        {"rgba8.png", "R", red},
        {"rgba8.png", "G", green},
        {"rgba8.png", "B", blue},
        {"rgba8.png", "A", alpha},
        {"rgba16_tiles.tif", "R", red},
        {"rgba16_tiles.tif", "B", blue},
        {"rgba16_tiles.tif", "A", alpha},
        {"palette.png", "R", over(255, {0, 51, 100, 255, 100, 51})},
        {"palette.png", "B", over(255, {20, 70, 120, 253, 120, 70})},
        {"grey2.png", "Y", over(3, {0, 1, 2, 3, 2, 1})},
        {"grey8_interlaced.png", "", over(255, {10, 20, 30, 40, 50, 60})},
        {"grey16.png", "Y", grey16},
        {"grey16_zip.tif", "", grey16},
        {"grey32_lzw.tif", "Y", grey32},
        {"half_tiles.exr", "", grey16_as_half},
        {"half_and_float.exr", "", grey32_as_half},
        {"half_and_float.exr", "coverage", grey32},
        {"two_parts.exr", "", grey32_as_half},  // the first of them
    };
    for (const Sample& sample : samples) {
        const auto map = read(data / sample.file, sample.channel);
        ASSERT_TRUE(map.value.has_value()) << map.diagnostics[0].message;
        EXPECT_TRUE(map.diagnostics.empty());
        EXPECT_EQ(map.value->width, 3);
        EXPECT_EQ(map.value->height, 2);
        EXPECT_EQ(map.value->values, sample.values) << sample.file << " " << sample.channel;
    }
}

// Whatever our own encoder writes, of any size, type and compression.
TEST(MapImage, HasTheValuesOfOurOwnFiles) {
    using config::Compression;
    using config::PixelType;
    const TemporaryFolder folder;
    EXPECT_TRUE(rc::check([&] {
        ExrImage image;
        image.channel_names = {"R", "G", "B", "A"};
        image.pixel_type = *rc::gen::element(PixelType::half, PixelType::float32);
        image.compression = *rc::gen::element(Compression::none, Compression::zip,
                                              Compression::zips, Compression::piz);
        image.pixels = testing::sample_image(*rc::gen::inRange(1, 70), *rc::gen::inRange(1, 70), 4);
        for (float& value : image.pixels.texels) value = std::min(value, 1.0F);
        testing::write_bytes(folder / "map.exr", encode_exr(image));
        const int channel = *rc::gen::inRange(0, 4);
        const auto map = read(folder / "map.exr", std::string(1, "RGBA"[channel]));
        RC_ASSERT(map.value.has_value());
        RC_ASSERT(map.value->width == image.pixels.width);
        RC_ASSERT(map.value->height == image.pixels.height);
        testing::for_each_texel(image.pixels.width, image.pixels.height, [&](int x, int y) {
            const auto index = static_cast<std::size_t>(y * image.pixels.width + x);
            RC_ASSERT(map.value->values[index] == image.pixels.texel(x, y)[channel]);
        });
    }));
}

// What `info` and `diff` read of files that others wrote.
TEST(ExrRows, AreThoseOfAPart) {
    std::vector<float> values(6);
    auto second = ExrRows::open(data / "two_parts.exr", 1);
    EXPECT_FALSE(second.value.value().read(0, 2, values.data()));
    EXPECT_EQ(values, grey16_as_half);
    EXPECT_EQ(first_code(ExrRows::open(data / "two_parts.exr", 2).diagnostics), "E0304");
    const auto window = ExrRows::open(data / "window.exr");
    EXPECT_EQ(window.value.value().facts().window, "(1, 0) to (3, 1) of (0, 0) to (4, 1)");
}

TEST(MapImage, HashIsOfSizeAndValues) {
    const std::string hash = read(data / "grey16.png").value->content_hash;
    EXPECT_EQ(read(data / "grey16_zip.tif").value->content_hash, hash);
    EXPECT_NE(read(data / "grey32_lzw.tif").value->content_hash, hash);
    std::string bytes("\3\0\0\0\2\0\0\0", 8);
    bytes.append(reinterpret_cast<const char*>(grey16.data()), grey16.size() * sizeof(float));
    EXPECT_EQ(xxh3_hex(bytes), hash);
}

// --- The sRGB transfer function -----------------------------------------------------------------

// Half an ulp of rounding, and next to nothing more.
TEST(MapImage, DecodesSrgb) {
    const TemporaryFolder folder;
    ExrImage image;
    image.channel_names = {"Y"};
    image.pixels = Image2<float>(256, 9, 1);
    testing::Random random(3);
    for (std::size_t i = 0; i < image.pixels.texels.size(); ++i) {
        image.pixels.texels[i] = i < 256 ? static_cast<float>(i) / 255.0F
                                         : static_cast<float>(random.below(1U << 24)) * 0x1p-24F;
    }
    testing::write_bytes(folder / "map.exr", encode_exr(image));
    const auto map = test::without_errors(read(folder / "map.exr", "", MapColorSpace::srgb));
    for (std::size_t i = 0; i < image.pixels.texels.size(); ++i) {
        const long double v = image.pixels.texels[i];
        const long double exact =
            v <= 0.04045L ? v / 12.92L : std::pow((v + 0.055L) / 1.055L, 2.4L);
        const float value = map.values[i];
        const float ulp = std::nextafter(value, 2.0F) - value;
        EXPECT_LE(std::abs(value - exact), 0.50001L * ulp) << image.pixels.texels[i];
    }
    EXPECT_EQ(map.values[0], 0.0F);
    EXPECT_EQ(map.values[255], 1.0F);
}

TEST(MapImage, IsTheSameOnEveryMachine) {
    EXPECT_EQ(read(data / "rgba8.png", "G", MapColorSpace::srgb).value->content_hash,
              "06c6133bab831d69cd44f98719b54c45");
}

// --- What is refused ----------------------------------------------------------------------------

TEST(MapImageFails, WhereThereIsNoFile) {
    EXPECT_EQ(error_of(data / "none.png"), "E0300 cannot read the map `" +
                                               (data / "none.png").string() +
                                               "`: No such file or directory");
    EXPECT_EQ(error_of(data).substr(0, 5), "E0300");
    EXPECT_EQ(error_of("/dev/null").substr(0, 5), "E0300");
}

// The recipe's line where a recipe names the map: the file's, or that of the channel.
TEST(MapImageFails, AtTheRecipesLine) {
    CloudMap map;
    map.path = data / "none.png";
    EXPECT_EQ(read_map_image(map).diagnostics.at(0).where.source, map.path.string());
    map.file_place = {"k.toml", 17, 8, 10, ""};
    map.channel_place = {"k.toml", 18, 11, 3, ""};
    EXPECT_EQ(read_map_image(map).diagnostics.at(0).where.line, 17);
    map.path = data / "rgba8.png";
    map.channel = "Y";
    EXPECT_EQ(read_map_image(map).diagnostics.at(0).where.line, 18);
    map.path = data / "deep.exr";
    EXPECT_EQ(read_map_image(map).diagnostics.at(0).where.line, 17);
}

void expect_refused(const std::filesystem::path& path, const std::string& words,
                    const std::string& channel = "") {
    const std::string error = error_of(path, channel);
    EXPECT_EQ(error.substr(0, 5), "E0304") << path;
    EXPECT_NE(error.find(words), std::string::npos) << error;
}

TEST(MapImage, MayBeARadiancePicture) {
    const TemporaryFolder folder;
    const std::string texels = {char(128), 64, 32, char(128), 16, char(200), 1, 127};
    const std::string head = "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    for (const char* first : {"#?RADIANCE\n", "#?RGBE\n"}) {
        testing::write_bytes(folder / "map.hdr", first + head + texels);
        EXPECT_EQ(read(folder / "map.hdr", "G").value->values, over(512, {128, 200}));
    }
}

TEST(MapImageFails, ForOtherFiles) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "empty.png", "");
    testing::write_bytes(folder / "text.png", "P2\n1 1\n255\n0\n");  // a picture, of another kind
    expect_refused(folder / "empty.png", "it is neither PNG nor TIFF nor OpenEXR nor Radiance");
    expect_refused(folder / "text.png", "it is neither PNG nor TIFF nor OpenEXR nor Radiance");
    expect_refused(data / "deep.exr", "it is a deep image");
    expect_refused(data / "uint.exr", "its values are of type uint");
}

TEST(MapImageFails, ForChannelsThatAreNotThere) {
    expect_refused(data / "rgba8.png", "it has no channel `Y`, only `R`, `G`, `B`, `A`", "Y");
    expect_refused(data / "half_and_float.exr",
                   "it has no channel `coverge`, only `Y`, `coverage`; did you mean `coverage`?",
                   "coverge");
    expect_refused(data / "two_parts.exr", "it has no channel `y`, only `Y`", "y");
}

TEST(MapImageFails, ForValuesThatAreNoShares) {
    const TemporaryFolder folder;
    const auto error = [&](float value) {
        ExrImage image;
        image.channel_names = {"R", "G", "B"};
        image.pixels = Image2<float>(5, 4, 3);
        image.pixels.texel(3, 2)[1] = value;
        testing::write_bytes(folder / "map.exr", encode_exr(image));
        EXPECT_EQ(error_of(folder / "map.exr", "R"), "");
        return error_of(folder / "map.exr", "G");
    };
    const auto place = "the pixel in column 3, row 2 (from 0, the first row is 0) is ";
    const float tiny = std::numeric_limits<float>::denorm_min();
    EXPECT_NE(error(1.5F).find(place + std::string("1.5, ")), std::string::npos);
    EXPECT_NE(error(-tiny).find(place + std::string("-1e-45, ")), std::string::npos);
    EXPECT_NE(error(NAN).find(place + std::string("nan, ")), std::string::npos);
    EXPECT_NE(error(INFINITY).find(place + std::string("inf, ")), std::string::npos);
    EXPECT_NE(error(-INFINITY).find(place + std::string("-inf, ")), std::string::npos);
    EXPECT_NE(error(std::nextafter(1.0F, 2.0F)), "");
    EXPECT_EQ(error(1.0F), "");
    EXPECT_EQ(error(tiny), "");
}

// The pictures of artists hold numbers beyond 1.
TEST(MapImage, IsScaledAndClamped) {
    const TemporaryFolder folder;
    ExrImage image;
    image.channel_names = {"Y"};
    image.pixels = Image2<float>(4, 1, 1);
    image.pixels.texels = {-0.5F, 0.5F, 3, 65504};
    testing::write_bytes(folder / "map.exr", encode_exr(image));
    CloudMap map;
    map.path = folder / "map.exr";
    const auto values = [&](double factor, bool clamp, MapColorSpace space) {
        map.factor = factor;
        map.clamp = clamp;
        map.color_space = space;
        const auto read = read_map_image(map);
        return read.value ? read.value->values : std::vector<float>{};
    };
    EXPECT_EQ(values(1, false, MapColorSpace::linear), std::vector<float>{});
    EXPECT_EQ(values(0.25, true, MapColorSpace::linear), (std::vector<float>{0, 0.125F, 0.75F, 1}));
    const std::vector<float> from_srgb = values(0.5, true, MapColorSpace::srgb);
    ASSERT_EQ(from_srgb.size(), 4U);
    EXPECT_NEAR(from_srgb[1], 0.107021, 1e-6);  // half of ((0.5 + 0.055) / 1.055)^2.4
    map.clamp = false;
    EXPECT_NE(read_map_image(map).diagnostics.at(0).message.find("`clamp = true` limits them"),
              std::string::npos);
}

// What the file does not have of its display window is black, and what lies beyond it does not count.
TEST(MapImage, IsReadOverTheDisplayWindow) {
    const TemporaryFolder folder;
    std::string bytes =
        testing::read_bytes(data / "window.exr");  // 3 x 2 pixels from (1, 0) of 5 x 2
    const std::vector<float>& grey = grey32_as_half;
    const auto whole = test::without_errors(read(data / "window.exr"));
    EXPECT_EQ(whole.values, (std::vector<float>{0, grey[0], grey[1], grey[2], 0, 0, grey[3],
                                                grey[4], grey[5], 0}));
    const std::array<std::int32_t, 4> window = {2, 1, 2, 3};
    const std::size_t at =
        bytes.find("displayWindow") + sizeof("displayWindow") + sizeof("box2i") + 4;
    bytes.replace(at, sizeof(window), reinterpret_cast<const char*>(window.data()), sizeof(window));
    testing::write_bytes(folder / "map.exr", bytes);
    const auto part = test::without_errors(read(folder / "map.exr"));
    EXPECT_EQ(part.values, (std::vector<float>{grey[4], 0, 0}));
}

// --- TIFF, tag by tag ---------------------------------------------------------------------------

// A little-endian file of one strip without compression, all of whose tags have one 32-bit value.
std::string tiff(const std::map<unsigned, unsigned>& changes, const std::string& strip) {
    constexpr unsigned head_bytes = 8, entry_bytes = 12;
    std::map<unsigned, unsigned> tags = {{256, 3}, {257, 2}, {258, 8}, {259, 1}, {262, 1},
                                         {273, 0}, {277, 1}, {278, 2}, {279, 0}};
    for (const auto& [tag, value] : changes) tags[tag] = value;
    const auto count = static_cast<unsigned>(tags.size());
    tags[273] = head_bytes + 2 + count * entry_bytes + 4;
    tags[279] = static_cast<unsigned>(strip.size());
    std::string bytes("II*\0\10\0\0\0", head_bytes);
    const auto append = [&](unsigned value, int size) {
        for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
    };
    append(count, 2);
    for (const auto& [tag, value] : tags) {
        append(tag, 2);
        append(4, 2);  // 32 bits
        append(1, 4);
        append(value, 4);
    }
    append(0, 4);
    return bytes + strip;
}

const std::string six_bytes("\0\x33\x66\x99\xCC\xFF", 6);

TEST(MapImageOfTiff, TakesWhatItKnowsExactly) {
    const TemporaryFolder folder;
    const auto values = [&](const std::map<unsigned, unsigned>& tags, const std::string& strip) {
        testing::write_bytes(folder / "map.tif", tiff(tags, strip));
        const auto map = read(folder / "map.tif");
        EXPECT_EQ(first_code(map.diagnostics), "");
        return map.value ? map.value->values : std::vector<float>();
    };
    EXPECT_EQ(values({}, six_bytes), over(255, {0, 51, 102, 153, 204, 255}));
    EXPECT_EQ(values({{258, 4}}, {"\x01\x20\x0F\x70", 4}), over(15, {0, 1, 2, 0, 15, 7}));
    EXPECT_EQ(values({{258, 1}}, {"\xA0\x40", 2}), std::vector<float>({1, 0, 1, 0, 1, 0}));
    EXPECT_EQ(values({{258, 16}}, six_bytes + six_bytes),
              over(65535, {0x3300, 0x9966, 0xFFCC, 0x3300, 0x9966, 0xFFCC}));
    EXPECT_EQ(values({{258, 16}, {339, 3}}, {"\0\x34\0\x38\0\x3C\0\0\1\0\xFF\x3B", 12}),
              std::vector<float>({0.25F, 0.5F, 1, 0, 0x1p-24F, 0x1.FFCp-1F}));
    EXPECT_EQ(values({{274, 1}}, six_bytes), values({}, six_bytes));
}

TEST(MapImageOfTiff, RefusesTheRest) {
    const TemporaryFolder folder;
    const auto refuses = [&](const std::map<unsigned, unsigned>& tags, const std::string& words,
                             const std::string& strip = std::string(48, '\0')) {
        testing::write_bytes(folder / "map.tif", tiff(tags, strip));
        SCOPED_TRACE(tags.begin()->first);
        expect_refused(folder / "map.tif", words);
    };
    refuses({{256, 16385}}, "it has 16385 x 2 pixels, at most 16384 along each edge are read");
    refuses({{257, 0x7FFFFFFF}}, "");
    refuses({{256, 0}}, "");
    refuses({{257, 0}}, "");
    refuses({{256, 16384}, {257, 16384}, {278, 16384}}, "");  // so large, but for its pixels
    refuses({{277, 60000}}, "");
    refuses({{322, 16}, {323, 16}, {32997, 2}, {32998, 2}}, "it is a volume");
    refuses({{262, 0}}, "its colour model");            // white is 0
    refuses({{262, 5}, {277, 4}}, "its colour model");  // CMYK
    refuses({{262, 6}, {277, 3}}, "");                  // YCbCr
    refuses({{262, 8}, {277, 3}}, "its colour model");  // L*a*b*
    for (const unsigned orientation : {2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
        refuses({{274, orientation}}, "its orientation tag turns or mirrors it");
    }
    refuses({{258, 12}}, "its values have 12 bits");
    refuses({{339, 2}}, "its values are of type int8");
    refuses({{258, 16}, {339, 2}}, "its values are of type int16");
    refuses({{258, 32}}, "its values are of type uint");
    refuses({{258, 64}, {339, 3}}, "its values");
    refuses({{259, 12345}}, "");  // an unknown compression
    refuses({{322, 1U << 30}, {323, 1U << 30}}, "");
}

// --- Damage -------------------------------------------------------------------------------------

// Wherever a file ends, what is read is right or refused. (What is behind the pixels of TIFF and
// EXR, a date or another part, may be missing; PNG files are whole.)
TEST(MapImageDamage, FilesThatEndEarly) {
    const TemporaryFolder folder;
    for (const auto& entry : std::filesystem::directory_iterator(data)) {
        if (entry.path().extension() == ".md") continue;
        const auto whole = read(entry.path());
        const bool png = entry.path().extension() == ".png";
        const std::string bytes = testing::read_bytes(entry.path());
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            testing::write_bytes(folder / "cut", bytes.substr(0, size));
            const auto cut = read(folder / "cut");
            const std::string code = first_code(cut.diagnostics);
            EXPECT_TRUE(code == "E0304" || (code.empty() && !png)) << entry.path() << " " << size;
            if (!cut.value) continue;
            ASSERT_TRUE(whole.value.has_value());
            EXPECT_EQ(cut.value->values, whole.value->values) << entry.path() << " " << size;
        }
    }
}

TEST(MapImageDamage, EveryBitOfPngCounts) {
    const TemporaryFolder folder;
    for (const char* name : {"rgba8.png", "grey8_interlaced.png", "palette.png"}) {
        const std::string bytes = testing::read_bytes(data / name);
        for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
            std::string damaged = bytes;
            damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
            testing::write_bytes(folder / "damaged.png", damaged);
            EXPECT_EQ(first_code(read(folder / "damaged.png").diagnostics), "E0304") << bit;
        }
    }
}

// Damage elsewhere gives an error or other values, never a crash.
TEST(MapImageDamage, OfTiff) {
    const TemporaryFolder folder;
    testing::Random random(5);
    int refused = 0, changed = 0;
    for (const char* name : {"rgba16_tiles.tif", "grey16_zip.tif", "grey32_lzw.tif"}) {
        const std::string bytes = testing::read_bytes(data / name);
        for (int i = 0; i < 1000; ++i) {
            std::string damaged = bytes;
            const std::size_t at = random.below(bytes.size());
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << random.below(8)));
            testing::write_bytes(folder / "damaged.tif", damaged);
            const auto map = read(folder / "damaged.tif");
            map.value.has_value() ? ++changed : ++refused;
            EXPECT_EQ(first_code(map.diagnostics), map.value.has_value() ? "" : "E0304");
        }
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(changed, 0);
}

// --- Modules ------------------------------------------------------------------------------------

TEST(LoadModule, SaysWhatIsMissing) {
    const ModuleSymbol none = load_module("skybake_none", "symbol");
    EXPECT_EQ(none.address, nullptr);
    EXPECT_NE(none.reason.find("the module `skybake_none.so` is not in `lib"), std::string::npos)
        << none.reason;
    const ModuleSymbol other = load_module("skybake_images", "no_such_symbol");
    EXPECT_EQ(other.address, nullptr);
    EXPECT_NE(other.reason.find("no_such_symbol"), std::string::npos) << other.reason;
}

// Run by the test below, from where there is no module.
TEST(LoadModule, DISABLED_MapsNeedTheirModule) {
    EXPECT_NE(error_of(data / "rgba8.png").find("`skybake_images.so` is not in"),
              std::string::npos);
    EXPECT_EQ(error_of(data / "rgba8.png").substr(0, 5), "E0300");
}

TEST(LoadModule, FailsWhereTheProgramIsAlone) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "alone/bin");
    const auto program = folder / "alone/bin/map_tests";
    std::filesystem::copy_file("/proc/self/exe", program);
    const std::string command = program.string() +
                                " --gtest_also_run_disabled_tests"
                                " --gtest_filter=LoadModule.DISABLED_MapsNeedTheirModule";
    const std::string output = " > " + (folder / "output").string() + " 2>&1";
    const int status = std::system((command + output).c_str());
    const std::string words = testing::read_bytes(folder / "output");
    EXPECT_EQ(WEXITSTATUS(status), 0) << words;
    EXPECT_NE(words.find("1 test from 1 test suite ran"), std::string::npos) << words;
}

}  // namespace
}  // namespace skybake
