#include "bakers/field/bc6h.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/math/half_conversion.h"

namespace skybake {
namespace {

constexpr std::size_t texels = 16;
constexpr std::array<int, 16> weights = {0,  4,  9,  13, 17, 21, 26, 30,
                                         34, 38, 43, 47, 51, 55, 60, 64};

struct Mode {
    int word;        // the first five bits
    int precision;   // bits of the first end point
    int difference;  // bits of the second one; below `precision` it is a difference
};
constexpr std::array<Mode, 4> modes = {
    {{0x03, 10, 10}, {0x07, 11, 9}, {0x0B, 12, 8}, {0x0F, 16, 4}}};

using Color = std::array<int, 3>;
using RealColor = std::array<double, 3>;
using EndPoints = std::array<Color, 2>;  // as the mode stores them

// Texels in the scale of 16 bits in which the format interpolates: 64/31 of a half's bits.
struct HdrBlock {
    std::array<Color, texels> halves;
    std::array<RealColor, texels> values;
};

// --- The format ---------------------------------------------------------------------------------

int widened(int stored, int precision) {
    if (precision >= 15 || stored == 0) return stored;
    if (stored == (1 << precision) - 1) return 0xFFFF;
    return ((stored << 16) + 0x8000) >> precision;
}

// The bits of the half between two widened end points.
int half_between(int first, int second, int weight) {
    const int value = (first * (64 - weight) + second * weight + 32) >> 6;
    return (value * 31) >> 6;
}

using Palette = std::array<Color, texels>;

Palette palette_of(const EndPoints& ends, int precision) {
    Palette palette;
    for (std::size_t c = 0; c < 3; ++c) {
        const int first = widened(ends[0][c], precision);
        const int second = widened(ends[1][c], precision);
        for (std::size_t k = 0; k < texels; ++k) {
            palette[k][c] = half_between(first, second, weights[k]);
        }
    }
    return palette;
}

// 128 bits, the first one the lowest of the first byte.
class Bits {
  public:
    explicit Bits(std::uint8_t* block) : bytes_(block) {}

    void put(int value, int count) {
        for (int i = 0; i < count; ++i, ++at_) {
            const int bit = value >> i & 1;
            bytes_[at_ / 8] = static_cast<std::uint8_t>(bytes_[at_ / 8] | bit << at_ % 8);
        }
    }
    // Puts bits `count` - 1 to 0: the highest comes first.
    void put_reversed(int value, int count) {
        for (int i = count; i-- > 0;) put(value >> i & 1, 1);
    }

  private:
    std::uint8_t* bytes_;
    int at_ = 0;
};

class BitsReader {
  public:
    explicit BitsReader(const std::uint8_t* block) : bytes_(block) {}

    int take(int count) {
        int value = 0;
        for (int i = 0; i < count; ++i, ++at_) value |= (bytes_[at_ / 8] >> at_ % 8 & 1) << i;
        return value;
    }
    int take_reversed(int count) {
        int value = 0;
        for (int i = 0; i < count; ++i) value = value << 1 | take(1);
        return value;
    }

  private:
    const std::uint8_t* bytes_;
    int at_ = 0;
};

// --- Search -------------------------------------------------------------------------------------

// A way to store a block, and its error.
struct Encoding {
    const Mode* mode = nullptr;
    EndPoints ends{};
    std::array<int, texels> indices{};
    double error = std::numeric_limits<double>::infinity();
};

// Whether the second end point can be stored, also after an exchange of the two.
bool can_store(const EndPoints& ends, const Mode& mode) {
    if (mode.difference == mode.precision) return true;
    const int most = (1 << (mode.difference - 1)) - 1;
    for (std::size_t c = 0; c < 3; ++c) {
        if (std::abs(ends[1][c] - ends[0][c]) > most) return false;
    }
    return true;
}

// Where a texel lies between the first and the last colour of a palette, as an index that may be one
// too large or too small: the steps of a palette are uneven by less than half of one.
class Projection {
  public:
    explicit Projection(const Palette& palette) : first_(palette.front()) {
        double square = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            along_[c] = palette.back()[c] - first_[c];
            square += along_[c] * along_[c];
        }
        for (double& along : along_) along *= square > 0 ? 15 / square : 0;
    }
    int index(const Color& halves) const {
        double place = 0.5;
        for (std::size_t c = 0; c < 3; ++c) place += along_[c] * (halves[c] - first_[c]);
        return static_cast<int>(std::clamp(place, 0.0, 15.0));
    }

