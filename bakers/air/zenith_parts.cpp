#include "bakers/air/zenith_parts.h"

#include <algorithm>
#include <cmath>

namespace skybake {

std::vector<ZenithPart> zenith_parts(double horizon, double height, int zenith_nodes) {
    const auto share = [&](double part) {
        return std::max(2, static_cast<int>(std::lround(part * zenith_nodes)));
    };
    std::vector<ZenithPart> parts = {{horizon, -1, true, share(0.5 + 0.2 * height)}};
    if (horizon < 0) parts.push_back({horizon, 0, false, share(0.7 + 0.7 * height)});
    parts.push_back({0, 1, false, share(0.7 - 0.4 * height)});
    return parts;
}

}  // namespace skybake
