#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/combine_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include "bakers/noise/combine_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using Floats = hn::ScalableTag<float>;
constexpr Floats kFloats;
static_assert(hn::MaxLanes(kFloats) <= static_cast<std::size_t>(kLanePadding));
using FloatVector = hn::Vec<Floats>;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);

HWY_INLINE FloatVector constant(float value) { return hn::Set(kFloats, value); }

// Adds kFields weighted rows to `out`, or sets it.
template <std::size_t kFields>
void add_fields(const WeightedField* uses, const std::vector<const float*>& fields, bool set,
                std::size_t count, float* HWY_RESTRICT out) {
    const float* rows[kFields];
    FloatVector weights[kFields];
    for (std::size_t k = 0; k < kFields; ++k) {
        rows[k] = fields[static_cast<std::size_t>(uses[k].field)];
        weights[k] = constant(uses[k].weight);
    }
    for (std::size_t i = 0; i < count; i += kLanes) {
        FloatVector sum = set ? hn::Zero(kFloats) : hn::LoadU(kFloats, out + i);
        HWY_UNROLL(4)
        for (std::size_t k = 0; k < kFields; ++k) {
            sum = hn::Add(sum, hn::Mul(hn::LoadU(kFloats, rows[k] + i), weights[k]));
        }
        hn::StoreU(sum, kFloats, out + i);
    }
}

// The weighted sum of a channel's cell fields, up to three in one pass.
void sum_cells(const ChannelPlan& channel, const std::vector<const float*>& fields,
               std::size_t count, float* HWY_RESTRICT out) {
    const std::size_t uses = channel.cells.size();
    for (std::size_t k = 0; k < uses; k += 3) {
        const auto add = uses - k == 1   ? add_fields<1>
                         : uses - k == 2 ? add_fields<2>
                                         : add_fields<3>;
        add(channel.cells.data() + k, fields, k == 0, count, out);
    }
}

// Compares, since instruction sets differ in which of two zeros their minimum is.
HWY_INLINE FloatVector between(FloatVector value, FloatVector low, FloatVector high) {
    value = hn::IfThenElse(hn::Lt(value, low), low, value);
    return hn::IfThenElse(hn::Gt(value, high), high, value);
}

HWY_INLINE FloatVector shaped(const ChannelPlan& channel, FloatVector value) {
    if (channel.remapped) {
        value = hn::Add(
            hn::Mul(hn::Sub(value, constant(channel.remap_low_in)), constant(channel.remap_scale)),
            constant(channel.remap_low_out));
    }
    const FloatVector one = constant(1);
    if (channel.stepped) {
        const FloatVector x = between(
            hn::Mul(hn::Sub(value, constant(channel.step_from)), constant(channel.step_scale)),
            hn::Zero(kFloats), one);
        value = hn::Mul(hn::Mul(x, x), hn::Sub(constant(3), hn::Mul(constant(2), x)));
    }
    if (channel.invert) value = hn::Sub(one, value);
    if (channel.biased) {
        const FloatVector biased = hn::Div(
            value, hn::Add(hn::Mul(hn::Sub(one, value), constant(channel.bias_slope)), one));
        const auto inside = hn::And(hn::Ge(value, hn::Zero(kFloats)), hn::Le(value, one));
        value = hn::IfThenElse(inside, biased, value);
    }
    if (channel.clamped) {
        value = between(value, constant(channel.clamp_low), constant(channel.clamp_high));
    }
    return value;
}

}  // namespace

