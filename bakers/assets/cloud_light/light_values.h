// The channels of a cloud_light volume: values of optical depths towards given directions.
#pragma once

#include <array>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/depth_sweep.h"
#include "bakers/assets/cloud_light/hemisphere_harmonics.h"
#include "bakers/math/bake_options.h"

namespace skybake::config {
struct CloudLightBake;
}  // namespace skybake::config

namespace skybake::cloud_light {

// A channel is a sum over directions of weights times either the optical depth or the transmittance
// towards them.
struct LightChannels {
    std::vector<glm::dvec3> directions;        // unit vectors that rise
    std::vector<std::vector<double>> weights;  // of each direction, one for each channel
    bool is_transmittance = false;

    std::size_t count() const { return weights.front().size(); }
    // The least and the greatest value that a channel can have, whatever the cloud: a transmittance is
    // in [0, 1], an optical depth at least 0.
    std::array<float, 2> bounds(std::size_t channel) const;
};

// The directions that harmonics are made of: zenith angles times azimuths.
struct DirectionCounts {
    int zenith = 6;
    int around = 12;
};
// The directions of the reference, which shares none with the others.
inline constexpr DirectionCounts kReferenceDirections = {8, 16};

// The unit vectors towards the suns of a recipe.
std::vector<glm::dvec3> sun_directions(const config::CloudLightBake& bake);

LightChannels light_channels(const config::CloudLightBake& bake,
                             const DirectionCounts& counts = {});

// Returns the channels at all places, x fastest: one vector for each channel. The result does not
// depend on the number of threads; it is incomplete once options.progress is cancelled.
std::vector<std::vector<float>> light_values(const CloudLayer& layer, const PlaceGrid& places,
                                             const LightChannels& channels,
                                             const BakeOptions& options);

// Returns the channels at one place, by the plain integrator.
std::vector<double> light_reference(const CloudLayer& layer, const glm::dvec3& place,
                                    const LightChannels& channels);

}  // namespace skybake::cloud_light
