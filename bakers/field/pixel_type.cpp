#include "bakers/field/pixel_type.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "bakers/field/value_kernel.h"
#include "bakers/math/half_conversion.h"

namespace skybake {

float round_to_pixel_type(double value, PixelType type) {
    const auto single = static_cast<float>(value);
    if (type == PixelType::half) return float_of_half(half_of_float(single));
    if (type == PixelType::unorm8)
        return static_cast<float>(std::floor(single * 255.0 + 0.5) / 255);
    if (type == PixelType::unorm16) {
        return static_cast<float>(std::floor(single * 65535.0 + 0.5) / 65535);
    }
    return single;
}

PixelRange range_of(PixelType type) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    if (type == PixelType::float32) return {-kLargest, kLargest};
    if (type == PixelType::half) return {-kLargestHalf, kLargestHalf};
    if (type == PixelType::bc6h) return {0, kLargestHalf};
    if (type == PixelType::rgbe) return {0, largest_rgbe};
    return {0, 1};
}

const char* range_text(PixelType type) {
    if (type == PixelType::float32) return "the finite numbers";
    if (type == PixelType::bc6h) return "[0, 65504]";
    if (type == PixelType::rgbe) return "[0, 1.69e38]";
    return type == PixelType::half ? "[-65504, 65504]" : "[0, 1]";
}

namespace {

struct TypeFacts {
    std::size_t bytes;      // of a value; of types that code blocks, of a decoded one
    double bits;            // of a value in a file
    double rounding_error;  // of types that code blocks, that of the decoded float
};

// In the order of the enumerators.
constexpr TypeFacts kTypes[] = {
    {4, 32, 0x1p-24},        // float32
    {2, 16, 0x1p-11},        // half
    {1, 8, 0.5 / 255},       // unorm8
    {2, 16, 0.5 / 65535},    // unorm16
    {4, 32.0 / 3, 0x1p-24},  // rgbe
    {4, 4, 0x1p-24},         // bc4
    {4, 8.0 / 3, 0x1p-24},   // bc6h
    {4, 4, 0x1p-24},         // bc5
};

const TypeFacts& facts_of(PixelType type) { return kTypes[static_cast<std::size_t>(type)]; }

static_assert(std::endian::native == std::endian::little,
              "values are stored as they lie in memory");

struct AsFloat {
    using Stored = float;
    static float store(float value) { return value; }
    static float load(float value) { return value; }
};

struct AsHalf {
    using Stored = std::uint16_t;
    static Stored store(float value) { return half_of_float(value); }
    static float load(Stored value) { return float_of_half(value); }
};

// Values in steps of 1 / kSteps. A float times kSteps is exact in double, so there is only one
// rounding.
template <class T, int kSteps>
struct AsUnorm {
    using Stored = T;
    static Stored store(float value) {
        return static_cast<T>(static_cast<std::int32_t>(double{value} * kSteps + 0.5));
    }
    static float load(Stored value) { return static_cast<float>(value / double{kSteps}); }
};

// Calls `work` with the pixel type's conversion.
template <class Work>
void with_conversion(PixelType type, const Work& work) {
    if (type == PixelType::half) return work(AsHalf{});
    if (type == PixelType::unorm8) return work(AsUnorm<std::uint8_t, 255>{});
    if (type == PixelType::unorm16) return work(AsUnorm<std::uint16_t, 65535>{});
    return work(AsFloat{});  // or decoded
}

// The usual numbers of channels are compile-time constants, so that the compiler can unroll the
// loop over channels.
template <class Conversion, std::size_t kChannels>
void interleave(const std::vector<const float*>& channels, std::size_t count,
                typename Conversion::Stored* __restrict out) {
    for (std::size_t c = 0; c < kChannels; ++c) {
        const float* __restrict in = channels[c];
        for (std::size_t i = 0; i < count; ++i) out[i * kChannels + c] = Conversion::store(in[i]);
    }
}

template <class Conversion>
void interleave(const std::vector<const float*>& channels, std::size_t count,
                typename Conversion::Stored* out) {
    switch (channels.size()) {
        case 3:
            return interleave<Conversion, 3>(channels, count, out);
        case 4:
            return interleave<Conversion, 4>(channels, count, out);
        default:
            break;
    }
    for (std::size_t c = 0; c < channels.size(); ++c) {
        for (std::size_t i = 0; i < count; ++i) {
            out[i * channels.size() + c] = Conversion::store(channels[c][i]);
        }
    }
}

void round_to_rgbe(float* values, std::size_t count) {
    for (float* texel = values; count >= 3; texel += 3, count -= 3) {
        const auto [least, largest] = std::minmax({texel[0], texel[1], texel[2]});
        if (!(least >= 0 && largest <= largest_rgbe)) continue;
        int exponent = 0;
        std::frexp(largest, &exponent);
        const auto steps = [&exponent](float value) {
            return std::round(std::ldexp(double{value}, 8 - exponent));
        };
        if (steps(largest) > 255) ++exponent;
        const bool is_dark = largest < 1e-32F;
        for (std::size_t c = 0; c < 3; ++c) {
            texel[c] = is_dark ? 0 : static_cast<float>(std::ldexp(steps(texel[c]), exponent - 8));
        }
    }
}

}  // namespace

