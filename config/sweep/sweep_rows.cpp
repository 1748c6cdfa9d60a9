// The keys of [sweep] itself, and of a range in it. All other keys of [sweep] are paths of keys.
#include "config/sweep/sweep_rows.h"
#include "config/fields/fields.h"
#include "config/sweep/sweep.h"

namespace skybake::config {
namespace {

constexpr Range value_count_range{2, most_variants};
constexpr Range points_range{1, most_variants};

constexpr std::array scale_choices = {
    Choice{SweepScale::linear, "linear", "equal differences"},
    Choice{SweepScale::log, "log", "equal ratios, which need from and to above 0"},
};

constexpr std::array sweep_table = {
    Field{.key = "zip",
          .kind = Kind::path_groups,
          .documentation =
              "keys varied in lockstep instead of crossed, with equally many values each"},
    Field{.key = "sobol",
          .kind = Kind::integer,
          .range = points_range,
          .documentation = "points of a Sobol sequence that cover all ranges without a count",
          .hint = "a power of two covers them best",
          .citation = "Joe and Kuo 2008, Constructing Sobol sequences with better two-dimensional "
                      "projections"},
};

constexpr std::array range_table = {
    Field{.key = "from",
          .kind = Kind::swept,
          .required = true,
          .documentation = "the first value, written as the key takes it"},
    Field{.key = "to",
          .kind = Kind::swept,
          .required = true,
          .documentation = "the last value; Sobol points stay below it"},
    Field{.key = "count",
          .kind = Kind::integer,
          .range = value_count_range,
          .documentation = "number of values, with both ends; without it `sobol` says how many"},
    Field{.key = "scale",
          .kind = Kind::choice,
          .choices = scale_choices,
          .fallback = R"("linear")",
          .documentation = "how the values are spaced"},
};

}  // namespace

std::span<const Field> sweep_fields() { return sweep_table; }

std::span<const Field> sweep_range_fields() { return range_table; }

}  // namespace skybake::config
