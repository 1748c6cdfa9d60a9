#include "bakers/air/particles/size_distribution.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// ln Gamma(q) for q > 0, within 1e-13 of its size: Gamma(q + 1) is the integral of e^((q + 1) z -
// e^z) over all z. The integrand is analytic for |Im z| < pi / 2, and near its maximum at
// ln(q + 1) a Gaussian of deviation (q + 1)^(-1/2): with steps of a quarter of it, the trapezoidal
// rule is off by less than e^(-pi^2 / 0.25) < 1e-17.
double log_gamma(double q) {
    const double step = 0.25 / std::sqrt(q + 1);
    const double middle = logarithm(q + 1);
    const double highest = (q + 1) * middle - (q + 1);
    double sum = 1;
    for (const double direction : {-1.0, 1.0}) {
        for (int i = 1;; ++i) {
            const double z = middle + direction * i * step;
            const double exponent = (q + 1) * z - exponential(z) - highest;
            if (exponent < -45) break;
            sum += exponential(exponent);
        }
    }
    return highest + logarithm(step * sum) - logarithm(q);
}

using Concave = std::function<double(double)>;

// Where a concave function is largest.
double maximum_of(const Concave& f, double near) {
    double reach = 1;
    while (f(near - reach) > f(near - reach / 2) || f(near + reach) > f(near + reach / 2)) {
        reach *= 2;
    }
    double low = near - reach;
    double high = near + reach;
    // Each step keeps two thirds: 100 of them leave the last digits.
    for (int i = 0; i < 100; ++i) {
        const double a = low + (high - low) / 3;
        const double b = high - (high - low) / 3;
        (f(a) < f(b) ? low : high) = f(a) < f(b) ? a : b;
    }
    return 0.5 * (low + high);
}

// The distance from which on `holds` is true.
double distance_where(const std::function<bool(double)>& holds) {
    double high = 1;
    while (!holds(high)) high *= 2;
    double low = 0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (holds(middle) ? high : low) = middle;
    }
    return high;
}

// Where exp(f), f concave, has fallen by a factor of e from its maximum at `top`.
double e_fold(const Concave& f, double top, double direction) {
    return distance_where([&](double d) { return f(top + direction * d) <= f(top) - 1; });
}

// How far from its maximum at `top` the integral of exp(f) may be cut so that the tail beyond has
// less than `share` of it. From the maximum to its e-fold the integral has more than that distance
// / e. A concave f falls beyond a point faster than it did on average from its maximum to there:
// with a fall of F over a distance d, the tail has less than d / F e^-F.
double cut(const Concave& f, double top, double direction, double share) {
    const double bound = share * e_fold(f, top, direction) / std::numbers::e;
    return top + direction * distance_where([&](double d) {
                     const double fall = f(top) - f(top + direction * d);
                     return fall > 1 && d / fall * exponential(-fall) < bound;
                 });
}

// Terms of the series that are kept in memory at once: 100 MB.
constexpr double kTermsAtOnce = 3e6;
// A multiple of the longest vector's doubles.
constexpr std::size_t kSeriesAtOnce = 8;

}  // namespace

RadiusDistribution::RadiusDistribution(const config::Particles& particles) {
    if (particles.smallest_radius.meters > 0) {
        smallest_ = logarithm(particles.smallest_radius.meters);
    }
    if (particles.largest_radius.meters > 0) largest_ = logarithm(particles.largest_radius.meters);
    switch (particles.sizes) {
        case config::SizeDistribution::log_normal:
            log_normal_ = true;
            center_ = logarithm(particles.radius.meters);
            deviation_ = logarithm(particles.geometric_deviation);
            log_norm_ = logarithm(std::sqrt(2 * std::numbers::pi) * deviation_);
            return;
        case config::SizeDistribution::gamma: {
            const double variance = particles.effective_variance;
            center_ = logarithm(particles.effective_radius.meters * variance);
            power_ = (1 - 2 * variance) / variance;
            break;
        }
        case config::SizeDistribution::modified_gamma:
        case config::SizeDistribution::monodisperse:
            center_ = logarithm(particles.radius.meters);
            power_ = particles.alpha + 1;
            gamma_ = particles.gamma;
            break;
    }
    log_norm_ = log_gamma(power_ / gamma_) - logarithm(gamma_);
}

