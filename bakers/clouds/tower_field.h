// Gaussian towers over the ground plan of a cloud, with all their periodic images, so that the sum
// tiles without a seam:
//
//   T(p) = sum over towers, sum over integer n:  a exp(-q / 2),   q = d^T C^-1 d,   d = p - c + n
//
// p, c and sigma are in tiles. C is the covariance: sigma_x^2, sigma_y^2 and correlation sigma_x
// sigma_y along the tower's own axes, which its rotation turns relative to x and y. Over a tile a
// tower integrates to 2 pi sigma_x sigma_y sqrt(1 - correlation^2) a.
//
// The sum over images is evaluated directly where they are few. For wide towers it is evaluated by
// its Fourier series (Poisson's summation formula), whose terms decrease fast where those of the
// images do not:
//
//   sum over n of f(d + n) = 2 pi sqrt(det C) a  sum over integer k of
//                            exp(-2 pi^2 k^T C k) cos(2 pi k . d)
//
// Either sum leaves out terms below e^-25 = 1.4e-11 of the greatest. The towers of Olajos 2016 have
// no images, which leaves a seam.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "config/sections/cloud.h"

namespace skybake::cloud {

class TowerField {
  public:
    TowerField() = default;
    explicit TowerField(std::span<const config::Tower> towers);

    // Adds the field at (x[i], y) to sums[i]. x ascends. Each value is a pure function of its place
    // and does not depend on the other x.
    void add_row(double y, std::span<const double> x, double* sums) const;

  private:
    // The covariance of a tower along x and y.
    struct Covariance {
        double xx = 0, xy = 0, yy = 0;
        double determinant = 0;
    };
    // q = dy^2 / variance_y + (dx - slope dy)^2 / variance_x_given_y is a sum of squares, so that
    // nothing cancels in thin towers.
    struct Images {
        std::array<double, 2> center{};
        double amplitude = 0;
        double variance_y = 0, variance_x_given_y = 0, slope = 0;
    };
    struct Wave {
        std::array<int, 2> k{};
        double amplitude = 0;
    };
    struct Waves {
        std::array<double, 2> center{};
        std::vector<Wave> waves;  // one for each pair k, -k, with the amplitude of both
    };

    static Covariance covariance_of(const config::Tower& tower);
    static Waves waves_of(const config::Tower& tower, const Covariance& covariance);
    void add_images(const Images& tower, double y, std::span<const double> x, double* sums) const;
    void add_waves(const Waves& tower, double y, std::span<const double> x, double* sums) const;

    std::vector<Images> narrow_;
    std::vector<Waves> wide_;
};

}  // namespace skybake::cloud
