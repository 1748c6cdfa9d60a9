#include "bakers/assets/transmittance/transmittance_as_in_paper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/air/ray.h"

namespace skybake {

namespace {

constexpr double kSampleInStep = 0.3;  // SampleSegmentT in the sample of Hillaire 2020

// A ray to the top on which extinction is sampled and summed.
class SampledRay {
  public:
    SampledRay(const Medium& medium, double altitude_km, double s_km)
        : medium_(medium), shell_(shell_of(medium)), altitude_km_(altitude_km), s_km_(s_km) {}

    double length_km() const { return distance_to_top_km(shell_, altitude_km_, s_km_); }

    // Adds the extinction at a distance, times a step's length.
    void add(double distance_km, double step_km) {
        const double altitude = std::clamp(
            altitude_along_km(shell_, altitude_km_, s_km_, distance_km), 0.0, shell_.thickness_km);
        for (const ExponentialLayer& layer : medium_.exponential_layers) {
            // The C library's exponential, faster than ours: a baseline must not be slow by choice,
            // and no asset is made of it.
            const double density = std::exp(-altitude / layer.scale_height_km);
            add_column(density * step_km, layer.extinction_per_km);
        }
        for (const PiecewiseLayer& layer : medium_.piecewise_layers) {
            for (const LinearPiece& piece : layer.pieces) {
                if (altitude < piece.bottom_km || altitude > piece.top_km) continue;
                add_column(density_at(piece, altitude) * step_km, layer.extinction_per_km);
                break;
            }
        }
    }

    const Spectrum& depth() const { return depth_; }

  private:
    void add_column(double column_km, const Spectrum& extinction_per_km) {
        depth_ += column_km * extinction_per_km;
    }

    const Medium& medium_;
    Shell shell_;
    double altitude_km_;
    double s_km_;
    Spectrum depth_{};
};

}  // namespace

Spectrum optical_depth_by_steps(const Medium& medium, double altitude_km, double s_km, int steps,
                                StepRule rule) {
    SampledRay ray(medium, altitude_km, s_km);
    const double step = ray.length_km() / steps;
    switch (rule) {
        case StepRule::end_point: {
            double begin = 0;
            for (int i = 0; i < steps; ++i) {
                const double end = step * (i + kSampleInStep);
                ray.add(end, end - begin);
                begin = end;
            }
            break;
        }
        case StepRule::midpoint:
            for (int i = 0; i < steps; ++i) ray.add(step * (i + 0.5), step);
            break;
        case StepRule::trapezoid:
            for (int i = 0; i <= steps; ++i) {
                ray.add(step * i, i == 0 || i == steps ? step / 2 : step);
            }
            break;
    }
    return ray.depth();
}

}  // namespace skybake
