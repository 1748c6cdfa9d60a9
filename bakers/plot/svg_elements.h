// The elements that plots are drawn of, as SVG text.
#pragma once

#include <string>
#include <string_view>

#include "bakers/plot/label_placement.h"

namespace skybake {

// Lengths in px.
inline constexpr double kTextSize = 12;
inline constexpr double kMarkerSize = 4.5;  // about half a marker's width

inline constexpr std::string_view kInk = "#1f2328";
inline constexpr std::string_view kPaleInk = "#59636e";
inline constexpr std::string_view kGridInk = "#e6e8eb";
inline constexpr std::string_view kFrontInk = "#444c56";
inline constexpr std::string_view kPaper = "#ffffff";

// Text as XML may hold it, in elements and in attributes.
std::string escaped(std::string_view text);

// About how wide a text will be, in whatever sans-serif face the viewer has.
double width_of(std::string_view text, double text_size, bool bold = false);

// `attributes` as XML: "text-anchor=\"end\"".
std::string text_at(double x, double y, std::string_view text, std::string_view attributes = "");
std::string line_between(const Segment& line, std::string_view color, double width);

// The marker of a family, which has its own colour and shape.
std::string marker_at(double x, double y, int family, std::string_view tooltip = "");

}  // namespace skybake