  private:
    Color first_;
    RealColor along_;
};

double squared_distance(const Color& a, const Color& b) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double difference = a[c] - b[c];
        sum += difference * difference;
    }
    return sum;
}

// Finds the best index of each texel.
void try_ends(const HdrBlock& block, const Mode& mode, const EndPoints& ends, Encoding& best) {
    if (!can_store(ends, mode)) return;
    const Palette palette = palette_of(ends, mode.precision);
    const Projection projection(palette);
    Encoding tried{&mode, ends, {}, 0};
    for (std::size_t i = 0; i < texels && tried.error < best.error; ++i) {
        const int near = projection.index(block.halves[i]);
        double least = std::numeric_limits<double>::infinity();
        for (int k = std::max(0, near - 1); k <= std::min(15, near + 1); ++k) {
            const double error =
                squared_distance(palette[static_cast<std::size_t>(k)], block.halves[i]);
            if (error >= least) continue;
            least = error;
            tried.indices[i] = k;
        }
        tried.error += least;
    }
    if (tried.error < best.error) best = tried;
}

int narrowed(double value, int precision) {
    const double step = 1 << (16 - precision);
    const int most = (1 << precision) - 1;
    return std::clamp(static_cast<int>(std::floor(value / step)), 0, most);
}

// A line through the colours, from `ends[0]` to `ends[1]`.
using Line = std::array<RealColor, 2>;

// Returns the line through the mean along the direction of the greatest variance, which iteration
// finds, over the extent of the colours.
Line principal_line(const HdrBlock& block) {
    RealColor mean{};
    for (const RealColor& value : block.values) {
        for (std::size_t c = 0; c < 3; ++c) mean[c] += value[c] / texels;
    }
    std::array<RealColor, 3> covariance{};
    for (const RealColor& value : block.values) {
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t b = 0; b < 3; ++b) {
                covariance[a][b] += (value[a] - mean[a]) * (value[b] - mean[b]);
            }
        }
    }
    RealColor axis = {1, 1, 1};
    for (int i = 0; i < 8; ++i) {
        RealColor next{};
        double largest = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t b = 0; b < 3; ++b) next[a] += covariance[a][b] * axis[b];
            largest = std::max(largest, std::abs(next[a]));
        }
        if (largest == 0) return {mean, mean};
        for (std::size_t a = 0; a < 3; ++a) axis[a] = next[a] / largest;
    }
    const double square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    double low = 0;
    double high = 0;
    for (const RealColor& value : block.values) {
        double along = 0;
        for (std::size_t c = 0; c < 3; ++c) along += (value[c] - mean[c]) * axis[c] / square;
        low = std::min(low, along);
        high = std::max(high, along);
    }
    Line line;
    for (std::size_t c = 0; c < 3; ++c) {
        line[0][c] = mean[c] + low * axis[c];
        line[1][c] = mean[c] + high * axis[c];
    }
    return line;
}

// Returns the line whose points at the indices are nearest to the texels: least squares, with the
// same two weights for all channels.
Line fitted_line(const HdrBlock& block, const std::array<int, texels>& indices, const Line& from) {
    double aa = 0;
    double ab = 0;
    double bb = 0;
    RealColor at{};
    RealColor bt{};
    for (std::size_t i = 0; i < texels; ++i) {
        const double b = weights[static_cast<std::size_t>(indices[i])] / 64.0;
        const double a = 1 - b;
        aa += a * a;
        ab += a * b;
        bb += b * b;
        for (std::size_t c = 0; c < 3; ++c) {
            at[c] += a * block.values[i][c];
            bt[c] += b * block.values[i][c];
        }
    }
    const double determinant = aa * bb - ab * ab;
    if (determinant < 1e-6) return from;  // all indices are alike; else it is at least 4/64 squared
    Line line;
    for (std::size_t c = 0; c < 3; ++c) {
        line[0][c] = (bb * at[c] - ab * bt[c]) / determinant;
        line[1][c] = (aa * bt[c] - ab * at[c]) / determinant;
    }
    return line;
}

EndPoints stored_ends(const Line& line, const Mode& mode) {
    EndPoints ends;
    for (std::size_t e = 0; e < 2; ++e) {
        for (std::size_t c = 0; c < 3; ++c) ends[e][c] = narrowed(line[e][c], mode.precision);
    }
    return ends;
}

