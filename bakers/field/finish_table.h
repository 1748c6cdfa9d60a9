// The steps that all table bakers share once they know their model: the choice of a size, texels,
// their range and error, levels of detail, probes.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/field/choose_probes.h"
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

// The physical coordinates of coordinates (x, y) of a table.
using PlaceOf = std::function<Place(double x, double y)>;

// Names the place of an error or a probe: "altitude_km 0.02, sun_cos_zenith -0.01".
std::string place_text(const Place& place);

// A table that has its texels and figures, and the places that its probes may have.
struct TablePart {
    Baked table;
    ProbeSpace space;
};

// Chooses size and level, bakes, rounds and measures. `table` comes with its texts filled in. After
// an interruption there is neither a value nor a diagnostic. E0401 a texel is not finite, E0402
// beyond the pixel type, E0403 max_error cannot be held, E0404 max_texel_error neither, E0405 a
// value that physics does not allow; W0201 texels below the pixel type's normal range.
config::Outcome<TablePart> make_part(const TableModel& model, const AccuracyRequest& request,
                                     const BakeOptions& options, const PlaceOf& place_of,
                                     Baked table);

// The table of one part, or of several of one size, channels and pixel type below each other: part
// k of n stands at v from k / n to (k + 1) / n. The first one's texts speak for all; range counts
// and certificates are those of all parts together. Adds levels of detail, surveys them and chooses
// their probes, some of each part. E0407 no probes tell a wrong file; no value and no diagnostics
// after an interruption.
config::Outcome<Baked> stack_tables(std::vector<TablePart> parts, const BakeOptions& options);

// A table of one part.
config::Outcome<Baked> finish_table(const TableModel& model, const AccuracyRequest& request,
                                    const BakeOptions& options, const PlaceOf& place_of,
                                    Baked table);

}  // namespace skybake
