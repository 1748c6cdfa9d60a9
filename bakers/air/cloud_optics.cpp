#include "bakers/air/cloud_optics.h"

#include <algorithm>

#include "config/sections/cloud.h"

namespace skybake {

CloudOptics cloud_optics(const Cloud& cloud) {
    return {cloud.extinction_scale.per_meter, cloud.threshold_at == config::ThresholdAt::runtime,
            cloud.threshold, cloud.edge_softness, cloud.particles};
}

double density(const CloudOptics& optics, double value) {
    const double threshold = optics.has_edge ? optics.threshold : 0.0;
    if (!(value > threshold)) return 0;
    if (!optics.has_edge || optics.edge_softness == 0) return value;
    const double x = std::min((value - threshold) / optics.edge_softness, 1.0);
    return value * (x * x * (3 - 2 * x));
}

}  // namespace skybake
