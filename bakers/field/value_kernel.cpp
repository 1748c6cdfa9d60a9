#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/field/value_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "bakers/field/value_kernel.h"
#include "bakers/math/half_conversion.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using Floats = hn::ScalableTag<float>;
using Integers = hn::RebindToSigned<Floats>;
using Words = hn::RebindToUnsigned<Floats>;
using Halves = hn::Rebind<std::uint16_t, Floats>;
constexpr Floats kFloats;
constexpr Integers kIntegers;
constexpr Words kWords;
constexpr Halves kHalves;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);

// At most as many doubles as a LaneSummary has lanes.
using Doubles = hn::CappedTag<double, LaneSummary::kLanes>;
constexpr Doubles kDoubles;
constexpr std::size_t kDoubleLanes = hn::MaxLanes(kDoubles);
using DoubleVector = hn::Vec<Doubles>;

using AllDoubles = hn::ScalableTag<double>;
constexpr AllDoubles kAllDoubles;

// Doubles of kDoubleLanes floats.
HWY_INLINE DoubleVector load_doubles(const float* from) {
    const hn::Rebind<float, Doubles> floats;
    return hn::PromoteTo(kDoubles, hn::LoadU(floats, from));
}

// half_of_float for a vector.
HWY_INLINE auto as_halves(hn::Vec<Floats> value) {
    const auto constant = [](std::int32_t i) HWY_ATTR { return hn::Set(kIntegers, i); };
    const auto bits = hn::BitCast(kIntegers, value);
    const auto magnitude = hn::And(bits, constant(0x7fffffff));
    const auto sign = hn::And(hn::ShiftRight<16>(bits), constant(0x8000));
    const auto rebiased = hn::Sub(magnitude, constant(112 << 23));
    const auto odd = hn::And(hn::ShiftRight<13>(rebiased), constant(1));
    const auto normal = hn::ShiftRight<13>(hn::Add(hn::Add(rebiased, constant(0xfff)), odd));
    const auto rounded = hn::Add(hn::BitCast(kFloats, magnitude), hn::Set(kFloats, 0.5f));
    const auto denormal = hn::Sub(hn::BitCast(kIntegers, rounded), constant(0x3f000000));
    const auto finite = hn::IfThenElse(hn::Lt(magnitude, constant(0x38800000)), denormal, normal);
    const auto bounded =
        hn::IfThenElse(hn::Gt(magnitude, constant(0x477fffff)), constant(0x7c00), finite);
    const auto result =
        hn::IfThenElse(hn::Gt(magnitude, constant(0x7f800000)), constant(0x7e00), bounded);
    return hn::DemoteTo(kHalves, hn::Or(result, sign));
}

// float_of_half for a vector.
HWY_INLINE hn::Vec<Floats> as_floats(hn::Vec<Halves> halves) {
    const auto constant = [](std::uint32_t i) HWY_ATTR { return hn::Set(kWords, i); };
    const auto bits = hn::PromoteTo(kWords, halves);
    const auto magnitude = hn::And(bits, constant(0x7fff));
    const auto sign = hn::ShiftLeft<16>(hn::And(bits, constant(0x8000)));
    const auto is_finite = hn::Lt(magnitude, constant(0x7c00));
    const auto bias = hn::IfThenElse(is_finite, constant(112U << 23), constant(224U << 23));
    const auto normal = hn::Add(hn::ShiftLeft<13>(magnitude), bias);
    const auto units = hn::ConvertTo(kFloats, hn::BitCast(kIntegers, magnitude));
    const auto denormal = hn::BitCast(kWords, hn::Mul(units, hn::Set(kFloats, 0x1p-24f)));
    const auto is_denormal = hn::Lt(magnitude, constant(0x400));
    return hn::BitCast(kFloats, hn::Or(hn::IfThenElse(is_denormal, denormal, normal), sign));
}

}  // namespace

