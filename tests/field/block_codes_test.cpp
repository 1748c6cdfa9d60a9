// BC4, BC5 and BC6H: the encoders against exhaustive searches, the decoders against libsquish and
// OpenImageIO.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <squish.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "bakers/field/bc4.h"
#include "bakers/field/bc6h.h"
#include "bakers/field/block_voxels.h"
#include "bakers/field/survey_volume.h"
#include "tests/support/comparisons.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using Random = std::mt19937;  // the same numbers everywhere

using Texels = std::array<float, 16>;

double uniform(Random& random) { return static_cast<double>(random() % (1 << 24)) / (1 << 24); }

enum class Kind { noise, ramp, rough_ramp, clipped_ramp, gaps, bright, almost_flat };
constexpr std::array kKinds = {Kind::noise, Kind::ramp,   Kind::rough_ramp, Kind::clipped_ramp,
                               Kind::gaps,  Kind::bright, Kind::almost_flat};

Texels sample_block(Kind kind, Random& random) {
    const double centre = uniform(random);
    const double steepness = uniform(random) * 0.3;
    const double along_x = (uniform(random) - 0.5) * steepness;
    const double along_y = (uniform(random) - 0.5) * steepness;
    Texels texels;
    for (int i = 0; i < 16; ++i) {
        const double noise = uniform(random);
        const double ramp = centre + along_x * (i % 4) + along_y * (i / 4);
        double value = noise;
        if (kind == Kind::ramp) value = ramp;
        if (kind == Kind::rough_ramp) value = ramp + 0.02 * (noise - 0.5);
        if (kind == Kind::clipped_ramp) value = 3 * (ramp - centre) + centre - 0.5 + 0.1 * noise;
        if (kind == Kind::gaps) value = noise < steepness * 3 ? 0 : centre + 0.1 * noise;
        if (kind == Kind::bright) value = ramp + 0.4 * noise;
        if (kind == Kind::almost_flat) value = centre + 0.004 * noise;
        texels[static_cast<std::size_t>(i)] = static_cast<float>(std::clamp(value, 0.0, 1.0));
    }
    return texels;
}

// Blocks beside each other, as a plane.
std::vector<float> plane_of(const std::vector<Texels>& blocks) {
    const std::size_t pitch = 4 * blocks.size();
    std::vector<float> plane(4 * pitch + bc4_padding);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        for (std::size_t i = 0; i < 16; ++i) plane[i / 4 * pitch + 4 * b + i % 4] = blocks[b][i];
    }
    return plane;
}

std::vector<std::uint8_t> encoded(const std::vector<Texels>& blocks) {
    const std::vector<float> plane = plane_of(blocks);
    std::vector<std::uint8_t> bytes(bc4_bytes * blocks.size());
    encode_bc4({plane.data(), 4 * blocks.size(), blocks.size(), 1}, bytes.data(), bc4_bytes);
    return bytes;
}

// The least sum of squares of all 65536 pairs of end points.
double exhaustive_error(const Texels& texels) {
    double best = 1e9;
    for (int first = 0; first < 256; ++first) {
        for (int second = 0; second < 256; ++second) {
            std::array<double, 8> values = {0, 0, 0, 0, 0, 0, 0, 1};
            const int steps = first > second ? 7 : 5;
            for (int k = 0; k <= steps; ++k) {
                values[static_cast<std::size_t>(k)] =
                    ((steps - k) * first + k * second) / (255.0 * steps);
            }
            double error = 0;
            for (std::size_t i = 0; i < 16 && error < best; ++i) {
                double least = 1;
                for (const double value : values) {
                    least = std::min(least, std::abs(value - double{texels[i]}));
                }
                error += least * least;
            }
            best = std::min(best, error);
        }
    }
    return best;
}

TEST(Bc4, IsAlmostAsGoodAsAnExhaustiveSearch) {
    Random random(11);
    double found_in_all = 0;
    double least_in_all = 0;
    for (const Kind kind : kKinds) {
        std::vector<Texels> blocks;
        for (int i = 0; i < 12; ++i) blocks.push_back(sample_block(kind, random));
        const std::vector<std::uint8_t> bytes = encoded(blocks);
        double found = 0;
        double least = 0;
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            found +=
                16 *
                std::pow(test::rms_difference(decode_bc4(&bytes[b * bc4_bytes]), blocks[b]), 2);
            least += exhaustive_error(blocks[b]);
        }
        // A single block of six steps may be a tenth off: clipped ramps reach 1.085.
        EXPECT_LT(std::sqrt(found / least), 1.1) << static_cast<int>(kind);
        EXPECT_GE(found, least * (1 - 1e-6));
        found_in_all += found;
        least_in_all += least;
    }
    std::printf("BC4: RMS %.4f of that of an exhaustive search\n",
                std::sqrt(found_in_all / least_in_all));
    EXPECT_LT(std::sqrt(found_in_all / least_in_all), 1.02);
}

