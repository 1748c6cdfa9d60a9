#include "bakers/field/pixel_type.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "bakers/math/half_conversion.h"
#include "tests/field/hard_floats.h"

namespace skybake {
namespace {

TEST(HalfConversion, RoundsAsImath) {
    long wrong = 0;
    const auto visit = [&](std::uint32_t bits) {
        const auto value = std::bit_cast<float>(bits);
        if (half_of_float(value) == half(value).bits()) return;
        if (std::isnan(value) && (half_of_float(value) & 0x7fff) > 0x7c00) return;
        if (wrong++ == 0) ADD_FAILURE() << "at bits " << std::hex << bits;
    };
    testing::for_each_hard_float(1, visit);
    std::uint32_t bits = 0;
    do visit(bits);
    while ((bits += 1021) >= 1021);  // over all floats by a prime stride, until it wraps
    EXPECT_EQ(wrong, 0);
}

TEST(HalfConversion, ReadsEachHalfExactly) {
    for (std::uint32_t bits = 0; bits < 1U << 16; ++bits) {
        const auto stored = static_cast<std::uint16_t>(bits);
        half wanted;
        wanted.setBits(stored);
        const float value = float_of_half(stored);
        if (std::isnan(static_cast<float>(wanted))) {
            EXPECT_TRUE(std::isnan(value)) << bits;
            continue;
        }
        EXPECT_EQ(std::bit_cast<std::uint32_t>(value),
                  std::bit_cast<std::uint32_t>(static_cast<float>(wanted)))
            << bits;
        EXPECT_EQ(half_of_float(value), stored);
    }
}

template <class T>
T value_at(const std::string& bytes, std::size_t index) {
    T value;
    std::memcpy(&value, bytes.data() + index * sizeof(T), sizeof(T));
    return value;
}

TEST(VoxelBytes, InterleavesChannels) {
    const std::vector<float> red = {0, 0.25F, 1};
    const std::vector<float> green = {0.5F, 0.75F, 0.125F};
    for (const std::size_t channels : {1U, 2U, 3U, 4U}) {
        std::vector<const float*> planes;
        for (std::size_t c = 0; c < channels; ++c)
            planes.push_back(c % 2 == 0 ? red.data() : green.data());
        for (const PixelType type :
             {PixelType::float32, PixelType::half, PixelType::unorm8, PixelType::unorm16}) {
            std::string bytes(3 * channels * bytes_per_value(type), '\0');
            store_voxels(planes, 3, type, bytes.data());
            std::vector<float> read(3 * channels);
            load_values(bytes.data(), read.size(), type, read.data());
            for (std::size_t i = 0; i < read.size(); ++i) {
                const float value = planes[i % channels][i / channels];
                EXPECT_EQ(read[i], round_to_pixel_type(value, type));
            }
        }
    }
}

TEST(VoxelBytes, UnormRoundsToNearest) {
    // 0.5 / 255 is no float: the two beside it go down and up.
    const auto middle = static_cast<float>(0.5 / 255);
    const float below = double{middle} * 255 < 0.5 ? middle : std::nextafter(middle, 0.0F);
    const std::vector<float> values = {0,    below, std::nextafter(below, 1.0F),
                                       0.5F, 1,     std::nextafter(1.0F, 0.0F)};
    std::string bytes(values.size() * 2, '\0');
    store_values(values.data(), values.size(), PixelType::unorm8, bytes.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(value_at<std::uint8_t>(bytes, i), std::lround(values[i] * 255.0)) << values[i];
    }
    EXPECT_EQ(value_at<std::uint8_t>(bytes, 1), 0);
    EXPECT_EQ(value_at<std::uint8_t>(bytes, 2), 1);
    EXPECT_EQ(value_at<std::uint8_t>(bytes, 3), 128);  // 127.5
    store_values(values.data(), values.size(), PixelType::unorm16, bytes.data());
    EXPECT_EQ(value_at<std::uint16_t>(bytes, 3), 32768);  // 32767.5
    EXPECT_EQ(value_at<std::uint16_t>(bytes, 4), 65535);
}

TEST(VoxelBytes, EachUnormStepReadsBackAsItself) {
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        const int steps = type == PixelType::unorm8 ? 255 : 65535;
        for (int k = 0; k <= steps; ++k) {
            const auto value = static_cast<float>(static_cast<double>(k) / steps);
            EXPECT_EQ(round_to_pixel_type(value, type), value) << k;
            std::string bytes(2, '\0');
            store_values(&value, 1, type, bytes.data());
            float read = -1;
            load_values(bytes.data(), 1, type, &read);
            EXPECT_EQ(read, value);
        }
    }
}

}  // namespace
}  // namespace skybake
