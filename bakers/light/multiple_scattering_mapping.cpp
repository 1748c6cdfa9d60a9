#include "bakers/light/multiple_scattering_mapping.h"

#include <cmath>

namespace skybake {

using config::MultipleScatteringMapping;

double sun_cos_zenith_at(MultipleScatteringMapping mapping, double x) {
    const double centred = 2 * x - 1;
    return mapping == MultipleScatteringMapping::twilight ? centred * std::fabs(centred) : centred;
}

double sun_coordinate(MultipleScatteringMapping mapping, double sun_cos_zenith) {
    const double centred = mapping == MultipleScatteringMapping::twilight
                               ? std::copysign(std::sqrt(std::fabs(sun_cos_zenith)), sun_cos_zenith)
                               : sun_cos_zenith;
    return 0.5 + 0.5 * centred;
}

}  // namespace skybake
