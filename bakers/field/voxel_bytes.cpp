#include "bakers/field/voxel_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "bakers/math/half_conversion.h"

namespace skybake {

namespace {

using config::PixelType;

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

// Steps of 1 / kSteps. A float times kSteps is exact in double, so that only the rounding rounds.
template <class T, int kSteps>
struct AsUnorm {
    using Stored = T;
    static Stored store(float value) {
        return static_cast<T>(static_cast<std::int32_t>(double{value} * kSteps + 0.5));
    }
    static float load(Stored value) { return static_cast<float>(value / double{kSteps}); }
};

// Calls `work` with the type's conversion.
template <class Work>
void with_conversion(PixelType type, const Work& work) {
    switch (type) {
        case PixelType::float32:
            return work(AsFloat{});
        case PixelType::half:
            return work(AsHalf{});
        case PixelType::unorm8:
            return work(AsUnorm<std::uint8_t, 255>{});
        case PixelType::unorm16:
            return work(AsUnorm<std::uint16_t, 65535>{});
    }
}

// The number of channels is known where it is usual, so that the loop has no inner one.
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
        case 1:
            return interleave<Conversion, 1>(channels, count, out);
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

}  // namespace

void store_voxels(const std::vector<const float*>& channels, std::size_t count, PixelType type,
                  char* out) {
    with_conversion(type, [&]<class Conversion>(Conversion) {
        using Stored = typename Conversion::Stored;
        interleave<Conversion>(channels, count, reinterpret_cast<Stored*>(out));
    });
}

void store_values(const float* values, std::size_t count, PixelType type, char* out) {
    store_voxels({values}, count, type, out);
}

void load_values(const char* bytes, std::size_t count, PixelType type, float* out) {
    with_conversion(type, [&]<class Conversion>(Conversion) {
        const auto* stored = reinterpret_cast<const typename Conversion::Stored*>(bytes);
        for (std::size_t i = 0; i < count; ++i) out[i] = Conversion::load(stored[i]);
    });
}

void round_values(float* values, std::size_t count, PixelType type) {
    if (type == PixelType::float32) return;
    constexpr std::size_t kPiece = 4096;
    std::array<char, kPiece * 2> stored;
    for (std::size_t i = 0; i < count; i += kPiece) {
        const std::size_t piece = std::min(kPiece, count - i);
        store_values(values + i, piece, type, stored.data());
        load_values(stored.data(), piece, type, values + i);
    }
}

}  // namespace skybake