TEST(Bc4, HoldsWhatItCanHoldExactly) {
    std::vector<Texels> blocks;
    for (const float value : {0.0F, 1.0F, 51.0F / 255}) {
        Texels texels;
        texels.fill(value);
        blocks.push_back(texels);
    }
    Texels mixed;
    for (std::size_t i = 0; i < 16; ++i) {
        mixed[i] = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 100.0F / 255;
    }
    blocks.push_back(mixed);
    for (std::size_t i = 0; i < 16; ++i) mixed[i] = static_cast<float>(10 + 7 * (i % 8)) / 255;
    blocks.push_back(mixed);
    const std::vector<std::uint8_t> bytes = encoded(blocks);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Texels decoded = decode_bc4(&bytes[b * bc4_bytes]);
        for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(decoded[i], blocks[b][i]) << b << " " << i;
    }
}

// The alpha of a DXT5 block is a block of BC4. (For kBc4 and kBc5, libsquish 1.15 decodes colours.)
// It rounds values down to 8 bits.
TEST(Bc4, SquishDecodesTheSame) {
    Random random(5);
    for (int i = 0; i < 3000; ++i) {
        std::array<std::uint8_t, 16> block;
        for (auto& byte : block) byte = static_cast<std::uint8_t>(random() % 256);
        if (i % 3 == 0) block[0] = block[1];
        std::array<std::uint8_t, 64> rgba{};
        squish::Decompress(rgba.data(), block.data(), squish::kDxt5);
        const Texels found = decode_bc4(block.data());
        for (std::size_t t = 0; t < 16; ++t) {
            ASSERT_NEAR(255 * double{found[t]}, rgba[4 * t + 3], 1.001);
        }
    }
}

// --- BC6H ---------------------------------------------------------------------------------------

// The pixels of blocks beside each other, of three channels, as OpenImageIO reads them from a DDS file.
std::vector<float> decoded_by_library(const std::vector<std::uint8_t>& blocks) {
    const auto width = static_cast<std::uint32_t>(blocks.size() / 16 * 4);
    std::array<std::uint32_t, 37> head{};  // as Microsoft documents it, for DXGI_FORMAT_BC6H_UF16
    for (const auto& [at, word] :
         std::vector<std::pair<std::size_t, std::uint32_t>>{{0, 0x20534444},
                                                            {1, 124},
                                                            {2, 0x1007},
                                                            {3, 4},
                                                            {4, width},
                                                            {19, 32},
                                                            {20, 4},
                                                            {21, 0x30315844},
                                                            {27, 0x1000},
                                                            {32, 95},
                                                            {33, 3},
                                                            {35, 1}}) {
        head[at] = word;
    }
    std::string bytes(reinterpret_cast<const char*>(head.data()), sizeof head);
    bytes.append(blocks.begin(), blocks.end());
    const TemporaryFolder folder;
    const auto input = OIIO::ImageInput::open(folder.write("blocks.dds", bytes).string());
    std::vector<float> pixels(std::size_t{4} * width * 3);
    EXPECT_TRUE(input && input->read_image(0, 0, 0, 3, OIIO::TypeFloat, pixels.data()))
        << OIIO::geterror();
    return pixels;
}

// The encoder's four modes are decoded, which have one pair of end points; no others.
TEST(Bc6h, OpenImageIODecodesTheSame) {
    constexpr std::array words = {3, 7, 11, 15};
    constexpr std::size_t kBlocks = 4000;
    Random random(9);
    std::vector<std::uint8_t> blocks(16 * kBlocks);
    for (auto& byte : blocks) byte = static_cast<std::uint8_t>(random() % 256);
    for (std::size_t b = 0; b < kBlocks; b += 2) {
        blocks[16 * b] = static_cast<std::uint8_t>((blocks[16 * b] & ~31) | words[random() % 4]);
    }
    const std::vector<float> pixels = decoded_by_library(blocks);
    for (std::size_t b = 0; b < kBlocks; ++b) {
        const bool is_known = std::ranges::count(words, blocks[16 * b] & 31) > 0;
        const auto found = decode_bc6h(&blocks[16 * b]);
        for (std::size_t t = 0; t < 16; ++t) {
            const std::size_t pixel = t / 4 * 4 * kBlocks + 4 * b + t % 4;
            for (std::size_t c = 0; c < 3; ++c) {
                ASSERT_EQ(found[c][t], is_known ? pixels[3 * pixel + c] : 0) << b << ' ' << t;
            }
        }
    }
}

// Relative RMS error of blocks of colours; the encoder's own measure is close to it.
double bc6h_error(const std::vector<std::array<Texels, 3>>& blocks, std::vector<int>* words) {
    std::array<std::vector<float>, 3> planes;
    std::array<TexelPlane, 3> texels;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<Texels> channel;
        for (const auto& block : blocks) channel.push_back(block[c]);
        planes[c] = plane_of(channel);
        texels[c] = {planes[c].data(), 4 * blocks.size(), blocks.size(), 1};
    }
    std::vector<std::uint8_t> bytes(16 * blocks.size());
    encode_bc6h(texels, bytes.data());
    double sum = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (words != nullptr) words->push_back(bytes[16 * b] & 31);
        const auto decoded = decode_bc6h(&bytes[16 * b]);
        for (std::size_t i = 0; i < 16; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const double value = double{blocks[b][c][i]};
                const auto found = double{decoded[c][i]};
                sum += std::pow(value == 0 ? found : found / value - 1, 2);
            }
        }
    }
    return std::sqrt(sum / (48.0 * static_cast<double>(blocks.size())));
}

