#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/field/bc4.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>

#include "bakers/field/bc4.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

// Each lane is a block. Values and end points are in steps of 1/255; end points are whole numbers.
// All operations are exact or rounded once, so that the bytes are the same on every machine.
using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;
using Integers = hn::RebindToSigned<Floats>;
constexpr Floats kFloats;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
constexpr std::size_t kTexels = 16;
constexpr float kHopeless = 3;  // times the error of eight steps

HWY_INLINE Vector set(float value) { return hn::Set(kFloats, value); }

struct Block {
    std::array<Vector, kTexels> texels;
    std::array<Vector, kTexels> shares;  // of the range, from the least value on
    Vector least;
    Vector range;
};

// End points, and the error of the block with the best indices.
struct Candidate {
    Vector low;
    Vector high;
    Vector error;
};

HWY_INLINE void keep_better(const Candidate& candidate, Candidate& best) {
    const auto is_better = hn::Lt(candidate.error, best.error);
    best.low = hn::IfThenElse(is_better, candidate.low, best.low);
    best.high = hn::IfThenElse(is_better, candidate.high, best.high);
    best.error = hn::IfThenElse(is_better, candidate.error, best.error);
}

// Whole numbers within [0, 255].
HWY_INLINE Vector as_end_point(Vector value) {
    return hn::Round(hn::Min(hn::Max(value, hn::Zero(kFloats)), set(255)));
}

// The values of a block with eight steps, or with six and the ends of the range.
template <int kSteps>
class Levels {
  public:
    static constexpr bool kHasEnds = kSteps == 5;

    // Equal end points have one level, and units of 1/255.
    HWY_INLINE Levels(Vector low, Vector high) {
        const auto has_steps = hn::Gt(high, low);
        const Vector range = hn::IfThenElse(has_steps, hn::Sub(high, low), set(kSteps));
        step_ = hn::Mul(range, set(1.0F / kSteps));
        inverse_ = hn::Div(set(kSteps), range);
        offset_ = hn::Mul(low, inverse_);
        last_ = hn::IfThenElseZero(has_steps, set(kSteps));
    }

    // Where a value lies, in steps above the lower end point.
    HWY_INLINE Vector place(Vector t) const { return hn::Sub(hn::Mul(t, inverse_), offset_); }
    HWY_INLINE Vector index(Vector place) const {
        return hn::Min(hn::Max(hn::Round(place), hn::Zero(kFloats)), last_);
    }
    // How far a value is from 0 or 1, in steps.
    HWY_INLINE Vector from_ends(Vector t) const {
        return hn::Mul(hn::Min(t, hn::Sub(set(255), t)), inverse_);
    }
    // Whether 0 or 1 is nearer to a value than level k.
    HWY_INLINE hn::Mask<Floats> is_end(Vector t, Vector place, Vector k) const {
        return hn::Lt(from_ends(t), hn::Abs(hn::Sub(place, k)));
    }
    HWY_INLINE Vector squared(Vector steps) const { return hn::Mul(steps, hn::Mul(step_, step_)); }

  private:
    Vector step_;
    Vector inverse_;
    Vector offset_;
    Vector last_;
};

template <int kSteps>
HWY_INLINE Candidate measured(const Block& block, Vector low, Vector high) {
    const Levels<kSteps> levels(low, high);
    std::array<Vector, 2> errors = {hn::Zero(kFloats), hn::Zero(kFloats)};
    for (std::size_t i = 0; i < kTexels; ++i) {
        const Vector t = block.texels[i];
        const Vector place = levels.place(t);
        Vector distance = hn::Sub(place, levels.index(place));
        if constexpr (Levels<kSteps>::kHasEnds) {
            distance = hn::Min(hn::Abs(distance), levels.from_ends(t));
        }
        errors[i % 2] = hn::Add(errors[i % 2], hn::Mul(distance, distance));
    }
    return {low, high, levels.squared(hn::Add(errors[0], errors[1]))};
}

// The sums of least squares, t = low + k s, over the texels that lie between the end points.
struct Sums {
    Vector count;
    Vector k;
    Vector kk;
    Vector t;
    Vector kt;

