#include "bakers/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "bakers/report/label_placement.h"
#include "bakers/report/log_axis.h"

namespace skybake {

namespace {

// Lengths in px of the picture.
constexpr double kMargin = 24;
constexpr double kPanelWidth = 430;
constexpr double kPanelHeight = 380;
constexpr double kRoomForTicks = 62;  // left of a panel: tick labels and the axis' title
constexpr double kRoomBelow = 52;
constexpr double kTextSize = 12;
constexpr double kLabelSize = 11;
constexpr double kLineHeight = 17;
constexpr double kMarkerSize = 4.5;
constexpr double kSamePlace = 24;

// Mean width of a letter of a sans-serif face, in units of its size; bold is wider.
constexpr double kLetterWidth = 0.56;
constexpr double kBoldLetterWidth = 0.61;

// Below the resolution of a double on a scale of 1 there is nothing to tell apart.
constexpr double kSmallestShown = 1e-17;

constexpr std::string_view kInk = "#1f2328";
constexpr std::string_view kPaleInk = "#59636e";
constexpr std::string_view kGrid = "#e6e8eb";
constexpr std::string_view kFront = "#444c56";
constexpr std::string_view kPaper = "#ffffff";

// Okabe & Ito, "Color Universal Design", 2008: apart for all kinds of colour vision.
constexpr std::array<std::string_view, 8> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#000000", "#8c8c8c"};

std::string escaped(std::string_view text) {
    std::string result;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&apos;";
                break;
            default:
                // XML knows no other control characters.
                result += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
        }
    }
    return result;
}

std::size_t letter_count(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char letter) {
        return (static_cast<unsigned char>(letter) & 0xC0) != 0x80;  // not within a letter of UTF-8
    }));
}

std::string text_at(double x, double y, std::string_view text, std::string_view attributes = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes,
                       escaped(text));
}

std::string line_between(const Segment& line, std::string_view attributes) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n",
                       line.x0, line.y0, line.x1, line.y1, attributes);
}

std::string_view color_of(int family) {
    return kColors[static_cast<std::size_t>(family) % kColors.size()];
}

struct Corner {
    double x, y;
};

// Corners of a family's marker about the origin, in units of its size; none: a circle.
const std::vector<Corner>& corners_of(int family) {
    static const std::array<std::vector<Corner>, 8> shapes = {{
        {},
        {{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}},
        {{0, -1.35}, {1.35, 0}, {0, 1.35}, {-1.35, 0}},
        {{0, -1.3}, {1.2, .9}, {-1.2, .9}},
        {{0, 1.3}, {1.2, -.9}, {-1.2, -.9}},
        {{-.42, -1.3},
         {.42, -1.3},
         {.42, -.42},
         {1.3, -.42},
         {1.3, .42},
         {.42, .42},
         {.42, 1.3},
         {-.42, 1.3},
         {-.42, .42},
         {-1.3, .42},
         {-1.3, -.42},
         {-.42, -.42}},
        {{-1.3, 0}, {.9, -1.2}, {.9, 1.2}},
        {{1.3, 0}, {-.9, -1.2}, {-.9, 1.2}},
    }};
    return shapes[static_cast<std::size_t>(family) % shapes.size()];
}

std::string marker_at(double x, double y, int family, std::string_view tooltip = "") {
    const std::string style =
        fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"0.7\"", color_of(family), kPaper);
    const std::string title =
        tooltip.empty() ? "" : fmt::format("<title>{}</title>", escaped(tooltip));
    const std::vector<Corner>& corners = corners_of(family);
    if (corners.empty()) {
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {}>{}</circle>\n", x, y,
                           kMarkerSize, style, title);
    }
    std::string points;
    for (const Corner& corner : corners) {
        points +=
            fmt::format("{:.1f},{:.1f} ", x + kMarkerSize * corner.x, y + kMarkerSize * corner.y);
    }
    points.pop_back();
    return fmt::format("<polygon points=\"{}\" {}>{}</polygon>\n", points, style, title);
}

// A panel whose axes cross at (left, bottom).
class PanelDrawing {
  public:
    PanelDrawing(const PlotPanel& panel, double left, double top)
        : panel_(panel),
          area_{left, top, left + kPanelWidth, top + kPanelHeight},
          x_axis_(values(&PlotPoint::x), kSmallestShown),
          y_axis_(values(&PlotPoint::y), kSmallestShown) {}

