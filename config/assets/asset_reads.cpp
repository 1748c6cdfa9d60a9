#include <fmt/format.h>

#include <iterator>

#include "config/assets/asset_kind.h"
#include "config/sections/cloud.h"
#include "config/sections/layer.h"
#include "config/sections/noise.h"
#include "config/sections/particles.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// The scattering and extinction of a layer of particles, a gas or an aerosol follow from the values
// listed here.
std::vector<Read> reads_of_matter(const Layer& layer) {
    if (layer.gas || layer.aerosol) {
        return {{join_path("atmosphere.layers", layer.name),
                 {Role::geometry, Role::content, Role::particles}}};
    }
    if (layer.phase != Phase::mie) return {};
    std::vector<Read> reads;
    for (const SphereKind& kind : layer.particles.kinds) {
        append(reads_of_particles(kind.particles.name), reads);
    }
    Roles roles = {Role::phase, Role::particles};
    if (layer.particles.optical_depth) roles = {Role::phase, Role::particles, Role::geometry};
    reads.push_back({join_path("atmosphere.layers", layer.name), roles});
    return reads;
}

}  // namespace

void append(std::vector<Read>&& more, std::vector<Read>& reads) {
    reads.insert(reads.end(), std::make_move_iterator(more.begin()),
                 std::make_move_iterator(more.end()));
}

std::vector<Read> reads_of_air(const Parameters& parameters, Roles roles) {
    std::vector<Read> reads = {{""}, {"atmosphere", roles}, {"atmosphere.layers.*", roles}};
    for (const Layer& layer : parameters.atmosphere.layers) append(reads_of_matter(layer), reads);
    return reads;
}

std::vector<Read> reads_of_light(const Parameters& parameters, Roles roles) {
    // Colours are fitted to the skies of the whole air.
    std::vector<Read> reads = reads_of_air(parameters, parameters.color ? Roles::all() : roles);
    reads.push_back({"color"});
    return reads;
}

std::vector<Read> reads_of_layer(const Layer& layer, Roles roles) {
    std::vector<Read> reads = reads_of_matter(layer);
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
    if (const Noise* base = noise_of(parameters, cloud)) {
        append(reads_of_noise(*base, used_channels(*base, cloud.channels)), reads);
    } else if (!cloud.volume.empty()) {
        reads.push_back({join_path("volumes", cloud.volume)});
    }
    if (!cloud.detail.empty() && cloud.detail != cloud.noise) {
        const Noise& detail = noise_named(parameters, cloud.detail);
        append(reads_of_noise(detail, used_channels(detail, CloudChannels::density)), reads);
    }
    return reads;
}

}  // namespace skybake::config
