// How many spheres have which radius: n(r) of config::Particles, with an integral over r of 1.
//
//   log_normal      s = ln(geometric_deviation)
//   gamma           Hansen & Travis 1974, 2.56; a modified gamma of alpha = (1 - 3 v) / v,
//                   gamma = 1 and the scale radius effective_radius v
//   modified_gamma  Deirmendjian 1969, whose mode radius is radius (alpha / gamma)^(1 / gamma);
//                   with the scale radius in its place alpha may be 0. Marshall & Palmer's rain
//                   (1948) is alpha = 0, gamma = 1 and the radius 1 / (2 Lambda), where Lambda is
//                   4.1 / mm times (rain rate in mm/h)^-0.21
//
// Over u = ln r all of them are of one kind: r^c n is the exponential of a concave function of u.
// It has one maximum and falls ever faster on both sides of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "config/sections/particles.h"

namespace skybake {

class RadiusDistribution {
  public:
    // Not of monodisperse particles, which have no n(r).
    explicit RadiusDistribution(const config::Particles& particles);

    // r n(r), the share of particles per interval of u = ln(r / metre).
    double per_log_radius(double log_radius) const;

    // From where to where, in ln(r / metre), particles count. A sphere scatters as r^2 min(1, x^4),
    // about, x = 2 pi r / wavelength, and absorbs as r^2 min(1, x): what is left out above is below
    // 1e-9 of the sum with the first weight, what is left out below with r^2, the larger there.
    struct LogRange {
        double first = 0;
        double last = 0;
        double center = 0;  // where particles scatter most, by the first weight
        double width = 0;   // from where they scatter 1 / e of it to there
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
};

// --- Spheres of all sizes ------------------------------------------------------------------------

// Spheres of one material and many sizes, each with a weight: their cross-sections and what they
// scatter by angle, summed in the order in which they were added.

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
