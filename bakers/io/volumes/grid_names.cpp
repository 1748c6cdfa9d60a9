#include "bakers/io/volumes/grid_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace skybake {

std::optional<std::string> find_grid_name(const std::vector<GridName>& grids,
                                          const std::string& asked, std::size_t& number) {
    const std::string wanted = asked.empty() ? "density" : asked;
    const auto named = std::find_if(grids.begin(), grids.end(),
                                    [&](const GridName& grid) { return grid.name == wanted; });
    const auto is_of_numbers = [](const GridName& grid) { return grid.is_of_numbers; };
    auto found = named;
    const bool takes_any = asked.empty() && (named == grids.end() || !named->is_of_numbers);
    if (takes_any && std::count_if(grids.begin(), grids.end(), is_of_numbers) == 1) {
        found = std::find_if(grids.begin(), grids.end(), is_of_numbers);
    }
    number = static_cast<std::size_t>(found - grids.begin());
    if (found != grids.end()) return std::nullopt;
    if (grids.empty()) return "it has no grids";
    std::vector<std::string> choices;
    for (const GridName& grid : grids) {
        if (grid.is_of_numbers) choices.push_back(fmt::format("grid = \"{}\"", grid.name));
    }
    if (choices.empty()) return "it has no grid of numbers";
    return fmt::format("it has no grid `{}`; write {}", wanted, fmt::join(choices, " or "));
}

}  // namespace skybake
