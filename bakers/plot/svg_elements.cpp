#include "bakers/plot/svg_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace skybake {

namespace {

// Mean width of a letter of a sans-serif face, in units of its size; bold is wider.
constexpr double kLetterWidth = 0.56;
constexpr double kBoldLetterWidth = 0.61;

// Okabe & Ito, "Color Universal Design", 2008, and a grey: apart for all kinds of colour vision.
constexpr std::array<std::string_view, 8> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#000000", "#8c8c8c"};

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

}  // namespace

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

double width_of(std::string_view text, double text_size, bool bold) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char letter) {
        return (static_cast<unsigned char>(letter) & 0xC0) != 0x80;  // not within a letter of UTF-8
    });
    return static_cast<double>(letters) * text_size * (bold ? kBoldLetterWidth : kLetterWidth);
}

std::string text_at(double x, double y, std::string_view text, std::string_view attributes) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes,
                       escaped(text));
}

std::string line_between(const Segment& line, std::string_view color, double width) {
    return fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
        "stroke-width=\"{}\"/>\n",
        line.x0, line.y0, line.x1, line.y1, color, width);
}

std::string marker_at(double x, double y, int family, std::string_view tooltip) {
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

}  // namespace skybake
