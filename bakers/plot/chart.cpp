#include "bakers/plot/chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/plot/chart_frame.h"
#include "bakers/plot/colour_map.h"
#include "bakers/plot/field_scaling.h"

namespace skybake {
namespace {

constexpr int bar_width = 16;
constexpr int plot_to_bar = 18;

// --- Colours ------------------------------------------------------------------------------------

// Where there is no value.
constexpr Colour missing_colour = {0xd0, 0xd4, 0xd9};

// Where a value stands on a scale: 0 at low, 1 at high; beyond them, and what has no logarithm, at
// the nearer end.
double place_on(const ColourScale& scale, double value) {
    const double t = scale.logarithmic ? std::log(std::max(value, scale.low) / scale.low) /
                                             std::log(scale.high / scale.low)
                                       : (value - scale.low) / (scale.high - scale.low);
    return std::isnan(t) ? 0.5 : std::clamp(t, 0.0, 1.0);  // low == high
}

Colour colour_of(const ColourScale& scale, double value) {
    if (std::isnan(value)) return missing_colour;
    const double t = place_on(scale, value);
    return scale.diverging ? diverging_colour(t) : sequential_colour(t);
}

ChartAxis axis_of(const ColourScale& scale) {
    const auto linear = [scale](double t) { return scale.low + t * (scale.high - scale.low); };
    const auto logarithmic = [scale](double t) {
        return scale.low * std::pow(scale.high / scale.low, t);
    };
    if (scale.logarithmic) return {scale.title, logarithmic, AxisTicks::logarithmic};
    return {scale.title, linear, AxisTicks::decimal};
}

// One pixel a texel, row 0 at the bottom.
Picture coloured(const Image2<float>& field, const ColourScale& scale) {
    Picture picture(field.width, field.height);
    auto pixel = picture.rgb.begin();
    for (int y = field.height - 1; y >= 0; --y) {
        for (int x = 0; x < field.width; ++x) {
            const Colour colour = colour_of(scale, double{*field.texel(x, y)});
            pixel = std::copy(colour.begin(), colour.end(), pixel);
        }
    }
    return picture;
}

// --- The bar ------------------------------------------------------------------------------------

int room_for_bar(const std::vector<AxisTick>& ticks) {
    double widest = 0;
    for (const AxisTick& tick : ticks)
        widest = std::max(widest, text_width(tick.label, tick_style));
    return plot_to_bar + bar_width + 8 + static_cast<int>(std::ceil(widest)) + 20;
}

void draw_bar(ChartFrame& frame, const ColourScale& scale, const std::vector<AxisTick>& ticks,
              int room) {
    const PlotArea& plot = frame.plot;
    const PlotArea bar{plot.x + plot.width + plot_to_bar, plot.y, bar_width, plot.height};
    for (int y = 0; y < bar.height; ++y) {
        const double t = (bar.height - y - 0.5) / bar.height;
        frame.canvas.fill(bar.x, bar.y + y, bar.width, 1,
                          scale.diverging ? diverging_colour(t) : sequential_colour(t));
    }
    draw_border(frame.canvas, bar);
    for (const AxisTick& tick : ticks) {
        const int y = bar.y + bar.height - 1 -
                      std::clamp(static_cast<int>(tick.t * bar.height), 0, bar.height - 1);
        frame.canvas.fill(bar.x + bar.width + 1, y, 3, 1, pale_ink_colour);
        frame.canvas.write(tick.label, bar.x + bar.width + 8, y + 4, TextAlign::left, tick_style);
    }
    frame.canvas.write_upwards(scale.title, plot.x + plot.width + room, plot.y + plot.height / 2,
                               axis_title_style);
}

}  // namespace

Picture false_colour_chart(const Image2<float>& field, const ColourScale& scale,
                           const std::string& title, const ChartAxis& across, const ChartAxis& up,
                           int smallest_edge) {
    if (field.width <= 0 || field.height <= 0) return {};
    const int longest_edge = std::max(1024, 2 * smallest_edge);
    const Picture plot = coloured(fitted(field, smallest_edge, longest_edge), scale);
    const ChartAxis bar_axis = axis_of(scale);
    const std::vector<AxisTick> ticks = axis_ticks(bar_axis, tick_gap_up(plot.height));
    const int room = room_for_bar(ticks);
    ChartFrame frame = make_frame({plot.width, plot.height, title, across, up, 0, room});
    frame.canvas.place(plot, frame.plot.x, frame.plot.y);
    draw_bar(frame, scale, ticks, room);
    return frame.canvas.picture();
}

Picture framed(const Picture& picture, const std::string& title, const ChartAxis& across,
               const ChartAxis& up) {
    if (picture.width <= 0 || picture.height <= 0) return {};
    ChartFrame frame = make_frame({picture.width, picture.height, title, across, up, 0, 0});
    frame.canvas.place(picture, frame.plot.x, frame.plot.y);
    return frame.canvas.picture();
}

}  // namespace skybake
