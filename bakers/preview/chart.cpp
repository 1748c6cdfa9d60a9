#include "bakers/preview/chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/preview/chart_frame.h"
#include "bakers/preview/colour_map.h"

namespace skybake {
namespace {

constexpr int bar_width = 16;
constexpr int plot_to_bar = 18;

// --- Colours ------------------------------------------------------------------------------------

// Where a value stands on a scale: 0 at low, 1 at high; beyond them, and what has no logarithm, at
// the nearer end.
double place_on(const ColourScale& scale, double value) {
    const double t = scale.logarithmic ? std::log(std::max(value, scale.low) / scale.low) /
                                             std::log(scale.high / scale.low)
                                       : (value - scale.low) / (scale.high - scale.low);
    return std::isnan(t) ? 0 : std::clamp(t, 0.0, 1.0);
}

Colour colour_of(const ColourScale& scale, double value) {
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

// --- Fields -------------------------------------------------------------------------------------

// Means of blocks of `block` x `block` texels; the last ones of a row or column may be smaller.
Image2<float> averaged(const Image2<float>& field, int block) {
    Image2<float> small((field.width + block - 1) / block, (field.height + block - 1) / block, 1);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            const int x_end = std::min((x + 1) * block, field.width);
            const int y_end = std::min((y + 1) * block, field.height);
            double sum = 0;
            for (int row = y * block; row < y_end; ++row) {
                for (int column = x * block; column < x_end; ++column) {
                    sum += double{*field.texel(column, row)};
                }
            }
            const int count = (x_end - x * block) * (y_end - y * block);
            *small.texel(x, y) = static_cast<float>(sum / count);
        }
    }
    return small;
}

// Each texel as a square of `edge` pixels, row 0 at the bottom.
Picture coloured(const Image2<float>& field, const ColourScale& scale, int edge) {
    Picture picture(field.width * edge, field.height * edge);
    for (int y = 0; y < picture.height; ++y) {
        const int row = field.height - 1 - y / edge;
        for (int x = 0; x < field.width; ++x) {
            const Colour colour = colour_of(scale, double{*field.texel(x, row)});
            auto pixel = picture.rgb.begin() +
                         3 * (static_cast<std::ptrdiff_t>(y) * picture.width + x * edge);
            for (int i = 0; i < edge; ++i) pixel = std::copy(colour.begin(), colour.end(), pixel);
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
    constexpr int longest_edge = 1024;  // of a field that is not averaged
    const int longer = std::max(field.width, field.height);
    const int block = (longer + longest_edge - 1) / longest_edge;
    const Image2<float> shown = block > 1 ? averaged(field, block) : field;
    const int shown_edge = std::max(shown.width, shown.height);
    const Picture plot = coloured(shown, scale, (smallest_edge + shown_edge - 1) / shown_edge);

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
    ChartFrame frame = make_frame({picture.width, picture.height, title, across, up, 0, 0});
    frame.canvas.place(picture, frame.plot.x, frame.plot.y);
    return frame.canvas.picture();
}

}  // namespace skybake
