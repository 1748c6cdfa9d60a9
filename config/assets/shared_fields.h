// Keys that several bake sections share, described once, for the field tables.
#pragma once

#include <array>

#include "config/fields/fields.h"
#include "config/fields/shared_ranges.h"
#include "config/sections/files.h"
#include "config/sections/sky_choices.h"

namespace skybake::config {

inline constexpr Field asset_field{
    .key = "asset",
    .kind = Kind::text,
    .documentation = "asset to bake; by default the one that the section's name says"};

inline constexpr std::array orders_choices = {
    Choice{SkyOrders::all, "all", "all light"},
    Choice{SkyOrders::single, "single", "sunlight scattered once, in the air"},
    Choice{SkyOrders::multiple, "multiple",
           "the rest: scattered more than once, or reflected by the ground"},
};
inline constexpr Field orders_field{
    .key = "orders",
    .kind = Kind::choice,
    .choices = orders_choices,
    .fallback = R"("all")",
    .documentation = "which orders of scattering; single and multiple add up to all"};

inline constexpr std::string_view single_orders[] = {"single"};
inline constexpr Field layers_field{.key = "layers",
                                    .kind = Kind::text_list,
                                    .documentation =
                                        "layers of the atmosphere that scatter; by default every "
                                        "one, and all of them always attenuate",
                                    .hint = "[\"mie\"]",
                                    .selector = "orders",
                                    .selected_by = single_orders};

inline constexpr Field camera_altitude_field{
    .key = "altitude",
    .kind = Kind::length,
    .range = camera_altitude_range,
    .fallback = R"("0 km")",
    .documentation = "altitude of the camera, which may be in space"};

inline constexpr Field max_error_field{
    .key = "max_error",
    .kind = Kind::fraction,
    .range = lookup_error_range,
    .documentation =
        "in place of size, asks for the smallest table whose lookups are within this error",
    .hint = "errors below 0.01 are invisible",
    .exclusive_group = "size"};

}  // namespace skybake::config
