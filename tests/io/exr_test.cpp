#include "tests/io/open_formats.h"
#include "tests/support/exr_image.h"

#include <array>
#include <cstring>
#include <fstream>

#include "bakers/io/formats/exr/exr_file.h"
#include "tests/io/exr_bytes.h"
#include "tests/io/format_checks.h"

namespace skybake {
namespace {

using config::Compression;
using testing::Random;

Baked sample(PixelType type, Compression compression, int channels = 3) {
    Baked volume = testing::plain_volume({37, 19, 1}, channels, type);
    volume.compression = compression;
    return volume;
}

std::string bytes_of(const Baked& volume) {
    const TemporaryFolder folder;
    return testing::written(folder, config::FileFormat::exr, volume, 1);
}

TEST(Exr, CarriesNoDateHostOrOwner) {
    const std::string bytes = bytes_of(sample(PixelType::float32, Compression::none));
    for (const char* word : {"capDate", "owner", "host", "utcOffset", "software"}) {
        EXPECT_EQ(bytes.find(word), std::string::npos) << word;
    }
}

// Uncompressed, the last 4 bytes are the last texel of the last row, as increasing Y comes last.
TEST(Exr, FirstScanlineIsRowZero) {
    const std::string bytes = bytes_of(sample(PixelType::float32, Compression::none, 1));
    EXPECT_EQ(testing::number<float>(bytes, bytes.size() - sizeof(float)),
              testing::sample_voxel(36, 18, 0, 0));
}

TEST(Exr, SaysWhatIsWrongWithAFileThatIsNone) {
    const TemporaryFolder folder;
    for (const std::string bytes : {"", "hello", "\x76\x2f\x31\x01"}) {
        const auto read = ExrRows::open(folder.write("broken.exr", bytes));
        EXPECT_FALSE(read.value.has_value());
        ASSERT_EQ(testing::first_code(read.diagnostics), "E0304");
        EXPECT_EQ(read.diagnostics[0].where.source, (folder / "broken.exr").string());
    }
}

TEST(Exr, RefusesDamagedFiles) {
    for (const Compression compression :
         {Compression::none, Compression::zip, Compression::zips, Compression::piz}) {
        for (const PixelType type : {PixelType::half, PixelType::float32}) {
            testing::expect_refuses_damage(config::FileFormat::exr, sample(type, compression));
        }
    }
}

TEST(Exr, SurvivesRandomBytes) {
    const TemporaryFolder folder;
    Random random(11);
    for (int round = 0; round < 200; ++round) {
        std::string bytes = "\x76\x2f\x31\x01\x02";
        bytes.append(3, '\0');
        for (std::size_t i = random.below(300); i > 0; --i)
            bytes += static_cast<char>(random.next());
        EXPECT_FALSE(ExrRows::open(folder.write("random.exr", bytes)).value.has_value());
    }
}

// Gives the header's windows of these names another maximum, which is behind two numbers of the minimum.
std::string with_window(std::string bytes, const std::vector<std::string>& names,
                        const std::array<int, 2>& maximum) {
    for (const std::string& name : names) {
        const std::size_t at = testing::exr_attribute(bytes, name).at + 8;
        std::memcpy(bytes.data() + at, maximum.data(), sizeof(maximum));
    }
    return bytes;
}

// Gives an attribute of the header another size than it has.
std::string with_claim(std::string bytes, const std::string& name, std::int32_t size) {
    std::memcpy(bytes.data() + testing::exr_attribute(bytes, name).at - 4, &size, sizeof(size));
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

// The library takes a header at its word: 1.8 GB for an attribute, 8 bytes for each row of blocks,
// a buffer of 16 rows.
TEST(Exr, MemoryIsBoundedByTheFilesLength) {
    const testing::TemporaryFolder folder;
    const std::string bytes = bytes_of(sample(PixelType::float32, Compression::zip));
    const std::string plain = bytes_of(sample(PixelType::float32, Compression::none));
    const std::vector<std::string> both = {"dataWindow", "displayWindow"};
    const std::pair<const char*, std::string> lies[] = {
        {"a text", with_claim(bytes, "skybake/asset", 1'800'000'000)},
        {"a text of negative length", with_claim(bytes, "skybake/asset", -1)},
        {"a box", with_claim(bytes, "dataWindow", 1'800'000'000)},
        {"rows", with_window(bytes, {"dataWindow"}, {36, 1 << 30})},
        {"columns", with_window(bytes, {"dataWindow"}, {1 << 30, 18})},
        {"texels of both windows", with_window(bytes, both, {60000, 60000})},
        {"rows of both windows", with_window(bytes, both, {0, 1 << 20})},
        {"columns of both windows", with_window(bytes, both, {1 << 20, 18})},
        {"texels that are not packed", with_window(plain, both, {800, 800})},
    };
    constexpr long allowed = 4 << 10;
    ASSERT_GT(peak_kib(), 0);
    for (const auto& [what, lie] : lies) {
        const auto path = folder.write("lie.exr", lie);
        // A child begins with no peak above what it has.
        const int status = testing::in_child([&] {
            const long before = peak_kib();
            if (testing::first_code(ExrRows::open(path).diagnostics) != "E0304") return 2;
            return peak_kib() - before < allowed ? 0 : 1;
        });
        EXPECT_EQ(status, 0) << what << (status == 2 ? ": not refused" : ": too much memory");
    }
}

// A file of all zeros is as small as they come, and is read.
TEST(Exr, ReadsWhatPacksBest) {
    const TemporaryFolder folder;
    for (const Compression compression : {Compression::zip, Compression::zips, Compression::piz}) {
        const ExrImage image{
            Image2<float>(1024, 512, 1), {"Y"}, PixelType::float32, compression, {}};
        EXPECT_TRUE(ExrRows::open(folder.write("zero.exr", encode_exr(image))).value.has_value());
    }
}

TEST(Exr, RefusesAPartOfAnImage) {
    const std::string bytes = bytes_of(sample(PixelType::float32, Compression::zip));
    const testing::TemporaryFolder folder;
    testing::write_bytes(folder / "part.exr", with_window(bytes, {"displayWindow"}, {99, 99}));
    const auto cropped = testing::inspect_file(exr_format(), folder / "part.exr");
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