double RadiusDistribution::log_density(double log_radius) const {
    const double u = log_radius - center_;
    if (log_normal_) return -0.5 * (u / deviation_) * (u / deviation_) - log_norm_;
    return power_ * u - exponential(gamma_ * u) - log_norm_;
}

double RadiusDistribution::per_log_radius(double log_radius) const {
    return exponential(log_density(log_radius));
}

RadiusDistribution::LogRange RadiusDistribution::scattering_range(config::Length wavelength) const {
    constexpr double kLeftOut = 1e-9;
    const double unit_size = logarithm(wavelength.meters / (2 * std::numbers::pi));
    const auto area = [&](double u) { return log_density(u) + 2 * (u - center_); };
    const auto scattering = [&](double u) { return area(u) + 4 * std::min(u - unit_size, 0.0); };
    const double center = maximum_of(scattering, center_);
    LogRange range = {cut(area, maximum_of(area, center_), -1, kLeftOut),
                      cut(scattering, center, 1, kLeftOut), center,
                      0.5 * (e_fold(scattering, center, -1) + e_fold(scattering, center, 1))};
    range.first = std::max(range.first, smallest_);
    range.last = std::min(range.last, largest_);
    if (range.first < range.last) range.center = std::clamp(center, range.first, range.last);
    return range;
}

std::size_t WeightedSpheres::batch_end(std::size_t first) const {
    double terms = 0;
    std::size_t end = first;
    while (end < spheres_.size() && (end == first || terms < kTermsAtOnce)) {
        terms += mie_term_count(spheres_[end++].size_parameter);
    }
    return end;
}

std::span<const MieTerms> WeightedSpheres::series(std::size_t begin, std::size_t end) {
    if (terms_ > kTermsAtOnce) {
        kept_.clear();
        kept_begin_ = begin;
    }
    const std::size_t known = kept_.size();
    const std::size_t next = kept_begin_ + known;
    if (next < end) {
        kept_.resize(end - kept_begin_);
        std::vector<double> sizes;
        for (std::size_t i = next; i < end; ++i) sizes.push_back(spheres_[i].size_parameter);
        std::vector<MieEfficiencies> efficiencies(sizes.size());
        const std::size_t tiles = (sizes.size() + kSeriesAtOnce - 1) / kSeriesAtOnce;
        parallel_for(static_cast<int>(tiles), threads_, [&](int tile) {
            const std::size_t first = static_cast<std::size_t>(tile) * kSeriesAtOnce;
            const std::size_t count = std::min(kSeriesAtOnce, sizes.size() - first);
            mie_series(std::span(sizes).subspan(first, count), index_,
                       std::span(kept_).subspan(known + first, count),
                       std::span(efficiencies).subspan(first, count));
        });
        for (std::size_t i = next; i < end; ++i) spheres_[i].efficiencies = efficiencies[i - next];
    }
    return std::span(kept_).subspan(begin - kept_begin_, end - begin);
}

void WeightedSpheres::add_intensities(std::size_t first,
                                      const std::vector<double>& one_minus_cosines,
                                      MieIntensities& intensities) {
    for (std::size_t begin = first; begin < spheres_.size();) {
        const std::size_t end = batch_end(begin);
        std::vector<double> weights;
        for (std::size_t i = begin; i < end; ++i) weights.push_back(spheres_[i].weight);
        add_mie_intensities(series(begin, end), weights, one_minus_cosines, threads_, intensities);
        begin = end;
    }
}

CrossSectionSums WeightedSpheres::cross_sections() const {
    CrossSectionSums sums;
    for (const auto& [x, weight, q] : spheres_) {
        sums.extinction += weight * x * x * q.extinction;
        sums.scattering += weight * x * x * q.scattering;
        sums.cosine += weight * x * x * q.scattering * q.mean_cosine;
    }
    return sums;
}

}  // namespace skybake
