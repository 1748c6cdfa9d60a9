// What has changed between two texts of resolved parameters, as parameters_toml writes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skybake::config {

struct ParameterChange {
    std::string path;    // "clouds.cumulus.threshold"
    std::string before;  // TOML; empty where it was not there
    std::string after;   // the same
};

// By path. Everything is new where `before` cannot be read as TOML.
std::vector<ParameterChange> parameter_changes(std::string_view before, std::string_view after);

// "clouds.cumulus.threshold 0.35 → 0.4", long values shortened.
std::string change_text(const ParameterChange& change);

}  // namespace skybake::config
