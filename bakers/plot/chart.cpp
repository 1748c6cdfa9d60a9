#include "bakers/plot/chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/plot/chart_points.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

constexpr Colour border_colour = {0x8c, 0x95, 0x9f};

constexpr TextStyle figure_title_style = {17, FontWeight::bold, ink_colour};
constexpr TextStyle title_style = {16, FontWeight::bold, ink_colour};
constexpr TextStyle panel_title_style = {13, FontWeight::bold, ink_colour};
constexpr TextStyle axis_title_style = {13, FontWeight::regular, ink_colour};
constexpr TextStyle subtitle_style = {12, FontWeight::regular, pale_ink_colour};
constexpr TextStyle tick_style = {12, FontWeight::regular, pale_ink_colour};

// All lengths are in pixels.
constexpr int chart_margin = 14;  // around everything in a chart
constexpr int tick_length = 4;
constexpr int tick_to_label = 4;  // from a tick's end to its label
constexpr int label_ascent = 9;   // height of digits in tick_style
constexpr int title_ascent = 12;  // of capitals in title_style
constexpr int title_to_plot = 14;
constexpr int line_height = 18;   // of axis titles
constexpr int widest_label = 52;  // "−2.5×10⁻⁵" in tick_style, with the space to the next one
constexpr int bar_width = 16;
constexpr int plot_to_bar = 18;
constexpr int legend_height = 20;  // of a row
constexpr int legend_sample = 18;  // the length of a line's sample
constexpr int legend_gap = 18;     // between entries
constexpr double curve_width = 2;

int ceiled(double length) { return static_cast<int>(std::ceil(length)); }

// The distance between ticks, as a share of an axis of `pixels`, at which labels do not touch.
double tick_gap_up(int pixels) { return 2.8 * tick_style.em_pixels / pixels; }

int widest(const std::vector<AxisTick>& ticks) {
    double width = 0;
    for (const AxisTick& tick : ticks) width = std::max(width, text_width(tick.label, tick_style));
    return ceiled(width);
}

// Returns the pixel that t falls on along an axis of a plot.
int pixel_at(double t, int length) {
    return std::clamp(static_cast<int>(std::floor(t * length)), 0, length - 1);
}

// Draws a thin line around an area, outside of it.
void draw_border(Drawing& drawing, const PlotArea& area) {
    drawing.fill(area.x - 1, area.y - 1, area.width + 2, 1, border_colour);
    drawing.fill(area.x - 1, area.y + area.height, area.width + 2, 1, border_colour);
    drawing.fill(area.x - 1, area.y - 1, 1, area.height + 2, border_colour);
    drawing.fill(area.x + area.width, area.y - 1, 1, area.height + 2, border_colour);
}

// --- Legends ------------------------------------------------------------------------------------

// Arranges names in rows of a given width. Each name has a sample of its curve or marker at its
// left.
class LegendRows {
  public:
    struct Entry {
        std::size_t index;  // of the name
        int x;
        int row;
    };

    // Empty names get no entry.
    LegendRows(const std::vector<std::string>& names, int width) {
        int x = 0;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i].empty()) continue;
            const int length = legend_sample + 6 + ceiled(text_width(names[i], tick_style));
            if (x > 0 && x + length > width) {
                x = 0;
                ++last_row_;
            }
            entries_.push_back({i, x, last_row_});
            x += length + legend_gap;
        }
    }

    int height() const { return entries_.empty() ? 0 : (last_row_ + 1) * legend_height; }
    const std::vector<Entry>& entries() const { return entries_; }

  private:
    std::vector<Entry> entries_;
    int last_row_ = 0;
};

// --- One chart ----------------------------------------------------------------------------------

