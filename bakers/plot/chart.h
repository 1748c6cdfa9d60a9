// Charts: pictures with what makes them readable, curves and points over axes with units.
//
// A chart is drawn once, as a Drawing, which becomes pixels or an SVG file (drawing.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/plot/axis.h"
#include "bakers/plot/drawing.h"
#include "bakers/plot/false_colours.h"

namespace skybake {

// A curve, with a gap wherever an axis cannot show a value.
struct ChartLine {
    std::string name;  // in the legend; empty: not there
    Colour colour{};
    std::vector<double> x;
    std::vector<double> y;
};

// Values that are not positive stand at the low end of a logarithmic axis.
struct ChartPoint {
    double x = 0;
    double y = 0;
    int family = 0;           // index into Figure::families: colour and marker
    std::string label;        // written beside it where there is room; empty: none
    std::string tooltip;      // what a viewer of the file shows under the pointer; empty: none
    bool emphasised = false;  // ringed, its label bold and placed before others
    bool on_front = false;    // joined by the line of the front
};

struct Chart {
    std::string title;
    ChartAxis across;
    ChartAxis up;
    int width = 0;                            // of what is between the axes, in pixels
    int height = 0;                           // the same
    Picture picture = {};                     // of that size; empty: a grid on paper
    std::optional<ColourScale> colours = {};  // of the picture, as a bar beside it
    std::vector<ChartLine> lines = {};
    std::vector<ChartPoint> points = {};
};

// Charts beside each other under one title, with one legend of their points.
struct Figure {
    std::string title;
    std::vector<std::string> subtitles;  // one a line
    std::vector<std::string> families;   // of points
    std::string front_name;              // of the line that joins points
    std::vector<Chart> charts;
};

Drawing drawing_of(const Chart& chart);
Drawing drawing_of(const Figure& figure);

// A scalar field in false colours (one channel; row 0 at the bottom; grey where it is NaN),
// enlarged to at least `smallest_edge` pixels along its longer edge by nearest texels, with axes
// and colour bar. Fields of more than 1024 texels along an edge, or 2 smallest_edge, are averaged.
// An empty field has an empty chart.
Picture false_colour_chart(const Image2<float>& field, const ColourScale& scale,
                           const std::string& title, const ChartAxis& across, const ChartAxis& up,
                           int smallest_edge = 512);

// A finished picture (row 0 at the top) in the same frame, without a colour bar; of an empty
// one, an empty chart.
Picture framed(const Picture& picture, const std::string& title, const ChartAxis& across,
               const ChartAxis& up);

// Curves over a shared axis: profiles, histograms, spectra.
Picture line_chart(const std::vector<ChartLine>& lines, const std::string& title,
                   const std::string& x_title, const std::string& y_title, bool logarithmic_x,
                   bool logarithmic_y);

// Points over logarithmic axes, for a figure; errors of 0 stand at the lowest place that is drawn.
Chart scatter_chart(std::vector<ChartPoint> points, const std::string& title,
                    const std::string& x_title, const std::string& y_title);

// Where a family stands among those of a figure; a new one is appended.
int family_index(std::vector<std::string>& families, const std::string& family);

// Pictures in a grid of `columns`, each with its caption below; for contact sheets and comparisons.
Picture contact_sheet(const std::vector<Picture>& pictures,
                      const std::vector<std::string>& captions, int columns);

}  // namespace skybake
