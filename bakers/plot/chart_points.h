// Draws the points of a chart: their markers, the line of their front, and labels that cover
// neither each other nor the points.
#pragma once

#include <optional>
#include <vector>

#include "bakers/plot/chart.h"

namespace skybake {

// The area of a chart's plot in its drawing, in pixels.
struct PlotArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

DrawingPoint place_in(const PlotArea& plot, const Chart& chart, double x, double y);

void draw_points(Drawing& drawing, const Chart& chart, const PlotArea& plot);

// Draws the marker of a family. Each family has its own colour and shape.
void draw_marker(Drawing& drawing, DrawingPoint at, int family);

void draw_front_sample(Drawing& drawing, DrawingPoint left, double length);

struct Box {
    double left = 0;
    double top = 0;
    double right = 0;
    double bottom = 0;
};

struct Segment {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// The size of a label that is to be placed near (x, y).
struct Label {
    double x = 0;
    double y = 0;
    double width = 0;
    double height = 0;
};

// Returns a box for each label. Labels are placed in the given order. Boxes stay within `area` and
// touch neither each other nor an obstacle. Among the remaining places, a label takes one that is near
// and crosses few lines; a label without any place gets no box.
std::vector<std::optional<Box>> place_labels(const std::vector<Label>& labels, const Box& area,
                                             const std::vector<Box>& obstacles,
                                             const std::vector<Segment>& lines);

}  // namespace skybake
