#include "cli/info_lookup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/preview/load_assets.h"
#include "bakers/preview/runtime/runtime_library.h"
#include "cli/command.h"
#include "cli/events.h"
#include "config/assets/asset_kind.h"
#include "config/recipe/asset_parameters.h"
#include "config/sections/files.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

// --- What is known of the file ------------------------------------------------------------------

Outcome<DescribedFile> described(const fs::path& path) {
    auto entry = entry_of_file(path);
    if (entry.value) {
        ManifestFile file = entry.value->files[0];
        return {DescribedFile{std::move(*entry.value), std::move(file)}, {}};
    }
    std::error_code error;
    auto found = fs::exists(path, error) ? described_by_manifest(path) : std::nullopt;
    if (!found) return {{}, std::move(entry.diagnostics)};
    return {std::move(found), {}};
}

// Returns the size by which a lookup finds its place: that of level 0, which a file of another level does not
// know, but the manifest beside it does. Levels of a grid of occupancy are grids of their own.
std::vector<int> size_of_lookup(const DescribedFile& file, const Bake& bake, const fs::path& path) {
    if (file.asset.kind == "occupancy") return size_of(file.asset, file.file);
    const auto whole = config::files_of(bake).mips > 1 ? described_by_manifest(path) : std::nullopt;
    return whole ? whole->asset.size : file.asset.size;
}

// --- What is said of it -------------------------------------------------------------------------

std::string values_line(const ManifestAsset& asset, const ManifestLevel& level) {
    std::vector<std::string> channels;
    for (std::size_t c = 0; c < asset.channels.size(); ++c) {
        const ValueStatistics& values = level.statistics[c];
        channels.push_back(
            fmt::format("{} from {:.6g} to {:.6g}", asset.channels[c], values.min, values.max));
    }
    return fmt::format("{}", fmt::join(channels, ", "));
}

std::string layout_line(const ManifestAsset& asset, const ManifestFile& file) {
    if (file.layout && asset.is_volume()) {
        return sheet_line(asset.levels[static_cast<std::size_t>(file.level)].size, *file.layout);
    }
    if (file.layout) return file.layout->flipped ? "upside down: row 0 last" : "row 0 first";
    if (file.format == "vdb") {
        return fmt::format("voxel (i, j, k) of {} is texel (i, j, k), and 0 where it is not active",
                           fmt::join(file.grids, ", "));
    }
    if (file.texture == TextureParts::cube) {
        return "the faces of a cube texture, which texture(cube, environment_view(dir, up, ahead)) "
               "reads; the functions below read the faces below each other";
    }
    if (file.texture == TextureParts::layers)
        return "an array of 2-D textures, a layer for each slice";
    return file.format == "bin" ? "x fastest, then y, then z" : "a texture as it is";
}

std::string texture_line(const ManifestAsset& asset, const ManifestFile& file,
                         const AssetLookup& lookup) {
    const bool is_flat = lookup.functions.front().arguments.starts_with("sampler2D");
    return fmt::format("{}-D, {} texels of {}, {}; {}", is_flat ? 2 : 3,
                       fmt::join(size_of(asset, file), " x "), fmt::join(asset.channels, " "),
                       to_string(file.pixel_type), layout_line(asset, file));
}

std::string sampler_line(const ManifestAsset& asset) {
    std::vector<std::string> axes;
    for (std::size_t i = 0; i < asset.axes.size(); ++i) {
        const AxisMapping& axis = asset.axes[i];
        if (axis.quantity == "none") continue;
        axes.push_back(fmt::format(
            "{} along {}, which {}", axis.filter == AxisFilter::linear ? "linear" : "nearest",
            "uvw"[i], axis.wrap == AxisWrap::repeat ? "repeats" : "is clamped"));
    }
    return fmt::format("{}", fmt::join(axes, "; "));
}

std::string levels_line(const ManifestAsset& asset, int levels) {
    if (asset.kind == "occupancy") {
        return "each of its files of other levels is a grid with a lookup of its own";
    }
    return fmt::format("{}, for one texture; sizes are those of its level 0", levels);
}

// How the functions differ from GLSL's, in which a texture has its sampler with it.
std::string language_line(ShadingLanguage language) {
    if (language == ShadingLanguage::glsl) return "";
    const std::string_view name = row_of(language).name;
    if (language == ShadingLanguage::godot) return std::string(name);
    return fmt::format("{}; a texture's sampler follows it, and level 0 is read", name);
}

// Returns what a runtime must know of the file besides the functions.
std::string heading(const DescribedFile& described, const fs::path& path, const Bake& bake,
                    const AssetLookup& lookup, ShadingLanguage language) {
    const auto& [asset, file] = described;
    const int levels = config::files_of(bake).mips;
    FactLines lines = {
        {"Language", language_line(language)},
        {"Texels", asset.content},
        {"Units", units_line(asset.conventions)},
        {"Values", values_line(asset, asset.levels[static_cast<std::size_t>(file.level)])},
        {"Texture", texture_line(asset, file, lookup)},
        {"Sampler", sampler_line(asset)},
        {"Cost", "at most " + cost_text(cost_of(lookup))},
        {"Levels", levels > 1 ? levels_line(asset, levels) : ""},
    };
    std::string text =
        glsl_comment(fmt::format("{}: asset = \"{}\" of [bake.{}]",
                                 config::printable(path.filename().string()), baker_of(bake).asset,
                                 config::printable(bake.name))) +
        "//\n";
    for (const auto& [name, fact] : lines) {
        if (!fact.empty()) text += glsl_comment(name + ": " + config::printable(fact));
    }
    return text + "//\n" +
           glsl_comment(fmt::format("Below stands what it needs of {}.glsl, and then functions "
                                    "that call it with the numbers of this bake.",
                                    lookup.library)) +
           "\n";
}

