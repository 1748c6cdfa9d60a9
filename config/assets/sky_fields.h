// Keys and ranges that the assets of the sky share, for their field tables.
#pragma once

#include <array>
#include <numbers>

#include "config/assets/shared_fields.h"
#include "config/fields/fields.h"

namespace skybake::config {

inline constexpr Range elevation_range{-std::numbers::pi / 2, std::numbers::pi / 2};
inline constexpr Range camera_altitude_range{0, 1e12};
inline constexpr Range view_distance_range{1e-3, 1e12};

inline constexpr std::string_view hillaire_2020 =
    "Hillaire 2020, A Scalable and Production Ready Sky and Atmosphere Rendering Technique";

inline constexpr std::array table_pixel_type_choices = {
    Choice{"float", "32 bits per channel"},
    Choice{"half", "16 bits per channel: 3 digits, 6e-8 to 65504"},
};
inline constexpr Field table_pixel_type_field{.key = "pixel_type",
                                              .kind = Kind::choice,
                                              .choices = table_pixel_type_choices,
                                              .fallback = R"("float")",
                                              .documentation = "type of the numbers in the file"};

inline constexpr std::array orders_choices = {
    Choice{"all", "all light"},
    Choice{"single", "sunlight scattered once, in the air"},
    Choice{"multiple", "the rest: scattered more than once, or reflected by the ground"},
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

}  // namespace skybake::config
