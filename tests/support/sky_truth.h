// Sky radiance by path tracing in many directions, stored as text because tracing it again takes
// minutes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/path_medium.h"

namespace skybake {

struct SkyTruthDirection {
    double altitude_km = 0;
    double sun_zenith_degrees = 0;
    double view_zenith_degrees = 0;
    double azimuth_degrees = 0;  // of the view from the sun
    bool operator==(const SkyTruthDirection&) const = default;
};

// Returns all directions with these angles in degrees that differ.
std::vector<SkyTruthDirection> sky_truth_directions(double altitude_km,
                                                    const std::vector<double>& suns,
                                                    const std::vector<double>& views,
                                                    const std::vector<double>& azimuths);

// Returns 178 directions: suns from the zenith to 6 degrees below the horizon, and views from the
// zenith to half a degree above the horizon, towards the sun, across and away from it where these
// differ.
std::vector<SkyTruthDirection> sky_truth_directions(double altitude_km);

struct SkyTruthSettings {
    std::uint64_t seed = 0;
    std::int64_t paths = 0;  // per direction
};

// One channel of one direction, in 1/sr for a solar irradiance of 1. View rays that hit the ground
// do not see it.
struct SkyTruth {
    SkyTruthDirection direction;
    int channel = 0;
    std::array<double, kPathOrders> orders{};  // 1 to 5, 6 and more
    double radiance = 0;
    double standard_error = 0;
    bool operator==(const SkyTruth&) const = default;
};

// Returns all channels of the first direction, then of the second, and so on. Direction i is ray i
// of the seed. The first order is computed by quadrature.
std::vector<SkyTruth> trace_sky_truth(const SkyMedium& medium,
                                      const std::vector<SkyTruthDirection>& directions,
                                      const SkyTruthSettings& settings, int threads);

// Writes a line of `comment` (which has no line breaks), a line of the columns' names, and one line
// per value. The columns are
//   h_km,sun_zenith_deg,view_zenith_deg,azimuth_deg,channel,L1,L2,L3,L4,L5,L6plus,L_total,stderr_total
// Numbers have as many digits as it takes to read back the same values.
std::string sky_truth_csv(const std::vector<SkyTruth>& values, std::string_view comment);

}  // namespace skybake
