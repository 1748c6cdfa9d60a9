#include "bakers/assets/registry/probe_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/finish_table.h"
#include "config/recipe/asset_parameters.h"

namespace skybake {
namespace {

bool are_alike(const Uvw& found, const Uvw& wanted, const std::array<bool, 3>& repeats) {
    for (std::size_t i = 0; i < 3; ++i) {
        double apart = found[i] - wanted[i];
        if (repeats[i]) apart -= std::round(apart);
        if (!(std::fabs(apart) <= 1e-9)) return false;
    }
    return true;
}

// An empty text where the probe's place and its texture coordinates are one.
std::string problem_of(const Probe& probe, int level, const AssetPlaces& lookup,
                       const std::array<bool, 3>& repeats) {
    const bool named = std::equal(
        probe.at.begin(), probe.at.end(), lookup.names.begin(), lookup.names.end(),
        [](const auto& coordinate, const std::string& name) { return coordinate.first == name; });
    if (!named) {
        return fmt::format("the coordinates of a probe are not {}", fmt::join(lookup.names, ", "));
    }
    const std::vector<ProbeLookup> wanted = lookup.lookups(probe, level);
    bool alike = are_alike(probe.uvw, wanted.front().uvw, repeats) &&
                 probe.blend.has_value() == (wanted.size() > 1);
    if (alike && probe.blend) {
        alike = are_alike(probe.blend->uvw, wanted[1].uvw, repeats) &&
                std::fabs(probe.blend->share - wanted[1].share) <= 1e-9;
    }
    if (alike) return {};
    return fmt::format("{} is at uvw {:.9g}, not at {:.9g}", place_text(probe.at),
                       fmt::join(wanted.front().uvw, ", "), fmt::join(probe.uvw, ", "));
}

std::vector<std::string> check(const ManifestAsset& asset, int& checks) {
    // The parameters that an asset carries are themselves a recipe; a grid of occupancy has its
    // volume's too.
    const auto recipe = config::parse_asset_parameters(asset.parameters, asset.name);
    const Bake* own =
        recipe.value ? config::own_bake(recipe.value->parameters, asset.name) : nullptr;
    if (own == nullptr) {
        ++checks;
        return {"its parameters cannot be read as a recipe"};
    }
    const AssetPlaces places = baker_of(*own).places(
        recipe.value->parameters, *own, {asset.mapping, asset.size, asset.channels.size()});
    const std::array<bool, 3> repeats = repeating_axes(asset.axes);
    std::vector<std::string> failures;
    for (std::size_t level = 0; level < asset.levels.size(); ++level) {
        for (const Probe& probe : asset.levels[level].probes) {
            ++checks;
            std::string problem = problem_of(probe, static_cast<int>(level), places, repeats);
            if (!problem.empty()) failures.push_back(std::move(problem));
        }
    }
    return failures;
}

}  // namespace

AssetCheck probe_check() { return {"probe place", check}; }

}  // namespace skybake
