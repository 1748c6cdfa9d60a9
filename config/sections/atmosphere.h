// This header declares the planet: [atmosphere]. Its air is made of layers (layer.h).
#pragma once

#include <vector>

#include "config/sections/forward.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct Atmosphere {
    Atmosphere();
    Atmosphere(const Atmosphere&);
    Atmosphere(Atmosphere&&) noexcept;
    Atmosphere& operator=(const Atmosphere&);
    Atmosphere& operator=(Atmosphere&&) noexcept;
    ~Atmosphere();

    Length ground_radius;
    Length top_radius;
    std::vector<double> ground_albedo;           // one per channel
    std::vector<SpectrumPoint> ground_spectrum;  // from which it follows; empty if it is given
    std::vector<Layer> layers;                   // the enabled layers, sorted by name
    bool operator==(const Atmosphere&) const = default;
};

// Returns the optical depth of a layer straight up, from the ground to the top of the atmosphere,
// one value per channel. `show` prints it, so that a wrong unit is seen, and a warning uses it.
// Bakers have their own code for it.
std::vector<double> zenith_optical_depth(const Layer& layer, const Atmosphere& atmosphere);

}  // namespace skybake::config
