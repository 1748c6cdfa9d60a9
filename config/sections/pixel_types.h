// This header says which types the numbers of a file may have.
#pragma once

#include <cstddef>

namespace skybake::config {

// Types up to unorm16 hold each number by itself, and rgbe the three channels of a texel with one
// exponent. The others code blocks of 4 x 4 texels, which GPUs decode. Recipes do not offer bc5, the last
// one, because no asset has two channels.
enum class PixelType { float32, half, unorm8, unorm16, rgbe, bc4, bc6h, bc5 };

constexpr bool is_block_coded(PixelType type) { return type >= PixelType::bc4; }

// Returns how many channels a type codes, or 0 if it takes any number.
constexpr std::size_t coded_channels(PixelType type) {
    if (type == PixelType::bc4) return 1;
    if (type == PixelType::bc5) return 2;
    return type == PixelType::bc6h || type == PixelType::rgbe ? 3 : 0;
}

// A set of pixel types.
class PixelTypes {
  public:
    template <class... T>
    constexpr explicit PixelTypes(T... types) : bits_((0U | ... | bit(types))) {}
    constexpr bool contains(PixelType type) const { return (bits_ & bit(type)) != 0; }

  private:
    static constexpr unsigned bit(PixelType type) { return 1U << static_cast<unsigned>(type); }
    unsigned bits_;
};

inline constexpr PixelTypes floating_types(PixelType::float32, PixelType::half);
inline constexpr PixelTypes unorm_types(PixelType::unorm8, PixelType::unorm16);
inline constexpr PixelTypes number_types(PixelType::float32, PixelType::half, PixelType::unorm8,
                                         PixelType::unorm16);
inline constexpr PixelTypes texture_types(PixelType::float32, PixelType::half, PixelType::unorm8,
                                          PixelType::unorm16, PixelType::bc4, PixelType::bc5,
                                          PixelType::bc6h);
inline constexpr PixelTypes all_types(PixelType::float32, PixelType::half, PixelType::unorm8,
                                      PixelType::unorm16, PixelType::bc4, PixelType::bc5,
                                      PixelType::bc6h, PixelType::rgbe);

}  // namespace skybake::config

namespace skybake {
using config::PixelType;
}  // namespace skybake