bool AreZeros(const float* values, std::size_t count) {
    const auto load = [&](std::size_t i)
                          HWY_ATTR { return hn::BitCast(kWords, hn::LoadU(kFloats, values + i)); };
    auto any = hn::Zero(kWords);
    auto other = any;
    std::size_t i = 0;
    for (; i + 2 * kLanes <= count; i += 2 * kLanes) {
        any = hn::Or(any, load(i));
        other = hn::Or(other, load(i + kLanes));
    }
    std::uint32_t rest = 0;
    for (; i < count; ++i) rest |= std::bit_cast<std::uint32_t>(values[i]);
    const auto all = hn::Or(any, other);
    return rest == 0 && hn::AllTrue(kWords, hn::Eq(all, hn::Zero(kWords)));
}

bool AreWithin(const float* values, std::size_t count, float low, float high) {
    const auto least = hn::Set(kFloats, low);
    const auto most = hn::Set(kFloats, high);
    auto inside = hn::Eq(least, least);
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        const auto value = hn::LoadU(kFloats, values + i);
        inside = hn::And(inside, hn::And(hn::Ge(value, least), hn::Le(value, most)));
    }
    bool rest = true;
    for (; i < count; ++i) rest = rest && values[i] >= low && values[i] <= high;
    return rest && hn::AllTrue(kFloats, inside);
}

long CountBelow(const float* values, std::size_t count, float bound) {
    const auto limit = hn::Set(kFloats, bound);
    std::size_t below = 0;
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        const auto value = hn::LoadU(kFloats, values + i);
        const auto is_below = hn::Lt(hn::Abs(value), limit);
        below += hn::CountTrue(kFloats, hn::And(is_below, hn::Ne(value, hn::Zero(kFloats))));
    }
    for (; i < count; ++i) below += values[i] != 0 && std::fabs(values[i]) < bound ? 1 : 0;
    return static_cast<long>(below);
}

void AddValues(const float* values, std::size_t count, LaneSummary& summary) {
    constexpr std::size_t kVectors = LaneSummary::kLanes / kDoubleLanes;
    DoubleVector least[kVectors], most[kVectors], sums[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) {
        least[v] = hn::LoadU(kDoubles, summary.least.data() + v * kDoubleLanes);
        most[v] = hn::LoadU(kDoubles, summary.most.data() + v * kDoubleLanes);
        sums[v] = hn::LoadU(kDoubles, summary.sums.data() + v * kDoubleLanes);
    }
    std::size_t i = 0;
    for (; i + LaneSummary::kLanes <= count; i += LaneSummary::kLanes) {
        for (std::size_t v = 0; v < kVectors; ++v) {
            const DoubleVector value = load_doubles(values + i + v * kDoubleLanes);
            least[v] = hn::Min(least[v], value);
            most[v] = hn::Max(most[v], value);
            sums[v] = hn::Add(sums[v], value);
        }
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
        hn::StoreU(least[v], kDoubles, summary.least.data() + v * kDoubleLanes);
        hn::StoreU(most[v], kDoubles, summary.most.data() + v * kDoubleLanes);
        hn::StoreU(sums[v], kDoubles, summary.sums.data() + v * kDoubleLanes);
    }
    for (std::size_t lane = 0; i < count; ++i, ++lane) {
        const double value = values[i];
        summary.least[lane] = std::min(summary.least[lane], value);
        summary.most[lane] = std::max(summary.most[lane], value);
        summary.sums[lane] += value;
    }
}

void FindBins(const float* values, std::size_t count, const std::array<double, 2>& range,
              double scale, int bins, std::int32_t* out) {
    const hn::Rebind<std::int32_t, Doubles> bin_tag;
    const auto low = hn::Set(kDoubles, range[0]);
    const auto high = hn::Set(kDoubles, range[1]);
    const auto last = hn::Set(kDoubles, bins - 1);
    std::size_t i = 0;
    for (; i + kDoubleLanes <= count; i += kDoubleLanes) {
        const DoubleVector value = load_doubles(values + i);
        const auto is_inside = hn::And(hn::Ge(value, low), hn::Le(value, high));
        const auto place = hn::Min(hn::Mul(hn::Sub(value, low), hn::Set(kDoubles, scale)), last);
        const auto bin = hn::IfThenElse(is_inside, place, hn::Set(kDoubles, bins));
        hn::StoreU(hn::DemoteTo(bin_tag, bin), bin_tag, out + i);
    }
    for (; i < count; ++i) {
        const double value = values[i];
        const bool is_inside = value >= range[0] && value <= range[1];
        out[i] =
            is_inside ? std::min(static_cast<int>((value - range[0]) * scale), bins - 1) : bins;
    }
}

