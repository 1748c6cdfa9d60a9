// The variants of an asset that a report compares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bakers/field/certify.h"
#include "bakers/field/table_model.h"
#include "config/sections/files.h"

namespace skybake {

// One way to make a table. Texels are a function of model, level and size; the pixel type comes
// after.
struct Variant {
    std::string family;
    std::string name;
    std::string baseline;
    bool of_recipe = false;
    bool in_quadrature_sweep = false;
    std::array<int, 2> size{};
    config::PixelType pixel_type = config::PixelType::float32;
    std::shared_ptr<const TableModel> model;
    int level = 0;
    // The model whose reference, texel convention and error are the measure; shared by all variants
    // that mean the same values at the same coordinates.
    std::shared_ptr<const TableModel> truth;
};

struct Sweep {
    std::string timing;  // what the times are
    PointCounts texels;  // at most so many are compared
    PointCounts lookups;
    std::vector<Variant> variants;
};

// Sizes of tables (2 axes) and volumes (3) that are the given one times the factors, at least 2
// texels an axis unless the size itself has 1, without those of more than `max_texels` and without
// duplicates.
template <std::size_t Axes>
std::vector<std::array<int, Axes>> sizes_around(
    std::array<int, Axes> size, const std::vector<std::array<double, Axes>>& factors,
    std::int64_t max_texels);

// The size halved on all axes until it has no more than `max_texels` (at least 2 to the number of
// axes).
template <std::size_t Axes>
std::array<int, Axes> size_within(std::array<int, Axes> size, std::int64_t max_texels);

// "256x64"
std::string size_text(std::span<const int> size);

}  // namespace skybake
