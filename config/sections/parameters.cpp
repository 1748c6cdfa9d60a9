#include "config/sections/parameters.h"

#include <algorithm>

#include "config/sections/cloud.h"
#include "config/sections/file_formats.h"
#include "config/sections/layer.h"
#include "config/sections/noise.h"
#include "config/sections/particles.h"
#include "config/sections/volume.h"

namespace skybake::config {
namespace {

template <class Section>
const Section& named(const std::vector<Section>& sections, std::string_view name) {
    return *std::ranges::find(sections, name, &Section::name);
}

}  // namespace

Parameters::Parameters() : target(Target::none) {}
Parameters::Parameters(const Parameters&) = default;
Parameters::Parameters(Parameters&&) noexcept = default;
Parameters& Parameters::operator=(const Parameters&) = default;
Parameters& Parameters::operator=(Parameters&&) noexcept = default;
Parameters::~Parameters() = default;

bool holds_colors(const Parameters& parameters) {
    return parameters.color && parameters.color->space != ColorSpace::none;
}

std::size_t channels_of_light(const Parameters& parameters) {
    return holds_colors(parameters) ? 3 : parameters.atmosphere.ground_albedo.size();
}

const Noise& noise_named(const Parameters& parameters, std::string_view name) {
    return named(parameters.noises, name);
}

const VolumeFile& volume_named(const Parameters& parameters, std::string_view name) {
    return named(parameters.volumes, name);
}

const Cloud& cloud_named(const Parameters& parameters, std::string_view name) {
    return named(parameters.clouds, name);
}

const Bake& bake_named(const Parameters& parameters, std::string_view name) {
    return named(parameters.bakes, name);
}

const Noise* noise_of(const Parameters& parameters, const Cloud& cloud) {
    return cloud.noise.empty() ? nullptr : &noise_named(parameters, cloud.noise);
}

}  // namespace skybake::config
