// One panel of a plot: axes, markers, front and labels.
#pragma once

#include <string>

#include "bakers/plot/svg_plot.h"

namespace skybake {

// Lengths in px.
inline constexpr double kPanelWidth = 430;
inline constexpr double kPanelHeight = 380;
inline constexpr double kRoomLeft = 62;   // of a panel, for tick labels and the axis' title
inline constexpr double kRoomBelow = 52;  // the same
inline constexpr double kFrontWidth = 1.5;

// SVG elements; (left, top) is the corner of the area between the axes.
std::string svg_panel(const PlotPanel& panel, double left, double top);

}  // namespace skybake
