// The light scattered twice or more, as a runtime reads it from a stored table.
#pragma once

#include <memory>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/light/higher_orders.h"
#include "config/assets/multiple_scattering.h"
#include "config/sections/parameters.h"

namespace skybake {

// Whether the table has all orders solved; else only Hillaire's closure of the second.
bool is_solved(const config::MultipleScatteringBake& asset);

// Returns the number of tables below each other: that of the moments, or 1.
int tables_of(const config::MultipleScatteringBake& asset);

// Returns the orders of a table as it is stored. `medium` and `table` must outlive the result.
std::unique_ptr<const HigherOrders> stored_orders(const config::Parameters& parameters,
                                                  const config::MultipleScatteringBake& asset,
                                                  const SkyMedium& medium,
                                                  const Image2<float>& table);

}  // namespace skybake
