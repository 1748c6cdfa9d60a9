// Dense measurements of Bruneton's tables of scattering, which share nothing with the search that
// certificates are made of. Their errors have no place where most of them are, as those of flat
// tables have: peaks of a few views hold half of the mean square, so there must be thousands.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bakers/assets/bruneton/scattering_error.h"
#include "bakers/math/relative_error.h"
#include "tests/certificates/dense_measurement.h"
#include "tests/certificates/random_cases.h"

namespace skybake::test {

class DenseScattering {
  public:
    // The largest errors are those against `exact`.
    DenseScattering(const ScatteringMapping& mapping, const VoxelArray& table, TexelRow row,
                    ExactTexel exact, RandomCase& random)
        : mapping_(mapping),
          table_(table),
          scale_(largest_values(table)),
          row_(std::move(row)),
          exact_(std::move(exact)),
          random_(random) {}

    // Over views, suns and cosines to the sun that are spread evenly.
    ErrorFigures figures() {
        constexpr int kAltitudes = 48;
        constexpr int kAngles = 96;  // of both halves
        double sum = 0;
        for (int i = 0; i < kAltitudes * kAngles; ++i) {
            const double altitude = (i / kAngles + random_.uniform(0, 1)) / kAltitudes;
            const double angle = (i % kAngles + random_.uniform(0, 1)) / kAngles;
            sum += mean_square(mapping_.view(std::fabs(2 * angle - 1), angle < 0.5, altitude));
        }
        return {largest_.figure([&](const Direction& at) {
                    return error_at(at, exact_(at.view, at.sun, at.nu)).largest;
                }),
                std::sqrt(sum / (kAltitudes * kAngles))};
    }

  private:
    struct Direction {
        ScatteringView view;
        double sun = 0;  // cosine of its zenith angle
        double nu = 0;
    };

    // Returns the mean square of the errors under suns of one view.
    double mean_square(const ScatteringView& view) {
        constexpr int kSuns = 256;
        constexpr double kGoldenSection = 0.6180339887498949;
        const double cosine = std::clamp(
            view.s_km / (mapping_.shell().ground_radius_km + view.altitude_km), -1.0, 1.0);
        const double start = random_.uniform(0, 1);
        std::vector<double> suns;
        std::vector<double> nu;
        for (int k = 0; k < kSuns; ++k) {
            suns.push_back(mapping_.sun_cos_zenith((k + random_.uniform(0, 1)) / kSuns));
            const FeasibleCosines range = feasible_cosines(cosine, suns.back());
            const double share = start + k * kGoldenSection;
            nu.push_back(range.low + (share - std::floor(share)) * (range.high - range.low));
        }
        const std::vector<Texel> wanted = row_(view, suns, nu);
        double sum = 0;
        for (std::size_t k = 0; k < suns.size(); ++k) {
            const Direction at = {view, suns[k], nu[k]};
            const PointError error = error_at(at, wanted[k]);
            largest_.add(at, error.largest);
            sum += error.mean_square;
        }
        return sum / kSuns;
    }

    PointError error_at(const Direction& at, const Texel& wanted) const {
        Texel found = look_up(table_, mapping_, mapping_.coordinates(at.view, at.sun, at.nu),
                              config::PixelType::float32);
        std::vector<double> errors;
        for (std::size_t c = 0; c < table_.channels(); ++c) {
            errors.push_back(relative_error(found[c], wanted[c], scale_[c]));
        }
        return PointError::of(errors.data(), errors.size());
    }

    const ScatteringMapping& mapping_;
    const VoxelArray& table_;
    std::vector<double> scale_;
    TexelRow row_;
    ExactTexel exact_;
    RandomCase& random_;
    LargestErrors<Direction> largest_;
};

}  // namespace skybake::test
