#include "tests/support/exr_image.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <tuple>

#include "bakers/io/formats/exr/exr_file.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

using config::Compression;
using testing::Random;

ExrImage sample(PixelType type, Compression compression, int channels = 3) {
    ExrImage image;
    image.pixels = testing::sample_image(37, 19, channels);
    image.channel_names = channels == 1 ? std::vector<std::string>{"Y"}
                                        : std::vector<std::string>{"R", "G", "B", "A"};
    image.channel_names.resize(static_cast<std::size_t>(channels));
    image.pixel_type = type;
    image.compression = compression;
    image.attributes = {{"skybake/kind", "transmittance"},
                        {"skybake/parameters", "a = 1\nb = \"µ\"\n"}};
    return image;
}

class ExrRoundTrip : public ::testing::TestWithParam<std::tuple<PixelType, Compression, int>> {};

TEST_P(ExrRoundTrip, KeepsEverything) {
    const auto [type, compression, channels] = GetParam();
    const ExrImage image = sample(type, compression, channels);
    const auto bytes = encode_exr(image);
    ASSERT_TRUE(bytes.value.has_value());
    const auto read = decode_exr(*bytes.value, "sample.exr");
    ASSERT_TRUE(read.value.has_value()) << read.diagnostics[0].message;
    EXPECT_EQ(read.value->pixels.width, 37);
    EXPECT_EQ(read.value->pixels.height, 19);
    EXPECT_EQ(read.value->pixels.texels, image.pixels.texels);
    EXPECT_EQ(read.value->channel_names, image.channel_names);
    EXPECT_EQ(read.value->pixel_type, type);
    EXPECT_EQ(read.value->compression, compression);
    EXPECT_EQ(read.value->attributes, image.attributes);
}

TEST_P(ExrRoundTrip, GivesTheSameBytesAgain) {
    const auto [type, compression, channels] = GetParam();
    const ExrImage image = sample(type, compression, channels);
    EXPECT_EQ(*encode_exr(image).value, *encode_exr(image).value);
}

INSTANTIATE_TEST_SUITE_P(Profile, ExrRoundTrip,
                         ::testing::Combine(::testing::Values(PixelType::float32, PixelType::half),
                                            ::testing::Values(Compression::none, Compression::zip,
                                                              Compression::zips, Compression::piz),
                                            ::testing::Values(1, 3, 4)));

TEST(Exr, CarriesNoDateHostOrOwner) {
    const std::string bytes = *encode_exr(sample(PixelType::float32, Compression::none)).value;
    for (const char* word : {"capDate", "owner", "host", "utcOffset", "software"}) {
        EXPECT_EQ(bytes.find(word), std::string::npos) << word;
    }
}

TEST(Exr, FirstScanlineIsRowZero) {
    ExrImage image = sample(PixelType::float32, Compression::none, 1);
    image.attributes.clear();
    const std::string bytes = *encode_exr(image).value;
    // Uncompressed, the last 4 bytes are the last texel of the last row, and increasing Y comes
    // last.
    float last = 0;
    std::memcpy(&last, bytes.data() + bytes.size() - sizeof(last), sizeof(last));
    EXPECT_EQ(last, image.pixels.texel(36, 18)[0]);
}

TEST(Exr, SaysWhatIsWrongWithAFileThatIsNone) {
    for (const std::string bytes : {"", "hello", "\x76\x2f\x31\x01"}) {
        const auto read = decode_exr(bytes, "broken.exr");
        EXPECT_FALSE(read.value.has_value());
        ASSERT_EQ(testing::first_code(read.diagnostics), "E0304");
        EXPECT_EQ(read.diagnostics[0].where.source, "broken.exr");
    }
    EXPECT_EQ(testing::first_code(read_exr("/no/such.exr").diagnostics), "E0300");
}

TEST(Exr, SurvivesEveryTruncation) {
    for (const Compression compression : {Compression::none, Compression::zip, Compression::piz}) {
        const std::string bytes = *encode_exr(sample(PixelType::half, compression)).value;
        for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 64) {
            EXPECT_EQ(testing::first_code(decode_exr(bytes.substr(0, size), "cut.exr").diagnostics),
                      "E0304")
                << size;
        }
    }
}

TEST(Exr, SurvivesDamage) {
    Random random(7);
    for (const Compression compression : {Compression::none, Compression::zip, Compression::piz}) {
        const std::string whole = *encode_exr(sample(PixelType::float32, compression)).value;
        for (int round = 0; round < 400; ++round) {
            std::string bytes = whole;
            // The header is where damage hurts most.
            const std::size_t reach =
                round % 2 == 0 ? std::min<std::size_t>(bytes.size(), 500) : bytes.size();
            for (std::size_t i = random.below(8) + 1; i > 0; --i) {
                bytes[random.below(reach)] = static_cast<char>(random.next());
            }
            const auto read = decode_exr(bytes, "damaged.exr");  // any answer but a crash
            EXPECT_NE(read.value.has_value(), !read.diagnostics.empty());
        }
    }
}

TEST(Exr, SurvivesRandomBytes) {
    Random random(11);
    for (int round = 0; round < 200; ++round) {
        std::string bytes = "\x76\x2f\x31\x01\x02";
        bytes.append(3, '\0');
        for (std::size_t i = random.below(300); i > 0; --i)
            bytes += static_cast<char>(random.next());
        EXPECT_FALSE(decode_exr(bytes, "random.exr").value.has_value());
    }
}

