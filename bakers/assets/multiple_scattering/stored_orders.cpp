#include "bakers/assets/multiple_scattering/stored_orders.h"

#include <optional>

#include "bakers/assets/description/probe_places.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

using config::MultipleScatteringBake;

bool is_solved(const MultipleScatteringBake& asset) {
    return asset.method == config::MultipleScatteringMethod::solved;
}

int tables_of(const MultipleScatteringBake& asset) {
    const bool moments = asset.content == config::MultipleScatteringContent::moments;
    return is_solved(asset) && moments ? moment_count(asset.degree) : 1;
}

std::unique_ptr<const HigherOrders> stored_orders(const config::Parameters& parameters,
                                                  const MultipleScatteringBake& asset,
                                                  const SkyMedium& medium,
                                                  const Image2<float>& table) {
    const Shell shell = shell_of(parameters.atmosphere);
    const auto scene = is_solved(asset) ? parameters.scene : std::nullopt;
    const PlaceInTable place = [columns = sun_columns(asset.mapping, scene, shell), shell](
                                   double altitude_km, double sun_cos_zenith) {
        return TablePlace{columns.coordinate(sun_cos_zenith), altitude_km / shell.thickness_km};
    };
    const int degree = tables_of(asset) > 1 ? asset.degree : 0;
    return std::make_unique<const TableOrders>(medium, table, degree, place);
}

}  // namespace skybake