    HWY_INLINE Sums(Vector of_count, Vector of_t)
        : count(of_count),
          k(hn::Zero(kFloats)),
          kk(hn::Zero(kFloats)),
          t(of_t),
          kt(hn::Zero(kFloats)) {}

    HWY_INLINE void add(Vector index, Vector value) {
        k = hn::Add(k, index);
        kk = hn::Add(kk, hn::Mul(index, index));
        kt = hn::Add(kt, hn::Mul(index, value));
    }

    // Returns the line at k = 0 and k = steps, and minus the squares that it explains beyond the
    // mean. Where all indices are alike, it is the mean.
    HWY_INLINE Candidate line(float steps) const {
        const Vector some = hn::Max(count, set(1));
        const Vector mean = hn::Div(t, some);
        const Vector spread = hn::Sub(hn::Mul(some, kk), hn::Mul(k, k));
        const Vector common = hn::Sub(hn::Mul(some, kt), hn::Mul(k, t));
        const auto has_slope = hn::Gt(spread, hn::Zero(kFloats));
        const Vector slope = hn::IfThenElseZero(
            has_slope, hn::Div(common, hn::IfThenElse(has_slope, spread, set(1))));
        const Vector low = hn::Sub(mean, hn::Mul(slope, hn::Div(k, some)));
        return {low, hn::Add(low, hn::Mul(slope, set(steps))),
                hn::Neg(hn::Div(hn::Mul(slope, common), some))};
    }
};

// Fits end points to the indices of a candidate.
template <int kSteps>
HWY_INLINE Candidate fitted(const Block& block, const Candidate& at) {
    const Levels<kSteps> levels(at.low, at.high);
    Sums sums(hn::Zero(kFloats), hn::Zero(kFloats));
    for (std::size_t i = 0; i < kTexels; ++i) {
        Vector t = block.texels[i];
        const Vector place = levels.place(t);
        Vector k = levels.index(place);
        Vector one = set(1);
        if constexpr (Levels<kSteps>::kHasEnds) {
            const auto is_end = levels.is_end(t, place, k);
            k = hn::IfThenZeroElse(is_end, k);
            t = hn::IfThenZeroElse(is_end, t);
            one = hn::IfThenZeroElse(is_end, one);
        }
        sums.add(k, t);
        sums.t = hn::Add(sums.t, t);
        sums.count = hn::Add(sums.count, one);
    }
    const Candidate line = sums.line(kSteps);
    const Vector low = as_end_point(line.low);
    return measured<kSteps>(block, low, hn::Max(low, as_end_point(line.high)));
}

// Tries the end points around the best ones.
template <int kSteps>
HWY_INLINE void try_neighbours(const Block& block, Candidate& best) {
    constexpr std::array<std::array<float, 2>, 6> moves = {
        {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, -1}, {-1, 1}}};
    for (const auto& [low, high] : moves) {
        const Vector moved = as_end_point(hn::Add(best.low, set(low)));
        keep_better(measured<kSteps>(block, moved,
                                     hn::Max(moved, as_end_point(hn::Add(best.high, set(high))))),
                    best);
    }
}

// How far the end points of a start lie within the extremes of the values, in shares of the range.
// Below 0 they lie beyond: fewer levels are used, which suits values in even steps. Chosen greedily
// from 196 pairs: each lowers the error of ramps, curved ramps and noise, clipped or not, the most.
struct Start {
    float low;
    float high;
};
constexpr std::array<Start, 12> kStarts = {{{0.04F, 0.06F},
                                            {0.04F, -0.08F},
                                            {0.04F, -0.04F},
                                            {0, 0.06F},
                                            {-0.40F, 0.02F},
                                            {0.04F, 0.02F},
                                            {-0.12F, 0.02F},
                                            {-0.16F, 0.08F},
                                            {0.08F, 0},
                                            {-0.04F, 0.02F},
                                            {0, -0.04F},
                                            {0.08F, 0.06F}}};

