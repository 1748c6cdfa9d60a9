// The points of a chart: markers, the line of their front, and names that cover neither each other
// nor the points.
#pragma once

#include <optional>
#include <vector>

#include "bakers/plot/chart.h"

namespace skybake {

// Where the plot of a chart is in its drawing, in pixels.
struct PlotArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

DrawingPoint place_in(const PlotArea& plot, const Chart& chart, double x, double y);

void draw_points(Drawing& drawing, const Chart& chart, const PlotArea& plot);

// The marker of a family, which has its own colour and shape.
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

// A name to be written near (x, y).
struct Label {
    double x = 0;
    double y = 0;
    double width = 0;
    double height = 0;
};

// The box of each label, in the order given: the earlier chooses first. Boxes stay within `area`
// and touch neither one another nor an obstacle; of the places left, a label takes the one that
// lies nearest and crosses the fewest lines. None where there is no such place.
std::vector<std::optional<Box>> place_labels(const std::vector<Label>& labels, const Box& area,
                                             const std::vector<Box>& obstacles,
                                             const std::vector<Segment>& lines);

}  // namespace skybake
