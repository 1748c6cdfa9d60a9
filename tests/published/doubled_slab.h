// The light that leaves a slab of plane-parallel air over black ground, by doubling: a layer so thin
// that light is scattered in it at most once is laid on itself until it is as deep as the slab (van
// de Hulst 1963; Hansen & Travis 1974, section 3). It shares nothing with the solver or with paths.
//
// Reflection and transmission are matrices over cosines of the zenith angle, one pair for each
// azimuthal order m of cos(m phi): Gauss's 64 nodes, and after them the cosines that are asked for,
// with a weight of 0. 64 and 96 nodes agree to seven digits.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "bakers/math/quadrature.h"

namespace skybake::test {

// A square matrix, row by row.
class SquareMatrix {
  public:
    explicit SquareMatrix(std::size_t size) : size_(size), values_(size * size) {}
    std::size_t size() const { return size_; }
    double& at(std::size_t row, std::size_t column) { return values_[row * size_ + column]; }
    double at(std::size_t row, std::size_t column) const { return values_[row * size_ + column]; }
    double largest() const {
        return std::ranges::max(values_, {}, [](double v) { return std::fabs(v); });
    }

  private:
    std::size_t size_;
    std::vector<double> values_;
};

class DoubledSlab {
  public:
    // `moments` are those of the phase function over Legendre's polynomials, of which the first is
    // 1. `beam` is the irradiance of a surface that faces the sun.
    DoubledSlab(double depth, double albedo, std::vector<double> moments, double sun_cosine,
                double beam, std::vector<double> cosines)
        : albedo_(albedo), moments_(std::move(moments)), beam_(beam) {
        const QuadratureRule rule = gauss_legendre(static_cast<int>(kNodes));  // on [0, 1]
        cosines_ = rule.nodes;
        weights_ = rule.weights;
        cosines_.insert(cosines_.end(), cosines.begin(), cosines.end());
        cosines_.push_back(sun_cosine);
        weights_.resize(cosines_.size());
        const int orders = sun_cosine < 1 ? static_cast<int>(moments_.size()) : 1;
        for (int m = 0; m < orders; ++m) layers_.push_back(doubled(m, depth));
    }

    // Returns the radiance that leaves the top or the bottom at the cosine with this index. The
    // azimuth is 0 where the eye looks towards the sun's side.
    double leaving(std::size_t cosine, bool is_up, double azimuth_cosine) const {
        const std::size_t sun = cosines_.size() - 1;
        const double azimuth = std::acos(azimuth_cosine);
        double sum = 0;
        for (std::size_t m = 0; m < layers_.size(); ++m) {
            const SquareMatrix& of = is_up ? layers_[m].reflected : layers_[m].transmitted;
            sum += (m == 0 ? 1 : 2) * std::cos(static_cast<double>(m) * azimuth) *
                   of.at(kNodes + cosine, sun);
        }
        return cosines_[sun] * beam_ / std::numbers::pi * sum;
    }

  private:
    static constexpr std::size_t kNodes = 64;
    static constexpr double kThinnest = 2e-8;  // optical depth

    struct Layer {
        SquareMatrix reflected;
        SquareMatrix transmitted;     // without light that was not scattered
        std::vector<double> passing;  // the share of light that was not scattered
    };

    // sqrt((l - m)! / (l + m)!) P_l^m of each node, by l, with the same sign for all of an m.
    std::vector<std::vector<double>> legendre(int m) const {
        std::vector<std::vector<double>> values(moments_.size(),
                                                std::vector<double>(cosines_.size()));
        for (auto l = static_cast<unsigned>(m); l < moments_.size(); ++l) {
            const double norm = std::sqrt(4 * std::numbers::pi / (2 * l + 1));
            for (std::size_t i = 0; i < cosines_.size(); ++i) {
                values[l][i] =
                    norm * std::sph_legendre(l, static_cast<unsigned>(m), std::acos(cosines_[i]));
            }
        }
        return values;
    }

