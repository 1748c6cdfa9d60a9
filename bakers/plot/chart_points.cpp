#include "bakers/plot/chart_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace skybake {
namespace {

constexpr double marker_size = 4.5;  // about half a marker's width, in pixels
constexpr double front_width = 1.5;
constexpr Colour front_colour = {0x44, 0x4c, 0x56};
constexpr TextStyle point_style = {11, FontWeight::regular, ink_colour};
constexpr TextStyle emphasised_style = {11, FontWeight::bold, ink_colour};

// --- Markers ------------------------------------------------------------------------------------

// The colours of Okabe & Ito, "Color Universal Design", 2008, and a grey. They can be distinguished
// with all kinds of colour vision.
constexpr std::array<Colour, 8> family_colours = {{{0x00, 0x72, 0xb2},
                                                   {0xd5, 0x5e, 0x00},
                                                   {0x00, 0x9e, 0x73},
                                                   {0xcc, 0x79, 0xa7},
                                                   {0xe6, 0x9f, 0x00},
                                                   {0x56, 0xb4, 0xe9},
                                                   {0x00, 0x00, 0x00},
                                                   {0x8c, 0x8c, 0x8c}}};

// Returns the corners of a family's marker around the origin, in units of its size. A circle has
// none.
const std::vector<DrawingPoint>& corners_of(int family) {
    static const std::array<std::vector<DrawingPoint>, 8> shapes = {{
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

// --- Places of labels ---------------------------------------------------------------------------

constexpr double label_gap = 1.5;  // between a label and anything else
constexpr std::array<double, 7> label_distances = {9, 14, 22, 32, 46, 64, 86};
constexpr int label_directions = 16;
constexpr double price_of_crossing = 14;  // equals this many pixels of distance
constexpr double price_of_leaning = 5;    // for a place above or below, where leaders read worse

bool overlap(const Box& a, const Box& b) {
    return a.left < b.right + label_gap && b.left < a.right + label_gap &&
           a.top < b.bottom + label_gap && b.top < a.bottom + label_gap;
}

bool within(const Box& box, const Box& area) {
    return box.left >= area.left && box.right <= area.right && box.top >= area.top &&
           box.bottom <= area.bottom;
}

// Whether a segment passes through a box, by clipping its parameter range.
bool crosses(const Segment& line, const Box& box) {
    double from = 0;
    double to = 1;
    const auto clip = [&](double start, double step, double low, double high) {
        if (step == 0) return start >= low && start <= high;
        const double a = (low - start) / step;
        const double b = (high - start) / step;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
        return from <= to;
    };
    return clip(line.x0, line.x1 - line.x0, box.left, box.right) &&
           clip(line.y0, line.y1 - line.y0, box.top, box.bottom);
}

// Returns the label's box whose nearest side or corner is at a given distance and in a given
// direction.
Box box_at(const Label& label, double distance, double angle) {
    const double across = std::cos(angle);
    const double down = std::sin(angle);
    const double x = label.x + distance * across + across * label.width / 2;
    const double y = label.y + distance * down + down * label.height / 2;
    return {x - label.width / 2, y - label.height / 2, x + label.width / 2, y + label.height / 2};
}

// Returns the line from the point to the nearest place of its label.
Segment leader_of(const Label& label, const Box& box) {
    return {label.x, label.y, std::clamp(label.x, box.left, box.right),
            std::clamp(label.y, box.top, box.bottom)};
}

class PointDrawing {
  public:
    PointDrawing(Drawing& drawing, const Chart& chart, const PlotArea& plot)
        : drawing_(drawing), chart_(chart), plot_(plot) {}

    void draw() {
        const std::vector<Segment> front = front_lines();
        for (const Segment& line : front) draw_line(line, front_width, front_colour);
        draw_markers();
        draw_labels(front);
    }

  private:
    DrawingPoint place_of(const ChartPoint& point) const {
        return place_in(plot_, chart_, point.x, point.y);
    }

    void draw_line(const Segment& line, double width, Colour colour) {
        drawing_.line({{line.x0, line.y0}, {line.x1, line.y1}}, width, colour);
    }

    std::vector<Segment> front_lines() const {
        std::vector<const ChartPoint*> front;
        for (const ChartPoint& point : chart_.points) {
            if (point.on_front && std::isfinite(point.x)) front.push_back(&point);
        }
        std::ranges::sort(front,
                          [](const ChartPoint* a, const ChartPoint* b) { return a->x < b->x; });
        std::vector<Segment> lines;
        for (std::size_t i = 1; i < front.size(); ++i) {
            const DrawingPoint from = place_of(*front[i - 1]), to = place_of(*front[i]);
            lines.push_back({from.x, from.y, to.x, to.y});
        }
        return lines;
    }

    // Draws emphasised points on top of all others. Otherwise, earlier points are on top, because
    // later families are variations of earlier ones.
    void draw_markers() {
        for (const bool emphasised : {false, true}) {
            for (auto at = chart_.points.rbegin(); at != chart_.points.rend(); ++at) {
                if (at->emphasised == emphasised) draw_point(*at);
            }
        }
    }

    void draw_point(const ChartPoint& point) {
        const DrawingPoint place = place_of(point);
        if (point.emphasised) {
            Shape ring;
            ring.points = {place};
            ring.radius = marker_size + 3.5;
            ring.stroke_width = 1.3;
            drawing_.items.emplace_back(std::move(ring));
        }
        draw_marker(drawing_, place, point.family);
        if (!point.tooltip.empty()) drawing_.tooltips.push_back({place, point.tooltip});
    }

    // Returns the points with labels, the most important first. If several points share a label and
    // almost share a place, only one is returned.
    std::vector<const ChartPoint*> labelled() const {
        constexpr double same_place = 24;  // pixels
        std::vector<const ChartPoint*> points;
        for (const bool emphasised : {true, false}) {
            for (const ChartPoint& point : chart_.points) {
                const DrawingPoint place = place_of(point);
                const bool told = std::ranges::any_of(points, [&](const auto* other) {
                    const DrawingPoint there = place_of(*other);
                    return !point.emphasised && other->label.ends_with(point.label) &&
                           std::hypot(there.x - place.x, there.y - place.y) < same_place;
                });
                if (point.emphasised == emphasised && !point.label.empty() && !told) {
                    points.push_back(&point);
                }
            }
        }
        return points;
    }

    static const TextStyle& style_of(const ChartPoint& point) {
        return point.emphasised ? emphasised_style : point_style;
    }

    static double clearance(const ChartPoint& point) {
        return marker_size + (point.emphasised ? 4 : 1);
    }

    void draw_labels(const std::vector<Segment>& front) {
        const std::vector<const ChartPoint*> points = labelled();
        std::vector<Label> wanted;
        for (const ChartPoint* point : points) {
            const DrawingPoint place = place_of(*point);
            wanted.push_back({place.x, place.y, text_width(point->label, style_of(*point)) + 2,
                              point_style.em_pixels + 1.0});
        }
        std::vector<Box> obstacles;
        for (const ChartPoint& point : chart_.points) {
            const double half = clearance(point);
            const DrawingPoint at = place_of(point);
            obstacles.push_back({at.x - half, at.y - half, at.x + half, at.y + half});
        }
        const Box inner = {plot_.x + 8.0, plot_.y + 4.0, plot_.x + plot_.width - 4.0,
                           plot_.y + plot_.height - 8.0};
        const auto boxes = place_labels(wanted, inner, obstacles, front);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (boxes[i]) draw_label(*points[i], wanted[i], *boxes[i]);
        }
    }

    // Draws the label on a background of paper, which keeps lines off the letters. If its point is
    // not near, a thin line leads to it.
    void draw_label(const ChartPoint& point, const Label& wanted, const Box& box) {
        const Segment leader = leader_of(wanted, box);
        const double length = std::hypot(leader.x1 - leader.x0, leader.y1 - leader.y0);
        const double clear = clearance(point);
        if (length > clear + 11) {
            const double t = clear / length;
            draw_line({leader.x0 + t * (leader.x1 - leader.x0),
                       leader.y0 + t * (leader.y1 - leader.y0), leader.x1, leader.y1},
                      0.7, pale_ink_colour);
        }
        Shape paper;
        paper.points = {{box.left, box.top},
                        {box.right, box.top},
                        {box.right, box.bottom},
                        {box.left, box.bottom}};
        paper.closed = true;
        paper.fill = paper_colour;
        drawing_.items.emplace_back(std::move(paper));
        drawing_.write(point.label, (box.left + box.right) / 2, box.bottom - 2.5, TextAlign::centre,
                       style_of(point));
    }

    Drawing& drawing_;
    const Chart& chart_;
    const PlotArea& plot_;
};

}  // namespace

std::vector<std::optional<Box>> place_labels(const std::vector<Label>& labels, const Box& area,
                                             const std::vector<Box>& obstacles,
                                             const std::vector<Segment>& lines) {
    std::vector<Box> taken = obstacles;
    std::vector<Segment> drawn = lines;
    std::vector<std::optional<Box>> boxes;
    for (const Label& label : labels) {
        std::optional<Box> best;
        double best_price = 0;
        for (const double distance : label_distances) {
            for (int i = 0; i < label_directions; ++i) {
                const double angle = 2 * std::numbers::pi * i / label_directions;
                const Box box = box_at(label, distance, angle);
                if (!within(box, area)) continue;
                const auto hit = [&](const Box& other) { return overlap(box, other); };
                if (std::ranges::any_of(taken, hit)) continue;
                double price = distance + price_of_leaning * std::fabs(std::sin(angle));
                for (const Segment& line : drawn) {
                    if (crosses(line, box)) price += price_of_crossing;
                }
                if (!best || price < best_price) {
                    best = box;
                    best_price = price;
                }
            }
        }
        if (best) {
            taken.push_back(*best);
            drawn.push_back(leader_of(label, *best));
        }
        boxes.push_back(best);
    }
    return boxes;
}

// --- Points -------------------------------------------------------------------------------------

DrawingPoint place_in(const PlotArea& plot, const Chart& chart, double x, double y) {
    return {plot.x + place_on(chart.across, x) * plot.width,
            plot.y + (1 - place_on(chart.up, y)) * plot.height};
}

void draw_marker(Drawing& drawing, DrawingPoint at, int family) {
    Shape marker;
    marker.closed = true;
    marker.fill = family_colours[static_cast<std::size_t>(family) % family_colours.size()];
    marker.stroke = paper_colour;
    marker.stroke_width = 0.7;
    for (const DrawingPoint& corner : corners_of(family)) {
        marker.points.push_back({at.x + marker_size * corner.x, at.y + marker_size * corner.y});
    }
    if (marker.points.empty()) {
        marker.points = {at};
        marker.radius = marker_size;
    }
    drawing.items.emplace_back(std::move(marker));
}

void draw_front_sample(Drawing& drawing, DrawingPoint left, double length) {
    drawing.line({left, {left.x + length, left.y}}, front_width, front_colour);
}

void draw_points(Drawing& drawing, const Chart& chart, const PlotArea& plot) {
    PointDrawing(drawing, chart, plot).draw();
}

}  // namespace skybake