    std::string svg() const { return frame() + grid() + titles() + front() + markers() + labels(); }

  private:
    std::vector<double> values(double PlotPoint::*member) const {
        std::vector<double> all;
        for (const PlotPoint& point : panel_.points) all.push_back(point.*member);
        return all;
    }

    double x_of(double value) const {
        return area_.left + x_axis_.position(value) * (area_.right - area_.left);
    }
    double y_of(double value) const {
        return area_.bottom - y_axis_.position(value) * (area_.bottom - area_.top);
    }

    std::string frame() const {
        return fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
            "stroke=\"{}\" stroke-width=\"1\"/>\n",
            area_.left, area_.top, area_.right - area_.left, area_.bottom - area_.top, kPaper,
            kPaleInk);
    }

    std::string grid() const {
        const std::string line = fmt::format("stroke=\"{}\" stroke-width=\"1\"", kGrid);
        const std::string tick = fmt::format("stroke=\"{}\" stroke-width=\"1\"", kPaleInk);
        std::string text;
        for (const LogTick& mark : x_axis_.ticks()) {
            const double x = x_of(mark.value);
            if (!mark.label.empty()) {
                text += line_between({x, area_.top + 1, x, area_.bottom - 1}, line);
                text += text_at(x, area_.bottom + 18, mark.label, "text-anchor=\"middle\"");
            }
            text += line_between({x, area_.bottom, x, area_.bottom - (mark.label.empty() ? 3 : 6)},
                                 tick);
        }
        for (const LogTick& mark : y_axis_.ticks()) {
            const double y = y_of(mark.value);
            if (!mark.label.empty()) {
                text += line_between({area_.left + 1, y, area_.right - 1, y}, line);
                text += text_at(area_.left - 7, y + 4, mark.label, "text-anchor=\"end\"");
            }
            text +=
                line_between({area_.left, y, area_.left + (mark.label.empty() ? 3 : 6), y}, tick);
        }
        return text;
    }

    std::string titles() const {
        const double middle = (area_.left + area_.right) / 2;
        const double centre = (area_.top + area_.bottom) / 2;
        const double beside = area_.left - kRoomForTicks + 14;
        return text_at(area_.left, area_.top - 9, panel_.title, "font-weight=\"bold\"") +
               text_at(middle, area_.bottom + 38, panel_.x_title, "text-anchor=\"middle\"") +
               text_at(beside, centre, panel_.y_title,
                       fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"",
                                   beside, centre));
    }

    std::vector<Segment> front_lines() const {
        std::vector<const PlotPoint*> front;
        for (const PlotPoint& point : panel_.points) {
            if (point.on_front) front.push_back(&point);
        }
        std::sort(front.begin(), front.end(),
                  [](const PlotPoint* a, const PlotPoint* b) { return a->x < b->x; });
        std::vector<Segment> lines;
        for (std::size_t i = 1; i < front.size(); ++i) {
            lines.push_back({x_of(front[i - 1]->x), y_of(front[i - 1]->y), x_of(front[i]->x),
                             y_of(front[i]->y)});
        }
        return lines;
    }

    std::string front() const {
        std::string text;
        for (const Segment& line : front_lines()) {
            text += line_between(line, fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", kFront));
        }
        return text;
    }

    std::string markers() const {
        std::string plain;
        std::string emphasised;  // on top of all others
        // The first on top: later families are variations of earlier ones.
        for (auto at = panel_.points.rbegin(); at != panel_.points.rend(); ++at) {
            const PlotPoint& point = *at;
            const double x = x_of(point.x);
            const double y = y_of(point.y);
            std::string& text = point.emphasised ? emphasised : plain;
            if (point.emphasised) {
                text += fmt::format(
                    "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"none\" stroke=\"{}\" "
                    "stroke-width=\"1.3\"/>\n",
                    x, y, kMarkerSize + 3.5, kInk);
            }
            text += marker_at(x, y, point.family, point.tooltip);
        }
        return plain + emphasised;
    }

    // The points with labels, those that matter most first. Points that share a label and all but
    // share a place are told once.
    std::vector<const PlotPoint*> labelled() const {
        std::vector<const PlotPoint*> points;
        for (const bool emphasised : {true, false}) {
            for (const PlotPoint& point : panel_.points) {
                const bool told = std::any_of(points.begin(), points.end(), [&](const auto* other) {
                    return !point.emphasised && other->label.ends_with(point.label) &&
                           std::hypot(x_of(other->x) - x_of(point.x),
                                      y_of(other->y) - y_of(point.y)) < kSamePlace;
                });
                if (point.emphasised == emphasised && !point.label.empty() && !told) {
                    points.push_back(&point);
                }
            }
        }
        return points;
    }

    std::string labels() const {
        const std::vector<const PlotPoint*> points = labelled();
        std::vector<Label> wanted;
        for (const PlotPoint* point : points) {
            const double letter = point->emphasised ? kBoldLetterWidth : kLetterWidth;
            wanted.push_back({x_of(point->x), y_of(point->y),
                              letter * kLabelSize * static_cast<double>(letter_count(point->label)),
                              kLabelSize + 1});
        }
        std::vector<Box> obstacles;
        for (const PlotPoint& point : panel_.points) {
            const double half = kMarkerSize + (point.emphasised ? 4 : 1);
            const double x = x_of(point.x);
            const double y = y_of(point.y);
            obstacles.push_back({x - half, y - half, x + half, y + half});
        }
        const Box inner = {area_.left + 8, area_.top + 4, area_.right - 4, area_.bottom - 8};
        const auto boxes = place_labels(wanted, inner, obstacles, front_lines());
        std::string text;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (boxes[i]) text += label(*points[i], wanted[i], *boxes[i]);
        }
        return text;
    }

    std::string label(const PlotPoint& point, const Label& wanted, const Box& box) const {
        const Segment leader = {wanted.x, wanted.y, std::clamp(wanted.x, box.left, box.right),
                                std::clamp(wanted.y, box.top, box.bottom)};
        const double length = std::hypot(leader.x1 - leader.x0, leader.y1 - leader.y0);
        const double clear = kMarkerSize + (point.emphasised ? 4 : 1);
        std::string text;
        if (length > clear + 11) {
            const double t = clear / length;
            text += line_between({leader.x0 + t * (leader.x1 - leader.x0),
                                  leader.y0 + t * (leader.y1 - leader.y0), leader.x1, leader.y1},
                                 fmt::format("stroke=\"{}\" stroke-width=\"0.7\"", kPaleInk));
        }
        // A broad white stroke below keeps lines off the letters.
        const std::string style =
            fmt::format("font-size=\"{}\" text-anchor=\"middle\"{}", kLabelSize,
                        point.emphasised ? " font-weight=\"bold\"" : "");
        const double x = (box.left + box.right) / 2;
        const double y = box.bottom - 2.5;
        text += text_at(x, y, point.label,
                        fmt::format("{} stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\" "
                                    "aria-hidden=\"true\"",
                                    style, kPaper));
        return text + text_at(x, y, point.label, style);
    }

    const PlotPanel& panel_;
    Box area_;
    LogAxis x_axis_;
    LogAxis y_axis_;
};

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
        const double room =
            34 + kLetterWidth * kTextSize * static_cast<double>(letter_count(name)) * 1.05;
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
    legend.svg += line_between({at - 6, y, at + 12, y},
                               fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", kFront));
    legend.svg += text_at(at + 18, y + 4, plot.front_name);
    legend.height = y + kLineHeight - top;
    return legend;
}

}  // namespace

std::string svg_of(const Plot& plot) {
    const auto panel_count = static_cast<double>(std::max<std::size_t>(plot.panels.size(), 1));
    const double width =
        2 * kMargin - 8 + panel_count * (kPanelWidth + kRoomForTicks) + (panel_count - 1) * 16;
    double y = kMargin + 14;
    std::string body = text_at(kMargin, y, plot.title, "font-size=\"17\" font-weight=\"bold\"");
    for (const std::string& subtitle : plot.subtitles) {
        y += kLineHeight;
        body += text_at(kMargin, y + 3, subtitle, fmt::format("fill=\"{}\"", kPaleInk));
    }
    y += 36;
    double x = kMargin;
    for (const PlotPanel& panel : plot.panels) {
        body += PanelDrawing(panel, x + kRoomForTicks, y).svg();
        x += kRoomForTicks + kPanelWidth + 16;
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
