#include "bakers/plot/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "bakers/plot/svg_elements.h"
#include "bakers/plot/svg_panel.h"

namespace skybake {

namespace {

// Lengths in px of the picture.
constexpr double kMargin = 24;
constexpr double kLineHeight = 17;

// The entries of the legend in rows of the picture's width, and the height they take.
struct Legend {
    std::string svg;
    double height = 0;
};

Legend legend_of(const Plot& plot, double top, double width) {
    Legend legend;
    double x = kMargin + 8;
    double y = top + kLineHeight / 2;
    const auto reserve = [&](std::string_view name) {
        const double room = 34 + 1.05 * width_of(name, kTextSize);
        if (x + room > width - kMargin && x > kMargin + 8) {
            x = kMargin + 8;
            y += kLineHeight + 2;
        }
        const double at = x;
        x += room;
        return at;
    };
    for (std::size_t i = 0; i < plot.families.size(); ++i) {
        const double at = reserve(plot.families[i]);
        legend.svg += marker_at(at, y, static_cast<int>(i));
        legend.svg += text_at(at + 10, y + 4, plot.families[i]);
    }
    const double at = reserve(plot.front_name + "xx");
    legend.svg += line_between({at - 6, y, at + 12, y}, kFrontInk, kFrontWidth);
    legend.svg += text_at(at + 18, y + 4, plot.front_name);
    legend.height = y + kLineHeight - top;
    return legend;
}

}  // namespace

int family_index(std::vector<std::string>& families, const std::string& family) {
    const auto at = std::find(families.begin(), families.end(), family);
    const auto index = at - families.begin();
    if (at == families.end()) families.push_back(family);
    return static_cast<int>(index);
}

std::string svg_of(const Plot& plot) {
    const auto panel_count = static_cast<double>(std::max<std::size_t>(plot.panels.size(), 1));
    const double width =
        2 * kMargin - 8 + panel_count * (kPanelWidth + kRoomLeft) + (panel_count - 1) * 16;
    double y = kMargin + 14;
    std::string body = text_at(kMargin, y, plot.title, "font-size=\"17\" font-weight=\"bold\"");
    for (const std::string& subtitle : plot.subtitles) {
        y += kLineHeight;
        body += text_at(kMargin, y + 3, subtitle, fmt::format("fill=\"{}\"", kPaleInk));
    }
    y += 36;
    double x = kMargin;
    for (const PlotPanel& panel : plot.panels) {
        body += svg_panel(panel, x + kRoomLeft, y);
        x += kRoomLeft + kPanelWidth + 16;
    }
    y += kPanelHeight + kRoomBelow;
    const Legend legend = legend_of(plot, y, width);
    body += legend.svg;
    const double height = y + legend.height + kMargin / 2;
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<!-- skybake report -->\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" "
        "font-family=\"'DejaVu Sans', Verdana, 'Helvetica Neue', Arial, sans-serif\" "
        "font-size=\"{2}\" fill=\"{3}\">\n"
        "<title>{4}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"{5}\"/>\n"
        "{6}</svg>\n",
        width, height, kTextSize, kInk, escaped(plot.title), kPaper, body);
}

}  // namespace skybake