// Fits a line to the indices of each start and returns the best of them.
HWY_INLINE Candidate best_line(const Block& block, Vector sum_of_shares) {
    Candidate best = {hn::Zero(kFloats), set(1), hn::Zero(kFloats)};
    for (const Start& start : kStarts) {
        const Vector scale = set(7 / (1 - start.low - start.high));
        const Vector offset = set(-start.low * 7 / (1 - start.low - start.high));
        Sums sums(set(kTexels), sum_of_shares);
        for (const Vector& share : block.shares) {
            const Vector place = hn::Round(hn::Add(hn::Mul(share, scale), offset));
            sums.add(hn::Min(hn::Max(place, hn::Zero(kFloats)), set(7)), share);
        }
        keep_better(sums.line(7), best);
    }
    return best;
}

HWY_INLINE Candidate search_eight(const Block& block) {
    Vector sum = hn::Zero(kFloats);
    for (const Vector& share : block.shares) sum = hn::Add(sum, share);
    Candidate best = measured<7>(block, as_end_point(block.least),
                                 as_end_point(hn::Add(block.least, block.range)));
    const Candidate line = best_line(block, sum);
    const Vector low = as_end_point(hn::Add(block.least, hn::Mul(line.low, block.range)));
    const Vector high = as_end_point(hn::Add(block.least, hn::Mul(line.high, block.range)));
    const Candidate rounded = measured<7>(block, low, hn::Max(low, high));
    keep_better(rounded, best);
    keep_better(fitted<7>(block, rounded), best);
    try_neighbours<7>(block, best);
    return best;
}

// End points from the extremes of the values that are neither 0 nor 1, as they are rounded, and not
// below a part of the largest one.
HWY_INLINE Candidate inner_extremes(const Block& block, float part) {
    const Vector largest = hn::Add(block.least, block.range);
    const Vector bound = hn::Max(set(0.5F), hn::Mul(largest, set(part)));
    Vector low = set(255);
    Vector high = hn::Zero(kFloats);
    for (const Vector& t : block.texels) {
        low = hn::Min(low, hn::IfThenElse(hn::Ge(t, bound), t, set(255)));
        high = hn::Max(high, hn::IfThenElseZero(hn::Le(t, set(254.5F)), t));
    }
    low = as_end_point(hn::Min(low, high));
    return measured<5>(block, low, hn::Max(low, as_end_point(high)));
}

HWY_INLINE Candidate search_six(const Block& block) {
    Candidate best = inner_extremes(block, 0);
    for (const float part : {0.0F, 0.15F, 0.4F}) {
        Candidate next = part == 0 ? best : inner_extremes(block, part);
        keep_better(next, best);
        for (int i = 0; i < 2; ++i) {
            next = fitted<5>(block, next);
            keep_better(next, best);
        }
    }
    try_neighbours<5>(block, best);
    return best;
}

// Writes end points and indices. `is_six`: the lanes of blocks with six steps.
HWY_INLINE void pack(const Block& block, const Candidate& eight, const Candidate& six,
                     hn::Mask<Floats> is_six, std::size_t blocks, std::uint8_t* out,
                     std::size_t stride) {
    constexpr Integers kIntegers;
    const Levels<7> levels_8(eight.low, eight.high);
    const Levels<5> levels_6(six.low, six.high);
    std::array<hn::Vec<Integers>, 2> words = {hn::Zero(kIntegers), hn::Zero(kIntegers)};
    for (std::size_t i = kTexels; i-- > 0;) {
        const Vector t = block.texels[i];
        // Steps 0 ... 7 from the lower end point have the indices 1, 7, 6, ..., 2, 0.
        const Vector k8 = levels_8.index(levels_8.place(t));
        Vector index = hn::Sub(set(8), k8);
        index = hn::IfThenElse(hn::Eq(k8, hn::Zero(kFloats)), set(1), index);
        index = hn::IfThenElseZero(hn::Lt(k8, set(7)), index);
        // Steps 0 ... 5 have 0, 2, ..., 5, 1; the ends of the range have 6 and 7.
        const Vector place = levels_6.place(t);
        const Vector k6 = levels_6.index(place);
        Vector other = hn::IfThenElse(hn::Ge(k6, set(5)), set(1), hn::Add(k6, set(1)));
        other = hn::IfThenElseZero(hn::Gt(k6, hn::Zero(kFloats)), other);
        const Vector end = hn::IfThenElse(hn::Lt(t, set(127.5F)), set(6), set(7));
        other = hn::IfThenElse(levels_6.is_end(t, place, k6), end, other);
        index = hn::IfThenElse(is_six, other, index);
        hn::Vec<Integers>& word = words[i / 8];
        word = hn::Add(hn::ShiftLeft<3>(word), hn::ConvertTo(kIntegers, index));
    }
    HWY_ALIGN std::array<std::int32_t, kLanes> first;
    HWY_ALIGN std::array<std::int32_t, kLanes> second;
    HWY_ALIGN std::array<std::array<std::int32_t, kLanes>, 2> indices;
    const auto store = [&](Vector value, std::array<std::int32_t, kLanes>& to) {
        hn::Store(hn::ConvertTo(kIntegers, value), kIntegers, to.data());
    };
    store(hn::IfThenElse(is_six, six.low, eight.high), first);
    store(hn::IfThenElse(is_six, six.high, eight.low), second);
    for (std::size_t w = 0; w < 2; ++w) hn::Store(words[w], kIntegers, indices[w].data());
    for (std::size_t b = 0; b < blocks; ++b, out += stride) {
        out[0] = static_cast<std::uint8_t>(first[b]);
        out[1] = static_cast<std::uint8_t>(second[b]);
        for (std::size_t byte = 0; byte < 6; ++byte) {
            out[2 + byte] =
                static_cast<std::uint8_t>(indices[byte / 3][b] >> 8 * (byte % 3) & 0xFF);
        }
    }
}

