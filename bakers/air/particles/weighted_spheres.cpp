#include "bakers/air/particles/weighted_spheres.h"

#include "bakers/math/parallel.h"

namespace skybake {

namespace {

// Of the series kept in memory at once: 100 MB.
constexpr double kTermsAtOnce = 3e6;

}  // namespace

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
        parallel_for(static_cast<int>(end - next), threads_, [&](int i) {
            const auto at = static_cast<std::size_t>(i);
            Sphere& sphere = spheres_[next + at];
            const MieCoefficients c = mie_coefficients(sphere.size_parameter, index_);
            sphere.efficiencies = mie_efficiencies(c);
            kept_[known + at] = mie_terms(c);
        });
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
