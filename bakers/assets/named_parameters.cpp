#include "bakers/assets/named_parameters.h"

#include <algorithm>
#include <vector>

namespace skybake {

namespace {

template <class Section>
const Section& named(const std::vector<Section>& sections, std::string_view name) {
    return *std::find_if(sections.begin(), sections.end(),
                         [&](const Section& section) { return section.name == name; });
}

}  // namespace

const config::Noise& noise_named(const config::Parameters& parameters, std::string_view name) {
    return named(parameters.noises, name);
}

const config::Cloud& cloud_named(const config::Parameters& parameters, std::string_view name) {
    return named(parameters.clouds, name);
}

const config::Bake& bake_named(const config::Parameters& parameters, std::string_view name) {
    return named(parameters.bakes, name);
}

}  // namespace skybake