// Gives the header's windows of these names another maximum.
std::string with_window(std::string bytes, const std::vector<std::string>& names,
                        const std::array<int, 2>& maximum) {
    for (const std::string& name : names) {
        const std::size_t window = bytes.find(name);
        EXPECT_NE(window, std::string::npos);
        // name, 0, "box2i", 0, size of 4 bytes, then min and max.
        const std::size_t at = window + name.size() + 1 + sizeof("box2i") + 4 + 8;
        std::memcpy(bytes.data() + at, maximum.data(), sizeof(maximum));
    }
    return bytes;
}

TEST(Exr, DoesNotAllocateWhatAHeaderLiesAbout) {
    const std::string bytes = *encode_exr(sample(PixelType::float32, Compression::zip)).value;
    const auto lie = with_window(bytes, {"dataWindow", "displayWindow"}, {60000, 60000});
    const auto huge = decode_exr(lie, "huge.exr");
    EXPECT_EQ(testing::first_code(huge.diagnostics), "E0304");
}

// Gives an attribute of the header another size than it has.
std::string with_claim(std::string bytes, const std::string& name, std::int32_t size) {
    const std::size_t at = bytes.find('\0', bytes.find(name + '\0') + name.size() + 1) + 1;
    std::memcpy(bytes.data() + at, &size, sizeof(size));
    return bytes;
}

// The largest address space that this process had, in KiB.
long peak_kib() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        long kib = 0;
        if (word == "VmPeak:" && status >> kib) return kib;
    }
    return -1;
}

// Returns by how many KiB reading the bytes, whole and row by row, raises the peak: in a child process,
// which begins with no peak above what it has. -1 where the file is not refused as damaged.
long cost_kib(const std::string& bytes, const std::filesystem::path& path) {
    testing::write_bytes(path, bytes);
    std::array<int, 2> pipe{};
    EXPECT_EQ(::pipe(pipe.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const long before = peak_kib();
        const bool refused = testing::first_code(read_exr(path).diagnostics) == "E0304" &&
                             testing::first_code(ExrRows::open(path).diagnostics) == "E0304";
        const long cost = refused ? peak_kib() - before : -1;
        ::_exit(::write(pipe[1], &cost, sizeof(cost)) == sizeof(cost) ? 0 : 1);
    }
    long cost = -1;
    EXPECT_EQ(::read(pipe[0], &cost, sizeof(cost)), static_cast<ssize_t>(sizeof(cost)));
    ::close(pipe[0]);
    ::close(pipe[1]);
    ::waitpid(child, nullptr, 0);
    return cost;
}

// The library takes a header at its word: 1.8 GB for an attribute, 8 bytes for each row of blocks,
// a buffer of 16 rows.
TEST(Exr, MemoryIsBoundedByTheFilesLength) {
    const testing::TemporaryFolder folder;
    const std::string bytes = *encode_exr(sample(PixelType::float32, Compression::zip)).value;
    const std::string plain = *encode_exr(sample(PixelType::float32, Compression::none)).value;
    const std::vector<std::string> both = {"dataWindow", "displayWindow"};
    const std::pair<const char*, std::string> lies[] = {
        {"a text", with_claim(bytes, "skybake/kind", 1'800'000'000)},
        {"a text of negative length", with_claim(bytes, "skybake/kind", -1)},
        {"a box", with_claim(bytes, "dataWindow", 1'800'000'000)},
        {"rows", with_window(bytes, {"dataWindow"}, {36, 1 << 30})},
        {"columns", with_window(bytes, {"dataWindow"}, {1 << 30, 18})},
        {"rows of both windows", with_window(bytes, both, {0, 1 << 20})},
        {"columns of both windows", with_window(bytes, both, {1 << 20, 18})},
        {"texels that are not packed", with_window(plain, both, {800, 800})},
    };
    constexpr long allowed = 4 << 10;
    ASSERT_GT(peak_kib(), 0);
    for (const auto& [what, lie] : lies) {
        const long cost = cost_kib(lie, folder / "lie.exr");
        EXPECT_GE(cost, 0) << what << ": not refused";
        EXPECT_LT(cost, allowed) << what;
    }
}

// A file of all zeros is as small as they come, and is read.
TEST(Exr, ReadsWhatPacksBest) {
    for (const Compression compression : {Compression::zip, Compression::zips, Compression::piz}) {
        ExrImage image;
        image.pixels = Image2<float>(1024, 512, 1);
        image.channel_names = {"Y"};
        image.compression = compression;
        EXPECT_TRUE(decode_exr(*encode_exr(image).value, "zero.exr").value.has_value());
    }
}

TEST(Exr, RefusesAPartOfAnImage) {
    const std::string bytes = *encode_exr(sample(PixelType::float32, Compression::zip)).value;
    const testing::TemporaryFolder folder;
    testing::write_bytes(folder / "part.exr", with_window(bytes, {"displayWindow"}, {99, 99}));
    const auto cropped = exr_format().inspect(folder / "part.exr");
    ASSERT_EQ(testing::first_code(cropped.diagnostics), "E0304");
    EXPECT_NE(cropped.diagnostics[0].message.find("cropped"), std::string::npos);
}

TEST(Exr, StoredBytesAreLittleEndianRowByRow) {
    Image2<float> image(2, 1, 1);
    image.texels = {1.0f, -2.0f};
    EXPECT_EQ(stored_bytes(image, PixelType::float32), std::string("\0\0\x80\x3f\0\0\0\xc0", 8));
    EXPECT_EQ(stored_bytes(image, PixelType::half), std::string("\0\x3c\0\xc0", 4));
}

}  // namespace
}  // namespace skybake