void combine(const ChannelPlan& channel, const float* gradient,
             const std::vector<const float*>& fields, std::size_t count, float* out) {
    const bool rectified = gradient != nullptr && channel.type != NoiseType::curl &&
                           channel.fractal == NoiseFractal::rectified;
    sum_cells(channel, fields, count, out);
    if (channel.type == NoiseType::perlin_worley) {
        const FloatVector one = constant(1);
        for (std::size_t i = 0; i < count; i += kLanes) {
            FloatVector value = hn::LoadU(kFloats, gradient + i);
            if (rectified) value = hn::Max(hn::Zero(kFloats), value);
            const FloatVector cells = hn::LoadU(kFloats, out + i);
            hn::StoreU(hn::Add(cells, hn::Mul(value, hn::Sub(one, cells))), kFloats, out + i);
        }
    } else if (channel.cells.empty()) {
        for (std::size_t i = 0; i < count; i += kLanes) {
            FloatVector value =
                gradient != nullptr ? hn::LoadU(kFloats, gradient + i) : constant(channel.value);
            if (rectified) value = hn::Max(hn::Zero(kFloats), value);
            hn::StoreU(value, kFloats, out + i);
        }
    }
    if (!channel.is_shaped()) return;
    for (std::size_t i = 0; i < count; i += kLanes) {
        hn::StoreU(shaped(channel, hn::LoadU(kFloats, out + i)), kFloats, out + i);
    }
}

void pack(NoisePacking packing, const std::array<const float*, 4>& channels, std::size_t count,
          float* out) {
    const bool shape = packing == NoisePacking::shape;
    const FloatVector one = constant(1);
    for (std::size_t i = 0; i < count; i += kLanes) {
        const auto weighted = [&](std::size_t first) HWY_ATTR {
            const auto channel = [&](std::size_t offset, float weight) HWY_ATTR {
                return hn::Mul(hn::LoadU(kFloats, channels[first + offset] + i), constant(weight));
            };
            return hn::Add(hn::Add(channel(0, 0.625f), channel(1, 0.25f)), channel(2, 0.125f));
        };
        FloatVector value = weighted(shape ? 1 : 0);
        if (shape) {
            const FloatVector gap = hn::Sub(one, value);
            value = hn::Div(hn::Add(hn::LoadU(kFloats, channels[0] + i), gap), hn::Add(gap, one));
        }
        hn::StoreU(value, kFloats, out + i);
    }
}

void add_shaped(OctaveShape shape, const float* octave, float weight_, bool set, std::size_t count,
                float* sums) {
    const FloatVector weight = constant(weight_);
    for (std::size_t i = 0; i < count; i += kLanes) {
        FloatVector value = hn::LoadU(kFloats, octave + i);
        if (shape != OctaveShape::plain) value = hn::Abs(value);
        if (shape == OctaveShape::one_minus_absolute) value = hn::Sub(constant(1), value);
        if (shape != OctaveShape::plain) value = hn::Mul(value, weight);
        const FloatVector before = set ? hn::Zero(kFloats) : hn::LoadU(kFloats, sums + i);
        hn::StoreU(hn::Add(before, value), kFloats, sums + i);
    }
}

void shift(float scale, float offset, std::size_t count, float* sums) {
    for (std::size_t i = 0; i < count; i += kLanes) {
        const FloatVector sum = hn::LoadU(kFloats, sums + i);
        hn::StoreU(hn::Add(hn::Mul(sum, constant(scale)), constant(offset)), kFloats, sums + i);
    }
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {

HWY_EXPORT(combine);
HWY_EXPORT(pack);
HWY_EXPORT(add_shaped);
HWY_EXPORT(shift);

void combine_channel(const ChannelPlan& channel, const float* gradient,
                     const std::vector<const float*>& fields, std::size_t count, float* out) {
    HWY_DYNAMIC_DISPATCH(combine)(channel, gradient, fields, count, out);
}

void pack_channels(NoisePacking packing, const std::array<const float*, 4>& channels,
                   std::size_t count, float* out) {
    HWY_DYNAMIC_DISPATCH(pack)(packing, channels, count, out);
}

void add_octave(OctaveShape shape, const float* octave, float weight, bool set, std::size_t count,
                float* sums) {
    HWY_DYNAMIC_DISPATCH(add_shaped)(shape, octave, weight, set, count, sums);
}

void scale_and_shift(float scale, float offset, std::size_t count, float* sums) {
    HWY_DYNAMIC_DISPATCH(shift)(scale, offset, count, sums);
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
