// Measures what a sky's colours cost: how many wavelengths are computed, how they become colours,
// how far these are from the colours of whole spectra, and how long the light takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"
#include "bakers/plot/chart.h"
#include "config/sections/parameters.h"
#include "config/text/quantity.h"

namespace skybake {

// One set of wavelengths, used in one way.
struct ColorErrorRow {
    std::string family;    // the way: "fitted matrix"
    std::string variant;   // the wavelengths: "best 4"
    std::string baseline;  // what is usual, or empty
    bool of_recipe = false;
    std::vector<config::Length> wavelengths;
    double time_ms = 0;     // processor time of the light of all orders, one thread
    double time_ratio = 0;  // to that of the fastest
    ColorError error;
    bool on_front = false;  // Pareto: time against median error
};

struct ColorReport {
    std::string space;    // of the colours: "linear_srgb"
    int repetitions = 0;  // each time is the median of this many
    std::vector<ColorErrorRow> rows;
};

// Measures the colours of a recipe's air, which must not be without radii; its wavelengths must be
// visible, from 380 to 780 nm. The ways of using wavelengths are:
//
//   as R, G, B         three wavelengths are shown as they are
//   factors            each of them times the factor that fits the recipe's skies best
//   linear spectrum    the weights of spectra that are linear between the wavelengths
//   fitted matrix      the weights that fit the recipe's skies best, as `bake` has them
//
// `quick` leaves out sixteen wavelengths and times once. Without a color in `parameters`, colours are
// linear sRGB. Returns nothing if the user has interrupted.
std::optional<ColorReport> measure_colors(const config::Parameters& parameters, bool quick,
                                          const BakeOptions& options);

// Returns CSV with one row per set and way. The first line names the columns. An error of 1 means
// 100 % of luminance.
std::string color_report_csv(const ColorReport& report);

// Returns one JSON object. Its keys are those of the structs in this header.
std::string color_report_json(const ColorReport& report);

// Plots time against the errors of skies, and of the sun on the horizon.
Figure color_figure(const ColorReport& report);

}  // namespace skybake
