#include "bakers/report/report_files.h"

#include <fmt/format.h>

#include <fstream>
#include <utility>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/report/report_plot.h"
#include "bakers/report/truth/sky_truth_store.h"

namespace skybake {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSignLength = 512;  // the signs stand within so many bytes

std::string beginning_of(const fs::path& path) {
    std::string text(kSignLength, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

}  // namespace

std::vector<ReportFile> report_files(const std::vector<AssetReport>& assets) {
    std::vector<ReportFile> files = {{"report.csv", report_csv(assets)},
                                     {"report.json", report_json(assets)}};
    for (const AssetReport& asset : assets) {
        // Without rows there is nothing to plot.
        if (!asset.rows.empty())
            files.push_back({asset.name + ".svg", report_svg(report_figure(asset))});
    }
    return files;
}

std::vector<std::string> report_file_names(const std::vector<std::string>& assets) {
    std::vector<std::string> names = {"report.csv", "report.json"};
    for (const std::string& asset : assets) names.push_back(asset + ".svg");
    return names;
}

bool is_report_text(std::string_view name, std::string_view text) {
    if (name.ends_with(".csv")) {
        return text.starts_with("asset,family,variant,baseline,") ||
               text.starts_with("method,family,variant,baseline,") || is_stored_sky_truth(text);
    }
    if (name.ends_with(".json"))
        return text.starts_with("{\n  \"report\": {\n    \"tool\": \"skybake\"");
    return text.find(fmt::format("<!-- {} -->", report_plot_sign)) < kSignLength;
}

std::vector<config::Diagnostic> foreign_report_files(const fs::path& folder,
                                                     const std::vector<std::string>& names) {
    std::vector<config::Diagnostic> diagnostics;
    for (const std::string& name : names) {
        const fs::path path = folder / name;
        std::error_code error;
        if (!fs::is_regular_file(path, error) || is_report_text(name, beginning_of(path))) continue;
        config::Diagnostic diagnostic = file_error(
            "E0303", path.string(),
            fmt::format("`{}` already exists and is not a report of skybake", path.string()));
        diagnostic.label = "overwrite it with --force, or choose another folder with -o";
        diagnostics.push_back(std::move(diagnostic));
    }
    return diagnostics;
}

}  // namespace skybake
