#include "cli/plan_page.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plot/chart.h"
#include "bakers/preview/page.h"
#include "bakers/report/measurement.h"

namespace skybake::cli {

namespace {

// The first chunk of a PNG has its width and height, the most significant byte first.
std::array<int, 2> png_size(std::string_view png) {
    std::array<int, 2> size{};
    for (std::size_t i = 0; i < 8 && 16 + i < png.size(); ++i) {
        size[i / 4] = size[i / 4] * 256 + static_cast<unsigned char>(png[16 + i]);
    }
    return size;
}

PageVariant row_of(const Plan& plan, std::size_t index) {
    const MeasuredWay& way = plan.ways[index];
    const auto number = [](double value) { return PageVariant::Cell{value, ""}; };
    return {full_name(way.way),
            "",
            {number(way.error.median),
             number(way.figures.error),
             number(way.error.max),
             number(way.figures.fetches),
             number(way.figures.operations),
             number(way.figures.bytes),
             number(way.bake_s),
             {std::nullopt, remark_of(plan, index)}},
            std::nullopt};
}

std::string content_of(const Plan& plan) {
    const MeasuredWay& chosen = plan.ways[plan.chosen];
    std::string text =
        fmt::format("{}: {}, {}. Errors: {}. Views: {}. Reference: {}; its standard error is {} %.",
                    plan.keeps_limits ? "Chosen" : "Least error", full_name(chosen.way),
                    figures_text(plan, chosen.figures), plan.words.meaning, plan.scene,
                    plan.reference, to_percent(plan.ways.front().error.standard_error));
    for (const std::string& note : plan.notes) text += " " + note;
    return text;
}

Outcome<PageTable> table_of(const Plan& plan) {
    PreviewPicture chart =
        as_plot({file_name_of(plan.subject) + "_chart", "Error against size and fetches",
                 "The line joins the ways that no other way beats.",
                 painted(drawing_of(plan_figure(plan)))});
    auto chart_bytes = png_bytes(chart.picture);
    if (!chart_bytes.value) return {{}, std::move(chart_bytes.diagnostics)};
    chart.picture.rgb = {};
    PageTable table;
    table.title = name_of(plan.subject);
    table.title.front() = 'T';  // "the sky", "the cloud `cumulus`"
    table.content = content_of(plan);
    table.pictures.push_back({std::move(chart), std::move(*chart_bytes.value)});
    if (!plan.sheet.empty()) {
        PagePicture sheet = {{file_name_of(plan.subject), "Pictures",
                              "By paths of light and by the best way of each family, with the "
                              "differences: red is brighter, blue darker.",
                              Picture()},
                             plan.sheet};
        const auto [width, height] = png_size(plan.sheet);
        sheet.picture.width = width;
        sheet.picture.height = height;
        sheet.kind = PictureKind::scene;
        table.pictures.push_back(std::move(sheet));
    }
    // "RMS %" without its unit, which the numbers have.
    const std::string column = plan.words.column.substr(0, plan.words.column.rfind(' '));
    table.columns = {{"error, median", "percent"}, {"error, " + column, "percent"},
                     {"error, max", "percent"},    {"fetches", "number"},
                     {"operations", "number"},     {"textures", "byteCount"},
                     {"bake", "duration"},         {"", ""}};
    for (const std::size_t i : by_error(plan.ways)) table.variants.push_back(row_of(plan, i));
    return {std::move(table), {}};
}

}  // namespace

std::string file_name_of(const PlanSubject& subject) {
    if (subject.is_cloud()) return "plan_" + subject.cloud;
    return subject.draws == config::Draws::sky ? "plan" : word_of(subject) + "_plan";
}

std::string remark_of(const Plan& plan, std::size_t index) {
    const MeasuredWay& way = plan.ways[index];
    std::string remark = way.on_front ? "front" : "";
    if (index == plan.knee) remark = "knee";
    if (index == plan.chosen) remark = plan.keeps_limits ? "chosen" : "least error";
    if (way.way.baseline.empty()) return remark;
    return fmt::format("{}{}baseline: {}", remark, remark.empty() ? "" : ", ", way.way.baseline);
}

Outcome<std::string> plan_page(const std::vector<Plan>& plans, const std::string& title) {
    PreviewPage page;
    page.title = title;
    for (const Plan& plan : plans) {
        auto table = table_of(plan);
        if (!table.value) return {{}, std::move(table.diagnostics)};
        page.tables.push_back(std::move(*table.value));
    }
    return {page_html(page), {}};
}

}  // namespace skybake::cli
