#include "bakers/assets/description/asset_label.h"

#include <algorithm>
#include <utility>

#include "bakers/field/baked.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

// Returns the conventions of all assets of an atmosphere; their bakers add what the values are.
Conventions sky_conventions(const Parameters& parameters) {
    Conventions conventions;
    conventions.length_unit = "km";
    conventions.coefficient_unit = "1/km";
    for (const config::Length& wavelength : parameters.wavelengths) {
        conventions.wavelengths_nm.push_back(to_digits(wavelength.meters * 1e9, 12));
    }
    return conventions;
}

}  // namespace

std::vector<std::string> names_of_channels(std::size_t count) {
    if (count == 1) return {"Y"};
    std::vector<std::string> names = {"R", "G", "B", "A"};
    names.resize(std::min(count, names.size()));
    return names;
}

std::vector<std::string> colour_names(const Parameters& parameters) {
    return names_of_channels(parameters.wavelengths.size());
}

Baked labelled_table(const Parameters& parameters, AssetLabel label) {
    Baked table;
    table.conventions = sky_conventions(parameters);
    table.name = std::move(label.name);
    table.channel_names = colour_names(parameters);
    table.parameters = std::move(label.parameters);
    table.details = std::move(label.details);
    return table;
}

Baked labelled_volume(AssetLabel label) {
    Baked volume;
    volume.name = std::move(label.name);
    volume.parameters = std::move(label.parameters);
    volume.details = std::move(label.details);
    return volume;
}

Baked labelled_sky_volume(const Parameters& parameters, AssetLabel label) {
    Baked volume = labelled_volume(std::move(label));
    volume.conventions = sky_conventions(parameters);
    return volume;
}

}  // namespace skybake