HWY_INLINE void prepare(Block& block) {
    block.least = set(255);
    Vector largest = hn::Zero(kFloats);
    for (const Vector& t : block.texels) {
        block.least = hn::Min(block.least, t);
        largest = hn::Max(largest, t);
    }
    block.range = hn::Sub(largest, block.least);
    const auto has_range = hn::Gt(block.range, hn::Zero(kFloats));
    const Vector inverse = hn::Div(set(1), hn::IfThenElse(has_range, block.range, set(1)));
    for (std::size_t i = 0; i < kTexels; ++i) {
        block.shares[i] = hn::Mul(hn::Sub(block.texels[i], block.least), inverse);
    }
}

// Collects blocks that six steps may suit better, until there is one for each lane.
class Pending {
  public:
    HWY_INLINE Pending(std::uint8_t* out, std::size_t stride) : out_(out), stride_(stride) {}

    // Takes the lanes of `mask`, whose best blocks with eight steps are `eight`.
    HWY_INLINE void add(const Block& block, const Candidate& eight, hn::Mask<Floats> mask,
                        std::size_t first, std::size_t blocks) {
        HWY_ALIGN std::array<float, kLanes> wanted;
        HWY_ALIGN std::array<float, kLanes> error;
        HWY_ALIGN std::array<std::array<float, kLanes>, kTexels> texels;
        hn::Store(hn::IfThenElseZero(mask, set(1)), kFloats, wanted.data());
        hn::Store(eight.error, kFloats, error.data());
        for (std::size_t i = 0; i < kTexels; ++i) {
            hn::Store(block.texels[i], kFloats, texels[i].data());
        }
        for (std::size_t lane = 0; lane < blocks; ++lane) {
            if (wanted[lane] == 0) continue;
            for (std::size_t i = 0; i < kTexels; ++i) texels_[i][count_] = texels[i][lane];
            errors_[count_] = error[lane];
            places_[count_] = first + lane;
            if (++count_ == kLanes) flush();
        }
    }

    // Writes the blocks for which six steps are better.
    HWY_INLINE void flush() {
        if (count_ == 0) return;
        for (std::size_t lane = count_; lane < kLanes; ++lane) {
            for (std::size_t i = 0; i < kTexels; ++i) texels_[i][lane] = 0;
            errors_[lane] = 0;
        }
        Block block;
        for (std::size_t i = 0; i < kTexels; ++i) {
            block.texels[i] = hn::Load(kFloats, texels_[i].data());
        }
        prepare(block);
        const Candidate six = search_six(block);
        HWY_ALIGN std::array<float, kLanes> error;
        hn::Store(six.error, kFloats, error.data());
        HWY_ALIGN std::array<std::uint8_t, kLanes * bc4_bytes> packed;
        pack(block, six, six, hn::Eq(set(0), set(0)), count_, packed.data(), bc4_bytes);
        for (std::size_t lane = 0; lane < count_; ++lane) {
            if (!(error[lane] < errors_[lane])) continue;
            std::copy_n(&packed[lane * bc4_bytes], bc4_bytes, out_ + places_[lane] * stride_);
        }
        count_ = 0;
    }

