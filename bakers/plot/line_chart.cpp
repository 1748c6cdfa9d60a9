// Curves in the frame of a chart; declared in chart.h.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bakers/plot/chart.h"
#include "bakers/plot/chart_frame.h"

namespace skybake {
namespace {

constexpr int plot_width = 600;
constexpr int plot_height = 320;
constexpr double line_width = 2;
constexpr int legend_height = 20;

// The range of an axis, and how values lie in it.
struct Range {
    double low = 0;
    double high = 1;
    bool logarithmic = false;

    // Far beyond anything measured; differences and quotients within are finite.
    static constexpr double largest = 1e150;
    bool shows(double value) const {
        return std::abs(value) <= largest && (!logarithmic || value >= 1 / largest);
    }
    double position(double value) const {
        const double t = logarithmic ? std::log(value / low) / std::log(high / low)
                                     : (value - low) / (high - low);
        return std::clamp(t, 0.0, 1.0);
    }
    ChartAxis axis(const std::string& title) const {
        const Range range = *this;
        if (!logarithmic) {
            return {title, [range](double t) { return range.low + t * (range.high - range.low); },
                    AxisTicks::decimal};
        }
        return {title,
                [range](double t) { return range.low * std::pow(range.high / range.low, t); },
                AxisTicks::logarithmic};
    }
};

// The range of what is shown; one value alone, or none, has some room about it.
Range range_of(const std::vector<ChartLine>& lines, std::vector<double> ChartLine::*values,
               bool logarithmic) {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                logarithmic};
    for (const ChartLine& line : lines) {
        for (const double value : line.*values) {
            if (!range.shows(value)) continue;
            range.low = std::min(range.low, value);
            range.high = std::max(range.high, value);
        }
    }
    if (range.low > range.high) range.low = range.high = 1;
    // Below a trillionth of the largest value is rounding.
    if (logarithmic) range.low = std::max(range.low, range.high * 1e-12);
    if (range.low == range.high) {
        const double room = range.low == 0 ? 1 : std::abs(range.low) / 2;
        range.low -= room;
        range.high += room;
    }
    return range;
}

// Room above and below curves, so that none hides under the frame; 0 stays at the frame.
void widen(Range& range) {
    constexpr double share = 0.04;
    if (range.logarithmic) {
        const double factor = std::pow(range.high / range.low, share);
        range.low /= factor;
        range.high *= factor;
        return;
    }
    const double room = share * (range.high - range.low);
    if (range.low != 0) range.low -= room;
    if (range.high != 0) range.high += room;
}

void draw_grid(ChartFrame& frame) {
    const PlotArea& plot = frame.plot;
    for (const AxisTick& tick : frame.across) {
        const int x = std::min(static_cast<int>(tick.t * plot.width), plot.width - 1);
        frame.canvas.fill(plot.x + x, plot.y, 1, plot.height, grid_colour);
    }
    for (const AxisTick& tick : frame.up) {
        const int y = std::min(static_cast<int>(tick.t * plot.height), plot.height - 1);
        frame.canvas.fill(plot.x, plot.y + plot.height - 1 - y, plot.width, 1, grid_colour);
    }
}

// The curve, with a gap wherever a value cannot be shown.
void draw_curve(ChartFrame& frame, const ChartLine& line, const Range& x_range,
                const Range& y_range) {
    const PlotArea& plot = frame.plot;
    std::vector<CanvasPoint> run;
    const auto finish_run = [&] {
        if (run.empty()) return;
        if (run.size() == 1) run.push_back(run.front());  // a dot
        frame.canvas.draw_line(run, line_width, Colour(line.colour));
        run.clear();
    };
    for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i) {
        if (!x_range.shows(line.x[i]) || !y_range.shows(line.y[i])) {
            finish_run();
            continue;
        }
        run.push_back({plot.x + x_range.position(line.x[i]) * plot.width,
                       plot.y + (1 - y_range.position(line.y[i])) * plot.height});
    }
    finish_run();
}

// Names beside samples of their lines, in rows between title and plot.
class Legend {
  public:
    explicit Legend(const std::vector<ChartLine>& lines) {
        int x = 0, row = 0;
        for (const ChartLine& line : lines) {
            if (line.name.empty()) continue;
            const int width =
                sample + 6 + static_cast<int>(std::ceil(text_width(line.name, tick_style)));
            if (x > 0 && x + width > plot_width) {
                x = 0;
                ++row;
            }
            entries_.push_back({&line, x, row});
            x += width + 18;
        }
        rows_ = entries_.empty() ? 0 : row + 1;
    }

    int height() const { return rows_ * legend_height; }

    void draw(ChartFrame& frame) const {
        for (const Entry& entry : entries_) {
            const int x = frame.plot.x + entry.x;
            const int baseline = frame.plot.y - 12 - (rows_ - 1 - entry.row) * legend_height;
            frame.canvas.fill(x, baseline - 6, sample, 3, Colour(entry.line->colour));
            frame.canvas.write(entry.line->name, x + sample + 6, baseline, TextAlign::left,
                               tick_style);
        }
    }

  private:
    static constexpr int sample = 18;
    struct Entry {
        const ChartLine* line;
        int x;
        int row;
    };
    std::vector<Entry> entries_;
    int rows_ = 0;
};

}  // namespace

Picture line_chart(const std::vector<ChartLine>& lines, const std::string& title,
                   const std::string& x_title, const std::string& y_title, bool logarithmic_x,
                   bool logarithmic_y) {
    const Range x_range = range_of(lines, &ChartLine::x, logarithmic_x);
    Range y_range = range_of(lines, &ChartLine::y, logarithmic_y);
    widen(y_range);
    const Legend legend(lines);
    ChartFrame frame = make_frame({plot_width, plot_height, title, x_range.axis(x_title),
                                   y_range.axis(y_title), legend.height(), 0});
    draw_grid(frame);
    for (const ChartLine& line : lines) draw_curve(frame, line, x_range, y_range);
    legend.draw(frame);
    draw_border(frame.canvas, frame.plot);
    return frame.canvas.picture();
}

}  // namespace skybake
