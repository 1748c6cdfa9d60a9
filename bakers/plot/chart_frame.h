// The frame of a chart: a plot with its title above, axes at the left and below, and room at the
// right.
#pragma once

#include <string>
#include <vector>

#include "bakers/plot/axis_ticks.h"
#include "bakers/plot/canvas.h"
#include "bakers/plot/chart.h"

namespace skybake {

inline constexpr TextStyle title_style = {16, FontWeight::bold, ink_colour};
inline constexpr TextStyle axis_title_style = {13, FontWeight::regular, ink_colour};
inline constexpr TextStyle tick_style = {12, FontWeight::regular, pale_ink_colour};

// Where the plot is in its chart, in pixels.
struct PlotArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

// What a frame is asked for.
struct FrameRequest {
    int plot_width = 0;
    int plot_height = 0;
    std::string title;
    ChartAxis across;
    ChartAxis up;
    int room_above = 0;  // between title and plot, for a legend
    int room_right = 0;  // beside the plot, for a colour bar
};

// An empty chart: its canvas with title, axes and ticks, and where its plot goes.
struct ChartFrame {
    Canvas canvas;
    PlotArea plot;
    std::vector<AxisTick> across;
    std::vector<AxisTick> up;
};
ChartFrame make_frame(const FrameRequest& request);

// How far apart ticks are so that labels of the style stand clear, as a share of a length.
double tick_gap_up(int pixels);

// A thin line about an area, outside of it.
void draw_border(Canvas& canvas, const PlotArea& area);

}  // namespace skybake
