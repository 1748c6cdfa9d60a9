#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/assets/cloud_light/radiance_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include "bakers/assets/cloud_light/radiance_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::cloud_light {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using RowFloats = hn::CappedTag<float, kRowSlack>;
using RowVector = hn::Vec<RowFloats>;
constexpr RowFloats kRowFloats;
constexpr std::size_t kRowLanes = hn::MaxLanes(kRowFloats);

}  // namespace

void send_out_here(const PairHarmonics& pair, const CoefficientRows<const float>& rows,
                   std::size_t count, float* first, float* second) {
    const auto sum_from = [&](std::size_t c, std::size_t i) {
        RowVector sum = hn::Zero(kRowFloats);
        for (; c < pair.count; c += 2) {
            sum = hn::Add(sum, hn::Mul(hn::Set(kRowFloats, pair.values[c]),
                                       hn::LoadU(kRowFloats, rows[c] + i)));
        }
        return sum;
    };
    for (std::size_t i = 0; i < count; i += kRowLanes) {
        const RowVector even = sum_from(0, i);
        const RowVector odd = sum_from(1, i);
        hn::StoreU(hn::Add(even, odd), kRowFloats, first + i);
        hn::StoreU(hn::Sub(even, odd), kRowFloats, second + i);
    }
}

// Light of pairs: of even orders, the sum of both directions, and of odd ones the difference.
using LightOfOrders = std::array<std::array<RowVector, kMostPairs>, 2>;

// Adds to the rows of coefficients c, c + 2, ..., of as many as there are sums: chains of additions that do not wait
// for each other.
template <std::size_t kSums>
void gather_coefficients(std::span<const PairLight> pairs, const LightOfOrders& light,
                         std::size_t c, std::size_t i, const CoefficientRows<float>& rows) {
    std::array<RowVector, kSums> sums;
    for (std::size_t k = 0; k < kSums; ++k) sums[k] = hn::LoadU(kRowFloats, rows[c + 2 * k] + i);
    for (std::size_t n = 0; n < pairs.size(); ++n) {
        for (std::size_t k = 0; k < kSums; ++k) {
            const RowVector weight = hn::Set(kRowFloats, pairs[n].weights.values[c + 2 * k]);
            sums[k] = hn::Add(sums[k], hn::Mul(weight, light[c % 2][n]));
        }
    }
    for (std::size_t k = 0; k < kSums; ++k) {
        hn::StoreU(sums[k], kRowFloats, rows[c + 2 * k] + i);
    }
}

void gather_here(std::span<const PairLight> pairs, std::size_t count,
                 const CoefficientRows<float>& rows) {
    constexpr std::size_t kTogether = 4;
    const std::size_t coefficients = pairs.front().weights.count;
    LightOfOrders light;
    for (std::size_t i = 0; i < count; i += kRowLanes) {
        for (std::size_t n = 0; n < pairs.size(); ++n) {
            const RowVector first = hn::LoadU(kRowFloats, pairs[n].first + i);
            const RowVector second = hn::LoadU(kRowFloats, pairs[n].second + i);
            light[0][n] = hn::Add(first, second);
            light[1][n] = hn::Sub(first, second);
        }
        for (const std::size_t parity : {0U, 1U}) {
            std::size_t c = parity;
            for (; c + 2 * kTogether <= coefficients + 1; c += 2 * kTogether) {
                gather_coefficients<kTogether>(pairs, light, c, i, rows);
            }
            for (; c < coefficients; c += 2) gather_coefficients<1>(pairs, light, c, i, rows);
        }
    }
}

void step_row_here(const RowStep& step, std::size_t count, float* after, float* mean) {
    const RowVector part = hn::Set(kRowFloats, step.part);
    for (std::size_t i = 0; i < count; i += kRowLanes) {
        RowVector light = hn::Zero(kRowFloats);
        for (std::size_t k = 0; k < step.light.size(); ++k) {
            light = hn::Add(light, hn::Mul(hn::Set(kRowFloats, step.share[k]),
                                           hn::LoadU(kRowFloats, step.light[k] + i)));
        }
        const RowVector source = hn::LoadU(kRowFloats, step.source + i);
        const RowVector excess = hn::Sub(light, source);
        const RowVector left = hn::Mul(excess, hn::LoadU(kRowFloats, step.passing + i));
        const RowVector within = hn::Mul(excess, hn::LoadU(kRowFloats, step.mean_passing + i));
        hn::StoreU(hn::Add(source, left), kRowFloats, after + i);
        const RowVector before = hn::LoadU(kRowFloats, mean + i);
        hn::StoreU(hn::Add(before, hn::Mul(part, hn::Add(source, within))), kRowFloats, mean + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::cloud_light
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::cloud_light {

HWY_EXPORT(send_out_here);
HWY_EXPORT(gather_here);
HWY_EXPORT(step_row_here);

void send_out(const PairHarmonics& pair, const CoefficientRows<const float>& rows,
              std::size_t count, float* first, float* second) {
    HWY_DYNAMIC_DISPATCH(send_out_here)(pair, rows, count, first, second);
}

void gather(std::span<const PairLight> pairs, std::size_t count,
            const CoefficientRows<float>& rows) {
    HWY_DYNAMIC_DISPATCH(gather_here)(pairs, count, rows);
}

void step_row(const RowStep& step, std::size_t count, float* after, float* mean) {
    HWY_DYNAMIC_DISPATCH(step_row_here)(step, count, after, mean);
}

}  // namespace skybake::cloud_light
#endif
