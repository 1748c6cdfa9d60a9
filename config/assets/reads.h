// Values that several assets are made from.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/fields/roles.h"
#include "config/sections/parameters.h"

namespace skybake::config {

// The wavelengths, and of the planet and its layers what has these roles. Layers of particles have
// their coefficients from those, which are always among them.
std::vector<Read> reads_of_air(const Parameters& parameters, Roles roles);

// One layer, with its particles.
std::vector<Read> reads_of_layer(const Layer& layer, Roles roles);

std::vector<Read> reads_of_particles(const std::string& name);

// A noise and these of its channels.
std::vector<Read> reads_of_noise(const Noise& noise, std::span<const NoiseChannel> channels);

// A cloud and what it takes from its noises.
std::vector<Read> reads_of_cloud(const Parameters& parameters, const std::string& name);

void append(std::vector<Read>&& more, std::vector<Read>& reads);

}  // namespace skybake::config
