#include "bakers/plot/chart_frame.h"

#include <algorithm>
#include <cmath>

namespace skybake {
namespace {

constexpr Colour border_colour = {0x8c, 0x95, 0x9f};

constexpr int margin = 14;  // about all that a chart holds
constexpr int tick_length = 4;
constexpr int tick_to_label = 4;  // from a tick's end to its label
constexpr int label_ascent = 9;   // height of digits in tick_style
constexpr int title_ascent = 12;  // of capitals in title_style
constexpr int title_to_plot = 14;
constexpr int line_height = 18;   // of axis titles
constexpr int widest_label = 52;  // "−2.5×10⁻⁵" in tick_style, with the space to the next one

double widest(const std::vector<AxisTick>& ticks) {
    double width = 0;
    for (const AxisTick& tick : ticks) width = std::max(width, text_width(tick.label, tick_style));
    return width;
}

// The pixel of a plot's axis that t falls on.
int pixel_at(double t, int length) {
    return std::clamp(static_cast<int>(std::floor(t * length)), 0, length - 1);
}

void draw_ticks_across(ChartFrame& frame, const std::string& title) {
    const PlotArea& plot = frame.plot;
    const int below = plot.y + plot.height;
    const int baseline = below + tick_length + tick_to_label + label_ascent;
    for (const AxisTick& tick : frame.across) {
        const int x = plot.x + pixel_at(tick.t, plot.width);
        frame.canvas.fill(x, below, 1, tick_length, border_colour);
        frame.canvas.write(tick.label, x, baseline, TextAlign::centre, tick_style);
    }
    frame.canvas.write(title, plot.x + plot.width / 2, baseline + line_height + 2,
                       TextAlign::centre, axis_title_style);
}

void draw_ticks_up(ChartFrame& frame, const std::string& title) {
    const PlotArea& plot = frame.plot;
    for (const AxisTick& tick : frame.up) {
        const int y = plot.y + plot.height - 1 - pixel_at(tick.t, plot.height);
        frame.canvas.fill(plot.x - tick_length, y, tick_length, 1, border_colour);
        frame.canvas.write(tick.label, plot.x - tick_length - tick_to_label, y + label_ascent / 2,
                           TextAlign::right, tick_style);
    }
    frame.canvas.write_upwards(title, margin + label_ascent, plot.y + plot.height / 2,
                               axis_title_style);
}

}  // namespace

double tick_gap_up(int pixels) { return 2.8 * tick_style.em_pixels / pixels; }

void draw_border(Canvas& canvas, const PlotArea& area) {
    canvas.fill(area.x - 1, area.y - 1, area.width + 2, 1, border_colour);
    canvas.fill(area.x - 1, area.y + area.height, area.width + 2, 1, border_colour);
    canvas.fill(area.x - 1, area.y - 1, 1, area.height + 2, border_colour);
    canvas.fill(area.x + area.width, area.y - 1, 1, area.height + 2, border_colour);
}

ChartFrame make_frame(const FrameRequest& request) {
    const std::vector<AxisTick> across =
        axis_ticks(request.across, double{widest_label} / request.plot_width);
    const std::vector<AxisTick> up = axis_ticks(request.up, tick_gap_up(request.plot_height));
    const int left = margin + line_height + static_cast<int>(std::ceil(widest(up))) +
                     tick_to_label + tick_length;
    const int top = margin + title_ascent + title_to_plot + request.room_above;
    const int bottom =
        tick_length + tick_to_label + label_ascent + line_height + 2 + margin - label_ascent / 2;
    const int beside = left + request.plot_width + std::max(request.room_right, margin);
    const int titled = left + static_cast<int>(std::ceil(text_width(request.title, title_style)));
    // The last label of the axis across is centred under the plot's corner.
    ChartFrame frame{
        Canvas(std::max(beside, titled) + margin, top + request.plot_height + bottom, paper_colour),
        PlotArea{left, top, request.plot_width, request.plot_height}, across, up};
    frame.canvas.write(request.title, left, margin + title_ascent, TextAlign::left, title_style);
    draw_ticks_across(frame, request.across.title);
    draw_ticks_up(frame, request.up.title);
    draw_border(frame.canvas, frame.plot);
    return frame;
}

}  // namespace skybake
