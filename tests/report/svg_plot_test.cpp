#include "bakers/plot/svg_plot.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "bakers/report/report_plot.h"
#include "tests/report/sample_rows.h"

namespace skybake {
namespace {

// Whether tags are balanced and no stray markup is left: enough for what svg_plot writes. The whole
// grammar is asked by check_report.py.
bool is_balanced(const std::string& text) {
    std::vector<std::string> open;
    std::size_t at = 0;
    while ((at = text.find('<', at)) != std::string::npos) {
        const std::size_t end = text.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = text.substr(at + 1, end - at - 1);
        at = end + 1;
        if (tag.find('<') != std::string::npos) return false;
        if (tag.starts_with("?") || tag.starts_with("!--") || tag.ends_with("/")) continue;
        const std::string name = tag.substr(0, tag.find(' '));
        if (!name.starts_with("/")) {
            open.push_back(name);
        } else if (open.empty() || "/" + open.back() != name) {
            return false;
        } else {
            open.pop_back();
        }
    }
    return open.empty();
}

TEST(SvgPlot, EscapesWhatTheTextsHold) {
    Plot plot;
    plot.title = "a < b & \"c\" > 'd' \x01";
    plot.families = {"<script>"};
    plot.panels = {{"]]>", "&", "<", {{1, 1, 0, "<b>", "\"t\"", true, true}}}};
    const std::string svg = svg_of(plot);
    EXPECT_TRUE(is_balanced(svg)) << svg;
    EXPECT_EQ(svg.find("<script>"), std::string::npos);
    EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot; &gt; &apos;d&apos;"), std::string::npos);
    EXPECT_EQ(svg.find('\x01'), std::string::npos);
}

TEST(SvgPlot, ShowsTitlesUnitsAndLabels) {
    const std::string svg = report_svg(testing::sample_report());
    EXPECT_TRUE(is_balanced(svg)) << svg;
    for (const char* text :
         {"air: what accuracy costs", "time (ms)", "lookup error, RMS", "texel error, RMS",
          "against a &quot;reference&quot; &lt;finer&gt; &amp; slower",
          "the paper&apos;s &amp; ours", "this recipe: 128x32", "Pareto front"}) {
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    }
}

TEST(SvgPlot, ShowsBytesOfVolumesAlone) {
    const std::string volume = report_svg(testing::sample_volume_report());
    EXPECT_TRUE(is_balanced(volume)) << volume;
    EXPECT_NE(volume.find("file (KiB)"), std::string::npos);
    EXPECT_NE(volume.find("Texels: octaves at 64x32x16"), std::string::npos);
    EXPECT_EQ(report_svg(testing::sample_report()).find("file (KiB)"), std::string::npos);
}

TEST(SvgPlot, TakesAnyNumbers) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Plot plot;
    plot.families = {"one"};
    PlotPanel panel;
    for (const double value : {0.0, -1.0, 1e-320, 1e308, infinity, nan}) {
        panel.points.push_back({value, value, 0, "point", "", false, true});
    }
    plot.panels = {panel, PlotPanel{}};
    const std::string svg = svg_of(plot);
    EXPECT_TRUE(is_balanced(svg));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(SvgPlot, BringsItsOwnBackground) {
    EXPECT_NE(svg_of(Plot{}).find("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>"),
              std::string::npos);
}

}  // namespace
}  // namespace skybake