TEST(Bc6h, SmoothColoursAreFine) {
    Random random(4);
    std::vector<std::array<Texels, 3>> blocks;
    for (int b = 0; b < 64; ++b) {
        std::array<Texels, 3> block;
        const double level = std::pow(2.0, 20 * uniform(random) - 10);
        const double along_x = 0.02 * (uniform(random) - 0.5);
        const double along_y = 0.02 * (uniform(random) - 0.5);
        for (std::size_t c = 0; c < 3; ++c) {
            const double tint = 0.3 + uniform(random);
            for (std::size_t i = 0; i < 16; ++i) {
                block[c][i] = static_cast<float>(level * tint *
                                                 (1 + along_x * static_cast<double>(i % 4) +
                                                  along_y * static_cast<double>(i / 4)));
            }
        }
        blocks.push_back(block);
    }
    std::vector<int> words;
    const double error = bc6h_error(blocks, &words);
    std::printf("BC6H: relative RMS %.5f of smooth colours\n", error);
    EXPECT_LT(error, 0.002);
    // Differences win where colours are near to each other.
    EXPECT_GT(std::count_if(words.begin(), words.end(), [](int word) { return word != 3; }), 32);
}

TEST(Bc6h, EqualColoursAreAlmostExactAndZeroIsZero) {
    for (const float value : {0.0F, 1.0F, 0.001F, 60000.0F, 65504.0F, 6e-8F}) {
        std::array<Texels, 3> block;
        for (Texels& channel : block) channel.fill(value);
        block[1].fill(value / 2);
        const double error = bc6h_error({block}, nullptr);
        EXPECT_LE(error, value < 1e-4F ? 1.0 : 0.0005) << value;
        EXPECT_TRUE(value != 0 || error == 0);
    }
}

// --- Volumes ------------------------------------------------------------------------------------

// A box of voxels is cut from whole blocks, wherever it begins: each voxel is the same in all boxes.
TEST(CodedVoxels, DoNotDependOnTheBox) {
    const std::array<int, 3> size = {13, 10, 9};
    struct Case {
        PixelType type;
        int channels;
    };
    for (const auto& [type, channels] :
         {Case{PixelType::bc4, 1}, {PixelType::bc5, 2}, {PixelType::bc6h, 3}}) {
        const auto voxel = [&](int x, int y, int z, int c) {
            EXPECT_TRUE(x < size[0] && y < size[1] && z < size[2]) << "beyond the edge";
            return static_cast<float>(0.5 + 0.3 * std::sin(0.2 * x + 0.1 * c) * std::cos(0.3 * y) +
                                      0.002 * z);
        };
        Baked volume = testing::plain_volume(size, channels, type, voxel);
        if (channels == 2) volume.channel_names = {"R", "G"};
        code_levels(volume);
        const auto count = static_cast<std::size_t>(channels);
        const VoxelSource& source = *volume.levels[0].voxels;
        const auto whole = testing::planes_of(source, {{}, size}, count);
        const auto raw = testing::planes_of(*volume.levels[0].uncoded, {{}, size}, count);
        double largest = 0;
        for (std::size_t c = 0; c < count; ++c) {
            for (std::size_t i = 0; i < raw[c].size(); ++i) {
                largest = std::max(largest, std::abs(double{whole[c][i]} - double{raw[c][i]}));
            }
        }
        EXPECT_GT(largest, 0) << static_cast<int>(type);
        EXPECT_LT(largest, 0.05) << static_cast<int>(type);
        for (const VoxelBox box :
             {VoxelBox{{3, 2, 1}, {2, 8, 2}}, {{0, 0, 8}, {13, 10, 1}}, {{12, 9, 0}, {1, 1, 9}}}) {
            EXPECT_TRUE(testing::is_part_of(whole, source, size, box));
        }
    }
}

// A survey finds what the type cannot hold, because it stays as it is.
TEST(CodedVoxels, KeepWhatTheyCannotHold) {
    Baked volume = testing::plain_volume(
        {9, 9, 9}, 1, PixelType::bc4,
        [](int x, int y, int z, int) { return x == 5 && y == 6 && z == 7 ? 1.5F : 0.25F; });
    code_levels(volume);
    const auto at = [&](const std::array<int, 3>& voxel) {
        return testing::planes_of(*volume.levels[0].voxels, {voxel, {1, 1, 1}}, 1)[0][0];
    };
    EXPECT_EQ(at({5, 6, 7}), 1.5F);
    EXPECT_LT(at({4, 6, 7}), 1);
    const auto problems = survey_level(volume, 0, {{0, 1}}, {2});
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].code, "E0402");
    EXPECT_NE(problems[0].message.find("(5, 6, 7)"), std::string::npos);
}

}  // namespace
}  // namespace skybake
