// Finds the grid of a file that a recipe means.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skybake {

struct GridName {
    std::string name;
    bool is_of_numbers = true;
};

// Finds the grid of a name. Without a name it is `density` or the only grid of numbers. Returns why
// there is none, in words, with what the recipe may say.
std::optional<std::string> find_grid_name(const std::vector<GridName>& grids,
                                          const std::string& asked, std::size_t& number);

}  // namespace skybake