// Tries the neighbours of the best end points until none is better.
void improve(const HdrBlock& block, Encoding& best) {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        const double before = best.error;
        for (std::size_t e = 0; e < 2; ++e) {
            for (std::size_t c = 0; c < 3; ++c) {
                for (const int step : {-1, 1}) {
                    EndPoints ends = best.ends;
                    ends[e][c] += step;
                    if (ends[e][c] < 0 || ends[e][c] >= 1 << best.mode->precision) continue;
                    try_ends(block, *best.mode, ends, best);
                }
            }
        }
        if (best.error == before || best.error == 0) return;
    }
}

Encoding search(const HdrBlock& block) {
    Encoding best;
    const Line principal = principal_line(block);
    for (const Mode& mode : modes) {
        Encoding of_mode;
        Line line = principal;
        try_ends(block, mode, stored_ends(line, mode), of_mode);
        for (int i = 0; i < 3 && of_mode.mode != nullptr; ++i) {
            line = fitted_line(block, of_mode.indices, line);
            try_ends(block, mode, stored_ends(line, mode), of_mode);
        }
        if (of_mode.error < best.error) best = of_mode;
    }
    improve(block, best);
    return best;
}

void pack(Encoding encoding, std::uint8_t* block) {
    // The first texel's index is stored without its highest bit, which is 0.
    if (encoding.indices[0] >= 8) {
        std::swap(encoding.ends[0], encoding.ends[1]);
        for (int& index : encoding.indices) index = 15 - index;
    }
    std::fill_n(block, 16, std::uint8_t{0});
    const Mode& mode = *encoding.mode;
    const auto& [first, second] = encoding.ends;
    Bits bits(block);
    bits.put(mode.word, 5);
    for (std::size_t c = 0; c < 3; ++c) bits.put(first[c], 10);
    for (std::size_t c = 0; c < 3; ++c) {
        const bool is_difference = mode.difference < mode.precision;
        bits.put(is_difference ? second[c] - first[c] : second[c], mode.difference);
        bits.put_reversed(first[c] >> 10, mode.precision - 10);
    }
    for (std::size_t i = 0; i < texels; ++i) bits.put(encoding.indices[i], i == 0 ? 3 : 4);
}

}  // namespace

void encode_bc6h(const std::array<TexelPlane, 3>& planes, std::uint8_t* out) {
    const TexelPlane& first = planes.front();
    for (std::size_t b = 0; b < first.blocks_x * first.blocks_y; ++b) {
        HdrBlock block;
        for (std::size_t i = 0; i < texels; ++i) {
            const std::size_t at =
                (b / first.blocks_x * 4 + i / 4) * first.pitch + b % first.blocks_x * 4 + i % 4;
            for (std::size_t c = 0; c < 3; ++c) {
                // -0 is stored as 0.
                const int half = half_of_float(planes[c].texels[at]) & 0x7FFF;
                block.halves[i][c] = half;
                // The middle of the values that become this half.
                block.values[i][c] = std::min(65535.0, (half + 0.5) * 64 / 31);
            }
        }
        pack(search(block), out + 16 * b);
    }
}

std::array<std::array<float, 16>, 3> decode_bc6h(const std::uint8_t* block) {
    std::array<std::array<float, 16>, 3> decoded{};
    BitsReader bits(block);
    const int word = bits.take(5);
    const auto mode = std::ranges::find(modes, word, &Mode::word);
    if (mode == modes.end()) return decoded;
    EndPoints ends;
    for (std::size_t c = 0; c < 3; ++c) ends[0][c] = bits.take(10);
    for (std::size_t c = 0; c < 3; ++c) {
        ends[1][c] = bits.take(mode->difference);
        ends[0][c] |= bits.take_reversed(mode->precision - 10) << 10;
        if (mode->difference == mode->precision) continue;
        const int sign = 1 << (mode->difference - 1);
        const int difference = (ends[1][c] ^ sign) - sign;
        ends[1][c] = (ends[0][c] + difference) & ((1 << mode->precision) - 1);
    }
    const Palette palette = palette_of(ends, mode->precision);
    for (std::size_t i = 0; i < texels; ++i) {
        const auto index = static_cast<std::size_t>(bits.take(i == 0 ? 3 : 4));
        for (std::size_t c = 0; c < 3; ++c) {
            decoded[c][i] = float_of_half(static_cast<std::uint16_t>(palette[index][c]));
        }
    }
    return decoded;
}

}  // namespace skybake
