#include "bakers/light/wide_row.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// The number of intervals between points, first and after it was doubled.
constexpr int kFewIntervals = 16;
constexpr int kManyIntervals = 32;
constexpr double kSmallShare = 1e-3;

double wide_point(int k, int intervals) { return cosine_of_pi(static_cast<double>(k) / intervals); }

// The weights of the values at Chebyshev's points, every `stride`-th of those of so many intervals, in
// the polynomial through them at t in [-1, 1].
std::array<double, kManyIntervals + 1> shares_at(double t, int intervals, int stride) {
    static const auto points = [] {
        std::array<double, kManyIntervals + 1> all{};
        for (int k = 0; k <= kManyIntervals; ++k) {
            all[static_cast<std::size_t>(k)] = wide_point(k, kManyIntervals);
        }
        return all;
    }();
    const int finest = stride * (kManyIntervals / intervals);
    std::array<double, kManyIntervals + 1> shares{};
    double sum = 0;
    for (int k = 0; k <= intervals / stride; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double gap = t - points[i * static_cast<std::size_t>(finest)];
        if (gap == 0) {
            shares = {};
            shares[i] = 1;
            return shares;
        }
        const double half = k == 0 || k == intervals / stride ? 0.5 : 1.0;
        shares[i] = (k % 2 == 0 ? half : -half) / gap;
        sum += shares[i];
    }
    for (double& share : shares) share /= sum;
    return shares;
}

// The parts of a row's sunlight at some azimuths: first of the layers, then of the ground.
class RowParts {
  public:
    RowParts(std::vector<SplitSunlight> light, const SkyMedium& medium) {
        for (std::size_t k = 0; k < medium.layers.size(); ++k) {
            if (medium.layers[k].scatters) layers_.push_back(k);
        }
        for (const SplitSunlight& at : light) {
            for (const std::size_t k : layers_) values_.push_back(at.single[k]);
            values_.push_back(at.ground);
        }
    }

    std::size_t count() const { return layers_.size() + 1; }
    std::size_t places() const { return values_.size() / count(); }
    const std::vector<std::size_t>& layers() const { return layers_; }
    const Spectrum* at(std::size_t place) const { return values_.data() + place * count(); }

  private:
    std::vector<std::size_t> layers_;  // the layers that scatter
    std::vector<Spectrum> values_;
};

// The polynomial through every `stride`-th place. `sums` has room for the parts.
void interpolate(const RowParts& parts, double t, int stride, Spectrum* sums) {
    const auto intervals = static_cast<int>(parts.places()) - 1;
    const auto shares = shares_at(t, intervals, stride);
    std::fill_n(sums, parts.count(), Spectrum{});
    for (int k = 0; k <= intervals / stride; ++k) {
        const Spectrum* values = parts.at(static_cast<std::size_t>(k * stride));
        const double share = shares[static_cast<std::size_t>(k)];
        for (std::size_t part = 0; part < parts.count(); ++part) {
            sums[part] += share * values[part];
        }
    }
}

// Returns a magnitude for each part at each place, to which errors are relative: of a layer its own,
// of the ground that of all light.
std::vector<Spectrum> scales_of(const RowParts& parts) {
    constexpr double kEvenly = 1 / (4 * std::numbers::pi);  // of a phase function
    std::vector<Spectrum> scales;
    std::vector<Spectrum> most(parts.count());
    for (std::size_t place = 0; place < parts.places(); ++place) {
        const Spectrum* values = parts.at(place);
        Spectrum all = absolute(values[parts.count() - 1]);
        for (std::size_t k = 0; k < parts.layers().size(); ++k)
            all += kEvenly * absolute(values[k]);
        for (std::size_t part = 0; part < parts.count(); ++part) {
            scales.push_back(part < parts.layers().size() ? absolute(values[part]) : all);
            most[part] = maximum(most[part], scales.back());
        }
    }
    for (std::size_t i = 0; i < scales.size(); ++i) {
        scales[i] = maximum(scales[i], kSmallShare * most[i % parts.count()]);
    }
    return scales;
}

// Whether the polynomial through every other point meets the others.
bool is_smooth(const RowParts& parts) {
    const auto intervals = static_cast<int>(parts.places()) - 1;
    const std::vector<Spectrum> scales = scales_of(parts);
    std::vector<Spectrum> found(parts.count());
    for (int k = 1; k < intervals; k += 2) {
        interpolate(parts, wide_point(k, intervals), 2, found.data());
        const auto place = static_cast<std::size_t>(k);
        for (std::size_t part = 0; part < parts.count(); ++part) {
            const Spectrum error = absolute(found[part] - parts.at(place)[part]);
            const Spectrum most = kWideRowError * scales[place * parts.count() + part];
            if (maximum(error, most) != most) return false;
        }
    }
    return true;
}

class WideRow {
  public:
    WideRow(const SkyRow& row, const SkyMedium& medium, const RowOfView& view,
            const std::vector<double>& azimuths)
        : row_(row), medium_(medium), view_(view), azimuths_(azimuths), order_(azimuths.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::ranges::stable_sort(
            order_, [&](std::size_t a, std::size_t b) { return azimuths[a] < azimuths[b]; });
        for (std::size_t place = 0; place < order_.size(); ++place) {
            const double azimuth = azimuths[order_[place]];
            if (place > 0 && azimuth == azimuths[order_[place - 1]]) continue;
            firsts_.push_back(place);
            cosines_.push_back(cosine_of_pi(azimuth));
        }
        firsts_.push_back(order_.size());
        light_.resize(cosines_.size());
    }

