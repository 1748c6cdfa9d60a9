#include "bakers/preview/file_metadata.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>
#include <variant>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/spelling.h"
#include "bakers/io/formats/exr/exr_rows.h"
#include "bakers/io/formats/vdb/vdb_volume.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

using config::Outcome;
namespace fs = std::filesystem;

std::string attribute(const Attributes& attributes, std::string_view name) {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto& entry) {
        return entry.first == fmt::format("skybake/{}", name);
    });
    return found == attributes.end() ? std::string() : found->second;
}

std::vector<std::string> words(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> result;
    for (std::string word; stream >> word;) result.push_back(word);
    return result;
}

template <class Number>
Number number(const std::string& text) {
    Number value{};
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

// The opposite of axis_line: "QUANTITY from FIRST to LAST, CONVENTION: FORMULA".
std::optional<AxisMapping> axis_of(const std::string& line) {
    const std::size_t from = line.find(" from ");
    const std::size_t to = line.find(" to ", from);
    const std::size_t comma = line.find(", ", to);
    const std::size_t colon = line.find(": ", comma);
    if (colon == std::string::npos) return std::nullopt;
    return AxisMapping{line.substr(0, from), line.substr(colon + 2),
                       line.substr(comma + 2, colon - comma - 2),
                       number<double>(line.substr(from + 6, to - from - 6)),
                       number<double>(line.substr(to + 4, comma - to - 4))};
}

// One line of skybake/statistics: "R: min 0 max 1 mean 0.5 histogram 0 to 1: 3 1 4".
ValueStatistics statistics_of(const std::string& line) {
    const std::vector<std::string> word = words(line);
    ValueStatistics statistics;
    if (word.size() < 11) return statistics;
    statistics.min = number<double>(word[2]);
    statistics.max = number<double>(word[4]);
    statistics.mean = number<double>(word[6]);
    statistics.histogram_range = {number<double>(word[8]), number<double>(word[10])};
    for (std::size_t i = 11; i < word.size(); ++i) {
        statistics.histogram.push_back(number<std::int64_t>(word[i]));
    }
    return statistics;
}

void add_level(const Attributes& attributes, const std::array<int, 3>& size, ManifestAsset& asset) {
    ManifestLevel level{size, asset.content_hash, {}, {}, {}};
    std::istringstream lines(attribute(attributes, "statistics"));
    for (std::string line; std::getline(lines, line);) {
        level.statistics.push_back(statistics_of(line));
    }
    level.statistics.resize(asset.channels.size());
    asset.levels.push_back(std::move(level));
    asset.seam_error = number<double>(attribute(attributes, "seam_error"));
}

// What tables and volumes say in the same words; none where one of them is missing.
std::optional<ManifestAsset> shared_entry(const Attributes& attributes, bool of_volume) {
    ManifestAsset asset;
    asset.kind = attribute(attributes, "kind");
    asset.content = attribute(attributes, "content");
    asset.channels = words(attribute(attributes, "channels"));
    asset.mapping = attribute(attributes, "mapping");
    asset.parameters = attribute(attributes, "parameters");
    asset.content_hash = attribute(attributes, "content_hash");
    asset.release = attribute(attributes, "release");
    asset.details.emplace_back("error", attribute(attributes, "error"));
    if (asset.kind.empty() || asset.channels.empty()) return std::nullopt;
    for (const char* axis : {"mapping_u", "mapping_v", "mapping_w"}) {
        if (!of_volume && asset.axes.size() == 2) break;
        const auto mapping = axis_of(attribute(attributes, axis));
        if (!mapping) return std::nullopt;
        asset.axes.push_back(*mapping);
    }
    return asset;
}

// "64 64 16" of a volume; none where the file is that of a table or says nonsense.
std::optional<std::array<int, 3>> volume_size(const Attributes& attributes) {
    const std::vector<std::string> text = words(attribute(attributes, "size"));
    if (text.size() != 3) return std::nullopt;
    std::array<int, 3> size{};
    for (std::size_t i = 0; i < 3; ++i) {
        constexpr int largest = 65536;  // as of manifests
        size[i] = number<int>(text[i]);
        if (size[i] < 1 || size[i] > largest) return std::nullopt;
    }
    return size;
}

// A table of the size that its parameters ask for; any, where they ask for an error instead.
bool fits_parameters(const ManifestAsset& table) {
    const auto recipe = config::parse_recipe(table.parameters, "the file");
    if (!recipe.value || recipe.value->parameters.bakes.size() != 1) return true;
    const auto asked = [](const auto& bake) -> std::vector<int> {
        return {bake.size.begin(), bake.size.end()};
    };
    const config::Bake& asset = recipe.value->parameters.bakes.front();
    std::vector<int> size;
    if (const auto* bake = asset.find<config::TransmittanceBake>()) size = asked(*bake);
    if (const auto* bake = asset.find<config::MultipleScatteringBake>()) size = asked(*bake);
    return size.empty() || size[0] <= 0 || size[1] <= 0 || size == table.size;
}

std::optional<ManifestAsset> entry_of(const ExrRows& image) {
    const Attributes& attributes = image.attributes();
    const auto size = volume_size(attributes);
    std::optional<ManifestAsset> asset = shared_entry(attributes, size.has_value());
    if (!asset) return std::nullopt;
    asset->compression = image.compression();
    ManifestFile file;
    file.format = spell(config::VolumeFormat::exr);
    file.pixel_type = image.pixel_type();
    if (size) {
        const std::string layout_text(attribute(attributes, "layout"));
        const bool stack = layout_text.starts_with("stack");
        const int columns = stack ? 1 : image.width() / (*size)[0];
        file.layout = volume_layout(
            *size, stack ? config::VolumeLayout::stack : config::VolumeLayout::atlas, columns);
        file.layout->flipped = layout_text.find("upside down") != std::string::npos;
        asset->size.assign(size->begin(), size->end());
        add_level(attributes, *size, *asset);
    } else {
        asset->size = {image.width(), image.height()};
        if (!fits_parameters(*asset)) return std::nullopt;
    }
    asset->files.push_back(std::move(file));
    return asset;
}

std::optional<ManifestAsset> entry_of(const VdbFile& vdb) {
    const auto size = volume_size(vdb.attributes);
    std::optional<ManifestAsset> asset = shared_entry(vdb.attributes, true);
    if (!asset || !size || vdb.grids.size() != asset->channels.size()) return std::nullopt;
    asset->size.assign(size->begin(), size->end());
    add_level(vdb.attributes, *size, *asset);
    ManifestFile file;
    file.format = spell(config::VolumeFormat::vdb);
    file.pixel_type = vdb.grids[0].half ? config::PixelType::half : config::PixelType::float32;
    for (const VdbGrid& grid : vdb.grids) file.grids.push_back(grid.name);
    asset->files.push_back(std::move(file));
    return asset;
}

Outcome<ManifestAsset> named(std::optional<ManifestAsset> asset, const fs::path& path) {
    if (!asset) {
        config::Diagnostic diagnostic =
            file_error("E0304", path.string(),
                       fmt::format("`{}` does not say what it holds, or holds something else: "
                                   "skybake did not write it, or it is incomplete",
                                   path.string()));
        diagnostic.label = "a manifest.json in its folder may describe it";
        return {{}, {std::move(diagnostic)}};
    }
    std::error_code error;
    asset->name = path.stem().string();
    asset->files[0].path = path.filename().string();
    asset->files[0].bytes = fs::file_size(path, error);
    return {std::move(asset), {}};
}

}  // namespace

Outcome<ManifestAsset> entry_from_metadata(const fs::path& path) {
    if (path.extension() == ".vdb") {
        const Outcome<VdbFile> file = read_vdb(path);
        return file.value ? named(entry_of(*file.value), path)
                          : Outcome<ManifestAsset>{{}, file.diagnostics};
    }
    std::error_code error;
    if (path.extension() == ".bin" && fs::is_regular_file(path, error)) return named({}, path);
    const Outcome<ExrRows> image = ExrRows::open(path);
    return image.value ? named(entry_of(*image.value), path)
                       : Outcome<ManifestAsset>{{}, image.diagnostics};
}

}  // namespace skybake