// Lays out a chart, including everything around its plot, and draws it.
class ChartLayout {
  public:
    ChartLayout(const Chart& chart, const TextStyle& style)
        : chart_(chart),
          title_style_(style),
          across_(axis_ticks(chart.across, double{widest_label} / chart.width)),
          up_(axis_ticks(chart.up, tick_gap_up(chart.height))),
          legend_(mapped<std::string>(chart.lines, &ChartLine::name), chart.width) {
        if (chart.colours) {
            bar_ = axis_ticks(chart.colours->axis(), tick_gap_up(chart.height));
            room_right_ = plot_to_bar + bar_width + 8 + widest(bar_) + 20;
        }
        left_ = chart_margin + line_height + widest(up_) + tick_to_label + tick_length;
        top_ = chart_margin + title_ascent + title_to_plot + legend_.height();
    }

    // The last label of the axis across is centred under the plot's corner.
    int width() const {
        const int beside = left_ + chart_.width + std::max(room_right_, chart_margin);
        const int titled = left_ + ceiled(text_width(chart_.title, title_style_));
        return std::max(beside, titled) + chart_margin;
    }
    int height() const {
        return top_ + chart_.height + tick_length + tick_to_label + label_ascent + line_height + 2 +
               chart_margin - label_ascent / 2;
    }

    // Draws the chart with its upper left corner at (x, y).
    void draw(Drawing& drawing, int x, int y) const {
        const PlotArea plot{x + left_, y + top_, chart_.width, chart_.height};
        drawing.write(chart_.title, plot.x, y + chart_margin + title_ascent, TextAlign::left,
                      title_style_);
        draw_plot(drawing, plot);
        draw_border(drawing, plot);
        draw_ticks_across(drawing, plot);
        draw_ticks_up(drawing, plot, x);
        if (chart_.colours) draw_bar(drawing, plot);
        draw_legend(drawing, plot);
    }

  private:
    void draw_plot(Drawing& drawing, const PlotArea& plot) const {
        if (chart_.picture.rgb.empty()) {
            draw_grid(drawing, plot);
        } else {
            drawing.items.emplace_back(PlacedPicture{chart_.picture, plot.x, plot.y});
        }
        for (const ChartLine& line : chart_.lines) draw_curve(drawing, plot, line);
        if (!chart_.points.empty()) draw_points(drawing, chart_, plot);
    }

    void draw_grid(Drawing& drawing, const PlotArea& plot) const {
        for (const AxisTick& tick : across_) {
            drawing.fill(plot.x + pixel_at(tick.t, plot.width), plot.y, 1, plot.height,
                         grid_colour);
        }
        for (const AxisTick& tick : up_) {
            drawing.fill(plot.x, plot.y + plot.height - 1 - pixel_at(tick.t, plot.height),
                         plot.width, 1, grid_colour);
        }
    }

