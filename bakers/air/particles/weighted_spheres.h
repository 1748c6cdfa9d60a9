// Spheres of one material and many sizes, each with a weight: their cross-sections and what they
// scatter by angle, summed in the order in which they were added.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/air/particles/complex_number.h"
#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/lorenz_mie_kernel.h"

namespace skybake {

// Sums over spheres of their weights times k^2 / pi cross-section, and times cosine.
struct CrossSectionSums {
    double extinction = 0;
    double scattering = 0;
    double cosine = 0;
};

// A weighted set of spheres of one material.
class WeightedSpheres {
  public:
    WeightedSpheres(ComplexNumber index, int threads) : index_(index), threads_(threads) {}

    void add(double size_parameter, double weight) {
        spheres_.push_back({size_parameter, weight, {}});
        terms_ += mie_term_count(size_parameter);
    }
    std::size_t count() const { return spheres_.size(); }
    double terms() const { return terms_; }  // of all series: the work per angle

    // Adds what the spheres from the first-th on scatter at the angles.
    void add_intensities(std::size_t first, const std::vector<double>& one_minus_cosines,
                         MieIntensities& intensities);
    // Of spheres whose intensities have been added once.
    CrossSectionSums cross_sections() const;

  private:
    struct Sphere {
        double size_parameter = 0;
        double weight = 0;
        MieEfficiencies efficiencies;
    };

    std::size_t batch_end(std::size_t first) const;
    std::span<const MieTerms> series(std::size_t begin, std::size_t end);

    ComplexNumber index_;
    int threads_;
    std::vector<Sphere> spheres_;
    double terms_ = 0;
    // The series of all spheres from the kept_begin_-th on if they fit, else of one batch.
    std::vector<MieTerms> kept_;
    std::size_t kept_begin_ = 0;
};

}  // namespace skybake
