#include "bakers/preview/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace skybake {
namespace {

// Figures with their titles and the page's functions that make texts of them.
constexpr std::array<std::array<const char*, 3>, 6> known_figures = {{
    {"sky_median", "sky error, median", "percent"},
    {"sky_p90", "sky error, 9 in 10", "percent"},
    {"sky_max", "sky error, max", "percent"},
    {"lookup_max", "lookup error, max", "figure"},
    {"lookup_rms", "lookup error, RMS", "figure"},
    {"bytes", "files", "byteCount"},
}};

// Returns the names of the figures that any variant has of an asset.
std::set<std::string> measured_figures(const PreviewSweep& sweep, const std::string& asset) {
    std::set<std::string> names;
    for (const SweepVariant& variant : sweep.variants) {
        const auto figures = variant.figures.find(asset);
        if (figures == variant.figures.end()) continue;
        for (const auto& [name, value] : figures->second) names.insert(name);
    }
    return names;
}

// Whether an asset has the same errors and bytes in all variants.
bool is_the_same_everywhere(const PreviewSweep& sweep, const std::string& asset) {
    for (const auto& [name, title, shown] : known_figures) {
        for (const SweepVariant& variant : sweep.variants) {
            if (figure_of(variant, asset, name) != figure_of(sweep.variants[0], asset, name)) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

SweepTable::SweepTable(const PreviewSweep& sweep) : sweep_(sweep) {
    // Figures that differ are to be seen without scrolling.
    std::vector<std::string> assets = sweep.assets;
    std::stable_partition(assets.begin(), assets.end(), [&](const std::string& asset) {
        return !is_the_same_everywhere(sweep, asset);
    });
    for (const std::string& asset : assets) {
        const std::set<std::string> measured = measured_figures(sweep, asset);
        for (const auto& [name, title, shown] : known_figures) {
            if (!measured.contains(name)) continue;
            figures_.push_back({asset, name, {fmt::format("{}: {}", asset, title), shown}});
        }
        for (const std::string& name : measured) {  // times: "texels_s"
            if (!name.ends_with("_s")) continue;
            const auto title = fmt::format("{}: {}", asset, name.substr(0, name.size() - 2));
            figures_.push_back({asset, name, {title, "duration"}});
        }
    }
}

std::vector<PageTable::Column> SweepTable::columns() const {
    std::vector<PageTable::Column> columns;
    for (std::size_t i = 0; i < sweep_.names.size(); ++i) {
        const bool numbers = std::ranges::all_of(sweep_.variants, [&](const SweepVariant& variant) {
            return variant.values[i].number.has_value();
        });
        columns.push_back({sweep_.names[i], numbers ? "number" : ""});
    }
    for (const Figure& figure : figures_) columns.push_back(figure.column);
    columns.push_back({"Picture: difference, RMS of 255", "figure"});
    columns.push_back({"Status", ""});
    return columns;
}

PageVariant SweepTable::row(const SweepVariant& variant, std::optional<double> difference,
                            const std::filesystem::path& folder) const {
    PageVariant row;
    row.name = variant.name;
    row.folder = (folder / variant.name).generic_string() + "/";
    for (const SweptValue& value : variant.values) row.cells.push_back({value.number, value.text});
    for (const Figure& figure : figures_) {
        row.cells.push_back({figure_of(variant, figure.asset, figure.name), ""});
    }
    row.cells.push_back({difference, ""});
    row.cells.push_back({std::nullopt, variant.status});
    return row;
}

}  // namespace skybake
