// Which channels of its noises a cloud is made of, and what a cloud volume calls its own.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake::config {

// Those of the noise that are computed: all of one that packs or of channels = "noise", else the
// first.
std::span<const NoiseChannel> used_channels(const Noise& noise, CloudChannels channels);

// {"Y"} of one channel, else the names of the noise's.
std::vector<std::string> cloud_channel_names(const Noise& noise, CloudChannels channels);

}  // namespace skybake::config