    std::vector<SkyRadiance> radiance() {
        fill({0, cosines_.size(), 0, 1});
        const std::vector<Spectrum> higher =
            row_.multiple([&](double cosine) { return view_.ray(cosine); }, cosines_);
        for (std::size_t k = 0; k < light_.size(); ++k) light_[k].multiple = higher[k];
        std::vector<SkyRadiance> result(azimuths_.size());
        for (std::size_t k = 0; k < light_.size(); ++k) {
            for (std::size_t i = firsts_[k]; i < firsts_[k + 1]; ++i) result[order_[i]] = light_[k];
        }
        return result;
    }

  private:
    // Some of the azimuths, and the range in half turns in which they lie.
    struct Range {
        std::size_t first;
        std::size_t end;
        double from;
        double to;
    };

    // A polynomial is tried where there are four times as many azimuths as intervals.
    void fill(const Range& range) {
        const std::size_t count = range.end - range.first;
        if (count < 4 * kFewIntervals) return compute_each(range);
        for (const int intervals : {kFewIntervals, kManyIntervals}) {
            if (count < 4 * static_cast<std::size_t>(intervals)) break;
            const RowParts parts = parts_at(points_of(range, intervals));
            if (is_smooth(parts)) return interpolate_all(range, parts);
        }
        fill_quarters(range);
    }

    void fill_quarters(const Range& range) {
        std::size_t first = range.first;
        for (int quarter = 1; quarter <= 4; ++quarter) {
            const double from = range.from + 0.25 * (quarter - 1) * (range.to - range.from);
            const double to = range.from + 0.25 * quarter * (range.to - range.from);
            std::size_t end = first;
            while (end < range.end && (quarter == 4 || azimuth(end) < to)) ++end;
            fill({first, end, from, to});
            first = end;
        }
    }

    double azimuth(std::size_t place) const { return azimuths_[order_[firsts_[place]]]; }

    // The cosine of a point t in [-1, 1] of a range: 1 at its beginning.
    struct Scale {
        double middle;
        double half;
    };
    static Scale scale_of(const Range& range) {
        const double first = cosine_of_pi(range.from);
        const double last = cosine_of_pi(range.to);
        return {0.5 * (first + last), 0.5 * (first - last)};
    }

    static std::vector<double> points_of(const Range& range, int intervals) {
        const Scale scale = scale_of(range);
        std::vector<double> cosines;
        for (int k = 0; k <= intervals; ++k) {
            const double cosine = scale.middle + scale.half * wide_point(k, intervals);
            cosines.push_back(std::clamp(cosine, -1.0, 1.0));  // rounding
        }
        return cosines;
    }

    RowParts parts_at(const std::vector<double>& cosines) const {
        return {row_.split([&](double cosine) { return view_.ray(cosine); }, cosines), medium_};
    }

    void compute_each(const Range& range) {
        if (range.first == range.end) return;
        const auto begin = cosines_.begin();
        const RowParts parts = parts_at({begin + static_cast<std::ptrdiff_t>(range.first),
                                         begin + static_cast<std::ptrdiff_t>(range.end)});
        for (std::size_t i = range.first; i < range.end; ++i) {
            set_light(i, parts.layers(), parts.at(i - range.first));
        }
    }

    void interpolate_all(const Range& range, const RowParts& parts) {
        const Scale scale = scale_of(range);
        std::vector<Spectrum> found(parts.count());
        for (std::size_t i = range.first; i < range.end; ++i) {
            // Azimuths next to the sun's may have one cosine.
            const double t = scale.half > 0 ? (cosines_[i] - scale.middle) / scale.half : 0;
            interpolate(parts, t, 1, found.data());
            set_light(i, parts.layers(), found.data());
        }
    }

    void set_light(std::size_t i, const std::vector<std::size_t>& layers, const Spectrum* parts) {
        const SkyRay ray = view_.ray(cosines_[i]);
        SkyRadiance& light = light_[i];
        for (const std::size_t k : layers) {
            light.single += *parts++ * first_phase_values(medium_.layers[k], ray.one_minus_cosine,
                                                          ray.one_plus_cosine);
        }
        light.ground = *parts;
        light.transmittance = row_.transmittance();
    }

    const SkyRow& row_;
    const SkyMedium& medium_;
    const RowOfView& view_;
    const std::vector<double>& azimuths_;
    std::vector<std::size_t> order_;   // of ascending azimuths
    std::vector<double> cosines_;      // of different azimuths
    std::vector<std::size_t> firsts_;  // where each of them begins in the order
    std::vector<SkyRadiance> light_;
};

}  // namespace

std::vector<SkyRadiance> wide_radiance(const SkyRow& row, const SkyMedium& medium,
                                       const RowOfView& view, const std::vector<double>& azimuths) {
    return WideRow(row, medium, view, azimuths).radiance();
}

}  // namespace skybake
