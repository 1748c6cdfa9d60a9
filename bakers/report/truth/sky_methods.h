// Methods of multiple scattering: the light that a sky may use as scattered before.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

// Returns the radiance of the air, without the ground, for a camera in the air, in 1/sr for a solar
// irradiance of 1. Any thread may call it.
using AirRadiance = std::function<Spectrum(double altitude_km, const SunZenith& sun,
                                           const SkyDirection& direction)>;

struct SkyMethod {
    std::string key;       // for file names: "solved_32x32"
    std::string family;    // what it shares with others: "moments, solved"
    std::string name;      // what it differs in: "degree 4"
    std::string baseline;  // source of a method that others are compared with; or empty
    // Does all the work before the first view ray, from the medium alone, on one thread. This work
    // is timed. Null: there are no higher orders, so nothing is made.
    std::function<std::unique_ptr<HigherOrders>()> make;
    // Does the same for methods that include single scattering. These have no `make`.
    std::function<AirRadiance()> make_whole = {};

    bool takes_time() const { return make || make_whole; }
};

// Returns the methods, from single scattering alone to moments of the highest degree. Tables are float with
// bilinear lookups, as a runtime has them; moments are looked up in the solver's own grid. `quick`
// leaves out the tables of 64x32. `medium` must outlive the results.
//
//   single scattering
//   eight strips       the second order alone (light/strip_orders.h)
//   as in the paper    64 directions x 20 steps, 32x32
//   converged          the same closure by the baker's quadrature (level 9), 32x32, 64x32 twilight
//   mean radiance      of the solution, all orders with their phases, in the same tables
//   Bruneton's tables  of scattering, 256x128x32, solved: with single_mie apart, and combined
//   moments            of the solution, of degree 2, 4 and 8, and of sky_degree if it is higher
std::vector<SkyMethod> sky_methods(const SkyMedium& medium, bool quick);

}  // namespace skybake