    void draw_curve(Drawing& drawing, const PlotArea& plot, const ChartLine& line) const {
        std::vector<DrawingPoint> run;
        const auto finish_run = [&] {
            if (run.size() == 1) run.push_back(run.front());  // a dot
            if (!run.empty()) drawing.line(std::exchange(run, {}), curve_width, line.colour);
        };
        for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i) {
            if (can_show(chart_.across, line.x[i]) && can_show(chart_.up, line.y[i])) {
                run.push_back(place_in(plot, chart_, line.x[i], line.y[i]));
            } else {
                finish_run();
            }
        }
        finish_run();
    }

    void draw_ticks_across(Drawing& drawing, const PlotArea& plot) const {
        const int below = plot.y + plot.height;
        const int baseline = below + tick_length + tick_to_label + label_ascent;
        for (const double t : minor_ticks(chart_.across, 3.0 / plot.width)) {
            drawing.fill(plot.x + pixel_at(t, plot.width), below, 1, tick_length / 2,
                         border_colour);
        }
        for (const AxisTick& tick : across_) {
            const int x = plot.x + pixel_at(tick.t, plot.width);
            drawing.fill(x, below, 1, tick_length, border_colour);
            drawing.write(tick.label, x + 0.5, baseline, TextAlign::centre, tick_style);
        }
        drawing.write(chart_.across.title, plot.x + plot.width / 2.0, baseline + line_height + 2,
                      TextAlign::centre, axis_title_style);
    }

    void draw_ticks_up(Drawing& drawing, const PlotArea& plot, int left) const {
        const auto row_of = [&](double t) {
            return plot.y + plot.height - 1 - pixel_at(t, plot.height);
        };
        for (const double t : minor_ticks(chart_.up, 3.0 / plot.height)) {
            drawing.fill(plot.x - tick_length / 2, row_of(t), tick_length / 2, 1, border_colour);
        }
        for (const AxisTick& tick : up_) {
            const int y = row_of(tick.t);
            drawing.fill(plot.x - tick_length, y, tick_length, 1, border_colour);
            drawing.write(tick.label, plot.x - tick_length - tick_to_label, y + label_ascent / 2,
                          TextAlign::right, tick_style);
        }
        drawing.write_upwards(chart_.up.title, left + chart_margin + label_ascent,
                              plot.y + plot.height / 2.0, axis_title_style);
    }

    void draw_bar(Drawing& drawing, const PlotArea& plot) const {
        const PlotArea bar{plot.x + plot.width + plot_to_bar, plot.y, bar_width, plot.height};
        for (int y = 0; y < bar.height; ++y) {
            const double t = (bar.height - y - 0.5) / bar.height;
            drawing.fill(bar.x, bar.y + y, bar.width, 1, chart_.colours->colour_at(t));
        }
        draw_border(drawing, bar);
        for (const AxisTick& tick : bar_) {
            const int y = bar.y + bar.height - 1 - pixel_at(tick.t, bar.height);
            drawing.fill(bar.x + bar.width + 1, y, 3, 1, pale_ink_colour);
            drawing.write(tick.label, bar.x + bar.width + 8, y + label_ascent / 2, TextAlign::left,
                          tick_style);
        }
        drawing.write_upwards(chart_.colours->title, plot.x + plot.width + room_right_,
                              plot.y + plot.height / 2.0, axis_title_style);
    }

    void draw_legend(Drawing& drawing, const PlotArea& plot) const {
        for (const LegendRows::Entry& entry : legend_.entries()) {
            const ChartLine& line = chart_.lines[entry.index];
            const int x = plot.x + entry.x;
            const int baseline = plot.y - 12 - legend_.height() + (entry.row + 1) * legend_height;
            drawing.fill(x, baseline - 6, legend_sample, 3, line.colour);
            drawing.write(line.name, x + legend_sample + 6, baseline, TextAlign::left, tick_style);
        }
    }

    const Chart& chart_;
    TextStyle title_style_;
    std::vector<AxisTick> across_;
    std::vector<AxisTick> up_;
    std::vector<AxisTick> bar_;
    LegendRows legend_;
    int left_ = 0;
    int top_ = 0;
    int room_right_ = 0;  // beside the plot, for a colour bar
};

// --- Figures ------------------------------------------------------------------------------------

constexpr int figure_margin = 24;
constexpr int subtitle_height = 17;

// Draws the samples of all families and of the front, in rows from `top` on.
void draw_families(Drawing& drawing, const Figure& figure, const LegendRows& legend, int top) {
    for (const LegendRows::Entry& entry : legend.entries()) {
        const int x = figure_margin + entry.x;
        const int y = top + entry.row * legend_height + legend_height / 2;
        const bool is_family = entry.index < figure.families.size();
        if (is_family) {
            draw_marker(drawing, {x + legend_sample / 2.0, double(y)},
                        static_cast<int>(entry.index));
        } else {
            draw_front_sample(drawing, {double(x), double(y)}, legend_sample);
        }
        drawing.write(is_family ? figure.families[entry.index] : figure.front_name,
                      x + legend_sample + 6, y + label_ascent / 2, TextAlign::left, tick_style);
    }
}

std::vector<double> all_of(const std::vector<ChartLine>& lines,
                           std::vector<double> ChartLine::*values) {
    std::vector<double> all;
    for (const ChartLine& line : lines) {
        all.insert(all.end(), (line.*values).begin(), (line.*values).end());
    }
    return all;
}

std::vector<double> all_of(const std::vector<ChartPoint>& points, double ChartPoint::*value) {
    return mapped<double>(points, [&](const ChartPoint& point) { return point.*value; });
}

}  // namespace