std::size_t bytes_per_value(PixelType type) { return facts_of(type).bytes; }
double bits_per_value(PixelType type) { return facts_of(type).bits; }
double rounding_error(PixelType type) { return facts_of(type).rounding_error; }

double smallest_normal(PixelType type) {
    if (type == PixelType::float32) return double{std::numeric_limits<float>::min()};
    return type == PixelType::half ? 0x1p-14 : 0;
}

float store(double value, PixelType type, RangeCounts& counts) {
    const float stored = round_to_pixel_type(value, type);
    if (!std::isfinite(stored)) ++counts.above_range;
    if (value != 0 && std::fabs(value) < smallest_normal(type)) ++counts.below_normal;
    return stored;
}

void store_voxels(const std::vector<const float*>& channels, std::size_t count, PixelType type,
                  char* out) {
    if (channels.size() == 1) return store_values(channels[0], count, type, out);
    with_conversion(type, [&]<class Conversion>(Conversion) {
        using Stored = typename Conversion::Stored;
        interleave<Conversion>(channels, count, reinterpret_cast<Stored*>(out));
    });
}

void store_values(const float* values, std::size_t count, PixelType type, char* out) {
    if (type == PixelType::half) {
        return halves_of_floats(values, count, reinterpret_cast<std::uint16_t*>(out));
    }
    if (type == PixelType::unorm8) {
        return bytes_of_floats(values, count, reinterpret_cast<std::uint8_t*>(out));
    }
    with_conversion(type, [&]<class Conversion>(Conversion) {
        auto* stored = reinterpret_cast<typename Conversion::Stored*>(out);
        for (std::size_t i = 0; i < count; ++i) stored[i] = Conversion::store(values[i]);
    });
}

void load_values(const char* bytes, std::size_t count, PixelType type, float* out) {
    if (type == PixelType::half) {
        return floats_of_halves(reinterpret_cast<const std::uint16_t*>(bytes), count, out);
    }
    with_conversion(type, [&]<class Conversion>(Conversion) {
        const auto* stored = reinterpret_cast<const typename Conversion::Stored*>(bytes);
        for (std::size_t i = 0; i < count; ++i) out[i] = Conversion::load(stored[i]);
    });
}

void round_values(float* values, std::size_t count, PixelType type) {
    if (type == PixelType::rgbe) return round_to_rgbe(values, count);
    if (type == PixelType::float32 || config::is_block_coded(type)) return;
    constexpr std::size_t kPiece = 4096;
    std::array<char, kPiece * 2> stored;
    for (std::size_t i = 0; i < count; i += kPiece) {
        const std::size_t piece = std::min(kPiece, count - i);
        store_values(values + i, piece, type, stored.data());
        load_values(stored.data(), piece, type, values + i);
    }
}

}  // namespace skybake
