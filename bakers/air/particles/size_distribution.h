// Size distributions n(r) of config::Particles, each with an integral over r of 1, and weighted
// sums over spheres of many sizes.
//
//   log_normal      s = ln(geometric_deviation)
//   gamma           Hansen & Travis 1974, 2.56; a modified gamma of alpha = (1 - 3 v) / v,
//                   gamma = 1 and the scale radius effective_radius v
//   modified_gamma  Deirmendjian 1969, whose mode radius is radius (alpha / gamma)^(1 / gamma);
//                   with the scale radius in its place alpha may be 0. Marshall & Palmer's rain
//                   (1948) is alpha = 0, gamma = 1 and the radius 1 / (2 Lambda), where Lambda is
//                   4.1 / mm times (rain rate in mm/h)^-0.21
//
// With u = ln r all of them have one property: r^c n is the exponential of a concave function of u.
// It therefore has one maximum and falls ever faster on both sides of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "config/sections/particles.h"

namespace skybake {

class RadiusDistribution {
  public:
    // The particles must not be monodisperse, since those have no n(r).
    explicit RadiusDistribution(const config::Particles& particles);

    // Whether spheres beyond some radius are missing.
    bool has_bounds() const { return smallest_ > kNoBound || largest_ < -kNoBound; }

    // Returns r n(r), the share of particles per unit of u = ln(r / metre), as if
    // there were no bounds.
    double per_log_radius(double log_radius) const;

    // The range of ln(r / metre) within which particles count. A sphere scatters about as r^2
    // min(1, x^4), with x = 2 pi r / wavelength, and absorbs as r^2 min(1, x). The part above the
    // range is below 1e-9 of the sum weighted by r^2 min(1, x^4); the part below it is below 1e-9
    // of the sum weighted by r^2, which is the larger weight there. The range ends at the bounds;
    // it is empty (first >= last) if no sphere that counts is within them.
    struct LogRange {
        double first = 0;
        double last = 0;
        double center = 0;  // where r^2 min(1, x^4) n is largest
        double width = 0;   // of the interval in which it exceeds 1 / e of its maximum
    };
    LogRange scattering_range(config::Length wavelength) const;

  private:
    double log_density(double log_radius) const;

    bool log_normal_ = false;
    double center_ = 0;     // ln of the median or of the scale radius
    double deviation_ = 1;  // s
    double power_ = 1;      // alpha + 1
    double gamma_ = 1;
    double log_norm_ = 0;

    static constexpr double kNoBound = -1e9;
    double smallest_ = kNoBound;  // ln of the radii
    double largest_ = -kNoBound;
};

// --- Spheres of all sizes ------------------------------------------------------------------------

// Spheres of one material and many sizes, each with a weight. Their cross-sections and the light
// that they scatter by angle are summed in the order in which the spheres were added.

// Sums over spheres of weight * k^2 / pi * cross-section; `cosine` is the sum of the scattering
// terms times the mean cosine.
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
    double terms() const { return terms_; }  // of all series together: the work per angle

    // Adds the light that the spheres from number `first` on scatter at the angles.
    void add_intensities(std::size_t first, const std::vector<double>& one_minus_cosines,
                         MieIntensities& intensities);
    // Returns the sums over all spheres. Their intensities must have been added once.
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
    // The series of all spheres from number kept_begin_ on if they fit into memory, else those of
    // one batch.
    std::vector<MieTerms> kept_;
    std::size_t kept_begin_ = 0;
};

}  // namespace skybake
