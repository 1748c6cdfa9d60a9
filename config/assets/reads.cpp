#include "config/assets/reads.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "config/sections/cloud_channels.h"
#include "config/sections/named_sections.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// The scattering and extinction of a layer of particles follow from these.
std::vector<Read> reads_of_spheres(const Layer& layer) {
    if (layer.phase != Phase::mie) return {};
    std::vector<Read> reads = reads_of_particles(layer.particles.particles.name);
    reads.push_back({join_path("atmosphere.layers", layer.name), {Role::phase, Role::particles}});
    return reads;
}

}  // namespace

void append(std::vector<Read>&& more, std::vector<Read>& reads) {
    reads.insert(reads.end(), std::make_move_iterator(more.begin()),
                 std::make_move_iterator(more.end()));
}

std::vector<Read> reads_of_air(const Parameters& parameters, Roles roles) {
    std::vector<Read> reads = {{""}, {"atmosphere", roles}, {"atmosphere.layers.*", roles}};
    for (const Layer& layer : parameters.atmosphere.layers) append(reads_of_spheres(layer), reads);
    return reads;
}

std::vector<Read> reads_of_layer(const Layer& layer, Roles roles) {
    std::vector<Read> reads = reads_of_spheres(layer);
    reads.push_back({join_path("atmosphere.layers", layer.name), roles});
    return reads;
}

std::vector<Read> reads_of_particles(const std::string& name) {
    return {{join_path("particles", name)}};
}

std::vector<Read> reads_of_noise(const Noise& noise, std::span<const NoiseChannel> channels) {
    const std::string path = join_path("noise", noise.name);
    std::vector<Read> reads = {{path}};
    for (const NoiseChannel& channel : channels) {
        reads.push_back({fmt::format("{}.channels.{}", path, channel.name)});
    }
    return reads;
}

std::vector<Read> reads_of_cloud(const Parameters& parameters, const std::string& name) {
    const Cloud& cloud = cloud_named(parameters, name);
    const std::string path = join_path("clouds", cloud.name);
    std::vector<Read> reads = {{path}, {path + ".*"}, {path + ".towers.*"}};
    const Noise& base = noise_named(parameters, cloud.noise);
    append(reads_of_noise(base, used_channels(base, cloud.channels)), reads);
    if (!cloud.detail.empty() && cloud.detail != cloud.noise) {
        const Noise& detail = noise_named(parameters, cloud.detail);
        append(reads_of_noise(detail, used_channels(detail, CloudChannels::density)), reads);
    }
    return reads;
}

}  // namespace skybake::config