void HalvesOfFloats(const float* values, std::size_t count, std::uint16_t* out) {
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        hn::StoreU(as_halves(hn::LoadU(kFloats, values + i)), kHalves, out + i);
    }
    for (; i < count; ++i) out[i] = half_of_float(values[i]);
}

void FloatsOfHalves(const std::uint16_t* halves, std::size_t count, float* out) {
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        hn::StoreU(as_floats(hn::LoadU(kHalves, halves + i)), kFloats, out + i);
    }
    for (; i < count; ++i) out[i] = float_of_half(halves[i]);
}

void BytesOfFloats(const float* values, std::size_t count, std::uint8_t* out) {
    const hn::Rebind<std::int32_t, AllDoubles> wide;
    const hn::Rebind<std::uint8_t, AllDoubles> bytes;
    const hn::Rebind<float, AllDoubles> floats;
    const auto steps = hn::Set(kAllDoubles, 255);
    const auto half = hn::Set(kAllDoubles, 0.5);
    constexpr std::size_t kStep = hn::MaxLanes(kAllDoubles);
    std::size_t i = 0;
    for (; i + kStep <= count; i += kStep) {
        const auto value = hn::PromoteTo(kAllDoubles, hn::LoadU(floats, values + i));
        const auto sum = hn::Add(hn::Mul(value, steps), half);
        hn::StoreU(hn::DemoteTo(bytes, hn::DemoteTo(wide, sum)), bytes, out + i);
    }
    for (; i < count; ++i) {
        out[i] =
            static_cast<std::uint8_t>(static_cast<std::int32_t>(double{values[i]} * 255 + 0.5));
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(AreZeros);
HWY_EXPORT(AreWithin);
HWY_EXPORT(CountBelow);
HWY_EXPORT(AddValues);
HWY_EXPORT(FindBins);
HWY_EXPORT(HalvesOfFloats);
HWY_EXPORT(FloatsOfHalves);
HWY_EXPORT(BytesOfFloats);

bool are_zeros(const float* values, std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(AreZeros)(values, count);
}

bool are_within(const float* values, std::size_t count, float low, float high) {
    return HWY_DYNAMIC_DISPATCH(AreWithin)(values, count, low, high);
}

long count_below(const float* values, std::size_t count, float bound) {
    return HWY_DYNAMIC_DISPATCH(CountBelow)(values, count, bound);
}

void add_values(const float* values, std::size_t count, LaneSummary& summary) {
    HWY_DYNAMIC_DISPATCH(AddValues)(values, count, summary);
}

void find_bins(const float* values, std::size_t count, const std::array<double, 2>& range,
               double scale, int bins, std::int32_t* out) {
    HWY_DYNAMIC_DISPATCH(FindBins)(values, count, range, scale, bins, out);
}

void halves_of_floats(const float* values, std::size_t count, std::uint16_t* out) {
    HWY_DYNAMIC_DISPATCH(HalvesOfFloats)(values, count, out);
}

void floats_of_halves(const std::uint16_t* halves, std::size_t count, float* out) {
    HWY_DYNAMIC_DISPATCH(FloatsOfHalves)(halves, count, out);
}

void bytes_of_floats(const float* values, std::size_t count, std::uint8_t* out) {
    HWY_DYNAMIC_DISPATCH(BytesOfFloats)(values, count, out);
}

}  // namespace skybake
#endif  // HWY_ONCE
