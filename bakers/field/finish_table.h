// The steps that all table bakers share once they know their model.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "bakers/field/baked_table.h"
#include "bakers/field/certify.h"
#include "bakers/field/make_probe.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// What a user asked of a table's accuracy, whatever the asset.
struct AccuracyRequest {
    std::array<int, 2> size{};
    std::optional<double> max_error;        // in place of size
    std::optional<double> max_texel_error;  // picks the quadrature level where size is given
    PointCounts choice;  // points that size and level are chosen by, whatever is certified
    PointCounts quick;   // how many points --certify=quick means
    PointCounts full;
};

// Names the place of an error or a probe: "altitude_km 0.02, sun_cos_zenith -0.01".
std::string place_text(const Place& place);

// Chooses size and level, bakes, rounds, measures and probes. `table` comes with its texts filled
// in; `place_of` tells the physical place of coordinates (x, y). After an interruption there is
// neither a value nor a diagnostic. E0401 a texel is not finite, E0402 beyond the pixel type, E0403
// max_error cannot be held, E0404 max_texel_error neither, E0407 no probes tell a wrong file; W0201
// texels below the pixel type's normal range.
config::Outcome<BakedTable> finish_table(const TableModel& model, const AccuracyRequest& request,
                                         const BakeOptions& options,
                                         const std::function<Place(double x, double y)>& place_of,
                                         BakedTable table);

}  // namespace skybake