    // Light that a layer of this depth scatters once.
    Layer thin_layer(int m, double depth) const {
        const std::size_t count = cosines_.size();
        Layer layer{SquareMatrix(count), SquareMatrix(count), std::vector<double>(count)};
        const auto harmonics = legendre(m);
        for (std::size_t i = 0; i < count; ++i) layer.passing[i] = std::exp(-depth / cosines_[i]);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j) {
                double forward = 0;
                double backward = 0;
                for (std::size_t l = static_cast<std::size_t>(m); l < moments_.size(); ++l) {
                    const double term = (2 * static_cast<double>(l) + 1) * moments_[l] *
                                        harmonics[l][i] * harmonics[l][j];
                    forward += term;
                    backward += (l + static_cast<std::size_t>(m)) % 2 == 0 ? term : -term;
                }
                const double scale = albedo_ / (4 * cosines_[i] * cosines_[j]);
                const double sum = 1 / cosines_[i] + 1 / cosines_[j];
                const double gap = 1 / cosines_[i] - 1 / cosines_[j];
                layer.reflected.at(i, j) = scale * backward * -std::expm1(-depth * sum) / sum;
                layer.transmitted.at(i, j) = scale * forward * layer.passing[i] *
                                             (gap == 0 ? depth : std::expm1(depth * gap) / gap);
            }
        }
        return layer;
    }

    // The light of `second` after `first`: the integral over the directions between them.
    SquareMatrix after(const SquareMatrix& second, const SquareMatrix& first) const {
        const std::size_t count = first.size();
        SquareMatrix result(count);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < kNodes; ++k) {
                const double factor = second.at(i, k) * 2 * cosines_[k] * weights_[k];
                for (std::size_t j = 0; j < count; ++j) {
                    result.at(i, j) += factor * first.at(k, j);
                }
            }
        }
        return result;
    }

    // Solves x = seed + after(again, x): the sum of light that went back and forth any number of times, whose
    // terms double from one step to the next.
    SquareMatrix repeated(SquareMatrix again, SquareMatrix seed) const {
        while (again.largest() > 1e-17) {
            add(seed, after(again, seed));
            again = after(again, again);
        }
        return seed;
    }

    static void add(SquareMatrix& a, const SquareMatrix& b) {
        for (std::size_t i = 0; i < a.size(); ++i) {
            for (std::size_t j = 0; j < a.size(); ++j) a.at(i, j) += b.at(i, j);
        }
    }
    // The light of `of` from light that passed the layer before without being scattered, or that
    // passes the next one so.
    static SquareMatrix from_passing(SquareMatrix of, const std::vector<double>& passing) {
        for (std::size_t i = 0; i < of.size(); ++i) {
            for (std::size_t j = 0; j < of.size(); ++j) of.at(i, j) *= passing[j];
        }
        return of;
    }
    static SquareMatrix then_passing(SquareMatrix of, const std::vector<double>& passing) {
        for (std::size_t i = 0; i < of.size(); ++i) {
            for (std::size_t j = 0; j < of.size(); ++j) of.at(i, j) *= passing[i];
        }
        return of;
    }

    // Lays a layer on itself. Between both, `down` comes from the upper and `up` from the lower one.
    Layer twice(const Layer& layer) const {
        const SquareMatrix& r = layer.reflected;
        const SquareMatrix& t = layer.transmitted;
        const SquareMatrix back_and_forth = after(r, r);
        SquareMatrix seed = from_passing(back_and_forth, layer.passing);
        add(seed, t);
        const SquareMatrix down = repeated(back_and_forth, std::move(seed));
        SquareMatrix up = from_passing(r, layer.passing);
        add(up, after(r, down));
        Layer result = layer;
        add(result.reflected, then_passing(up, layer.passing));
        add(result.reflected, after(t, up));
        result.transmitted = then_passing(down, layer.passing);
        add(result.transmitted, from_passing(t, layer.passing));
        add(result.transmitted, after(t, down));
        for (double& share : result.passing) share *= share;
        return result;
    }

    Layer doubled(int m, double depth) const {
        const int doublings =
            std::max(0, static_cast<int>(std::ceil(std::log2(depth / kThinnest))));
        Layer layer = thin_layer(m, std::ldexp(depth, -doublings));
        for (int i = 0; i < doublings; ++i) layer = twice(layer);
        return layer;
    }

    double albedo_;
    std::vector<double> moments_;
    double beam_;
    std::vector<double> cosines_;
    std::vector<double> weights_;
    std::vector<Layer> layers_;  // by azimuthal order
};

}  // namespace skybake::test
