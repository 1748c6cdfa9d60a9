#include "bakers/core/make_probe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/core/bilinear.h"
#include "bakers/core/pixel_type.h"

namespace skybake {

Probe make_probe(const Image2<float>& image, double u, double v, config::PixelType type) {
    Probe probe;
    probe.uv = {u, v};
    const auto channels = static_cast<std::size_t>(image.channels);
    probe.value.resize(channels);
    probe.tolerance.assign(channels, 0);
    bilinear(image, u, v, probe.value.data());
    // Weights that are multiples of 1/256, rounded or truncated, move the lookup by less than a
    // step.
    std::vector<double> moved(channels);
    for (const double du : {-1.0 / 256, 0.0, 1.0 / 256}) {
        for (const double dv : {-1.0 / 256, 0.0, 1.0 / 256}) {
            bilinear(image, u + du / image.width, v + dv / image.height, moved.data());
            for (std::size_t c = 0; c < channels; ++c) {
                probe.tolerance[c] =
                    std::max(probe.tolerance[c], std::fabs(moved[c] - probe.value[c]));
            }
        }
    }
    for (std::size_t c = 0; c < channels; ++c) {
        probe.tolerance[c] += 4 * rounding_error(type) * std::fabs(probe.value[c]);
    }
    return probe;
}

}  // namespace skybake
