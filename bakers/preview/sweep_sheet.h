// The contact sheet of a sweep: its axes are rows and columns, and a second sheet shows how far each
// picture is from the first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/plot/drawing.h"
#include "bakers/preview/load_sweep.h"

namespace skybake {

// The most variants that get a picture. The table lists all variants.
inline constexpr std::size_t most_pictured_variants = 144;

// Returns the sheet of the variants' pictures, and that of their differences from the first picture if
// any of them differs. A picture is empty if the variant has none. `light` says what light all
// pictures have; it may be empty.
std::vector<PreviewPicture> sweep_sheets(const PreviewSweep& sweep,
                                         const std::vector<Picture>& pictures,
                                         const std::string& light);

// Returns the root of the mean squared difference of two pictures over their channels, in [0, 255].
// Returns nothing if their sizes differ or one is empty.
std::optional<double> rms_difference(const Picture& picture, const Picture& other);

}  // namespace skybake