Drawing drawing_of(const Chart& chart) {
    Drawing drawing;
    if (chart.width <= 0 || chart.height <= 0) return drawing;
    const ChartLayout layout(chart, title_style);
    drawing.width = layout.width();
    drawing.height = layout.height();
    drawing.title = chart.title;
    layout.draw(drawing, 0, 0);
    return drawing;
}

Drawing drawing_of(const Figure& figure) {
    Drawing drawing;
    drawing.title = figure.title;
    std::vector<ChartLayout> layouts;
    int panels_width = 0, panels_height = 0;
    for (const Chart& chart : figure.charts) {
        layouts.emplace_back(chart, panel_title_style);
        panels_width += layouts.back().width();
        panels_height = std::max(panels_height, layouts.back().height());
    }
    double text = text_width(figure.title, figure_title_style);
    for (const std::string& subtitle : figure.subtitles) {
        text = std::max(text, text_width(subtitle, subtitle_style));
    }
    drawing.width = std::max(panels_width, ceiled(text)) + 2 * figure_margin - chart_margin;
    int y = figure_margin + title_ascent;
    drawing.write(figure.title, figure_margin, y, TextAlign::left, figure_title_style);
    for (const std::string& subtitle : figure.subtitles) {
        y += subtitle_height;
        drawing.write(subtitle, figure_margin, y + 4, TextAlign::left, subtitle_style);
    }
    y += title_to_plot;
    int x = figure_margin - chart_margin;
    for (const ChartLayout& layout : layouts) {
        layout.draw(drawing, x, y);
        x += layout.width();
    }
    y += panels_height;
    std::vector<std::string> names = figure.families;
    names.push_back(figure.front_name);
    const LegendRows legend(names, drawing.width - 2 * figure_margin);
    draw_families(drawing, figure, legend, y);
    drawing.height = y + legend.height() + figure_margin / 2;
    return drawing;
}

int family_index(std::vector<std::string>& families, const std::string& family) {
    const auto at = std::ranges::find(families, family);
    const auto index = at - families.begin();
    if (at == families.end()) families.push_back(family);
    return static_cast<int>(index);
}

// --- Kinds of charts ----------------------------------------------------------------------------

Picture false_colour_chart(const Image2<float>& field, const ColourScale& scale,
                           const std::string& title, const ChartAxis& across, const ChartAxis& up,
                           int smallest_edge) {
    const int longest_edge = std::max(1024, 2 * smallest_edge);
    Picture plot = in_false_colours(fitted(field, smallest_edge, longest_edge), scale);
    const int width = plot.width, height = plot.height;
    return painted(
        on_dark_paper(drawing_of(Chart{title, across, up, width, height, std::move(plot), scale})));
}

Picture framed(const Picture& picture, const std::string& title, const ChartAxis& across,
               const ChartAxis& up) {
    return painted(on_dark_paper(
        drawing_of(Chart{title, across, up, picture.width, picture.height, picture})));
}

Picture line_chart(const std::vector<ChartLine>& lines, const std::string& title,
                   const std::string& x_title, const std::string& y_title, bool logarithmic_x,
                   bool logarithmic_y) {
    constexpr int width = 600, height = 320;
    constexpr double room_above = 0.04;  // so that no curve hides under the frame
    Chart chart{title, axis_over(x_title, all_of(lines, &ChartLine::x), logarithmic_x, 0),
                axis_over(y_title, all_of(lines, &ChartLine::y), logarithmic_y, room_above), width,
                height};
    chart.lines = lines;
    return painted(drawing_of(chart));
}

Chart scatter_chart(std::vector<ChartPoint> points, const std::string& title,
                    const std::string& x_title, const std::string& y_title) {
    constexpr int width = 430, height = 380;
    // Errors below the resolution of a double on a scale of 1 cannot be distinguished.
    constexpr double smallest_shown = 1e-17;
    Chart chart{title, rounded_axis(x_title, all_of(points, &ChartPoint::x), smallest_shown),
                rounded_axis(y_title, all_of(points, &ChartPoint::y), smallest_shown), width,
                height};
    chart.points = std::move(points);
    return chart;
}

}  // namespace skybake
