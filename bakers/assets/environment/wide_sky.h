// The model of the asset sky_view for rows of thousands of azimuths.
#pragma once

#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"

namespace skybake {

// Returns sky_view_model with rows by wide_row.h. All arguments must outlive the model.
TableModel wide_sky_model(const SkyLight& light, const SkyViewCamera& camera, const SunZenith& sun,
                          SeenGround ground = SeenGround::lit);

}  // namespace skybake
