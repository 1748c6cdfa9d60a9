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
//
// Towers that live: each grows, stays and dissolves within the loop of its cloud, and is born anew in
// the next one. So the frame `period` is the frame 0 bit for bit.
//
// With its age a in loops, of a life of g loops of growth, m of maturity and d of decay (the three
// stages of a cumulus of Byers and Braham 1949, "The Thunderstorm"), and with the fade
// f(x) = x^2 (3 - 2 x) on [0, 1], which begins and ends at rest:
//
//   height     h = f(a / g) of the full height until a = g, then 1
//   width      grows_from + (1 - grows_from) h of the full width
//   amplitude  1 - f((a - g - m) / d) of the full amplitude once a >= g + m; 0 once it is dead
//
// The height of a Gaussian is its amplitude. So the integral of a growing tower grows as width squared
// times height, and that of a dissolving one falls as its amplitude; the lower field lets noise eat the
// cloud from its edges. The course of f is chosen for its smoothness.
//
// The wind carries a tower from the place where it was born: by `drift` tiles per loop of its age. Towers
// without a life stand, and drift through whole tiles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "config/sections/cloud.h"

namespace skybake::cloud {

struct TowerState {
    double height = 1;              // over the full height
    double width = 1;               // over the full width
    double amplitude = 1;           // over the full amplitude; 0 if the tower does not live
    std::array<double, 2> moved{};  // along x and y, in tiles
};

// Returns the state at the cloud's time of a tower that is born at `born`, in loops. It is a pure
// function of the time modulo the period.
TowerState tower_state(const config::TowerLife& tower, double born, const Cloud& cloud);

// Returns the towers of a cloud that live at its time.
std::vector<config::Tower> living_towers(const Cloud& cloud);

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
