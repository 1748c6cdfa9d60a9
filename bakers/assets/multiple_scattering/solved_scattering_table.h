// The table of multiple scattering with all orders solved for (light/solver/solve_light.h).
//
//   hillaire   the mean radiance Psi = E0 / 4pi: the texture of Hillaire 2020, made of every order
//              with its layer's own phase function and of the ground's light in all of them
//   moments    moments of the light up to a degree N, one table below the other by rising l, and in
//              it by rising m: M_lm in 1/sr, the first of them Psi itself. Towards a direction
//              whose zenith angle has the cosine mu and whose azimuth from the sun is phi a km of
//              air sends
//
//                sum over layers of sigma_s sum over l of chi_l sum over m of
//                    M_lm P_l^m(mu) cos(m phi)
//
//              with the layer's Legendre moments chi_l (phase_function.h) and associated
//              Legendre functions without the sign (-1)^m: P_1^1 = sqrt(1 - mu^2).
//
// The light scattered twice or more, as a runtime reads it from a stored table.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/assets/multiple_scattering.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"
#include "config/sections/parameters.h"
#include "config/sections/scene.h"

namespace skybake {

struct Baked;

// Returns the solved light of the table, and the finer one that its certificate compares it with.
std::vector<Need> needs_of_solved_scattering(const config::Atmosphere& atmosphere,
                                             const config::MultipleScatteringBake& bake,
                                             Certification certification);

// Bakes the table. `scene` restricts it to the suns that its cameras can see at points of the air.
// `table` comes labelled. Errors are those of finish_table, and E0405 if the solution is invalid:
// negative, or without balance of energy.
Outcome<Baked> bake_solved_scattering(const config::Atmosphere& atmosphere,
                                      const std::optional<config::Scene>& scene,
                                      const config::MultipleScatteringBake& bake,
                                      const BakeOptions& options, Baked table);

// Whether the table has all orders solved; else only Hillaire's closure of the second.
bool is_solved(const config::MultipleScatteringBake& asset);

// Returns the number of tables below each other: that of the moments, or 1.
int tables_of(const config::MultipleScatteringBake& asset);

// Returns the suns of its columns.
SunColumns sun_columns_of(const Parameters& parameters,
                          const config::MultipleScatteringBake& asset);

// Returns the orders of a table as it is stored. `medium` and `table` must outlive the result.
std::unique_ptr<const HigherOrders> stored_orders(const Parameters& parameters,
                                                  const config::MultipleScatteringBake& asset,
                                                  const SkyMedium& medium,
                                                  const Image2<float>& table);

}  // namespace skybake
