#include "config/sections/cloud_channels.h"

#include <algorithm>

namespace skybake::config {

std::span<const NoiseChannel> used_channels(const Noise& noise, CloudChannels channels) {
    const std::span<const NoiseChannel> all = noise.channels;
    const bool takes_all = channels == CloudChannels::noise || noise.pack != NoisePacking::none;
    return takes_all ? all : all.first(std::min<std::size_t>(all.size(), 1));
}

std::vector<std::string> cloud_channel_names(const Noise& noise, CloudChannels channels) {
    const bool is_one = channels == CloudChannels::density || noise.pack != NoisePacking::none ||
                        noise.channels.size() <= 1;
    if (is_one) return {"Y"};
    std::vector<std::string> names;
    for (const NoiseChannel& channel : noise.channels) names.push_back(channel.name);
    return names;
}

}  // namespace skybake::config