struct Lookup {
    std::string function, text;
    std::string numbers = {};  // of the recipe
};

void print(Console& console, const fs::path& path, const Lookup& lookup, ShadingLanguage language) {
    console.result(console.json() ? event_line({{"event", "lookup"},
                                                {"path", path.string()},
                                                {"function", lookup.function},
                                                {row_of(language).word, lookup.text}})
                                  : lookup.text);
}

// Returns the numbers of the recipe that a runtime needs beside the texels of a bake.
std::string numbers_glsl(const Parameters& parameters, const Bake& bake, const std::string& name) {
    std::string text;
    if (const config::Atmosphere& air = parameters.atmosphere; air.top_radius.meters > 0) {
        text += number_function("float", "baked_ground_radius_km",
                                glsl_number(air.ground_radius.kilometers()),
                                "The radius of the ground.") +
                number_function("float", "baked_top_radius_km",
                                glsl_number(air.top_radius.kilometers()),
                                "The radius at which the air ends.");
    }
    const auto* volume = bake.find<CloudVolumeBake>();
    if (volume == nullptr) return text;
    const Cloud cloud = spanned_cloud(parameters, *volume);
    return text +
           number_function("vec3", name + "_corner_m", glsl_vector(corner_m_of(cloud)),
                           "The lower corner of its box, whose z is the altitude of its base.") +
           number_function("vec3", name + "_extent_m", glsl_vector(extent_m_of(cloud)),
                           "What its voxels span along x, y and z.") +
           number_function("float", name + "_extinction_per_m",
                           glsl_number(cloud.extinction_scale.per_meter),
                           "The extinction where its density is 1.");
}

// Returns the lookup of a file in GLSL; its heading names the language that it will be translated to.
Outcome<Lookup> lookup_of_file(const fs::path& path, ShadingLanguage language) {
    const auto file = described(path);
    if (!file.value) return {{}, file.diagnostics};
    const ManifestAsset& asset = file.value->asset;
    const auto recipe = config::parse_asset_parameters(asset.parameters, path.string());
    const Bake* own =
        recipe.value ? config::own_bake(recipe.value->parameters, asset.name) : nullptr;
    if (own == nullptr) {
        return {
            {},
            {file_error(
                "E0304", path.string(),
                fmt::format("`{}`: this release cannot read the parameters that it was baked with",
                            path.string()))}};
    }
    const AssetLookup lookup = baker_of(*own).lookup(
        recipe.value->parameters, *own,
        {asset.mapping, size_of_lookup(*file.value, *own, path), asset.channels.size()});
    const std::string name = glsl_name(own->name);
    std::string text =
        heading(*file.value, path, *own, lookup, language) + lookup_glsl(lookup, name);
    const auto& color = asset.conventions.color;
    if (color && !color->is_applied) {
        text += "\n" + color_glsl(*color, asset.conventions.wavelengths_nm,
                                  config::packet_number(*own) > 0, name);
    }
    return {Lookup{name, std::move(text), numbers_glsl(recipe.value->parameters, *own, name)}, {}};
}

// Adds the paragraphs that are not there yet: lookups of two files share functions.
void add_paragraphs(std::string_view text, std::set<std::string, std::less<>>& seen,
                    std::string& all) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find("\n\n"), text.size());
        const std::string_view paragraph = text.substr(0, end);
        if (!paragraph.empty() && seen.emplace(config::trim(paragraph)).second) {
            all += fmt::format("{}\n\n", config::trim(paragraph));
        }
        text.remove_prefix(std::min(end + 2, text.size()));
    }
}

// Prints the lookups of all assets of a folder, each function once, with the recipe's numbers, and marches
// through its air and clouds.
ExitCode show_library(const fs::path& folder, ShadingLanguage language, Console& console) {
    const auto manifest = read_manifest(folder);
    if (!manifest.value) return console.report(manifest.diagnostics);
    std::set<std::string, std::less<>> seen;
    std::string text;
    for (const ManifestAsset& asset : manifest.value->assets) {
        const auto lookup = lookup_of_file(folder / asset.files.front().path, language);
        if (!lookup.value) return console.report(lookup.diagnostics);
        add_paragraphs(lookup.value->text + "\n" + lookup.value->numbers, seen, text);
    }
    const auto assets = load_folder(folder, LoadedTexels::tables);
    if (assets.value) add_paragraphs(runtime_library(*assets.value, 1), seen, text);
    if (text.ends_with("\n\n")) text.pop_back();
    print(console, folder, {"baked", translated(text, language)}, language);
    return ExitCode::done;
}

}  // namespace

std::optional<DescribedFile> described_by_manifest(const fs::path& path) {
    const auto manifest = read_manifest(path.has_parent_path() ? path.parent_path() : ".");
    if (!manifest.value) return std::nullopt;
    for (const ManifestAsset& asset : manifest.value->assets) {
        for (const ManifestFile& file : asset.files) {
            if (fs::path(file.path) == path.filename()) return DescribedFile{asset, file};
        }
    }
    return std::nullopt;
}

ExitCode show_lookup(const fs::path& path, ShadingLanguage language, Console& console) {
    std::error_code error;
    if (fs::is_directory(path, error)) return show_library(path, language, console);
    if (path.filename() == manifest_name) {
        return show_library(path.has_parent_path() ? path.parent_path() : ".", language, console);
    }
    auto lookup = lookup_of_file(path, language);
    if (!lookup.value) return console.report(lookup.diagnostics);
    lookup.value->text = translated(lookup.value->text, language);
    print(console, path, *lookup.value, language);
    return ExitCode::done;
}

}  // namespace skybake::cli
