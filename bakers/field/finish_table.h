// The steps that all table bakers share once they have a model: choosing a size, making the texels,
// checking their range, measuring their error, and adding levels of detail and probes.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/field/choose_probes.h"
#include "bakers/field/error_search.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// The accuracy that a user asked of a table.
struct AccuracyRequest {
    std::array<int, 2> size{};
    std::optional<double> max_error;        // replaces size
    std::optional<double> max_texel_error;  // chooses the quadrature level if size is given
    PointCounts choice;  // points for choosing size and level; independent of --certify
    PointCounts quick;   // how many texels --certify=quick compares
    PointCounts full;
    SearchCounts quick_search;  // how far --certify=quick searches the errors of lookups
    SearchCounts full_search;
};

// Returns the physical coordinates for the table coordinates (x, y).
using PlaceOf = std::function<Place(double x, double y)>;

// Describes the place of an error or a probe: "altitude_km 0.02, sun_cos_zenith -0.01".
std::string place_text(const Place& place);

// A table with its texels and figures, and the places where its probes may lie.
struct TablePart {
    Baked table;
    ProbeSpace space;
};

// Chooses a size and a quadrature level, then bakes, rounds and measures the texels. The caller has
// filled in the texts of `table`. After an interruption there is neither a value nor a diagnostic.
//
// Errors: E0401 if a texel is not finite, E0402 if it is beyond the pixel type's range, E0403 if
// max_error cannot be met, E0404 if max_texel_error cannot be met, E0405 if physics does not allow
// a value. Warning: W0201 if texels are below the pixel type's normal range.
Outcome<TablePart> make_part(const TableModel& model, const AccuracyRequest& request,
                             const BakeOptions& options, const PlaceOf& place_of, Baked table);

// The parts of a table; nothing if one of them could not be made.
using StackedParts = Outcome<std::vector<TablePart>>;

// Adds a part and what there is to say of it. Returns whether there is such a part.
bool add_part(Outcome<TablePart> part, StackedParts& parts);

// Joins parts of the same size, channels and pixel type to one table: part k of n lies at v from
// k/n to (k + 1)/n. The table has the texts of the first part; its range counts and its certificate
// cover all parts. Adds levels of detail, surveys them and chooses their probes, some in each part.
// E0407 if the probes cannot detect a wrong file. After an interruption there is neither a value
// nor a diagnostic. `change`, if there is one, comes before levels are added: it may change texels, which
// it rounds itself (store_texels), and add all levels, which are means otherwise.
using ChangeTable = std::function<void(Baked& table)>;
Outcome<Baked> stack_tables(StackedParts parts, const BakeOptions& options,
                            const ChangeTable& change = nullptr);

// Adds a level of texels, rounded to the table's pixel type.
void add_level(const Image2<double>& texels, Baked& table);

// Makes a table of one part: make_part, then stack_tables.
Outcome<Baked> finish_table(const TableModel& model, const AccuracyRequest& request,
                            const BakeOptions& options, const PlaceOf& place_of, Baked table);

}  // namespace skybake
