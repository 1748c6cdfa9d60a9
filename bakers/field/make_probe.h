// Probes: places where a runtime can check its lookup of a stored table.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked_table.h"
#include "bakers/field/choose_probes.h"
#include "bakers/field/table_model.h"

namespace skybake {

// The lookup of a stored image at (u, v), with the room that a GPU's filtering in 1/256 texel steps
// and the pixel type's rounding need. The physical place, Probe::at, is the caller's to fill.
Probe make_probe(const Image2<float>& image, double u, double v, config::PixelType type);

// A table as its probes are chosen from; asks for the image's texels, which must outlive it.
ReadableTexture readable_texture(const Image2<float>& image);

// The physical coordinates of an error or of a probe.
using Place = std::vector<std::pair<std::string, double>>;

// Where the probes of a table may lie: coordinates (x, y) in [0, 1], of which model.probe_place
// moves some, told by their places.
ProbeSpace table_space(const TableModel& model, std::array<int, 2> size,
                       std::function<Place(double x, double y)> place_of);

// Fills probes and catches of a table whose image is made of as many tables of one size, one below
// the other, as there are spaces, each with places of its own. E0407.
std::optional<config::Diagnostic> add_probes(std::vector<ProbeSpace> spaces,
                                             const BakeOptions& options, BakedTable& table);

}  // namespace skybake
