// Charts: pictures, curves and points over axes with titles, units and legends.
//
// A chart becomes a Drawing, which becomes pixels or an SVG file (drawing.h). Pictures and fields of
// colours are on dark paper, against which light is judged best and which suits light and dark pages.
// Curves and points are on white paper, which a dark page inverts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/plot/axis.h"
#include "bakers/plot/drawing.h"
#include "bakers/plot/false_colours.h"

namespace skybake {

// A curve. It has gaps at values that an axis cannot show.
struct ChartLine {
    std::string name;  // in the legend; empty: no entry
    Colour colour{};
    std::vector<double> x;
    std::vector<double> y;
};

// A point. On a logarithmic axis, values that are not positive are shown at its low end.
struct ChartPoint {
    double x = 0;
    double y = 0;
    int family = 0;           // index into Figure::families: colour and marker
    std::string label;        // written beside it if there is room; empty: none
    std::string tooltip;      // shown by viewers of the file under the pointer; empty: none
    bool emphasised = false;  // has a ring; its label is bold and placed before others
    bool on_front = false;    // joined by the line of the front
};

struct Chart {
    std::string title;
    ChartAxis across;
    ChartAxis up;
    int width = 0;                            // of the area between the axes, in pixels
    int height = 0;                           // the same
    Picture picture = {};                     // of this size; empty: a grid on paper
    std::optional<ColourScale> colours = {};  // the picture's, shown as a bar beside it
    std::vector<ChartLine> lines = {};
    std::vector<ChartPoint> points = {};
};

// Charts side by side under one title, with one legend for their points.
struct Figure {
    std::string title;
    std::vector<std::string> subtitles;  // one per line
    std::vector<std::string> families;   // of points
    std::string front_name;              // name of the line that joins points
    std::vector<Chart> charts;
};

Drawing drawing_of(const Chart& chart);
Drawing drawing_of(const Figure& figure);

// Draws a scalar field (one channel, row 0 at the bottom) in false colours, with axes and a colour
// bar; NaN is grey. The field is enlarged by nearest texels to at least `smallest_edge` pixels
// along its longer edge. Fields of more than 1024 texels along an edge, or 2 smallest_edge, are
// averaged. An empty field gives an empty chart.
Picture false_colour_chart(const Image2<float>& field, const ColourScale& scale,
                           const std::string& title, const ChartAxis& across, const ChartAxis& up,
                           int smallest_edge = 512);

// Draws a finished picture (row 0 at the top) in the same frame, without a colour bar. An empty
// picture gives an empty chart.
Picture framed(const Picture& picture, const std::string& title, const ChartAxis& across,
               const ChartAxis& up);

// Draws curves over a shared axis: profiles, histograms, spectra.
Picture line_chart(const std::vector<ChartLine>& lines, const std::string& title,
                   const std::string& x_title, const std::string& y_title, bool logarithmic_x,
                   bool logarithmic_y);

// Makes a chart of points over logarithmic axes, for a figure. Errors of 0 are shown at the low end
// of the axis.
Chart scatter_chart(std::vector<ChartPoint> points, const std::string& title,
                    const std::string& x_title, const std::string& y_title);

// Returns the index of a family among those of a figure. A new family is appended.
int family_index(std::vector<std::string>& families, const std::string& family);

// Arranges pictures in a grid of `columns` columns, each with its caption below. Contact sheets and
// comparisons are made so.
Picture contact_sheet(const std::vector<Picture>& pictures,
                      const std::vector<std::string>& captions, int columns);

// Pictures by row and column, with the names of both beside them.
struct SheetBlock {
    std::string title;  // above the block; may be empty
    std::vector<std::string> columns;
    std::vector<std::string> rows;
    std::vector<Picture> pictures;  // row by row; an empty picture leaves a gap
};

// Arranges blocks below each other, with the columns of all blocks in line.
Picture contact_sheet(const std::vector<SheetBlock>& blocks);

}  // namespace skybake
