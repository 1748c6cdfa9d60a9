// Scatter plots on logarithmic axes, as SVG text: one picture with panels beside each other and one
// legend. It brings its own light background, so that it reads in dark viewers too.
#pragma once

#include <string>
#include <vector>

namespace skybake {

struct PlotPoint {
    double x = 0;
    double y = 0;
    int family = 0;           // index into Plot::families: colour and marker
    std::string label;        // written beside it where there is room; empty: none
    std::string tooltip;      // what a viewer shows under the pointer
    bool emphasised = false;  // ringed, its label bold and placed before others
    bool on_front = false;    // joined by the line of the front
};

struct PlotPanel {
    std::string title;
    std::string x_title;
    std::string y_title;
    std::vector<PlotPoint> points;
};

struct Plot {
    std::string title;
    std::vector<std::string> subtitles;  // one a line
    std::vector<std::string> families;
    std::string front_name;
    std::vector<PlotPanel> panels;
};

// Where a family stands among those of a plot; a new one is appended.
int family_index(std::vector<std::string>& families, const std::string& family);

// Well-formed XML whatever the texts hold. Errors of 0 stand at the lowest place that is drawn.
std::string svg_of(const Plot& plot);

}  // namespace skybake
