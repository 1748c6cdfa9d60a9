// This header declares the asset "irradiance": the light that falls on level surfaces.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/sections/scene.h"

namespace skybake::config {

enum class IrradianceContent { direct, sky, total };

struct IrradianceBake : LightFiles {
    std::array<int, 2> size{};  // texels along the sun's cosine and along altitude
    IrradianceContent content = IrradianceContent::total;
    SkyOrders orders = SkyOrders::all;  // for content sky
    std::vector<std::string> layers;    // with orders = single: the layers that scatter; empty: all
    double max_texel_error = 0;         // quadrature error of a texel; sets the number of points
    MultipleScatteringMapping mapping = MultipleScatteringMapping::twilight;
};

}  // namespace skybake::config