  private:
    std::uint8_t* out_;
    std::size_t stride_;
    HWY_ALIGN std::array<std::array<float, kLanes>, kTexels> texels_;
    std::array<float, kLanes> errors_;
    std::array<std::size_t, kLanes> places_;
    std::size_t count_ = 0;
};

HWY_INLINE void encode_lanes(const Block& block, std::size_t first, std::size_t blocks,
                             std::uint8_t* out, std::size_t stride, Pending& pending) {
    const Vector largest = hn::Add(block.least, block.range);
    if (hn::AllTrue(kFloats, hn::Eq(largest, hn::Zero(kFloats)))) {
        for (std::size_t b = 0; b < blocks; ++b) {
            std::fill_n(out + (first + b) * stride, bc4_bytes, std::uint8_t{0});
        }
        return;
    }
    const Candidate eight = search_eight(block);
    // Blocks with equal end points are those of six steps.
    pack(block, eight, eight, hn::Le(eight.high, eight.low), blocks, out + first * stride, stride);
    // Six steps are better only if some value is nearer to an end of the range than to the steps,
    // which costs at least the square of how far the extremes are from it. And they are hardly
    // better where the first try is much worse.
    const Vector apart = hn::Min(block.least, hn::Sub(set(255), largest));
    auto may_be_six = hn::Lt(hn::Mul(apart, apart), eight.error);
    if (hn::AllFalse(kFloats, may_be_six)) return;
    const Candidate tried = inner_extremes(block, 0);
    may_be_six = hn::And(may_be_six, hn::Lt(tried.error, hn::Mul(eight.error, set(kHopeless))));
    if (!hn::AllFalse(kFloats, may_be_six)) pending.add(block, eight, may_be_six, first, blocks);
}

}  // namespace

void encode_bc4(const TexelPlane& plane, std::uint8_t* out, std::size_t stride) {
    Pending pending(out, stride);
    for (std::size_t y = 0; y < plane.blocks_y; ++y) {
        for (std::size_t x = 0; x < plane.blocks_x; x += kLanes) {
            Block block;
            for (std::size_t j = 0; j < 4; ++j) {
                Vector* const t = &block.texels[4 * j];
                hn::LoadInterleaved4(kFloats, plane.texels + (4 * y + j) * plane.pitch + 4 * x,
                                     t[0], t[1], t[2], t[3]);
            }
            // Lanes beyond the row hold other texels, of the next row or of the padding.
            for (Vector& t : block.texels) t = hn::Mul(t, set(255));
            prepare(block);
            encode_lanes(block, y * plane.blocks_x + x, std::min(kLanes, plane.blocks_x - x), out,
                         stride, pending);
        }
    }
    pending.flush();
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(encode_bc4);

void encode_bc4(const TexelPlane& plane, std::uint8_t* out, std::size_t stride) {
    HWY_DYNAMIC_DISPATCH(encode_bc4)(plane, out, stride);
}

std::array<float, 16> decode_bc4(const std::uint8_t* block) {
    const int first = block[0];
    const int second = block[1];
    std::array<float, 8> values;
    values[0] = static_cast<float>(first) / 255;
    values[1] = static_cast<float>(second) / 255;
    const int steps = first > second ? 7 : 5;
    for (int i = 1; i < steps; ++i) {
        values[static_cast<std::size_t>(i + 1)] =
            static_cast<float>((steps - i) * first + i * second) / static_cast<float>(255 * steps);
    }
    if (steps == 5) {
        values[6] = 0;
        values[7] = 1;
    }
    std::uint64_t indices = 0;
    for (std::size_t i = 0; i < 6; ++i) indices |= std::uint64_t{block[2 + i]} << 8 * i;
    std::array<float, 16> texels;
    for (std::size_t i = 0; i < 16; ++i) texels[i] = values[indices >> 3 * i & 7];
    return texels;
}

}  // namespace skybake
#endif  // HWY_ONCE
