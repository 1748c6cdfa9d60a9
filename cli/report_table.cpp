#include "cli/report_table.h"

#include <fmt/format.h>

#include <string_view>

#include "bakers/io/spelling.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

std::string bytes_text(std::uint64_t bytes) {
    const double kib = static_cast<double>(bytes) / 1024;
    return kib < 1024 ? fmt::format("{:.0f} KiB", kib) : fmt::format("{:.1f} MiB", kib / 1024);
}

// Three significant digits without an exponent, so that columns compare at a glance.
std::string time_text(double milliseconds) {
    const int decimals = milliseconds < 10 ? 2 : milliseconds < 100 ? 1 : 0;
    return fmt::format("{:.{}f} ms", milliseconds, decimals);
}

std::string error_text(const ErrorFigures& figures) {
    return fmt::format("{:.1e} / {:.1e}", figures.max, figures.rms);
}

std::string front_text(const ReportRow& row) {
    if (row.on_lookup_front && row.on_texel_front) return "lookup, texel";
    if (row.on_lookup_front) return "lookup";
    return row.on_texel_front ? "texel" : "";
}

std::string remark_of(const ReportRow& row) {
    const std::string_view own = row.of_recipe ? "this recipe" : "";
    if (row.baseline.empty()) return std::string(own);
    return fmt::format("{}{}baseline: {}", own, own.empty() ? "" : ", ", row.baseline);
}

std::string rows_text(const std::vector<ReportRow>& rows) {
    TextTable table({Align::left, Align::left, Align::right, Align::left, Align::right,
                     Align::right, Align::right, Align::right, Align::left, Align::left});
    table.add_row({"family", "variant", "size", "type", "file", "time", "texel error max / rms",
                   "lookup error max / rms", "front", ""});
    std::string family;
    for (const ReportRow& row : rows) {
        table.add_row({row.family == family ? "" : row.family, row.variant,
                       fmt::format("{}x{}", row.size[0], row.size[1]),
                       std::string(spell(row.pixel_type)), bytes_text(row.file_bytes),
                       time_text(row.time_ms), error_text(row.texel), error_text(row.lookup),
                       front_text(row), remark_of(row)});
        family = row.family;
    }
    return table.text();
}

std::string asset_text(const AssetReport& asset) {
    std::string text = fmt::format(
        "{}\n"
        "  error: {}, against {} ({} lookups, up to {} texels)\n"
        "  time: {}, median of {}\n"
        "  front: no variant is closer in as little time (within 5 %), in lookups or in texels at "
        "one size\n\n",
        asset.kind == asset.name ? asset.name : asset.name + " (" + asset.kind + ")", asset.scale,
        asset.reference, asset.lookup_points, asset.texel_points, asset.timing, asset.repetitions);
    text += rows_text(asset.rows);
    for (const std::string& note : asset.notes) text += fmt::format("  {}\n", note);
    return text;
}

}  // namespace

std::string report_table(const std::vector<AssetReport>& assets) {
    std::string text;
    for (const AssetReport& asset : assets) {
        text += fmt::format("{}{}", text.empty() ? "" : "\n", asset_text(asset));
    }
    return text;
}

}  // namespace skybake::cli
