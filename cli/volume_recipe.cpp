#include "cli/volume_recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "bakers/io/manifest/metadata.h"
#include "bakers/io/volumes/grid_files.h"
#include "bakers/io/volumes/volume_reader.h"
#include "cli/info_lookup.h"
#include "config/text/key_path.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

std::string recipe_text(const fs::path& path, const config::VolumeShape& shape) {
    constexpr double most_previewed = 256;
    constexpr double depth = 20;
    const double longest = *std::max_element(shape.size.begin(), shape.size.end());
    std::array<long, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) {
        size[i] = std::lround(std::ceil(shape.size[i] * std::min(1.0, most_previewed / longest)));
    }
    return fmt::format(R"([volumes.cloud]
file = {}
format = "{}"
border = 2
[clouds.cloud]
volume = "cloud"
base_altitude = "1 km"
corner = ["0 m", "0 m"]
extinction_scale = "{:.4g} /m"
[preview]
single = true
[bake.cloud]
asset = "cloud_volume"
cloud = "cloud"
size = [{}]
formats = ["exr"]
)",
                       config::toml_string(path.filename().string()),
                       path.extension().string().substr(1),
                       depth / (shape.size[2] * shape.voxel_size_m[2]), fmt::join(size, ", "));
}

}  // namespace

bool is_foreign_volume(std::string_view argument) {
    const fs::path path(argument);
    return has_grids(path) && !described_by_manifest(path) && !entry_of_file(path).value;
}

Outcome<Recipe> recipe_of_volume(const std::string& file, std::span<const std::string> settings) {
    const fs::path path(file);
    const auto with_shape = [&](const config::VolumeShape& shape) {
        return config::parse_recipe(recipe_text(path, shape), file, path.parent_path(), settings);
    };
    // The settings say which grid and axes, on which the shape depends.
    auto first = with_shape({{1, 1, 1}, {1, 1, 1}, {}});
    if (!first.value) return first;
    const auto shape = read_volume_shape(first.value->parameters.volumes.at(0));
    if (!shape.value) return {{}, shape.diagnostics};
    return with_shape(*shape.value);
}

}  // namespace skybake::cli
